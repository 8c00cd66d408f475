// SPDX-License-Identifier: GPL-3.0-or-later
#include "bridge.h"

#include "carried_texture.h"
#include "error_sentences.h"
#include "free_memory.h"
#include "parameters.h"
#include "results.h"
#include "run_report.h"

#include <ricci/base/numbers.h>
#include <ricci/base/task.h>

#include <vcg/complex/algorithms/parametrization/ricci_flow_layers.h>
#include <vcg/complex/algorithms/parametrization/ricci_seams.h>
#include <vcg/complex/algorithms/update/bounding.h>
#include <vcg/complex/algorithms/update/color.h>
#include <vcg/complex/algorithms/update/normal.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace filter_ricci {

namespace {

using Flow = vcg::tri::RicciFlow<CMeshO>;
using Layers = vcg::tri::RicciFlowLayers<CMeshO>;

/// Share of the map to the sphere in the work of both maps.
constexpr double kSphereShare = 0.4;

/// Share of the texture in the work of a run.
constexpr double kTextureShare = 0.15;

/// Faces that the layer of the universal cover may have at most.
constexpr std::size_t kMaxCoverFaces = 5000000;

/// Edges of one drawn geodesic.
constexpr int kGeodesicPieces = 200;

/// Sentences name a parameter by its id in braces: with the name that the user knows, the label in a window
/// and the id in a script.
std::string withNames(int filter, std::string text)
{
	for (const Parameter& parameter : filterParameters(filter)) {
		const std::string id = "{" + parameter.name + "}";
		const std::string name = !host::hasWindow() ? parameter.name
								 : parameter.place == Place::Options
									 ? parameter.name + " ('Options')"
									 : "'" + parameter.label + "'";
		for (std::size_t at = 0; (at = text.find(id, at)) != std::string::npos;)
			text.replace(at, id.size(), name);
	}
	return text;
}

/// Passes everything on, log lines with names.
class Named : public ricci::Progress
{
public:
	Named(int filter, ricci::Progress& listener) : m_filter(filter), m_listener(listener) {}

	void log(const std::string& line) override { m_listener.log(withNames(m_filter, line)); }

	bool update(double fraction, const std::string& what) override
	{
		return m_listener.update(fraction, what);
	}

private:
	int m_filter;
	ricci::Progress& m_listener;
};

/// Whether the vertex quality is a distortion: with the filter's attribute beside it, 1 or more everywhere,
/// and more altogether than the curvature of a sphere.
bool isOwnOutput(const CMeshO& m)
{
	double sum = 0.0, least = 1.0;
	for (const CVertexO& v : m.vert)
		if (!v.IsD()) {
			sum += static_cast<double>(v.cQ());
			least = std::min(least, static_cast<double>(v.cQ()));
		}
	return vcg::tri::HasPerVertexAttribute(m, "ricci_u") && least > 1.0 - 1e-6 &&
		   sum > 4.0 * ricci::kPi + 1e-3;
}

/// Sides of faces at chosen seams, for each face: beyond it they part more faces than they leave joined.
constexpr int kManySeams = 2;

/// Vertices, faces, and extents as the mesh is seen.
std::string sizeOf(const CMeshO& m)
{
	std::string size = std::to_string(m.vn) + " vertices, " + std::to_string(m.fn) + " faces, ";
	const Box3m box = m.trBB();
	for (int k = 0; k < 3; ++k)
		size += (k == 0 ? "" : " x ") + ricci::numberText(static_cast<double>(box.Dim()[k]), 4);
	return size;
}

/// Whether the layer's matrix changes angles: what is seen then is another surface than the file's.
bool isStretched(const CMeshO& m)
{
	double product[3][3] = {};
	for (int i = 0; i < 3; ++i)
		for (int j = 0; j < 3; ++j)
			for (int k = 0; k < 3; ++k)
				product[i][j] += static_cast<double>(m.Tr[k][i]) * static_cast<double>(m.Tr[k][j]);
	double worst = 0.0;
	for (int i = 0; i < 3; ++i)
		for (int j = 0; j < 3; ++j)
			worst = std::max(worst, std::abs(product[i][j] - (i == j ? product[0][0] : 0.0)));
	return worst > 1e-5 * product[0][0];
}

MeshModel& checkedMesh(MeshDocument& md, bool readsQuality)
{
	MeshModel* model = md.mm();
	if (model == nullptr)
		throw Refusal("There is no mesh. Open one first.");
	if (model->cm.fn == 0)
		throw Refusal(
			model->cm.vn == 0
				? "The mesh is empty. Choose a mesh with triangles."
				: "The mesh is a point cloud: it has vertices but no faces. Reconstruct a surface "
				  "first.");
	if (readsQuality && !model->hasDataMask(MeshModel::MM_VERTQUALITY))
		throw Refusal(
			"{target_curvature} is 'From vertex quality', but the mesh has no vertex quality. "
			"Store the curvature of each vertex, in radians, as its quality first.");
	if (readsQuality && isOwnOutput(model->cm))
		throw Refusal(
			"{target_curvature} is 'From vertex quality', but the quality is the distortion that "
			"this filter has written, not a curvature. Its own target is back with "
			"'Per Vertex Quality Function' and the function ricci_target_curvature.");
	return *model;
}

/// What the surface is to be opened by: sides of faces, or a map; and what is not to be joined.
struct Openings
{
	Flow::SideMarks marks;
	Flow::TextureMap map;
	Flow::Parts parts;
};

/// \throw Refusal if the mesh has none of what was chosen
Openings chosenSeams(const MeshModel& model, Seams seams)
{
	using Chosen = vcg::tri::RicciSeams<CMeshO>;
	Openings openings;
	openings.parts = host::parts(model);
	Flow::SideMarks& marks = openings.marks;
	if (seams == Seams::Texture) {
		if (!model.hasDataMask(MeshModel::MM_WEDGTEXCOORD) &&
			!model.hasDataMask(MeshModel::MM_VERTTEXCOORD))
			throw Refusal(
				"{seams} is 'Existing texture seams', or charts are to stay as they are, but the "
				"mesh has no texture coordinates: open one that has them, or choose otherwise.");
		openings.map = Flow::ReadMap(model.cm);
	}
	else if (seams == Seams::SelectedEdges) {
		marks = Chosen::OfSelectedEdges(model.cm);
		if (marks.empty())
			throw Refusal("{seams} is 'Selected edges', but no edge of a face is selected: select "
						  "some first ('Select Crease Edges'), or choose other seams.");
	}
	else if (seams == Seams::SelectedFaces) {
		marks = Chosen::OfSelectedFaces(model.cm);
		if (marks.empty())
			throw Refusal(
				"{seams} is 'Border of selected faces', but no edge lies between a selected face "
				"and another: select a part of the surface first, or choose other seams.");
	}
	return openings;
}

/// The colours of all vertices as one number, for knowing them again.
std::size_t fingerprint(const CMeshO& m)
{
	std::size_t sum = 14695981039346656037u; // FNV-1a
	for (const CVertexO& v : m.vert)
		for (int k = 0; k < 4; ++k)
			sum = (sum ^ v.cC()[k]) * 1099511628211u;
	return sum;
}

/// The attribute of a mesh that holds the fingerprint of the colours which the filter has given it.
const char* const kOwnColours = "ricci_colours";

/// The paper's colours (5.1): blue where angles are kept, red at \p top and above.
void colorizeByDistortion(MeshModel& model, double top)
{
	// The ramp of vcglib begins with red, so its ends change places.
	vcg::tri::UpdateColor<CMeshO>::PerVertexQualityRamp(
		model.cm, static_cast<Scalarm>(top), static_cast<Scalarm>(1.0));
}

/// Whether the colours show the distortion of an earlier run, and are not those that others have given.
bool hasOwnColours(MeshModel& model)
{
	using Allocator = vcg::tri::Allocator<CMeshO>;
	auto own = Allocator::FindPerMeshAttribute<std::size_t>(model.cm, kOwnColours);
	return Allocator::IsValidHandle(model.cm, own) && own() == fingerprint(model.cm);
}

void removeColours(MeshModel& model)
{
	vcg::tri::UpdateColor<CMeshO>::PerVertexConstant(model.cm, vcg::Color4b(vcg::Color4b::White));
	model.clearDataMask(MeshModel::MM_VERTCOLOR);
}

/// Layers that one run adds to a document. They are removed again unless the run reaches its end.
class NewLayers
{
public:
	NewLayers(MeshDocument& md, const MeshModel& model, const Flow::Result& result) :
			m_md(md), m_model(model), m_result(result)
	{
	}
	NewLayers(const NewLayers&) = delete;
	NewLayers& operator=(const NewLayers&) = delete;
	~NewLayers()
	{
		for (MeshModel* layer : m_layers)
			host::removeMesh(m_md, layer);
	}

	/// Adds one that lies where \p build, which is called with its mesh, puts it.
	/// \param elements MeshModel::MeshElement bits
	template<class Build>
	MeshModel& add(const std::string& name, int elements, const Build& build)
	{
		m_layers.reserve(m_layers.size() + 1);
		m_layers.push_back(host::addMesh(m_md, name + " " + host::label(m_model)));
		MeshModel& layer = *m_layers.back();
		layer.updateDataMask(elements);
		build(layer.cm);
		vcg::tri::UpdateBounding<CMeshO>::Box(layer.cm);
		if (layer.cm.fn > 0)
			vcg::tri::UpdateNormal<CMeshO>::PerVertexNormalizedPerFace(layer.cm);
		return layer;
	}

	/// Adds one that lies in the plane of the charts, and shows it beside the mesh and as large, by its matrix: its
	/// coordinates stay those of the charts.
	template<class Build>
	MeshModel& addBeside(const std::string& name, int elements, const Build& build)
	{
		MeshModel& layer = add(name, elements, build);
		const Box3m mesh = m_model.cm.trBB();
		if (mesh.IsNull()) // nobody has filled it in
			return layer;
		ricci::Box2 charts;
		for (const ricci::Chart& chart : m_result.charts)
			charts.add(chart.box);
		const double size = static_cast<double>(mesh.Dim()[mesh.MaxDim()]);
		const double scale = size / charts.extent();
		const ricci::Point2 middle = charts.centre();
		const double to[3] = {
			static_cast<double>(mesh.max[0]) + 0.1 * size + scale * (middle[0] - charts.min[0]),
			static_cast<double>(mesh.Center()[1]),
			static_cast<double>(mesh.Center()[2])};
		const auto factor = static_cast<Scalarm>(scale);
		layer.cm.Tr.SetScale(factor, factor, factor);
		for (int k = 0; k < 3; ++k)
			layer.cm.Tr[k][3] = static_cast<Scalarm>(
				to[k] - scale * (k < 2 ? middle[static_cast<std::size_t>(k)] : 0.0));
		return layer;
	}

	void keep() { m_layers.clear(); }

private:
	MeshDocument& m_md;
	const MeshModel& m_model;
	const Flow::Result& m_result;
	std::vector<MeshModel*> m_layers;
};

/// A line of the log.
std::string polygonLine(const ricci::CanonicalPolygon& polygon)
{
	if (polygon.corners.empty())
		return "Canonical polygon: not drawn, because its sides are too long to close up in "
			   "floating point numbers.";
	return "Canonical polygon: " + std::to_string(polygon.corners.size()) + " sides, " +
		   (polygon.isSimple ? "none crosses another" : "some cross each other") +
		   ", and the last one ends " + ricci::numberText(polygon.gap, 2) +
		   " beside the first corner.";
}

/// The host draws nothing of what the filter writes until it is told to.
std::string whereToLook(bool colorize, const Results& results)
{
	const std::string colours = colorize ? "The colours show the distortion, from " +
											   colourRamp(results) + " (drawn where Color is Vert)"
										 : "Filters > Color Creation and Processing > 'Colorize by "
										   "vertex Quality' colours the mesh by angle distortion";
	return "To see it: Filters > Texture > 'Set Texture' applies an image, such as a checkerboard, "
		   "to the surface. " +
		   colours + "; Render > '" + host::kHistogramName + "' shows its distribution.";
}

int changedElements(bool colorize, bool hasTexture, ricci::OutputTriangulation output)
{
	int elements = MeshModel::MM_WEDGTEXCOORD | MeshModel::MM_VERTQUALITY;
	if (colorize)
		elements |= MeshModel::MM_VERTCOLOR;
	if (hasTexture)
		elements |= MeshModel::MM_FACECOLOR;
	if (output == ricci::OutputTriangulation::CommonRefinement)
		elements |= MeshModel::MM_VERTNUMBER | MeshModel::MM_FACENUMBER;
	return elements;
}

void writeMesh(
	MeshModel& model,
	bool colorize,
	ricci::OutputTriangulation output,
	const Flow::Result& result,
	const Outcome& outcome,
	const CarriedTexture& texture)
{
	const bool hadOwnColours = hasOwnColours(model);
	auto own = vcg::tri::Allocator<CMeshO>::GetPerMeshAttribute<std::size_t>(model.cm, kOwnColours);
	model.updateDataMask(changedElements(colorize, false, output));
	if (output == ricci::OutputTriangulation::CommonRefinement) {
		model.clearDataMask(MeshModel::MM_FACEFACETOPO | MeshModel::MM_VERTFACETOPO);
		Flow::WriteRefinement(model.cm, result);
		vcg::tri::UpdateNormal<CMeshO>::PerFaceNormalized(model.cm);
	}
	else {
		Flow::WriteVertexQuality(model.cm, result); // first, because memory may run out there
		Flow::WriteWedgeTexCoord(model.cm, result);
	}
	texture.assignTo(model, outcome.origin);
	if (colorize) {
		colorizeByDistortion(model, colourRampTop(outcome.results));
		own() = fingerprint(model.cm);
	}
	else if (hadOwnColours)
		removeColours(model);
}

/// The texels that padding is counted in, before the map is known.
int texelsOf(const CarriedTexture& texture, const TextureSettings& settings)
{
	return texture.isWanted()  ? texture.size()
		   : settings.size > 0 ? settings.size
							   : TextureSettings().size;
}

/// The flow with the padding between its charts, or what a texture needs.
/// \throw Refusal if so many charts do not fit into a texture
Flow::Result computeFor(
	const CarriedTexture& texture, MeshModel& model, Settings& settings, const Openings& seams)
{
	const int texels = texelsOf(texture, settings.texture);
	double& margin = settings.flow.chartMargin;
	margin = std::min(static_cast<double>(settings.padding) / texels, ricci::kMaxChartMargin);
	if (texture.minMargin() > margin) {
		margin = texture.minMargin();
		ricci::logLine(
			"Texture: its charts are kept " + ricci::numberText(margin * texels, 3) +
			" pixels apart, more than {padding}.");
	}
	Flow::Result result =
		Flow::Compute(model.cm, settings.flow, seams.marks, seams.map, seams.parts);
	if (result.report.margin < texture.minMargin())
		throw Refusal(
			"There are " + std::to_string(result.report.charts) +
			(texels < kMaxTextureSize
				 ? " charts, too many to be kept apart in a texture of this size: raise "
				   "{texture_size}, to " +
					   std::to_string(kMaxTextureSize) + " at most."
				 : " charts, too many to be kept apart in any texture: leave {carry_texture} "
				   "empty."));
	return result;
}

/// See Outcome. Before the mesh is written.
void tellOrigins(
	const ricci::FlatMesh& map,
	const CMeshO& m,
	ricci::OutputTriangulation output,
	Outcome& outcome)
{
	for (std::size_t f = 0; f < m.face.size(); ++f)
		outcome.origin.push_back(static_cast<int>(f));
	outcome.chart.assign(m.face.size(), -1);
	std::vector<char> taken(m.face.size(), 0);
	for (const int i : map.points.indices()) {
		const auto f = static_cast<std::size_t>(map.face[i]);
		if (taken[f] && output == ricci::OutputTriangulation::CommonRefinement) {
			outcome.origin.push_back(map.face[i]);
			outcome.chart.push_back(map.chart[i]);
		}
		else
			outcome.chart[f] = map.chart[i];
		taken[f] = 1;
	}
}

/// What the runs of both filters share: what is read first, and how the result is written.
class Run
{
public:
	/// \throw Refusal for a mesh or a file that cannot be used
	Run(int filter,
		const Parameters& par,
		const RunSettings& settings,
		MeshDocument& md,
		bool readsQuality,
		ricci::Progress& listener) :
			task(listener, settings.timeLimit),
			model(checkedMesh(md, readsQuality)), seams(chosenSeams(model, settings.seams)),
			texture(settings.texture, model), m_filter(filter), m_par(par), m_settings(settings),
			m_md(md), m_report(settings.report, host::folder(model))
	{
		task.setMemoryLimit(freeMemory()); // beside the pictures
	}

	/// Share of the flow in the whole work.
	double flowShare() const { return texture.isWanted() ? 1.0 - kTextureShare : 1.0; }

	/// The order of writing: first the files, beside their places, because the disk may be full; then
	/// the new layers, which need the most memory; then the files move to their places, and last the
	/// mesh changes. So a failure leaves the mesh as it was, and before the files move also those.
	/// \param addLayers adds those beside the flat one
	template<class AddLayers>
	Outcome
	end(ricci::OutputTriangulation output,
		const Flow::Result& result,
		Results results,
		const AddLayers& addLayers)
	{
		const double drawn = 0.5 * (flowShare() + 1.0);
		{
			const ricci::Task drawing(flowShare(), drawn);
			texture.draw(result, results);
		}
		{
			const ricci::Task writing(drawn, 1.0);
			texture.write();
		}
		results.push_back(
			{"padding_pixels",
			 result.report.margin * texelsOf(texture, m_settings.texture),
			 "Pixels between charts and to the border"});
		Outcome outcome;
		outcome.sentences = summary(result.report, results);
		outcome.details = {toReason(results, result.report.choice)};
		RunReport report{
			filterText(m_filter).name,
			host::name(model),
			sizeOf(model.cm),
			m_par,
			outcome.sentences,
			results,
			result};
		for (const std::vector<std::string>& more : {outcome.details, result.notes})
			report.notes.insert(report.notes.end(), more.begin(), more.end());
		for (std::string& note : report.notes)
			note = withNames(m_filter, note);
		m_report.write(report);
		NewLayers layers(m_md, model, result);
		ricci::advance(1.0, "Adding the layers");
		if (m_settings.flatLayer)
			addFlatLayer(layers, result, results);
		addLayers(layers);
		ricci::checkpoint();
		texture.publish();
		for (const std::string& file : m_report.publish())
			outcome.details.push_back("Report: " + file);
		const bool recolours = m_settings.colorize || hasOwnColours(model);
		outcome.changedElements = changedElements(recolours, texture.isWanted(), output);
		outcome.results = std::move(results);
		tellOrigins(result.mesh, model.cm, output, outcome);
		writeMesh(model, m_settings.colorize, output, result, outcome, texture);
		layers.keep();
		return outcome;
	}

	ricci::Task task;
	MeshModel& model;
	const Openings seams;
	CarriedTexture texture;
	std::string noSphere; ///< why there is no map to the sphere that was asked for

private:
	void addFlatLayer(NewLayers& layers, const Flow::Result& result, const Results& results)
	{
		MeshModel& layer = layers.addBeside(
			m_filter == Hyperbolic ? "Disk" : "Flat",
			MeshModel::MM_WEDGTEXCOORD | MeshModel::MM_VERTQUALITY,
			[&](CMeshO& m) { Layers::BuildFlatMesh(result, m); });
		if (texture.isWanted())
			texture.assignTo(layer, {});
		else
			host::copyTextures(model, layer);
		if (m_settings.colorize) {
			layer.updateDataMask(MeshModel::MM_VERTCOLOR);
			colorizeByDistortion(layer, colourRampTop(results));
		}
	}

	std::vector<std::string> summary(const ricci::Report& report, const Results& results) const
	{
		std::vector<std::string> lines{toSentence(m_filter, results)};
		for (const auto& more :
			 {doubts(m_filter, results, m_par), ignored(m_filter, results, m_par)})
			lines.insert(lines.end(), more.begin(), more.end());
		if (!noSphere.empty())
			lines.push_back(noSphere + " There is no sphere layer.");
		if (report.piecesApart > 0)
			lines.push_back("{join_vertices} 'Always' joins pieces that touch along edges without "
							"sharing vertices.");
		if (!seams.map.empty() && report.chosenSeamEdges == 0)
			lines.push_back("The UVs are continuous across every edge inside the surface: its "
							"border is the only seam to keep.");
		if (isStretched(model.cm))
			lines.push_back("The matrix of the layer stretches the mesh: the mesh is flattened and "
							"measured as it is displayed.");
		if (2 * report.chosenSeamEdges > kManySeams * model.cm.fn)
			lines.push_back(
				"The surface is cut at " + std::to_string(report.chosenSeamEdges) +
				" chosen edges, which are most of its edges: many charts are single faces.");
		if (!texture.isWanted() && !model.cm.textures.empty())
			lines.push_back("The texture of the mesh no longer fits its UVs: {carry_texture} bakes "
							"it for the new ones.");
		return lines;
	}

	int m_filter;
	const Parameters& m_par;
	const RunSettings& m_settings;
	MeshDocument& m_md;
	ReportFiles m_report;
};

Outcome applyEuclidean(const Parameters& par, MeshDocument& md, ricci::Progress& listener)
{
	Settings settings = readSettings(par);
	Run run(
		Euclidean,
		par,
		settings,
		md,
		settings.flow.target == ricci::TargetCurvature::Prescribed,
		listener);
	const double share = settings.sphereLayer ? kSphereShare : 0.0;
	ricci::SphereMap sphere;
	if (settings.sphereLayer) {
		const ricci::Task before(0.0, share);
		try {
			sphere = Flow::ComputeSphere(run.model.cm, settings.flow);
		}
		catch (const ricci::InvalidOption& e) {
			settings.sphereLayer = false;
			run.noSphere = sentence(e);
		}
	}
	const Flow::Result result = [&] {
		const ricci::Task flow(share, run.flowShare());
		return computeFor(run.texture, run.model, settings, run.seams);
	}();
	Results results = toResults(result.report);
	addPlacedCones(result, results);
	if (settings.sphereLayer)
		addSphereResults(sphere, results);
	return run.end(settings.flow.output, result, results, [&](NewLayers& layers) {
		if (settings.sphereLayer)
			layers.add("Sphere of", 0, [&](CMeshO& m) {
				Layers::BuildSphereMesh(run.model.cm, sphere, m);
			});
	});
}

Outcome applyHyperbolic(const Parameters& par, MeshDocument& md, ricci::Progress& listener)
{
	HyperbolicSettings settings = readHyperbolicSettings(par);
	Run run(
		Hyperbolic,
		par,
		settings,
		md,
		settings.flow.target == ricci::HyperbolicTarget::Prescribed,
		listener);
	const Flow::Result result = [&] {
		const ricci::Task flow(0.0, run.flowShare());
		return Flow::ComputeHyperbolic(
			run.model.cm, settings.flow, run.seams.marks, run.seams.map, run.seams.parts);
	}();
	Results results = toResults(result.report);
	if (result.report.components - result.report.leftOutComponents == 1 &&
		result.charts.front().group.isCanonical())
		addGenerators(result.charts.front().group, results);
	return run.end(settings.flow.output, result, results, [&](NewLayers& layers) {
		if (settings.coverRings > 0)
			layers.addBeside(
				"Universal cover",
				MeshModel::MM_VERTCOLOR | MeshModel::MM_VERTQUALITY,
				[&](CMeshO& m) {
					Layers::BuildUniversalCover(result, settings.coverRings, kMaxCoverFaces, m);
				});
		if (settings.axes)
			layers.addBeside(
				"Axes", 0, [&](CMeshO& m) { Layers::BuildAxes(result, kGeodesicPieces, m); });
		if (settings.canonicalPolygon)
			layers.addBeside("Canonical polygon", 0, [&](CMeshO& m) {
				for (const auto& p : Layers::BuildCanonicalPolygons(result, kGeodesicPieces, m))
					ricci::logLine(polygonLine(p));
			});
	});
}

} // namespace

int preConditions()
{
	return MeshModel::MM_FACENUMBER;
}

int postConditions()
{
	return changedElements(true, false, ricci::OutputTriangulation::CommonRefinement);
}

Outcome applyFilter(int filter, const Parameters& par, MeshDocument& md, ricci::Progress& listener)
{
	const auto start = std::chrono::steady_clock::now();
	Named progress(filter, listener);
	Outcome outcome = filter == Hyperbolic ? applyHyperbolic(par, md, progress)
										   : applyEuclidean(par, md, progress);
	const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
	outcome.sentences.front() +=
		" It took " + ricci::numberText(std::round(100.0 * elapsed.count()) / 100.0, 6) + " s.";
	for (std::string& line : outcome.sentences)
		line = withNames(filter, line);
	std::vector<std::string> first = outcome.sentences, then = outcome.details;
	if (*host::kHistogramName != 0)
		first.push_back(whereToLook(valueOf<bool>(par, "colorize"), outcome.results));
	for (std::string& line : toLogLines(outcome.results))
		then.push_back(std::move(line));
	if (host::hasWindow()) // it shows the end of the log
		first.swap(then);
	for (const std::vector<std::string>& lines : {first, then})
		for (const std::string& line : lines)
			listener.log(line);
	return outcome;
}

std::string failure(int filter)
{
	return withNames(filter, currentErrorSentence());
}

} // namespace filter_ricci
