// SPDX-License-Identifier: GPL-3.0-or-later
#include "whole_map.h"

#include "base/parallel.h"
#include "base/task.h"
#include "cones/prescribed_target.h"
#include "flatten_steps.h"
#include "mesh/triangulation.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <numeric>
#include <optional>
#include <string>
#include <thread>
#include <utility>

namespace ricci {

namespace {

/// Of more components than this, the log and the notes describe so many only, the largest.
constexpr std::size_t kDescribedComponents = 20;

/// [component] 1 where nothing is said of it.
std::vector<char> silentComponents(const std::vector<Component>& components)
{
	std::vector<std::size_t> order(components.size());
	std::iota(order.begin(), order.end(), std::size_t(0));
	const std::size_t described = std::min(kDescribedComponents, order.size());
	std::partial_sort(
		order.begin(),
		order.begin() + static_cast<std::ptrdiff_t>(described),
		order.end(),
		[&](std::size_t a, std::size_t b) {
			const std::size_t m = components[a].triangles.size(),
							  n = components[b].triangles.size();
			return m != n ? m > n : a < b;
		});
	std::vector<char> isSilent(components.size(), 1);
	for (std::size_t i = 0; i < described; ++i)
		isSilent[order[i]] = 0;
	return isSilent;
}

/// Gives copies of vertices the values of their vertices, where there are any.
template<class T>
void extendToCopies(const OpenedMesh& opened, std::vector<T>& values)
{
	for (std::size_t v = values.size(); !values.empty() && v < opened.vertex.size(); ++v)
		values.push_back(values[positionOf(opened.vertex[v])]);
}

/// Gives an error the data of the component that it is of, where there are several.
void nameComponent(const OpenedMesh& opened, const Component& component, Error& error)
{
	if (component.triangles.size() == opened.mesh.triangles.size())
		return;
	error.componentFace = opened.face[positionOf(component.face.front())];
	error.componentFaces = component.triangles.size();
}

/// Maps components in threads. The thread that runs it appends them in their order, as soon as they are done.
class ComponentRuns
{
public:
	ComponentRuns(
		const OpenedMesh& opened,
		const VertexInput& values,
		const std::vector<Component>& components,
		const std::function<Parametrization(const Component&)>& flatten,
		bool isInPlane,
		Parametrization& whole) :
			m_opened(opened),
			m_components(components), m_flatten(flatten), m_whole(whole),
			m_isSilent(silentComponents(components)),
			m_originals(originals(components, values.selected, values.targetCurvature, isInPlane)),
			m_mapped(components.size()), m_firstFailed(static_cast<int>(components.size()))
	{
		for (std::size_t i = 0; i < components.size(); ++i) {
			const int original = m_originals[i].number;
			++m_mapped[positionOf(original)].uses;
			if (positionOf(original) != i)
				continue;
			m_toMap.push_back(original);
			m_faces += components[i].triangles.size();
		}
	}

	void run()
	{
		const auto count = static_cast<int>(m_toMap.size());
		const bool hasRoom = hasRoomFor(estimatedMemory(m_faces, m_faces, true));
		tasksInParallel(
			count, hasRoom ? threadsFor(static_cast<std::int64_t>(m_faces)) : 1, [this](int i) {
				mapOne(m_toMap[positionOf(i)]);
			});
		appendDone();
		if (const std::size_t copies = m_components.size() - m_toMap.size(); copies > 0)
			logLine(
				counted(copies, "component is a copy", "components are copies") +
				" of another one and mapped like it.");
		if (positionOf(m_firstFailed) < m_components.size())
			std::rethrow_exception(m_mapped[positionOf(m_firstFailed)].error);
	}

private:
	struct Mapped
	{
		std::optional<Parametrization> part;
		std::vector<std::string> lines;
		std::exception_ptr error;
		int uses = 0; // by copies, too
		std::atomic<bool> isDone{false};
	};

	void mapOne(int i)
	{
		if (i > m_firstFailed)
			return;
		const Component& component = m_components[positionOf(i)];
		Mapped& own = m_mapped[positionOf(i)];
		const auto share = [&](std::size_t done) {
			return kComponentsDone * static_cast<double>(done) / static_cast<double>(m_faces);
		};
		const bool isCaller = std::this_thread::get_id() == m_caller;
		try {
			const std::size_t before = m_facesDone;
			Task part(
				share(before),
				share(before + component.triangles.size()),
				m_isSilent[positionOf(i)] != 0);
			if (!isCaller || i != m_appended)
				part.keepLines(own.lines);
			own.part = m_flatten(component);
		}
		catch (const Stopped&) {
			throw; // not the component's fault
		}
		catch (Error& error) {
			nameComponent(m_opened, component, error);
			own.error = std::current_exception();
			for (int first = m_firstFailed;
				 i < first && !m_firstFailed.compare_exchange_weak(first, i);) {
			}
		}
		m_facesDone += component.triangles.size();
		own.isDone = true;
		if (isCaller)
			appendDone();
	}

	/// The whole takes no memory before a component is mapped.
	void appendDone()
	{
		const std::size_t vertices = m_opened.mesh.positions.size();
		if (m_whole.u.size() < vertices) {
			m_whole.mesh.source = verticesOf(vertices);
			m_whole.u.assign(vertices, 0.0);
			m_whole.targetCurvature.assign(vertices, 0.0);
		}
		for (; positionOf(m_appended) < m_mapped.size(); ++m_appended) {
			const Original& original = m_originals[positionOf(m_appended)];
			Mapped& own = m_mapped[positionOf(original.number)];
			if (!own.isDone)
				return;
			logLines(own.lines);
			own.lines.clear();
			if (own.error)
				return;
			if (m_isSilent[positionOf(m_appended)] != 0)
				own.part->notes.clear();
			const bool isLast = --own.uses == 0;
			Parametrization part = isLast ? std::move(*own.part) : *own.part;
			if (isLast)
				own.part.reset();
			else {
				own.part->report.iterations = 0; // the copies need none
				own.part->report.flowStates.clear();
				own.part->notes.clear();
			}
			if (original.mirrored)
				mirror(original.order, part.charts.size(), part.mesh);
			append(
				original.mirrored ? *original.mirrored : m_components[positionOf(m_appended)],
				std::move(part),
				m_whole);
		}
	}

	const OpenedMesh& m_opened;
	const std::vector<Component>& m_components;
	const std::function<Parametrization(const Component&)>& m_flatten;
	Parametrization& m_whole;
	const std::vector<char> m_isSilent;
	const std::vector<Original> m_originals; // [component]
	std::vector<int> m_toMap;                // components that are copies of none
	std::size_t m_faces = 0;                 // of these
	const std::thread::id m_caller = std::this_thread::get_id();
	std::vector<Mapped> m_mapped;
	int m_appended = 0; // components
	std::atomic<int> m_firstFailed;
	std::atomic<std::size_t> m_facesDone{0};
};

} // namespace

WholeMap
open(const SurfaceMesh& mesh, const VertexInput& input, const FlowOptions& options, OneSidedCut cut)
{
	requireLength("selected", input.selected.size(), mesh.positions.size());
	requireLength("targetCurvature", input.targetCurvature.size(), mesh.positions.size());
	advance(0.0, "Checking the mesh");
	WholeMap whole;
	Parametrization& map = whole.map;
	whole.opened = openMesh(mesh, cut, options.join, options.sharpAngle);
	const OpenedMesh& opened = whole.opened;
	whole.components = splitIntoComponents(opened);
	if (options.method != Method::IntrinsicFlips)
		requireAreaEverywhere(whole.components);
	std::size_t largest = 0;
	for (const Component& component : whole.components)
		largest = std::max(largest, component.triangles.size());
	requireMemory(
		largest,
		opened.mesh.triangles.size(),
		options.output == OutputTriangulation::CommonRefinement);
	map.notes = openingNotes(mesh, opened);
	logLines(map.notes);
	whole.values = input;
	for (std::size_t v = 0; v < opened.joined.size() && !input.selected.empty(); ++v)
		whole.values.selected[positionOf(opened.joined[v])] |= input.selected[v];
	extendToCopies(opened, whole.values.selected);
	extendToCopies(opened, whole.values.targetCurvature);
	Report& report = map.report;
	report.joinedEdges = opened.joinedEdges;
	report.piecesApart = opened.piecesApart;
	report.cutNonmanifoldEdges = opened.cutEdges;
	report.splitVertices = opened.splitVertices;
	report.duplicateFaces = opened.duplicateFaces;
	report.oneSidedComponents = opened.oneSidedComponents;
	report.degenerateFaces = static_cast<int>(opened.degenerate.size());
	report.chosenSeamEdges = opened.seamEdges;
	report.chosenSeamLength = opened.seamLength;
	report.seamEdges = opened.seamEdgesAdded;
	report.seamLength = opened.seamLengthAdded;
	return whole;
}

void append(const Component& component, Parametrization part, Parametrization& whole)
{
	FlatMesh &mesh = whole.mesh, &own = part.mesh;
	const int vertexCount = component.vertex.size();
	Array<int> index(component.vertex.values()); // of each vertex of the component's mesh
	for (int i = vertexCount; i < own.source.size(); ++i) {
		SurfacePoint p = own.source[i];
		for (int& v : p.vertex)
			v = component.vertex[Vertex(v)];
		index.push_back(mesh.source.size());
		mesh.source.push_back(p);
	}
	part.report.refinementPoints = std::max(0, own.source.size() - vertexCount);
	own.source = {};
	for (Triangle& vertices : own.vertices)
		for (int& v : vertices)
			v = index[v];
	for (int& chart : own.chart)
		chart += static_cast<int>(whole.charts.size());
	for (int& face : own.face)
		face = component.face[Face(face)];
	mesh.append(std::move(own));
	whole.charts.insert(whole.charts.end(), part.charts.begin(), part.charts.end());
	for (const Vertex v : component.vertex.indices()) {
		const std::size_t vertex = positionOf(component.vertex[v]);
		whole.u[vertex] = part.u[positionOf(v)];
		whole.targetCurvature[vertex] = part.targetCurvature[positionOf(v)];
	}
	for (const int v : part.placedCones)
		whole.placedCones.push_back(component.vertex[Vertex(v)]);
	whole.notes.insert(whole.notes.end(), part.notes.begin(), part.notes.end());
	whole.report += part.report;
}

Report& Report::operator+=(const Report& next)
{
	for (FlowState state : next.flowStates) {
		state.component += components;
		flowStates.push_back(state);
	}
	for (int Report::*count : std::initializer_list<int Report::*>{
			 &Report::components,
			 &Report::iterations,
			 &Report::brokenTriangles,
			 &Report::flips,
			 &Report::finishMoved,
			 &Report::endedEarly,
			 &Report::edgeSwaps,
			 &Report::boundarySplits,
			 &Report::refinementPoints,
			 &Report::eulerCharacteristic,
			 &Report::genus,
			 &Report::boundaryLoops,
			 &Report::cappedHoles,
			 &Report::cones,
			 &Report::seamEdges,
			 &Report::overlapCuts})
		this->*count += next.*count;
	seamLength += next.seamLength;
	for (double Report::*error : std::initializer_list<double Report::*>{
			 &Report::maxCurvatureError, &Report::residualFloor, &Report::lengthened})
		this->*error = std::max(this->*error, next.*error);
	if (next.hyperbolicArea)
		hyperbolicArea = hyperbolicArea.value_or(0.0) + *next.hyperbolicArea;
	const bool isOnly = components == next.components;
	if (isOnly || targetUsed == next.targetUsed)
		targetUsed = next.targetUsed;
	else
		targetUsed = TargetUsed::Several;
	choice = isOnly || choice == next.choice ? next.choice : "";
	for (std::optional<double> Report::*largest :
		 std::initializer_list<std::optional<double> Report::*>{
			 &Report::holonomyError,
			 &Report::relationError,
			 &Report::expectedSpread,
			 &Report::boundaryRatioMax})
		if (next.*largest)
			this->*largest = std::max((this->*largest).value_or(0.0), *(next.*largest));
	if (next.boundaryRatioMin)
		boundaryRatioMin =
			std::min(boundaryRatioMin.value_or(*next.boundaryRatioMin), *next.boundaryRatioMin);
	for (std::optional<double> Report::*invariant :
		 std::initializer_list<std::optional<double> Report::*>{
			 &Report::torusTauRe,
			 &Report::torusTauIm,
			 &Report::annulusModulus,
			 &Report::rectangleAspect,
			 &Report::periodError})
		this->*invariant = isOnly ? next.*invariant : std::nullopt;
	periodMatrix = isOnly ? next.periodMatrix : std::vector<std::complex<double>>();
	return *this;
}

std::size_t faceCount(const std::vector<Component>& components)
{
	std::size_t count = 0;
	for (const Component& component : components)
		count += component.triangles.size();
	return count;
}

void appendComponents(
	const OpenedMesh& opened,
	const VertexInput& values,
	const std::vector<Component>& components,
	const std::function<Parametrization(const Component&)>& flatten,
	bool isInPlane,
	Parametrization& whole)
{
	ComponentRuns(opened, values, components, flatten, isInPlane, whole).run();
	if (components.size() > kDescribedComponents)
		logLine(
			"The log leaves out the smaller ones of " + std::to_string(components.size()) +
			" components.");
}

namespace {

/// Half the side of the square in which components that are left out lie in the unit disk: that inscribed in it, less a margin.
constexpr double kHalfSquare = 0.7;

/// Why a component has no metric with the target; null where it has one.
std::exception_ptr whyNot(
	const OpenedMesh& opened,
	const Component& component,
	const VertexInput& input,
	const HyperbolicTargetOptions& options)
{
	const Topology topology =
		topologyOf(Triangulation(component.positions.size(), component.triangles));
	try {
		chooseHyperbolicTarget(
			topology, options, inputOf(component, input, component.vertex.size()));
	}
	catch (InadmissibleCurvature& error) {
		nameComponent(opened, component, error);
		if (error.problem == InadmissibleCurvature::HyperbolicSurface ||
			error.problem == InadmissibleCurvature::HyperbolicSum ||
			error.problem == InadmissibleCurvature::FreeBoundary)
			return std::current_exception();
	}
	catch (InvalidOption& error) {
		nameComponent(opened, component, error);
		if (error.problem == InvalidOption::NothingSelected)
			return std::current_exception();
	}
	return nullptr; // any other error is met again, and thrown, where the component is mapped
}

} // namespace

std::vector<Component> leaveOut(
	const OpenedMesh& opened,
	const VertexInput& input,
	const HyperbolicTargetOptions& options,
	std::vector<Component>& components)
{
	std::vector<Component> kept, leftOut;
	if (components.size() == 1)
		return leftOut;
	std::exception_ptr why;
	int largest = 0; // faces
	for (Component& component : components) {
		checkpoint();
		const std::exception_ptr found = whyNot(opened, component, input, options);
		if (found && component.face.size() > largest) {
			largest = component.face.size();
			why = found;
		}
		(found ? leftOut : kept).push_back(std::move(component));
	}
	if (kept.empty())
		std::rethrow_exception(why);
	components = std::move(kept);
	return leftOut;
}

void addBeside(Parametrization leftOut, Parametrization& map)
{
	FlatMesh &mesh = map.mesh, &own = leftOut.mesh;
	for (Point2& p : own.place)
		for (double& x : p)
			x = kHalfSquare * (2.0 * x - 1.0);
	own.across.assign(own.across.size(), Corner());
	own.chart.assign(own.chart.size(), static_cast<int>(map.charts.size()));
	map.charts.emplace_back();
	mesh.append(std::move(own));
	Report& report = map.report;
	for (int Report::*count : std::initializer_list<int Report::*>{
			 &Report::components,
			 &Report::iterations,
			 &Report::flips,
			 &Report::finishMoved,
			 &Report::endedEarly,
			 &Report::eulerCharacteristic,
			 &Report::genus,
			 &Report::boundaryLoops,
			 &Report::cappedHoles,
			 &Report::seamEdges,
			 &Report::overlapCuts})
		report.*count += leftOut.report.*count;
	report.seamLength += leftOut.report.seamLength;
	report.leftOutComponents = leftOut.report.components;
}

} // namespace ricci
