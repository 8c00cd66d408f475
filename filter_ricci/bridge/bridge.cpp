// SPDX-License-Identifier: GPL-3.0-or-later
#include "bridge.h"

#include "parameters.h"
#include "results.h"
#include "run_report.h"

#include <ricci/error.h>
#include <ricci/progress.h>

#include <vcg/complex/algorithms/update/bounding.h>
#include <vcg/complex/algorithms/update/color.h>
#include <vcg/complex/algorithms/update/normal.h>

#include <algorithm>
#include <exception>
#include <new>
#include <vector>

namespace filter_ricci {

namespace {

/// Share of the work that the map to the sphere takes beside the map to the plane.
constexpr double kSphereShare = 0.4;

class HostProgress : public ricci::Progress
{
public:
	HostProgress(vcg::CallBackPos* callback, const Log& log) : callback_(callback), log_(log) {}

	void log(const std::string& line) override { log_(line); }

	bool update(double fraction, const std::string& what) override
	{
		if (callback_ == nullptr)
			return true;
		const int percent = static_cast<int>(100.0 * std::clamp(fraction, 0.0, 1.0));
		return callback_(percent, host::progressText(what).c_str());
	}

private:
	vcg::CallBackPos* callback_;
	const Log& log_;
};

/// A part of the work of a run, on the whole's scale.
class PartOfProgress : public ricci::Progress
{
public:
	PartOfProgress(ricci::Progress& whole, double from, double to) :
			whole_(whole), from_(from), to_(to)
	{
	}

	void log(const std::string& line) override { whole_.log(line); }

	bool update(double fraction, const std::string& what) override
	{
		return whole_.update(from_ + fraction * (to_ - from_), what);
	}

private:
	ricci::Progress& whole_;
	double from_, to_;
};

MeshModel& checkedMesh(MeshDocument& md, const Settings& settings)
{
	MeshModel* model = md.mm();
	if (model == nullptr)
		throw ricci::InvalidMesh("There is no mesh. Open one first.");
	if (model->cm.fn == 0)
		throw ricci::InvalidMesh(
			model->cm.vn == 0
				? "The mesh is empty. Choose a mesh with triangles."
				: "The mesh is a point cloud: it has vertices but no faces. Reconstruct a surface "
				  "first.");
	if (settings.flow.target == ricci::TargetCurvature::Prescribed &&
		!model->hasDataMask(MeshModel::MM_VERTQUALITY))
		throw ricci::InvalidOption(
			"target_curvature is From vertex quality, but the mesh has no vertex quality. Store "
			"the curvature of each vertex, in radians, as its quality first.");
	return *model;
}

/// Fills a new layer; it disappears again when filling it fails.
MeshModel* addFlatLayer(MeshDocument& md, MeshModel& model, const Flow::Result& result)
{
	MeshModel* flat = md.addNewMesh(QString(), "Flat " + model.label(), false);
	try {
		flat->updateDataMask(MeshModel::MM_WEDGTEXCOORD | MeshModel::MM_VERTQUALITY);
		Flow::BuildFlatMesh(model.cm, result, flat->cm);
		vcg::tri::UpdateBounding<CMeshO>::Box(flat->cm);
		vcg::tri::UpdateNormal<CMeshO>::PerVertexNormalizedPerFace(flat->cm);
		host::copyTextures(model, *flat);
		return flat;
	}
	catch (...) {
		host::removeMesh(md, flat);
		throw;
	}
}

/// The same with the mesh on the sphere.
MeshModel* addSphereLayer(MeshDocument& md, MeshModel& model, const ricci::SphereMap& map)
{
	MeshModel* sphere = md.addNewMesh(QString(), "Sphere of " + model.label(), false);
	try {
		Flow::BuildSphereMesh(model.cm, map, sphere->cm);
		vcg::tri::UpdateBounding<CMeshO>::Box(sphere->cm);
		vcg::tri::UpdateNormal<CMeshO>::PerVertexNormalizedPerFace(sphere->cm);
		return sphere;
	}
	catch (...) {
		host::removeMesh(md, sphere);
		throw;
	}
}

void colorizeByDistortion(MeshModel& model, const ricci::Report& report)
{
	// A ramp needs two different ends, and a plane has no distortion at all.
	const double top = std::max(report.qcP99, 1.0 + 1e-6);
	vcg::tri::UpdateColor<CMeshO>::PerVertexQualityRamp(
		model.cm, static_cast<Scalarm>(1.0), static_cast<Scalarm>(top));
}

/// Nothing of what the filter writes is drawn by itself.
const char* whereToLook(const Settings& settings)
{
	return settings.colorize
			   ? "To see it: 'Set Texture' (Filters > Texture) lays an image on the surface; the "
				 "colours show the distortion, Render > 'Quality Histogram' how it is spread."
			   : "To see it: 'Set Texture' (Filters > Texture) lays an image on the surface; "
				 "'Colorize by vertex Quality' (Filters > Color Creation and Processing) shows the "
				 "distortion, Render > 'Quality Histogram' how it is spread.";
}

int changedElements(const Settings& settings)
{
	int elements = MeshModel::MM_WEDGTEXCOORD | MeshModel::MM_VERTQUALITY;
	if (settings.colorize)
		elements |= MeshModel::MM_VERTCOLOR;
	if (settings.flow.output == ricci::OutputTriangulation::CommonRefinement)
		elements |= MeshModel::MM_VERTNUMBER | MeshModel::MM_FACENUMBER;
	return elements;
}

void writeMesh(MeshModel& model, const Settings& settings, const Flow::Result& result)
{
	model.updateDataMask(changedElements(settings));
	if (settings.flow.output == ricci::OutputTriangulation::CommonRefinement) {
		model.clearDataMask(MeshModel::MM_FACEFACETOPO | MeshModel::MM_VERTFACETOPO);
		Flow::WriteRefinement(model.cm, result);
		vcg::tri::UpdateNormal<CMeshO>::PerFaceNormalized(model.cm);
	}
	else {
		Flow::WriteWedgeTexCoord(model.cm, result);
		Flow::WriteVertexQuality(model.cm, result);
	}
	if (settings.colorize)
		colorizeByDistortion(model, result.report);
}

/// The new layers, which need the most memory, come first: a failure there leaves the mesh alone.
void writeResult(
	MeshDocument& md,
	MeshModel& model,
	const Settings& settings,
	const Flow::Result& result,
	const ricci::SphereMap& sphere)
{
	std::vector<MeshModel*> layers;
	try {
		if (settings.flatLayer)
			layers.push_back(addFlatLayer(md, model, result));
		if (settings.sphereLayer)
			layers.push_back(addSphereLayer(md, model, sphere));
		writeMesh(model, settings, result);
	}
	catch (...) {
		for (MeshModel* layer : layers)
			host::removeMesh(md, layer);
		throw;
	}
}

} // namespace

int preConditions()
{
	return MeshModel::MM_FACENUMBER;
}

int postConditions()
{
	return MeshModel::MM_WEDGTEXCOORD | MeshModel::MM_VERTQUALITY | MeshModel::MM_VERTCOLOR |
		   MeshModel::MM_VERTNUMBER | MeshModel::MM_FACENUMBER;
}

Outcome applyFilter(
	int filter,
	const RichParameterList& par,
	MeshDocument& md,
	vcg::CallBackPos* callback,
	const Log& log)
{
	const Settings settings = readSettings(filter, par);
	MeshModel& model = checkedMesh(md, settings);
	const ReportFiles reportFiles(settings.report, model.pathName());
	HostProgress progress(callback, log);
	// The sphere first: it refuses most surfaces.
	const double share = settings.sphereLayer ? kSphereShare : 0.0;
	PartOfProgress before(progress, 0.0, share), after(progress, share, 1.0);
	ricci::SphereMap sphere;
	if (settings.sphereLayer)
		sphere = Flow::ComputeSphere(model.cm, settings.flow, before);
	const Flow::Result result = Flow::Compute(model.cm, settings.flow, after);
	Results results = toResults(result.report);
	if (settings.sphereLayer)
		addSphereResults(sphere, results);
	// Before the mesh, so that a full disk leaves it as it was.
	const std::vector<std::string> written = reportFiles.write(
		{filterText(filter).name.toStdString(),
		 model.shortName().toStdString(),
		 settingsAsText(par),
		 result.notes,
		 results,
		 result.report});
	writeResult(md, model, settings, result, sphere);
	for (const std::string& line : toLogLines(results))
		log(line);
	for (const std::string& file : written)
		log("Report: " + file);
	log(whereToLook(settings));
	return {results, changedElements(settings)};
}

std::string currentErrorSentence()
{
	try {
		throw;
	}
	catch (const ricci::Error& error) {
		return error.what();
	}
	catch (const std::bad_alloc&) {
		return "There is not enough memory for this mesh. The mesh is unchanged.";
	}
	catch (const std::exception& error) {
		return std::string("The filter failed unexpectedly (") + error.what() +
			   "). Please report this, with the mesh if you can.";
	}
	catch (...) {
		return "The filter failed unexpectedly, for an unknown reason. Please report this, with "
			   "the "
			   "mesh if you can.";
	}
}

} // namespace filter_ricci
