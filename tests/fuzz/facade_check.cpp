// SPDX-License-Identifier: GPL-3.0-or-later
#include "facade_check.h"

#include "hostile_mesh.h"
#include "support/mesh_contents.h"
#include "support/random.h"
#include "support/shapes.h"
#include "support/vcg_mesh.h"

#include <bridge/error_sentences.h>

#include <ricci/base/points.h>
#include <ricci/error.h>
#include <ricci/mesh/opened_mesh.h>

#include <vcg/complex/algorithms/parametrization/ricci_flow_layers.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <map>
#include <utility>
#include <vector>

namespace ricci::testing {

namespace {

using filter_ricci::sentence;

/// Calls of the progress that no mesh needs, and more for each face: an endless loop.
constexpr int kMaxSteps = 100000, kMaxStepsPerFace = 1000;

/// Once in so many executions the same input is run twice and the results are compared.
constexpr int kRepeat = 16;

class Watch : public Progress
{
public:
	Watch(int cancelAt, std::size_t faces) :
			m_cancelAt(cancelAt), m_maxSteps(kMaxSteps + kMaxStepsPerFace * static_cast<int>(faces))
	{
	}

	bool update(double fraction, const std::string& what) override
	{
		if (!(fraction >= m_last && fraction <= 1.0))
			defect =
				"progress goes from " + std::to_string(m_last) + " to " + std::to_string(fraction);
		m_last = fraction;
		if (what.empty())
			defect = "a stage has no name";
		if (++m_steps > m_maxSteps)
			defect = "there is no end";
		return m_steps - 1 != m_cancelAt && m_steps <= m_maxSteps;
	}
	void log(const std::string& line) override
	{
		if (line.empty() || line.find('\n') != std::string::npos)
			defect = "a line of the log is empty or has a line end";
	}

	std::string defect;

private:
	int m_cancelAt, m_maxSteps, m_steps = 0;
	double m_last = 0.0;
};

template<class Mesh>
void build(const HostileMesh& hostile, Mesh& m)
{
	toVcg(hostile.mesh, m);
	for (std::size_t v = 0; v < m.vert.size(); ++v) {
		m.vert[v].Q() = static_cast<typename Mesh::ScalarType>(hostile.quality[v]);
		if (hostile.selected[v])
			m.vert[v].SetS();
	}
	for (std::size_t f = 0; f < m.face.size(); ++f)
		if (hostile.deletedFace[f])
			vcg::tri::Allocator<Mesh>::DeleteFace(m, m.face[f]);
	for (std::size_t v = 0; v < m.vert.size(); ++v)
		if (hostile.deletedVertex[v])
			vcg::tri::Allocator<Mesh>::DeleteVertex(m, m.vert[v]);
}

/// What the façade reads, cut open as the core does it.
struct Reading
{
	SurfaceMesh mesh;
	std::vector<int> face; // [face of mesh] its number in the VCG mesh
	OpenedMesh opened;
	std::vector<int> wanted;        // [VCG face] orientation in the plane; 0 of one without area
	std::vector<char> isDegenerate; // [VCG face]

	template<class Mesh>
	Reading(const Mesh& m, const SideMarks& seams, OneSidedCut cut, double sharpAngle) :
			wanted(m.face.size(), 0), isDegenerate(m.face.size(), 0)
	{
		mesh = fromVcg(m);
		mesh.absent = m.vert.size() - static_cast<std::size_t>(m.vn);
		for (std::size_t v = 0; v < m.vert.size(); ++v)
			if (m.vert[v].IsD())
				mesh.positions[v] = {0, 0, 0};
		for (std::size_t f = 0; f < m.face.size(); ++f)
			if (!m.face[f].IsD()) {
				face.push_back(static_cast<int>(f));
				if (!seams.empty())
					mesh.seam.push_back(seams[f]);
			}
		opened = openMesh(mesh, cut, FlowOptions().join, sharpAngle);
		for (std::size_t f = 0; f < opened.face.size(); ++f)
			wanted[inVcg(opened.face[f])] = opened.reversed[Face(f)] ? -1 : 1;
		for (const int f : opened.degenerate)
			isDegenerate[inVcg(f)] = 1;
	}

	std::size_t inVcg(int f) const { return at(face[at(f)]); }
};

std::array<Point2, 3> asWritten(const std::array<Point2, 3>& p)
{
	std::array<Point2, 3> rounded;
	for (std::size_t k = 0; k < 3; ++k)
		for (std::size_t i = 0; i < 2; ++i) {
			volatile float x = static_cast<float>(p[k][i]);
			rounded[k][i] = x;
		}
	return rounded;
}

std::string contradictionOf(const Report& r, const OpenedMesh& opened)
{
	if (r.cutNonmanifoldEdges != opened.cutEdges || r.splitVertices != opened.splitVertices ||
		r.duplicateFaces != opened.duplicateFaces ||
		r.oneSidedComponents != opened.oneSidedComponents ||
		r.degenerateFaces != static_cast<int>(opened.degenerate.size()))
		return "the report counts other cuts";
	if (r.components != opened.componentCount)
		return std::to_string(r.components) + " components in the report";
	return {};
}

/// Barycentric coordinates of \p p in the triangle \p t; false if it is not there. Vertices at the same place
/// are the same point: where they are joined, a point of an edge is told by those of either face.
bool coordinatesIn(
	const std::vector<Point3>& place, const Triangle& t, const SurfacePoint& p, Point3& weight)
{
	weight = {0, 0, 0};
	for (std::size_t i = 0; i < 4; ++i) {
		const auto same = [&](int v) {
			return p.vertex[i] >= 0 && place[at(v)] == place[at(p.vertex[i])];
		};
		auto corner = std::find(t.begin(), t.end(), p.vertex[i]);
		if (corner == t.end())
			corner = std::find_if(t.begin(), t.end(), same);
		const auto k = corner - t.begin();
		if (k < 3)
			weight[static_cast<std::size_t>(k)] += p.weight[i];
		else if (p.weight[i] != 0.0)
			return false;
	}
	return true;
}

/// Whether the longest side of a face is not more than \p ratio times the shortest one.
bool isEven(const SurfaceMesh& mesh, double ratio)
{
	double shortest = std::numeric_limits<double>::infinity(), longest = 0.0;
	for (const Triangle& t : mesh.triangles)
		for (std::size_t k = 0; k < 3; ++k) {
			const double side =
				distance(mesh.positions[at(t[k])], mesh.positions[at(t[(k + 1) % 3])]);
			longest = std::max(longest, side);
			if (t[k] != t[(k + 1) % 3])
				shortest = std::min(shortest, side);
		}
	return longest <= ratio * shortest;
}

/// Whether the pieces of every face cover it once.
std::string defectOfPieces(const Reading& reading, const FlatMesh& refined, std::size_t vertices)
{
	constexpr double kTolerance = 1e-6, kEven = 1e6;
	std::map<int, std::pair<int, double>> covered; // [VCG face] pieces, their part of the area
	std::map<int, std::size_t> number;
	for (std::size_t f = 0; f < reading.face.size(); ++f)
		number[reading.face[f]] = f;
	for (std::size_t v = 0; v < vertices; ++v)
		if (refined.source.values()[v].vertex[0] != static_cast<int>(v) ||
			refined.source.values()[v].weight[0] != 1.0)
			return "a point of the refinement is not the vertex of its number";
	for (const int i : refined.vertices.indices()) {
		const int f = refined.face[i];
		if (number.count(f) == 0)
			return "a piece belongs to no face";
		const Triangle& t = reading.mesh.triangles[number[f]];
		auto& [pieces, area] = covered[f];
		++pieces;
		if (reading.isDegenerate[at(f)]) {
			if (refined.vertices[i] != t || pieces > 1)
				return "a face without area is not drawn as it is";
			continue;
		}
		Point3 w[3];
		for (std::size_t k = 0; k < 3; ++k)
			if (!coordinatesIn(
					reading.mesh.positions, t, refined.source[refined.vertices[i][k]], w[k]) ||
				std::min({w[k][0], w[k][1], w[k][2]}) < -kTolerance)
				return "a piece lies outside its face";
		const double part = w[0][0] * (w[1][1] * w[2][2] - w[1][2] * w[2][1]) -
							w[0][1] * (w[1][0] * w[2][2] - w[1][2] * w[2][0]) +
							w[0][2] * (w[1][0] * w[2][1] - w[1][1] * w[2][0]);
		if (part < -kTolerance && isEven(reading.mesh, kEven))
			return "a piece is flipped in its face";
		area += part;
	}
	for (const int f : reading.face) {
		if (covered.count(f) == 0)
			return "a face has no piece";
		if (!reading.isDegenerate[at(f)] && std::abs(covered[f].second - 1.0) > kTolerance)
			return "the pieces of a face cover " + std::to_string(covered[f].second) + " of it";
	}
	return {};
}

/// Whether the flow was asked for its target, floats have room for the map, its cones are those that the
/// filter chose, and charts may be cut: of such a map no face may be flipped once it is finished.
bool isOrdinary(const HostileMesh& hostile, const Reading& reading, const Report& report)
{
	return !hostile.hyperbolic && isFinished(hostile.options) &&
		   hostile.options.charts != Charts::OfTheFlow &&
		   hostile.options.target == TargetCurvature::Automatic && hostile.options.epsilon < 1e-6 &&
		   isEven(reading.mesh, 1e3) && report.areaDistortionSpread < 2.0 && report.qcMax < 100.0;
}

/// Sentences that speak of numbers and options, not of how faces are connected.
bool mayRefuse(const HostileMesh& hostile, InvalidMesh::Problem problem)
{
	const FlowOptions& flow = hostile.hyperbolic && !hostile.sphere
								  ? static_cast<const FlowOptions&>(hostile.hyperbolicOptions)
								  : hostile.options;
	switch (problem) {
	case InvalidMesh::IncoherentEdge:
		return false;
	case InvalidMesh::EdgesWithoutLength:
	case InvalidMesh::FacesWithoutArea:
		return flow.method != Method::IntrinsicFlips;
	case InvalidMesh::NotPuncturable:
		return hostile.sphere;
	default:
		return true;
	}
}

/// Counts as the report does: faces that the doubles of the map turn round, and more of them that
/// the written floats do.
template<class Mesh>
std::string miscounted(
	const typename vcg::tri::RicciFlow<Mesh>::Result& result,
	const Reading& reading,
	bool mustBeRight,
	bool isHyperbolic)
{
	int flipped = 0, byRounding = 0, drawn = 0;
	const auto count = [&](const std::array<Point2, 3>& p, std::size_t f) {
		const std::array<Point2, 3> rounded = asWritten(p);
		const int inFloats = orientation(rounded[0], rounded[1], rounded[2]);
		if (reading.isDegenerate[f])
			drawn += inFloats != 0;
		else if (orientation(p[0], p[1], p[2]) != reading.wanted[f])
			++flipped;
		else
			byRounding += inFloats != reading.wanted[f];
	};
	for (const int f : result.mesh.points.indices())
		count(result.mesh.at(f), at(result.mesh.face[f]));
	if (drawn > 0)
		return "a face without area has one in the map";
	if (isHyperbolic) // whose faces are geodesic triangles
		return {};
	if (mustBeRight && flipped + byRounding > 0)
		return "a finished map has flipped faces: " + std::to_string(flipped) + " and " +
			   std::to_string(byRounding);
	if (flipped == result.report.flippedFaces && byRounding == result.report.flippedByRounding)
		return {};
	return "flipped faces: " + std::to_string(flipped) + " and " + std::to_string(byRounding) +
		   ", reported: " + std::to_string(result.report.flippedFaces) + " and " +
		   std::to_string(result.report.flippedByRounding);
}

/// \param squares in which coordinates have to lie, side by side in both directions; 0: anywhere
template<class Mesh>
std::string defectOfWritten(Mesh& m, int squares)
{
	for (const auto& face : m.face) {
		if (face.IsD())
			continue;
		for (int k = 0; k < 3; ++k) {
			if (face.cV(k)->IsD())
				return "a face has a deleted vertex";
			for (float x : {face.cWT(k).U(), face.cWT(k).V()})
				if (!std::isfinite(x) ||
					(squares > 0 && !(x >= 0.0f && x <= static_cast<float>(squares))))
					return "a texture coordinate is " + std::to_string(x);
		}
	}
	using Scalar = typename Mesh::ScalarType;
	for (const char* name : {"ricci_u", "ricci_target_curvature"}) {
		auto found = vcg::tri::Allocator<Mesh>::template FindPerVertexAttribute<Scalar>(m, name);
		if (!vcg::tri::Allocator<Mesh>::IsValidHandle(m, found))
			return std::string("no attribute ") + name;
		for (std::size_t v = 0; v < m.vert.size(); ++v)
			if (!m.vert[v].IsD() && !std::isfinite(double(found[v])))
				return std::string(name) + " is not finite";
	}
	for (const auto& v : m.vert)
		if (!v.IsD() && !(double(v.cQ()) >= 1.0 && std::isfinite(double(v.cQ()))))
			return "quality of a vertex is " + std::to_string(double(v.cQ()));
	return {};
}

std::string defectOf(const Report& r, double epsilon)
{
	if (!r.converged)
		return "not converged";
	if (!(r.maxCurvatureError <= std::max(epsilon, 1e-8)))
		return "residual " + std::to_string(r.maxCurvatureError);
	for (double x : {r.residualFloor, r.qcMean, r.qcAreaMean, r.qcVertexMean, r.qcP99, r.qcMax})
		if (!std::isfinite(x) || x < 0.0)
			return "a value of the report is " + std::to_string(x);
	for (const auto& x :
		 {r.torusTauRe, r.torusTauIm, r.annulusModulus, r.rectangleAspect, r.holonomyError})
		if (x && !std::isfinite(*x))
			return "an invariant is " + std::to_string(*x);
	if (r.brokenTriangles != 0)
		return "broken triangles";
	return {};
}

template<class Mesh>
bool finitePositions(const Mesh& m)
{
	for (const auto& v : m.vert)
		for (int k = 0; k < 3; ++k)
			if (!v.IsD() && !std::isfinite(double(v.cP()[k])))
				return false;
	return true;
}

template<class Mesh>
std::string defectOfSphere(const Mesh& m, const SphereMap& map)
{
	for (double x :
		 {map.maxCurvatureError, map.offset, map.qcAreaMean, map.qcMax, map.areaDistortionMean})
		if (!std::isfinite(x) || x < 0.0)
			return "a value of the sphere's report is " + std::to_string(x);
	for (const Triangle& t : map.triangles)
		for (const int v : t) {
			const Point3& p = map.positions[at(v)];
			const double radius = std::hypot(p[0], p[1], p[2]);
			if (!(std::abs(radius - 1.0) < 1e-9))
				return "a point at the distance " + std::to_string(radius) +
					   " is not on the sphere";
		}
	Mesh sphere;
	vcg::tri::RicciFlowLayers<Mesh>::BuildSphereMesh(m, map, sphere);
	return finitePositions(sphere) && sphere.FN() == m.FN() ? "" : "the sphere's mesh is broken";
}

bool isSentence(const std::string& text)
{
	return text.size() > 2 && text.back() == '.' && text.find('\n') == std::string::npos;
}

/// The layers of the hyperbolic filter.
template<class Mesh>
std::string
defectOfCover(const Mesh& m, const typename vcg::tri::RicciFlow<Mesh>::Result& result, int rings)
{
	constexpr std::size_t kMaxFaces = 2000;
	Mesh cover;
	try {
		vcg::tri::RicciFlowLayers<Mesh>::BuildUniversalCover(result, rings, kMaxFaces, cover);
	}
	catch (const InvalidOption& error) {
		if (error.problem != InvalidOption::CoverTooLarge || !isSentence(sentence(error)))
			return "the universal cover is refused by: " + sentence(error);
		return {};
	}
	if (!finitePositions(cover))
		return "the universal cover is not finite";
	constexpr int kPieces = 8;
	Mesh axes, polygons;
	vcg::tri::RicciFlowLayers<Mesh>::BuildAxes(result, kPieces, axes);
	if (!finitePositions(axes) || axes.EN() % kPieces != 0)
		return "an axis is broken";
	for (const auto& polygon :
		 vcg::tri::RicciFlowLayers<Mesh>::BuildCanonicalPolygons(result, kPieces, polygons))
		for (const std::complex<double>& z : polygon.corners)
			if (!(std::abs(z) < 1.0))
				return "a corner of a canonical polygon is not in the disk";
	if (!finitePositions(polygons) || polygons.EN() % kPieces != 0)
		return "a canonical polygon is broken";
	if (cover.FN() < m.FN() || static_cast<std::size_t>(cover.FN()) > kMaxFaces)
		return "the universal cover has " + std::to_string(cover.FN()) + " faces";
	return {};
}

SideMarks seamsOf(const HostileMesh& hostile, std::size_t faces)
{
	SideMarks seams;
	if (hostile.seamEvery == 0)
		return seams;
	Random random(static_cast<std::uint64_t>(hostile.seamSeed));
	seams.resize(faces);
	for (auto& face : seams)
		for (char& side : face)
			side = random.index(hostile.seamEvery) == 0;
	return seams;
}

template<class Mesh>
Execution run(const HostileMesh& hostile)
{
	using Flow = vcg::tri::RicciFlow<Mesh>;
	Execution execution;
	Mesh m;
	build(hostile, m);
	const std::string before = contents(m);
	Options params = hostile.options;
	params.normalizeUV = hostile.normalizeUV;
	HyperbolicOptions hyperbolicParams = hostile.hyperbolicOptions;
	hyperbolicParams.canonicalGenerators = true;
	params.chartMargin = hostile.chartMargin;
	const typename Flow::SideMarks seams = seamsOf(hostile, m.face.size());
	Watch watch(hostile.cancelAt, hostile.mesh.triangles.size());
	typename Flow::Result result;
	SphereMap sphere;
	try {
		Task task(watch); // what is looked at afterwards is not a part of it
		task.setMemoryLimit(hostile.memoryLimit);
		if (hostile.sphere)
			sphere = Flow::ComputeSphere(m, params);
		else
			result = hostile.hyperbolic ? Flow::ComputeHyperbolic(m, hyperbolicParams, seams)
										: Flow::Compute(m, params, seams);
		execution.verdict = Verdict::Mapped;
	}
	catch (const Cancelled& cancelled) {
		execution.verdict = Verdict::Cancelled;
		execution.sentence = sentence(cancelled);
	}
	catch (const Error& error) {
		execution.verdict = Verdict::Refused;
		execution.sentence = sentence(error);
		const auto* invalid = dynamic_cast<const InvalidMesh*>(&error);
		if (invalid != nullptr && !mayRefuse(hostile, invalid->problem))
			execution.defect = "refused: " + execution.sentence;
		if (dynamic_cast<const InternalError*>(&error) != nullptr)
			execution.defect = "internal error: " + execution.sentence;
	}
	catch (const std::exception& error) {
		execution.defect = std::string("not a sentence: ") + error.what();
		return execution;
	}
	if (!watch.defect.empty())
		execution.defect = watch.defect;
	else if (contents(m) != before)
		execution.defect = "the mesh has changed";
	else if (execution.verdict != Verdict::Mapped && !isSentence(execution.sentence))
		execution.defect = "not a sentence: " + execution.sentence;
	if (!execution.defect.empty() || execution.verdict != Verdict::Mapped)
		return execution;

	if (hostile.sphere) {
		execution.defect = defectOfSphere(m, sphere);
		return execution;
	}
	execution.defect = defectOf(
		result.report,
		hostile.hyperbolic ? hostile.hyperbolicOptions.epsilon : hostile.options.epsilon);
	const Reading reading(
		m,
		seams,
		hostile.hyperbolic ? OneSidedCut::ClearOfBoundary : OneSidedCut::Shortest,
		hostile.options.sharpAngle);
	if (execution.defect.empty())
		execution.defect = contradictionOf(result.report, reading.opened);
	const bool refined =
		(hostile.hyperbolic ? hostile.hyperbolicOptions.output : hostile.options.output) ==
		OutputTriangulation::CommonRefinement;
	if (execution.defect.empty() && refined)
		execution.defect = defectOfPieces(reading, result.mesh, m.vert.size());
	const bool finished = isOrdinary(hostile, reading, result.report);
	if (execution.defect.empty())
		execution.defect = miscounted<Mesh>(result, reading, finished, hostile.hyperbolic);
	if (execution.defect.empty() && hostile.hyperbolic)
		execution.defect = defectOfCover<Mesh>(m, result, hostile.rings);
	if (!execution.defect.empty())
		return execution;
	Mesh flat;
	const std::size_t vertices = m.vert.size();
	const std::string shape = shapeOf(m, vertices, !refined).all; // which no filter may change
	if (refined)
		Flow::WriteRefinement(m, result);
	else {
		Flow::WriteWedgeTexCoord(m, result);
		Flow::WriteVertexQuality(m, result);
	}
	const bool isPacked = hostile.normalizeUV || hostile.hyperbolic;
	const bool hasTiles = !hostile.hyperbolic && hostile.options.tileSide > 0.0;
	execution.defect = defectOfWritten(m, isPacked ? (hasTiles ? kTilesInRow : 1) : 0);
	if (execution.defect.empty() && shapeOf(m, vertices, !refined).all != shape)
		execution.defect = "the mesh is not what it was";
	vcg::tri::RicciFlowLayers<Mesh>::BuildFlatMesh(result, flat);
	if (execution.defect.empty() && flat.FN() != m.FN())
		execution.defect = "the flat mesh has another number of faces";
	return execution;
}

} // namespace

Execution runFacade(const std::uint8_t* data, std::size_t size)
{
	ByteSource bytes(data, size);
	const HostileMesh hostile(bytes);
	const auto once = [&] {
		return hostile.doublePrecision ? run<DoubleMesh>(hostile) : run<FloatMesh>(hostile);
	};
	Execution first = once();
	if (first.defect.empty() && bytes.oneIn(kRepeat)) {
		const Execution second = once();
		if (second.verdict != first.verdict || second.sentence != first.sentence)
			first.defect = "another run ends otherwise";
	}
	return first;
}

} // namespace ricci::testing
