// SPDX-License-Identifier: GPL-3.0-or-later
#include "facade_check.h"

#include "hostile_mesh.h"
#include "support/mesh_contents.h"
#include "support/vcg_mesh.h"

#include <bridge/sentences.h>

#include <ricci/error.h>
#include <ricci/math/orientation.h>

#include <vcg/complex/algorithms/parametrization/ricci_flow_layers.h>

#include <algorithm>
#include <cmath>
#include <complex>
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

/// Orientation that each face should have in the plane, by what its component's majority has.
template<class Mesh>
std::vector<int> wantedOrientation(const Mesh& m)
{
	std::map<std::pair<std::size_t, std::size_t>, std::vector<std::pair<std::size_t, int>>> sides;
	const auto side = [&](std::size_t f, int k) {
		return std::make_pair(
			vcg::tri::Index(m, m.face[f].cV(k)), vcg::tri::Index(m, m.face[f].cV((k + 1) % 3)));
	};
	for (std::size_t f = 0; f < m.face.size(); ++f)
		for (int k = 0; k < 3 && !m.face[f].IsD(); ++k) {
			const auto s = side(f, k);
			sides[std::minmax(s.first, s.second)].push_back({f, s.first < s.second ? 1 : -1});
		}
	std::vector<int> wanted(m.face.size(), 0);
	for (std::size_t seed = 0; seed < m.face.size(); ++seed) {
		if (m.face[seed].IsD() || wanted[seed] != 0)
			continue;
		std::vector<std::size_t> component{seed};
		wanted[seed] = 1;
		int sum = 0;
		for (std::size_t head = 0; head < component.size(); ++head) {
			const std::size_t f = component[head];
			sum += wanted[f];
			for (int k = 0; k < 3; ++k) {
				const auto s = side(f, k);
				const int own = s.first < s.second ? 1 : -1;
				for (const auto& [g, its] : sides[std::minmax(s.first, s.second)])
					if (wanted[g] == 0) {
						wanted[g] = own == its ? -wanted[f] : wanted[f];
						component.push_back(g);
					}
			}
		}
		for (std::size_t f : component)
			if (sum < 0)
				wanted[f] = -wanted[f];
	}
	return wanted;
}

/// Counts as the report does: faces that the doubles of the map turn round, and more of them that
/// the written floats do.
template<class Mesh>
std::string miscounted(
	const Mesh& m,
	const typename vcg::tri::RicciFlow<Mesh>::Result& result,
	const std::vector<int>& wanted)
{
	int flipped = 0, byRounding = 0;
	const auto count = [&](const std::array<Point2, 3>& p, int orientationWanted) {
		Point2 rounded[3];
		for (std::size_t k = 0; k < 3; ++k)
			for (std::size_t i = 0; i < 2; ++i) {
				volatile float x = static_cast<float>(p[k][i]);
				rounded[k][i] = x;
			}
		if (orientation(p[0], p[1], p[2]) != orientationWanted)
			++flipped;
		else
			byRounding += orientation(rounded[0], rounded[1], rounded[2]) != orientationWanted;
	};
	if (result.refined.triangles.empty())
		for (std::size_t f = 0; f < m.face.size(); ++f) {
			if (!m.face[f].IsD())
				count(result.wedgeUV[f], wanted[f]);
		}
	for (std::size_t i = 0; i < result.refined.triangles.size(); ++i)
		count(result.refined.uv[i], wanted[static_cast<std::size_t>(result.refined.inputFace[i])]);
	if (flipped == result.report.flippedFaces && byRounding == result.report.flippedByRounding)
		return {};
	return "flipped faces: " + std::to_string(flipped) + " and " + std::to_string(byRounding) +
		   ", reported: " + std::to_string(result.report.flippedFaces) + " and " +
		   std::to_string(result.report.flippedByRounding);
}

template<class Mesh>
std::string defectOfWritten(Mesh& m, bool normalized)
{
	for (const auto& face : m.face) {
		if (face.IsD())
			continue;
		for (int k = 0; k < 3; ++k) {
			if (face.cV(k)->IsD())
				return "a face has a deleted vertex";
			for (float x : {face.cWT(k).U(), face.cWT(k).V()})
				if (!std::isfinite(x) || (normalized && !(x >= 0.0f && x <= 1.0f)))
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

std::string defectOf(const Report& r, const Options& options)
{
	if (!r.converged)
		return "not converged";
	if (!(r.maxCurvatureError <= std::max(options.epsilon, 1e-8)))
		return "residual " + std::to_string(r.maxCurvatureError);
	for (double x : {r.residualFloor, r.qcMean, r.qcAreaMean, r.qcVertexMean, r.qcP99, r.qcMax})
		if (!std::isfinite(x) || x < 0.0)
			return "a value of the report is " + std::to_string(x);
	for (const auto& x : {r.torusTauRe, r.torusTauIm, r.annulusModulus, r.rectangleAspect, r.holonomyError})
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
	std::vector<char> used(m.vert.size(), 0);
	for (const auto& face : m.face)
		for (int k = 0; k < 3 && !face.IsD(); ++k)
			used[vcg::tri::Index(m, face.cV(k))] = 1;
	for (std::size_t v = 0; v < used.size(); ++v) {
		const Point3& p = map.positions[v];
		const double radius = std::hypot(p[0], p[1], p[2]);
		if (used[v] && !(std::abs(radius - 1.0) < 1e-9))
			return "a point at the distance " + std::to_string(radius) + " is not on the sphere";
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
		vcg::tri::RicciFlowLayers<Mesh>::BuildUniversalCover(m, result, rings, kMaxFaces, cover);
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

template<class Mesh>
Execution run(const HostileMesh& hostile)
{
	using Flow = vcg::tri::RicciFlow<Mesh>;
	Execution execution;
	Mesh m;
	build(hostile, m);
	const std::string before = contents(m);
	typename Flow::Params params;
	static_cast<Options&>(params) = hostile.options;
	params.normalizeUV = hostile.normalizeUV;
	typename Flow::HyperbolicParams hyperbolicParams;
	static_cast<HyperbolicOptions&>(hyperbolicParams) = hostile.hyperbolicOptions;
	hyperbolicParams.canonicalGenerators = true;
	params.chartMargin = hostile.chartMargin;
	Watch watch(hostile.cancelAt, hostile.mesh.triangles.size());
	typename Flow::Result result;
	SphereMap sphere;
	try {
		if (hostile.sphere)
			sphere = Flow::ComputeSphere(m, params, watch);
		else
			result = hostile.hyperbolic ? Flow::ComputeHyperbolic(m, hyperbolicParams, watch)
										: Flow::Compute(m, params, watch);
		execution.verdict = Verdict::Mapped;
	}
	catch (const Cancelled& cancelled) {
		execution.verdict = Verdict::Cancelled;
		execution.sentence = sentence(cancelled);
	}
	catch (const Error& error) {
		execution.verdict = Verdict::Refused;
		execution.sentence = sentence(error);
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
	execution.defect = defectOf(result.report, hostile.options);
	if (!execution.defect.empty())
		return execution;
	if (!hostile.hyperbolic) // whose faces are geodesic triangles
		execution.defect = miscounted(m, result, wantedOrientation(m));
	if (!execution.defect.empty())
		return execution;
	if (hostile.hyperbolic)
		execution.defect = defectOfCover<Mesh>(m, result, hostile.rings);
	if (!execution.defect.empty())
		return execution;
	Mesh flat;
	if (hostile.options.output == OutputTriangulation::CommonRefinement)
		Flow::WriteRefinement(m, result);
	else {
		Flow::WriteWedgeTexCoord(m, result);
		Flow::WriteVertexQuality(m, result);
	}
	execution.defect = defectOfWritten(m, hostile.normalizeUV || hostile.hyperbolic);
	vcg::tri::RicciFlowLayers<Mesh>::BuildFlatMesh(m, result, flat);
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
