// SPDX-License-Identifier: GPL-3.0-or-later
#include "parametrize.h"

#include "error.h"
#include "flow/hyperbolic_target.h"
#include "flow/ricci_flow.h"
#include "layout/cut_graph.h"
#include "layout/distortion.h"
#include "layout/hyperbolic_layout.h"
#include "numbers.h"
#include "result_assembly.h"
#include "surface/component.h"
#include "text.h"
#include "verify/disk_check.h"
#include "verify/flow_check.h"

#include <algorithm>
#include <cmath>
#include <complex>

namespace ricci {

namespace {

/// A curvature above this makes an interior vertex a cone, which the cut must reach.
constexpr double kConeCurvature = 1e-9;

/// The check of the result allows this hyperbolic length.
constexpr double kCheckedGap = 1e-6;

using Triangle2 = std::array<Point2, 3>;

std::complex<double> asComplex(const Point2& p)
{
	return {p[0], p[1]};
}

/// The flat triangle whose sides are the chords of a geodesic triangle of the disk, with the
/// triangle's orientation. Where no flat triangle has these sides its height is 0.
Triangle2 chordTriangle(const Triangle2& p)
{
	const std::complex<double> x = asComplex(p[0]), y = asComplex(p[1]), z = asComplex(p[2]);
	const double base = chordLength(x, y), left = chordLength(x, z), right = chordLength(y, z);
	if (!(base > 0.0))
		return {};
	const double along = 0.5 * ((left - right) * (left + right) / base + base);
	const double heron = (base + left + right) * (base + left - right) * (base + right - left) *
						 (left + right - base);
	const double height = std::sqrt(std::max(0.0, heron)) / (2.0 * base);
	return {
		{{0.0, 0.0}, {base, 0.0}, {along, hyperbolicOrientation(x, y, z) < 0 ? -height : height}}};
}

int countFlipped(const std::vector<Triangle2>& uv, const std::vector<char>& reversed)
{
	int flipped = 0;
	for (std::size_t f = 0; f < uv.size(); ++f)
		flipped +=
			hyperbolicOrientation(asComplex(uv[f][0]), asComplex(uv[f][1]), asComplex(uv[f][2])) !=
			(reversed[f] ? -1 : 1);
	return flipped;
}

DistortionField measure(
	const SurfaceMesh& mesh,
	const std::vector<Triangle2>& uv,
	const std::vector<char>& reversed,
	Report& report)
{
	std::vector<Triangle2> chords(uv.size());
	std::transform(uv.begin(), uv.end(), chords.begin(), chordTriangle);
	DistortionField field = measureDistortion(mesh, chords, reversed, report);
	report.flippedFaces = countFlipped(uv, reversed);
	return field;
}

/// One component: flow, cut and layout.
class HyperbolicRun
{
public:
	HyperbolicRun(
		const Component& component,
		const VertexInput& input,
		const HyperbolicOptions& options,
		Interval interval) :
			m_component(component),
			m_input(input), m_options(options), m_interval(interval)
	{
	}

	void run(Parametrization& result)
	{
		flow(static_cast<int>(result.charts.size()), result.report.flowStates);
		m_interval.step(1.0 - kAfterFlow, "Cutting and layout");
		markCones();
		m_cut = cutToDisk(m_base, lengthsFound(), m_cones, {}, [&] {
			m_interval.step(1.0 - kAfterFlow, "Shortening the seams");
		});
		m_group = layOut();
		m_interval.step(1.0, "Checking the result");
		requireMetric(Background::HyperbolicPlane, m_flow, m_base.boundaryVertices());
		store(result);
		verify(result);
	}

private:
	void flow(int number, std::vector<FlowState>& states)
	{
		m_interval.step(0.0, "Circle packing");
		m_base =
			Triangulation(static_cast<int>(m_component.positions.size()), m_component.triangles);
		m_topology = topologyOf(m_base);
		m_interval.log(
			"Component of " + std::to_string(m_component.positions.size()) + " vertices, " +
			std::to_string(m_component.triangles.size()) + " faces: " + m_topology.name() + ".");
		HyperbolicRequest request;
		request.mode = m_options.target;
		request.freeBoundary = m_options.freeBoundary;
		request.coneAngle = m_options.coneAngle;
		request.prescribedPrecision = m_input.precision;
		for (int v : m_component.vertex) {
			request.selected.push_back(
				m_input.selected.empty() ? char(0) : m_input.selected[at(v)]);
			request.prescribed.push_back(
				m_input.targetCurvature.empty() ? 0.0 : m_input.targetCurvature[at(v)]);
		}
		const Target target = chooseHyperbolicTarget(m_topology, m_base.vertexCount(), request);
		for (const std::string& note : target.notes)
			m_interval.log(note);
		FlowProgress progress(m_interval, m_options.epsilon, number, states);
		m_flow = runRicciFlow(
			Background::HyperbolicPlane,
			m_base,
			edgeLengths(m_base, m_component.positions),
			m_component.positions,
			target,
			{},
			m_options,
			[&](int step, double residual) { progress(step, residual); });
		logLengthened(m_flow, m_interval);
	}

	/// Checks what was found by other formulas than those that found it.
	/// \throw NotConverged
	void verify(const Parametrization& result) const
	{
		const Chart& chart = result.charts.back();
		const OutputTriangles output = outputOf(m_component, chart, result);
		// What an angle leaves open grows like sinh of the distance across the layout.
		double radius = 0.0;
		bool finite = true;
		for (const Point2& p : m_layout.position) {
			const double r = std::hypot(p[0], p[1]);
			finite = finite && std::isfinite(r);
			radius = std::max(radius, 2.0 * std::atanh(std::min(1.0, r)));
		}
		const double tolerance = kCheckedGap + openCurvature(m_flow) * std::sinh(2.0 * radius);
		const DiskCheck check =
			checkDisk(output.triangles, output.plane, output.reversed, tolerance);
		if (check.outside > 0 && finite) // past a distance of about 37 the doubles of the disk end
			throw NotConverged(
				std::to_string(check.outside) +
				" corners of faces lie so far from the middle of the layout that rounding "
				"puts them on the border of the Poincaré disk: choose larger cone angles.");
		if (check.outside > 0)
			failCheck(std::to_string(check.outside) + " points lie outside the disk");
		// Where flips bend the edges of the input, its geodesic faces may turn.
		const bool bent = chart.refined.empty() &&
						  (!m_flow.history.startFlips.empty() || !m_flow.history.flowFlips.empty());
		if (!(check.seamGap <= tolerance) || (check.turned > 0 && !bent))
			failCheck(
				"seams " + numberText(check.seamGap, 3) + " apart in the disk, " +
				std::to_string(check.turned) + " faces turned round");
	}

	bool flips() const { return m_options.surgery == Surgery::IntrinsicFlips; }

	void markCones()
	{
		m_cones.assign(at(m_base.vertexCount()), 0);
		for (std::size_t v = 0; v < m_cones.size(); ++v)
			m_cones[v] =
				!m_topology.boundary[v] &&
				std::abs(m_flow.target.curvature[static_cast<Eigen::Index>(v)]) > kConeCurvature;
	}

	/// [edge] About how long the input's edges are in the metric found.
	std::vector<double> lengthsFound() const
	{
		return flips()
				   ? hyperbolicLengths(m_flow, m_base, edgeLengths(m_base, m_component.positions))
				   : m_flow.metric->lengths();
	}

	FuchsianGroup layOut()
	{
		std::vector<Transition> transition(at(m_base.edgeCount()));
		int sectorCount = 0;
		m_layout.sector = cornerSectors(m_base, m_cut.isCut, sectorCount);
		m_layout.position.resize(at(sectorCount));
		if (flips()) {
			m_refinement = overlayOfFlow(
				m_flow,
				Background::HyperbolicPlane,
				m_base,
				m_component.positions,
				m_cut.isCut,
				m_flow.doubled,
				m_options.output == OutputTriangulation::KeepMesh,
				overlayWatch(
					m_interval,
					m_options.output == OutputTriangulation::CommonRefinement,
					m_options.memoryLimit));
			for (std::size_t e = 0; e < transition.size(); ++e)
				transition[e] = m_refinement.transition[e];
			for (int h = 0; h < m_base.halfedgeCount(); ++h)
				if (!m_base.isOuter(h))
					m_layout.position[at(m_layout.sector[at(h)])] = m_refinement.inputLayout.at(h);
		}
		else {
			const CurvatureMap& metric = *m_flow.metric;
			const HyperbolicLayout disk =
				layOutInDisk(m_base, metric.lengths(), metric.angles(), m_cut.isCut);
			for (int e = 0; e < m_base.edgeCount(); ++e)
				if (m_cut.isCut[at(e)])
					offerTransition(
						disk, metric.lengths()[at(e)], 2 * e, 2 * e + 1, transition[at(e)]);
			for (int h = m_base.halfedgeCount() - 1; h >= 0; --h)
				if (!m_base.isOuter(h)) {
					const std::complex<double> z = disk.at(h);
					m_layout.position[at(m_layout.sector[at(h)])] = {z.real(), z.imag()};
				}
		}
		return fuchsianGroup(m_base, m_cut, transition, m_cones);
	}

	/// Largest difference between a boundary loop's length and that of the closed geodesic its
	/// motion moves along: they are one curve where the boundary has no curvature.
	double boundaryError() const
	{
		double error = 0.0;
		for (std::size_t i = 0; i < m_group.ends.size(); ++i)
			for (const std::vector<int>& loop : m_topology.loops)
				if (std::find(loop.begin(), loop.end(), m_group.endVertex[i]) != loop.end() &&
					isGeodesic(loop)) {
					const double half = 0.5 * std::abs(m_group.ends[i].trace());
					error = std::max(
						error, std::abs(2.0 * std::acosh(std::max(half, 1.0)) - lengthOf(loop)));
				}
		return error;
	}

	bool isGeodesic(const std::vector<int>& loop) const
	{
		return std::all_of(loop.begin(), loop.end(), [&](int v) {
			return !m_flow.target.fixed[at(v)] && m_flow.target.curvature[v] == 0.0;
		});
	}

	double lengthOf(const std::vector<int>& loop) const
	{
		double length = 0.0;
		for (int h = 0; h < m_base.halfedgeCount(); ++h) {
			if (m_base.isOuter(h) || !m_base.isBoundaryEdge(Triangulation::edge(h)) ||
				std::find(loop.begin(), loop.end(), m_base.origin(h)) == loop.end())
				continue;
			const double chord =
				chordLength(asComplex(m_layout.at(h)), asComplex(m_layout.at(m_base.next(h))));
			length += 2.0 * std::asinh(0.5 * chord);
		}
		return length;
	}

	void store(Parametrization& result) const
	{
		Chart chart;
		chart.faces = m_component.face;
		chart.group = m_group;
		if (m_options.output == OutputTriangulation::CommonRefinement)
			appendRefinement(m_refinement, m_component, result.refined, chart);
		result.charts.push_back(std::move(chart));
		for (int f = 0; f < m_base.faceCount(); ++f) {
			const std::size_t inputFace = at(m_component.face[at(f)]);
			const auto h = m_base.halfedges(f);
			result.reversed[inputFace] = m_component.reversed[at(f)];
			for (std::size_t k = 0; k < 3; ++k)
				result.uv[inputFace][m_component.inputCorner(at(f), k)] = m_layout.at(h[k]);
		}
		storeFlow(m_flow, m_component, m_topology, 0.0, result);
		Report& report = result.report;
		report.iterations += m_flow.iterations;
		report.refinementPoints += static_cast<int>(m_refinement.crossings);
		report.cones += static_cast<int>(std::count(m_cones.begin(), m_cones.end(), 1));
		storeCut(m_cut, edgeLengths(m_base, m_component.positions), report);
		report.hyperbolicArea = report.hyperbolicArea.value_or(0.0) + m_flow.area;
		report.relationError = std::max(
			{report.relationError.value_or(0.0),
			 m_group.polygonError,
			 m_group.closingError,
			 boundaryError()});
	}

	const Component& m_component;
	const VertexInput& m_input;
	const HyperbolicOptions& m_options;
	Interval m_interval;
	Triangulation m_base;
	Topology m_topology;
	FlowResult m_flow;
	std::vector<char> m_cones;
	CutGraph m_cut;
	CommonRefinement m_refinement; // with flips
	PlanarLayout m_layout;         // points of the disk
	FuchsianGroup m_group;
};

void checkOptions(const HyperbolicOptions& options)
{
	if (options.surgery == Surgery::EdgeSwap || options.packing == PackingScheme::Thurston)
		throw InvalidOption(
			"The hyperbolic flow runs with inversive distances and the surgery 'None' or "
			"'Intrinsic "
			"flips' only.");
	if (options.output == OutputTriangulation::CommonRefinement &&
		options.surgery != Surgery::IntrinsicFlips)
		throw InvalidOption(
			"The output 'Common refinement' belongs to the surgery 'Intrinsic flips': choose this, "
			"or the output 'Keep the mesh'.");
	checkFlowOptions(options);
}

} // namespace

Parametrization parametrizeHyperbolic(
	const SurfaceMesh& mesh,
	const VertexInput& input,
	const HyperbolicOptions& options,
	Progress& progress)
{
	checkOptions(options);
	progress.step(0.0, "Checking the mesh");
	Parametrization result;
	const std::vector<Component> components =
		startResult(mesh, options, options.output, progress, result);
	runComponents(mesh, components, progress, [&](const Component& component, Interval interval) {
		HyperbolicRun(component, input, options, interval).run(result);
	});
	progress.step(kComponentsDone, "Measuring the distortion");
	result.report.seamLengthRelative = result.report.seamLength / std::sqrt(areaOf(mesh));
	result.report.converged = true;
	measureResult(mesh, options.output, measure, result);
	progress.step(1.0, "Layout done");
	return result;
}

} // namespace ricci
