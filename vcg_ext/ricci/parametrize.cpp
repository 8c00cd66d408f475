// SPDX-License-Identifier: GPL-3.0-or-later
#include "parametrize.h"

#include "error.h"
#include "flow/ricci_flow.h"
#include "layout/cut_graph.h"
#include "layout/distortion.h"
#include "layout/hole_seams.h"
#include "layout/invariants.h"
#include "layout/least_rectangle.h"
#include "layout/orientation.h"
#include "layout/seam_cost.h"
#include "numbers.h"
#include "result_assembly.h"
#include "run_progress.h"
#include "separate_charts.h"
#include "surface/component.h"
#include "surface/hole_caps.h"
#include "text.h"
#include "verify/chart_check.h"
#include "verify/flow_check.h"
#include "verify/map_check.h"

#include <algorithm>
#include <cmath>

namespace ricci {

namespace {

/// A curvature above this makes an interior vertex a cone, which the cut must reach.
constexpr double kConeCurvature = 1e-9;

/// The check of the result allows this share of a chart's extent: a thousandth of a texel.
constexpr double kCheckedGap = 1e-6;

/// Starts of the flow that the splitting of boundary edges may ask for (paper 5.4).
constexpr int kMostStarts = 20;

/// A component's mesh as the flow uses it: equal to the component until boundary edges are split.
struct WorkingMesh
{
	std::vector<Point3> positions;
	std::vector<Triangle> triangles;
	int inputVertexCount = 0;
	std::vector<char> selected;
	std::vector<double> prescribed;
	/// [component face][corner] -> 3 face + corner of triangles
	std::vector<std::array<int, 3>> corner;

	WorkingMesh(const Component& component, const VertexInput& input) :
			positions(component.positions), triangles(component.triangles),
			inputVertexCount(static_cast<int>(component.positions.size()))
	{
		for (int v : component.vertex) {
			selected.push_back(input.selected.empty() ? char(0) : input.selected[at(v)]);
			prescribed.push_back(
				input.targetCurvature.empty() ? 0.0 : input.targetCurvature[at(v)]);
		}
		corner.resize(triangles.size());
		for (std::size_t f = 0; f < triangles.size(); ++f)
			for (std::size_t k = 0; k < 3; ++k)
				corner[f][k] = static_cast<int>(3 * f + k);
	}

	/// Splits the side k of face f, on the boundary, at its middle (paper 5.4).
	void split(int f, int k)
	{
		const int i = triangles[at(f)][at(k)], j = triangles[at(f)][at((k + 1) % 3)];
		const int apex = triangles[at(f)][at((k + 2) % 3)];
		const int middle = static_cast<int>(positions.size());
		const int added = static_cast<int>(triangles.size());
		Point3 p;
		for (std::size_t x = 0; x < 3; ++x)
			p[x] = 0.5 * (positions[at(i)][x] + positions[at(j)][x]);
		positions.push_back(p);
		selected.push_back(0);
		prescribed.push_back(0.0);
		for (std::array<int, 3>& corners : corner)
			for (int& c : corners)
				if (c == 3 * f + (k + 1) % 3)
					c = 3 * added + 1;
		triangles[at(f)] = {i, middle, apex};
		triangles.push_back({middle, j, apex});
		for (std::array<int, 3>& corners : corner) // the face now starts at i
			for (int& c : corners)
				if (c / 3 == f)
					c = 3 * f + (c % 3 == k ? 0 : 2);
	}
};

/// One component: flow, cut and layout.
class ComponentRun
{
public:
	ComponentRun(
		const Component& component,
		const VertexInput& input,
		const Options& options,
		Interval interval) :
			m_component(component),
			m_mesh(component, input), m_precision(input.precision), m_options(options),
			m_interval(interval)
	{
	}

	void run(Parametrization& result)
	{
		flow(static_cast<int>(result.charts.size()), result.report.flowStates);
		m_interval.step(1.0 - kAfterFlow, "Cutting and layout");
		cutOpen();
		layOut();
		store(result);
		m_interval.step(1.0, "Checking the result");
		verify(result);
		invariants(result.report);
	}

private:
	void flow(int number, std::vector<FlowState>& states)
	{
		for (int start = 0; start < kMostStarts; ++start) {
			if (start == 0)
				m_interval.step(0.0, "Circle packing");
			m_base = Triangulation(static_cast<int>(m_mesh.positions.size()), m_mesh.triangles);
			m_topology = topologyOf(m_base);
			m_lengths = edgeLengths(m_base, m_mesh.positions);
			closeHoles();
			TargetRequest request;
			request.mode = m_options.target;
			request.freeBoundary = m_options.freeBoundary;
			request.selected = m_mesh.selected;
			request.prescribed = m_mesh.prescribed;
			request.prescribedPrecision = m_precision;
			request.coneCount = m_options.coneCount;
			request.coneDistortion = m_options.coneDistortion;
			request.coneRounding = m_options.coneRounding;
			request.coneVertices = static_cast<int>(m_mesh.positions.size());
			request.vertexNumbers = m_component.vertex;
			request.selected.resize(m_solved.positions.size(), 0);
			request.prescribed.resize(m_solved.positions.size(), 0.0);
			const Topology topology = topologyOf(m_solved.triangulation);
			const std::vector<double> lengths =
				edgeLengths(m_solved.triangulation, m_solved.positions);
			Target target = chooseTarget(
				m_solved.triangulation, topology, lengths, m_solved.positions, request);
			if (start == 0) {
				m_interval.log(
					"Component of " + std::to_string(m_mesh.positions.size()) + " vertices, " +
					std::to_string(m_mesh.triangles.size()) + " faces: " + m_topology.name() + ".");
				for (const std::string& note : target.notes)
					m_interval.log(note);
			}
			FlowProgress progress(m_interval, m_options.epsilon, number, states);
			m_flow = runRicciFlow(
				Background::EuclideanPlane,
				m_solved.triangulation,
				lengths,
				m_solved.positions,
				target,
				topology.loops.empty() ? std::vector<int>() : topology.loops.front(),
				m_options,
				[&](int step, double residual) { progress(m_iterations + step, residual); });
			m_iterations += m_flow.iterations;
			m_swaps += m_flow.edgeSwaps;
			logLengthened(m_flow, m_interval);
			if (m_flow.edgesToSplit.empty()) {
				if (m_flow.residual >= m_options.epsilon)
					m_interval.log(
						"epsilon is below what rounding allows: the curvature is reached to " +
						numberText(m_flow.residual, 3) + " (rounding floor " +
						numberText(m_flow.floor, 3) + ").");
				return;
			}
			splitBoundary();
		}
		throw NotConverged(
			"Triangles on the boundary kept breaking after " + std::to_string(m_splits) +
			" boundary edges were split: remesh the boundary.");
	}

	/// The surface of the flow: the component, or with caps on its holes.
	void closeHoles()
	{
		if (m_options.holes == Holes::Capped && m_topology.loops.size() > 1)
			m_solved = capInnerLoops(m_base, m_mesh.positions);
		else {
			m_solved = CappedSurface();
			m_solved.triangulation = m_base;
			m_solved.positions = m_mesh.positions;
			m_solved.onHole.assign(m_mesh.positions.size(), 0);
		}
	}

	void splitBoundary()
	{
		std::vector<int> edges = m_flow.edgesToSplit;
		std::sort(edges.begin(), edges.end());
		edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
		std::vector<char> touched(m_mesh.triangles.size(), 0);
		for (int e : edges) {
			const int h = m_base.isOuter(2 * e) ? 2 * e + 1 : 2 * e;
			const int f = m_base.face(h);
			if (touched[at(f)])
				continue;
			touched[at(f)] = 1;
			const Triangle& t = m_mesh.triangles[at(f)];
			const int k =
				static_cast<int>(std::find(t.begin(), t.end(), m_base.origin(h)) - t.begin());
			m_mesh.split(f, k);
			++m_splits;
		}
		m_interval.log(std::to_string(m_splits) + " boundary edges split; the flow starts anew.");
	}

	/// The cut runs on edges of the input that the flow has kept and reaches every cone.
	void cutOpen()
	{
		std::vector<char> marked(m_mesh.positions.size(), 0), forbidden;
		for (std::size_t v = 0; v < marked.size(); ++v)
			marked[v] =
				(!m_topology.boundary[v] || m_solved.onHole[v]) &&
				std::abs(m_flow.target.curvature[static_cast<Eigen::Index>(v)]) > kConeCurvature;
		m_cones = static_cast<int>(std::count(marked.begin(), marked.end(), 1));
		if (m_swaps > 0 || m_splits > 0) {
			forbidden = m_flow.swapped;
			forbidden.resize(at(m_base.edgeCount()), 0);
			for (int e = 0; e < m_base.edgeCount(); ++e)
				if (std::max(m_base.origin(2 * e), m_base.target(2 * e)) >= m_mesh.inputVertexCount)
					forbidden[at(e)] = 1;
		}
		m_cut = cutToDisk(
			layoutTriangulation(),
			seamCost(m_base, m_lengths, m_mesh.positions, m_options.seamHiding),
			marked,
			forbidden,
			[&] { m_interval.step(1.0 - kAfterFlow, "Shortening the seams"); });
		if (m_solved.holes > 0)
			dropSeamsToHoles(m_base, m_lengths, m_solved.onHole, marked, m_cut);
		m_marked = std::move(marked);
	}

	bool flips() const { return m_options.surgery == Surgery::IntrinsicFlips; }

	/// The layout is known at the corners of these triangles: with flips the input's, else the
	/// flow's.
	const Triangulation& layoutTriangulation() const
	{
		return flips() ? m_base : m_flow.metric->triangulation();
	}

	void layOut()
	{
		placeCorners();
		if (m_topology.loops.size() > 1 && m_solved.holes == 0) { // seams where the metric asks
			const Triangulation& t = layoutTriangulation();
			const int edges = m_cut.edgeCount;
			dropSeamsToHoles(
				t, m_lengths, loopsThatClose(t, m_layout, m_cut.isCut), m_marked, m_cut);
			if (m_cut.edgeCount < edges)
				placeCorners();
		}
		// The flow leaves the scale open unless the boundary keeps its metric.
		const bool scaled = std::find(m_flow.target.fixed.begin(), m_flow.target.fixed.end(), 1) !=
							m_flow.target.fixed.end();
		if (!scaled) {
			double area = 0.0;
			for (const Triangle& t : m_mesh.triangles)
				area += triangleArea(
					{m_mesh.positions[at(t[0])],
					 m_mesh.positions[at(t[1])],
					 m_mesh.positions[at(t[2])]});
			m_scale = std::sqrt(area / areaInPlane());
		}
		turnUpright();
	}

	/// The layout, open along the cut.
	void placeCorners()
	{
		const CurvatureMap& metric = *m_flow.metric;
		if (flips())
			layOutFlipped();
		else
			m_layout = layOutInPlane(
				metric.triangulation(), metric.lengths(), metric.angles(), m_cut.isCut);
	}

	void layOutFlipped()
	{
		m_refinement = overlayOfFlow(
			m_flow,
			Background::EuclideanPlane,
			m_base,
			m_mesh.positions,
			m_cut.isCut,
			m_flow.doubled || m_solved.holes > 0,
			m_options.output == OutputTriangulation::KeepMesh && m_solved.holes == 0,
			overlayWatch(
				m_interval,
				m_options.output == OutputTriangulation::CommonRefinement,
				m_options.memoryLimit));

		int sectorCount = 0;
		m_layout.sector = cornerSectors(m_base, m_cut.isCut, sectorCount);
		m_layout.position.resize(at(sectorCount));
		for (int h = 0; h < m_base.halfedgeCount(); ++h)
			if (!m_base.isOuter(h))
				m_layout.position[at(m_layout.sector[at(h)])] = m_refinement.inputLayout.at(h);
	}

	/// Area of the component in the flow's metric, without caps.
	double areaInPlane() const
	{
		if (m_solved.holes == 0)
			return m_flow.area;
		double area = 0.0;
		for (const auto& p : m_refinement.uv)
			area += 0.5 * ((p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) -
						   (p[1][1] - p[0][1]) * (p[2][0] - p[0][0]));
		return area;
	}

	/// Turns and scales the layout so that its least bounding rectangle lies along the axes, from
	/// the origin.
	void turnUpright()
	{
		const OrientedRectangle r = leastRectangle(m_layout.position);
		const auto move = [&](Point2& p) {
			const Point2 q = r.inFrame(p);
			p = {m_scale * (q[0] - r.low[0]), m_scale * (q[1] - r.low[1])};
		};
		for (Point2& p : m_layout.position)
			move(p);
		for (std::array<Point2, 3>& triangle : m_refinement.uv)
			for (Point2& p : triangle)
				move(p);
	}

	/// Point of a corner of the input: the sector of the layout that begins at the same cut or
	/// boundary halfedge, which the flow never moves; any sector where the vertex is not cut.
	const Point2& pointOf(int halfedge, const std::vector<int>& anyHalfedge) const
	{
		int h = halfedge;
		do {
			const int e = Triangulation::edge(h);
			if (m_cut.isCut[at(e)] || m_base.isBoundaryEdge(e))
				return m_layout.at(h);
			h = m_base.next(Triangulation::twin(h));
		} while (h != halfedge);
		return m_layout.at(anyHalfedge[at(m_base.origin(halfedge))]);
	}

	void store(Parametrization& result) const
	{
		const Triangulation& end = layoutTriangulation();
		std::vector<int> anyHalfedge(m_mesh.positions.size(), -1);
		for (int h = end.halfedgeCount() - 1; h >= 0; --h)
			if (!end.isOuter(h))
				anyHalfedge[at(end.origin(h))] = h;
		// Halfedge of every corner of the working mesh, in the triangulation before any swap.
		std::vector<int> cornerHalfedge(3 * m_mesh.triangles.size());
		for (int f = 0; f < m_base.faceCount(); ++f) {
			const auto h = m_base.halfedges(f);
			for (int k = 0; k < 3; ++k)
				cornerHalfedge[at(3 * f + k)] = h[at(k)];
		}
		Chart chart;
		chart.faces = m_component.face;
		if (m_options.output == OutputTriangulation::CommonRefinement)
			appendRefinement(m_refinement, m_component, result.refined, chart);
		result.charts.push_back(std::move(chart));
		for (std::size_t f = 0; f < m_component.face.size(); ++f) {
			const std::size_t inputFace = at(m_component.face[f]);
			result.reversed[inputFace] = m_component.reversed[f];
			for (std::size_t k = 0; k < 3; ++k)
				result.uv[inputFace][m_component.inputCorner(f, k)] =
					pointOf(cornerHalfedge[at(m_mesh.corner[f][k])], anyHalfedge);
		}
		storeFlow(m_flow, m_component, m_topology, std::log(m_scale), result);
		Report& report = result.report;
		report.iterations += m_iterations;
		report.edgeSwaps += m_swaps;
		report.refinementPoints += static_cast<int>(m_refinement.crossings);
		report.boundarySplits += m_splits;
		report.cappedHoles += m_solved.holes;
		storeCut(m_cut, m_lengths, report);
		report.cones += m_cones;
	}

	/// Checks what was found by other formulas than those that found it.
	/// \throw NotConverged
	void verify(const Parametrization& result) const
	{
		requireMetric(
			Background::EuclideanPlane, m_flow, m_solved.triangulation.boundaryVertices());
		const Chart& chart = result.charts.back();
		const OutputTriangles output = outputOf(m_component, chart, result);
		const double tolerance = kCheckedGap + openCurvature(m_flow);
		const MapCheck map = checkMap(output.triangles, output.plane, output.reversed, tolerance);
		// Where flips or splits bend the edges of the input, its straight faces may turn.
		const bool bent = chart.refined.empty() && (!m_flow.history.startFlips.empty() ||
													!m_flow.history.flowFlips.empty() ||
													m_flow.doubled || m_swaps > 0 || m_splits > 0);
		if (!map.finite || !(map.seamGap <= tolerance) || (map.turned > 0 && !bent))
			failCheck(
				"seams " + numberText(map.seamGap, 3) + " of the chart apart, " +
				std::to_string(map.turned) + " faces turned round");
	}

	void invariants(Report& report) const
	{
		const Triangulation& t = layoutTriangulation();
		const bool flat = m_flow.target.curvature.lpNorm<Eigen::Infinity>() == 0.0;
		const bool free = std::find(m_flow.target.fixed.begin(), m_flow.target.fixed.end(), 1) !=
						  m_flow.target.fixed.end();
		if (m_topology.isTorus() && flat) {
			const auto tau = torusModulus(t, m_layout, m_cut);
			report.torusTauRe = tau.real();
			report.torusTauIm = tau.imag();
		}
		// A large epsilon can stop the flow where the metric closes round a hole, without a seam.
		if (m_topology.isAnnulus() && flat && !free && m_cut.edgeCount > 0)
			report.annulusModulus =
				annulusModulus(t, m_layout, m_cut, m_scale * m_scale * m_flow.area);
		if (m_flow.target.isRectangle)
			report.rectangleAspect = rectangleAspect();
	}

	double rectangleAspect() const
	{
		std::array<Point2, 4> corner;
		const Triangulation& t = layoutTriangulation();
		for (int h = 0; h < t.halfedgeCount(); ++h)
			for (std::size_t k = 0; k < 4; ++k)
				if (!t.isOuter(h) && t.origin(h) == m_flow.target.corners[k])
					corner[k] = m_layout.at(h);
		double side[4];
		for (std::size_t k = 0; k < 4; ++k)
			side[k] = std::hypot(
				corner[k][0] - corner[(k + 1) % 4][0], corner[k][1] - corner[(k + 1) % 4][1]);
		const double a = side[0] + side[2], b = side[1] + side[3];
		return std::max(a, b) / std::min(a, b);
	}

	const Component& m_component;
	WorkingMesh m_mesh;
	double m_precision;
	const Options& m_options;
	Interval m_interval;
	Triangulation m_base; ///< before any swap
	Topology m_topology;
	CappedSurface m_solved; ///< m_base, with caps on its holes if asked for
	std::vector<double> m_lengths;
	FlowResult m_flow;
	CutGraph m_cut;
	std::vector<char> m_marked;    ///< [vertex] 1 at cones
	CommonRefinement m_refinement; ///< with flips
	PlanarLayout m_layout;
	double m_scale = 1.0;
	int m_iterations = 0, m_swaps = 0, m_splits = 0, m_cones = 0;
};

void checkOptions(const Options& options)
{
	if (options.output == OutputTriangulation::CommonRefinement &&
		(options.surgery != Surgery::IntrinsicFlips || options.packing == PackingScheme::Thurston))
		throw InvalidOption(
			"The output 'Common refinement' belongs to the surgery 'Intrinsic flips' with the "
			"circle "
			"packing 'Inversive distance': choose these, or the output 'Keep the mesh'.");
	if (options.holes == Holes::Capped &&
		(options.surgery != Surgery::IntrinsicFlips || options.packing == PackingScheme::Thurston))
		throw InvalidOption(
			"The holes 'Capped' belong to the surgery 'Intrinsic flips' with the circle packing "
			"'Inversive distance': choose these, or the holes 'Boundaries'.");
	checkFlowOptions(options);
	if (options.coneCount < 0)
		throw InvalidOption(
			"cone_count must be 0 or more, not " + std::to_string(options.coneCount) + ".");
	if (!(options.coneDistortion > 0.0))
		throw InvalidOption(
			"cone_distortion must be greater than 0, not " + numberText(options.coneDistortion, 6) +
			".");
	if (!(options.seamHiding >= 0.0 && options.seamHiding <= 1.0))
		throw InvalidOption(
			"seam_hiding must be between 0 and 1, not " + numberText(options.seamHiding, 6) + ".");
}

/// \throw NotConverged if a chart of which no triangle is turned round still overlaps itself
void requireSeparateCharts(const SurfaceMesh& mesh, const Parametrization& result)
{
	const bool refined = !result.refined.triangles.empty();
	const auto& all = refined ? result.refined.triangles : mesh.triangles;
	std::vector<const std::vector<int>*> parts;
	int crossings = 0;
	for (const Chart& chart : result.charts) {
		parts.push_back(refined ? &chart.refined : &chart.faces);
		std::vector<Triangle> triangles;
		std::vector<std::array<Point2, 3>> plane;
		bool turned = false;
		for (int f : *parts.back()) {
			const int input = refined ? result.refined.inputFace[at(f)] : f;
			const auto& p = refined ? result.refined.uv[at(f)] : result.uv[at(f)];
			const int wanted = result.reversed[at(input)] ? -1 : 1;
			turned = turned || orientation(p[0], p[1], p[2]) != wanted;
			triangles.push_back(all[at(f)]);
			plane.push_back(p);
		}
		if (!turned)
			crossings += borderCrossings(triangles, plane, kCheckedGap);
	}
	if (crossings > 0 || !isPartition(parts, all.size()))
		failCheck(
			std::to_string(crossings) +
			" crossings of the borders of charts that should not overlap");
}

} // namespace

Parametrization parametrizeEuclidean(
	const SurfaceMesh& mesh, const VertexInput& input, const Options& asked, Progress& progress)
{
	checkOptions(asked);
	progress.step(0.0, "Checking the mesh");
	Parametrization result;
	Options options = asked;
	if (options.packing == PackingScheme::Thurston && options.surgery == Surgery::IntrinsicFlips) {
		// Flips need circles that do not overlap.
		options.surgery = Surgery::None;
		result.notes.push_back(
			"The Thurston packing runs on the mesh's own triangles, without flips.");
	}
	const std::vector<Component> components =
		startResult(mesh, options, options.output, progress, result);
	runComponents(mesh, components, progress, [&](const Component& component, Interval interval) {
		ComponentRun(component, input, options, interval).run(result);
	});
	if (components.size() > 1) {
		result.report.torusTauRe.reset();
		result.report.torusTauIm.reset();
		result.report.annulusModulus.reset();
		result.report.rectangleAspect.reset();
	}
	progress.step(kComponentsDone, "Measuring the distortion");
	result.report.converged = true;
	measureResult(mesh, options.output, measureDistortion, result);
	const auto tick = [&] { progress.step(kMeasured, "Looking for charts that overlap"); };
	tick();
	separateCharts(mesh, options.resolveOverlap, tick, result);
	result.report.seamLengthRelative = result.report.seamLength / std::sqrt(areaOf(mesh));
	if (options.resolveOverlap)
		requireSeparateCharts(mesh, result);
	progress.step(1.0, "Layout done");
	return result;
}

} // namespace ricci
