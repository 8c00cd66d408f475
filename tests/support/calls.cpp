// SPDX-License-Identifier: GPL-3.0-or-later
#include "calls.h"

#include <ostream>
#include <type_traits>

namespace ricci::testing {

namespace {

/// The bytes of numbers, and of arrays of them.
class Bytes
{
public:
	template<class T>
	void add(const T& value)
	{
		static_assert(std::is_trivially_copyable_v<T>);
		m_all.append(reinterpret_cast<const char*>(&value), sizeof value);
	}
	template<class Range>
	void addAll(const Range& range)
	{
		for (const auto& value : range)
			add(value);
		m_all += '|';
	}
	void addText(const std::string& text) { m_all += text + '|'; }

	const std::string& all() const { return m_all; }

private:
	std::string m_all;
};

void addMesh(const FlatMesh& mesh, Bytes& bytes)
{
	bytes.addAll(mesh.vertices);
	bytes.addAll(mesh.points);
	bytes.addAll(mesh.place);
	bytes.addAll(mesh.chart);
	bytes.addAll(mesh.face);
	for (const SurfacePoint& p : mesh.source) {
		bytes.addAll(p.vertex);
		bytes.addAll(p.weight);
	}
}

} // namespace

std::ostream& operator<<(std::ostream& out, const Call& call)
{
	return out << call.name;
}

Outcome outcomeOf(const Call& call)
{
	if (const auto* options = std::get_if<SphereOptions>(&call.options))
		return {{}, mapToSphere(call.mesh, *options)};
	if (const auto* options = std::get_if<HyperbolicOptions>(&call.options))
		return {parametrizeHyperbolic(call.mesh, call.input, *options), {}};
	return {parametrizeEuclidean(call.mesh, call.input, std::get<Options>(call.options)), {}};
}

std::vector<Figure> figuresOf(const Report& r)
{
	const auto known = [](const auto& value) { return double(value.value_or(-1)); };
	std::vector<Figure> figures{
		{"converged", double(r.converged), Figure::Count},
		{"targetUsed", r.targetUsed ? double(*r.targetUsed) : -1.0, Figure::Count},
		{"flippedFaces", double(r.flippedFaces), Figure::Count},
		{"flippedByRounding", double(r.flippedByRounding), Figure::Count},
		{"brokenTriangles", double(r.brokenTriangles), Figure::Count},
		{"eulerCharacteristic", double(r.eulerCharacteristic), Figure::Count},
		{"genus", double(r.genus), Figure::Count},
		{"boundaryLoops", double(r.boundaryLoops), Figure::Count},
		{"components", double(r.components), Figure::Count},
		{"cones", double(r.cones), Figure::Count},
		{"seamEdges", double(r.seamEdges), Figure::Cut},
		{"chosenSeamEdges", double(r.chosenSeamEdges), Figure::Count},
		{"charts", double(r.charts), Figure::Cut},
		{"cutNonmanifoldEdges", double(r.cutNonmanifoldEdges), Figure::Count},
		{"splitVertices", double(r.splitVertices), Figure::Count},
		{"duplicateFaces", double(r.duplicateFaces), Figure::Count},
		{"oneSidedComponents", double(r.oneSidedComponents), Figure::Count},
		{"degenerateFaces", double(r.degenerateFaces), Figure::Count},
		{"cappedHoles", double(r.cappedHoles), Figure::Count},
		{"overlappingFaces", double(r.overlappingFaces), Figure::Count},
		{"overlappingCharts", double(r.overlappingCharts), Figure::Count},
		{"unequalSeams", double(r.unequalSeams), Figure::Count},
		{"overlapCuts", double(r.overlapCuts), Figure::Cut},
		{"refinementPoints", double(r.refinementPoints), Figure::Count},
		{"edgeSwaps", double(r.edgeSwaps), Figure::Count},
		{"boundarySplits", double(r.boundarySplits), Figure::Count},
		{"lengthened", r.lengthened, Figure::Measure},
		{"expectedSpread", known(r.expectedSpread), Figure::Measure},
		{"boundaryRatioMin", known(r.boundaryRatioMin), Figure::Measure},
		{"boundaryRatioMax", known(r.boundaryRatioMax), Figure::Measure},
		{"qcMean", r.qcMean, Figure::Measure},
		{"qcVertexMean", r.qcVertexMean, Figure::Measure},
		{"qcAreaMean", r.qcAreaMean, Figure::Measure},
		{"qcP99", r.qcP99, Figure::Measure},
		{"qcMax", r.qcMax, Figure::Measure},
		{"areaDistortionMean", r.areaDistortionMean, Figure::Measure},
		{"areaDistortionSpread", r.areaDistortionSpread, Figure::Measure},
		{"stretch", known(r.stretch), Figure::Measure},
		{"objective", known(r.objective), Figure::Cut},
		{"seamLengthRelative", r.seamLengthRelative, Figure::Cut},
		{"occupancy", r.occupancy, Figure::Cut},
		{"torusTauRe", known(r.torusTauRe), Figure::Measure},
		{"torusTauIm", known(r.torusTauIm), Figure::Measure},
		{"annulusModulus", known(r.annulusModulus), Figure::Measure},
		{"rectangleAspect", known(r.rectangleAspect), Figure::Measure},
		{"hyperbolicArea", known(r.hyperbolicArea), Figure::Measure},
		{"iterations", double(r.iterations), Figure::Work},
		{"flips", double(r.flips), Figure::Work},
		{"finishMoved", double(r.finishMoved), Figure::Work},
		{"endedEarly", double(r.endedEarly), Figure::Work},
		{"seamLength", r.seamLength, Figure::Length},
		{"chosenSeamLength", r.chosenSeamLength, Figure::Length},
		{"maxCurvatureError", r.maxCurvatureError, Figure::Error},
		{"residualFloor", r.residualFloor, Figure::Error},
		{"holonomyError", known(r.holonomyError), Figure::Error},
		{"periodError", known(r.periodError), Figure::Error},
		{"relationError", known(r.relationError), Figure::Error}};
	return figures;
}

std::vector<Figure> figuresOf(const SphereMap& map)
{
	return {
		{"flippedFaces", double(map.flippedFaces), Figure::Count},
		{"qcAreaMean", map.qcAreaMean, Figure::Measure},
		{"qcMax", map.qcMax, Figure::Measure},
		{"areaDistortionMean", map.areaDistortionMean, Figure::Measure},
		{"areaDistortionSpread", map.areaDistortionSpread, Figure::Measure},
		{"iterations", double(map.iterations), Figure::Work},
		{"maxCurvatureError", map.maxCurvatureError, Figure::Error},
		{"offset", map.offset, Figure::Error}};
}

std::vector<Figure> figuresOf(const Outcome& outcome)
{
	return outcome.sphere.positions.empty() ? figuresOf(outcome.map.report)
											: figuresOf(outcome.sphere);
}

std::string bitsOf(const Outcome& outcome)
{
	Bytes bytes;
	for (const Figure& figure : figuresOf(outcome))
		if (figure.kind != Figure::Length)
			bytes.add(figure.value);
	const Parametrization& map = outcome.map;
	addMesh(map.mesh, bytes);
	for (const Chart& chart : map.charts) {
		bytes.add(chart.box);
		bytes.addAll(chart.group.sides);
		bytes.addAll(chart.group.peripheral);
		bytes.addAll(chart.group.handles);
		bytes.add(chart.middle);
	}
	bytes.addAll(map.report.periodMatrix);
	for (const FlowState& state : map.report.flowStates) {
		bytes.add(state.component);
		bytes.add(state.step);
		bytes.add(state.residual);
	}
	bytes.addText(map.report.choice);
	for (const std::string& note : map.notes)
		bytes.addText(note);
	bytes.addAll(map.vertexQC);
	bytes.addAll(map.targetCurvature);
	bytes.addAll(map.placedCones);
	bytes.addAll(outcome.sphere.positions);
	bytes.addAll(outcome.sphere.vertex);
	bytes.addAll(outcome.sphere.triangles);
	bytes.add(outcome.sphere.pole);
	return bytes.all();
}

} // namespace ricci::testing
