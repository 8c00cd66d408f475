// SPDX-License-Identifier: GPL-3.0-or-later
#include "target_curvature.h"

#include "../error.h"
#include "../layout/least_rectangle.h"
#include "../numbers.h"
#include "../text.h"
#include "cone_placement.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace ricci {

namespace {

/// Share of sum |K| that rounding may put between a prescribed curvature and Gauss-Bonnet, in
/// units of the precision of its values.
constexpr double kRoundingShare = 4.0;

std::string number(double x)
{
	return numberText(x, 9);
}

std::vector<int> selectedVertices(const TargetRequest& request)
{
	std::vector<int> vertices;
	for (std::size_t v = 0; v < request.selected.size(); ++v)
		if (request.selected[v])
			vertices.push_back(static_cast<int>(v));
	return vertices;
}

/// Fixes u on the boundary (paper 5.3).
void freeTheBoundary(const Topology& topology, Target& target)
{
	target.fixed = topology.boundary;
	target.notes.push_back("Free boundary: the boundary keeps its metric.");
}

void noteImpliedBoundary(const TargetRequest& request, const Topology& topology, Target& target)
{
	if (request.freeBoundary && !topology.isClosed())
		target.notes.push_back(
			"The target prescribes the boundary: free_boundary has no effect on it.");
}

/// Total curvature \p total on the loops, in proportion to the length of the two boundary edges at
/// each vertex.
void spreadOverBoundary(
	const Triangulation& t, const std::vector<double>& lengths, double total, Target& target)
{
	double perimeter = 0.0;
	for (int h = 0; h < t.halfedgeCount(); ++h)
		if (t.isOuter(h))
			perimeter += lengths[at(Triangulation::edge(h))];
	if (!(perimeter > 0.0))
		throw InvalidMesh("The boundary has no length: all its vertices lie in one point.");
	for (int h = 0; h < t.halfedgeCount(); ++h) {
		if (!t.isOuter(h))
			continue;
		const double share = 0.5 * total * lengths[at(Triangulation::edge(h))] / perimeter;
		target.curvature[t.origin(h)] += share;
		target.curvature[t.target(h)] += share;
	}
}

void setFlat(const Topology& topology, const TargetRequest& request, Target& target)
{
	if (topology.eulerCharacteristic != 0)
		throw InadmissibleCurvature(
			"'Flat everywhere' needs total curvature 2 pi chi = 0, but the surface is " +
			topology.name() + " with 2 pi chi = " + number(2 * kPi * topology.eulerCharacteristic) +
			": choose another target_curvature.");
	noteImpliedBoundary(request, topology, target);
}

void setDisk(
	const Triangulation& t,
	const Topology& topology,
	const std::vector<double>& lengths,
	const TargetRequest& request,
	Target& target)
{
	if (!topology.isDisk())
		throw InvalidOption(
			"'Disk' needs a topological disk (genus 0, one boundary loop), but the surface is " +
			topology.name() + ".");
	target.circular = true;
	spreadOverBoundary(t, lengths, 2 * kPi, target);
	noteImpliedBoundary(request, topology, target);
}

void setRectangle(
	const Topology& topology,
	const std::vector<Point3>& positions,
	const TargetRequest& request,
	Target& target)
{
	if (!topology.isDisk())
		throw InvalidOption(
			"'Rectangle' needs a topological disk (genus 0, one boundary loop), but the surface "
			"is " +
			topology.name() + ".");
	const std::vector<int>& loop = topology.loops.front();
	const std::vector<int> selected = selectedVertices(request);
	if (loop.size() < 4)
		throw InvalidOption(
			"'Rectangle' needs four boundary vertices, but the boundary has " +
			std::to_string(loop.size()) + ".");
	if (selected.empty()) {
		target.corners = rectangleCorners(loop, positions);
		target.notes.push_back("No vertices are selected: the corners are the boundary vertices "
							   "nearest to the corners "
							   "of the least rectangle round the boundary.");
	}
	else {
		if (selected.size() != 4)
			throw InvalidOption(
				"'Rectangle' needs four selected boundary vertices, or none, but " +
				std::to_string(selected.size()) + " are selected.");
		std::size_t found = 0;
		for (int v : loop)
			if (request.selected[at(v)])
				target.corners[found++] = v;
		if (found != 4)
			throw InvalidOption(
				"'Rectangle' needs four selected vertices on one boundary loop, but only " +
				std::to_string(found) + " of the selected vertices lie on it.");
	}
	for (int v : target.corners)
		target.curvature[v] = 0.5 * kPi;
	target.isRectangle = true;
	noteImpliedBoundary(request, topology, target);
}

void setCones(const Topology& topology, const TargetRequest& request, Target& target)
{
	const std::vector<int> cones = selectedVertices(request);
	if (cones.empty())
		throw InvalidOption(
			"'Cones at selected vertices' needs selected vertices, but none is selected.");
	const double share = 2 * kPi * topology.eulerCharacteristic / static_cast<double>(cones.size());
	bool onBoundary = false;
	for (int v : cones) {
		target.curvature[v] = share;
		onBoundary |= topology.boundary[at(v)] != 0;
	}
	target.notes.push_back(
		std::to_string(cones.size()) + " cones of curvature " + number(share) + " each.");
	if (topology.isClosed())
		return;
	if (request.freeBoundary && !onBoundary)
		freeTheBoundary(topology, target);
	else if (request.freeBoundary)
		target.notes.push_back("Cones lie on the boundary, which is therefore prescribed: "
							   "free_boundary has no effect.");
}

/// Copies the prescribed values; a defect of rounding size is spread in proportion to |K|.
void setPrescribed(const Topology& topology, const TargetRequest& request, Target& target)
{
	// A sum of many equal values in double drifts by more than their own rounding.
	long double exactSum = 0.0L;
	double magnitude = 0.0;
	std::size_t notFinite = 0;
	for (std::size_t v = 0; v < request.prescribed.size(); ++v) {
		double K = request.prescribed[v];
		if (std::abs(K) <= kRoundingShare * request.prescribedPrecision) // no cone
			K = 0.0;
		notFinite += !std::isfinite(K);
		target.curvature[static_cast<Eigen::Index>(v)] = K;
		exactSum += K;
		magnitude += std::abs(K);
	}
	if (notFinite > 0)
		throw InadmissibleCurvature(
			std::to_string(notFinite) + (notFinite == 1 ? " vertex has" : " vertices have") +
			" a quality that is not a finite number: 'From vertex quality' needs the "
			"target curvature in radians at every vertex.");
	if (!topology.isClosed() && request.freeBoundary) {
		freeTheBoundary(topology, target);
		return;
	}
	const auto sum = static_cast<double>(exactSum);
	const double wanted = 2 * kPi * topology.eulerCharacteristic;
	const double defect = wanted - sum;
	if (std::abs(defect) > kRoundingShare * request.prescribedPrecision * (magnitude + 2 * kPi))
		throw InadmissibleCurvature(
			"The vertex qualities add up to " + number(sum) +
			", but a metric on this surface has total curvature 2 pi chi = " + number(wanted) +
			" (Gauss-Bonnet): correct the qualities.");
	if (magnitude > 0.0)
		target.curvature += (defect / magnitude) * target.curvature.cwiseAbs();
}

/// Cones where they lower the distortion of area; a boundary is free or, if it is not to be, takes
/// the rest of the curvature in proportion to its length.
void setPlacedCones(
	const Triangulation& t,
	const Topology& topology,
	const std::vector<double>& lengths,
	const TargetRequest& request,
	Target& target)
{
	const bool prescribed = !topology.isClosed() && !request.freeBoundary;
	ConeRequest wanted;
	wanted.count = request.coneCount;
	wanted.distortion = request.coneDistortion;
	wanted.rounding = request.coneRounding;
	wanted.vertices = request.coneVertices;
	wanted.boundary = prescribed ? ConeBoundary::Prescribed : ConeBoundary::Fixed;
	const PlacedCones cones = placeCones(t, lengths, wanted);
	double total = 0.0;
	std::vector<std::pair<int, double>> named;
	for (std::size_t i = 0; i < cones.vertices.size(); ++i) {
		const int v = cones.vertices[i];
		target.curvature[v] = cones.curvatures[i];
		total += cones.curvatures[i];
		const bool hasNumber = at(v) < request.vertexNumbers.size();
		named.emplace_back(hasNumber ? request.vertexNumbers[at(v)] : v, cones.curvatures[i]);
	}
	std::sort(named.begin(), named.end());
	std::string list;
	for (const auto& [vertex, curvature] : named)
		list += (list.empty() ? " " : ", ") + std::to_string(vertex) + " (" +
				number(curvature / kPi) + ")";
	target.notes.push_back(
		std::to_string(cones.vertices.size()) + " cones placed, expected area distortion " +
		number(cones.distortion) + " (spread); vertex (curvature / pi):" + list + ".");
	if (prescribed) {
		spreadOverBoundary(t, lengths, 2 * kPi * topology.eulerCharacteristic - total, target);
		target.notes.push_back(
			"The boundary is prescribed: its curvature is proportional to its length.");
	}
	else if (!topology.isClosed())
		freeTheBoundary(topology, target);
}

void setAutomatic(
	const Triangulation& t,
	const Topology& topology,
	const std::vector<double>& lengths,
	const TargetRequest& request,
	Target& target)
{
	if (topology.isTorus() || topology.isAnnulus())
		return setFlat(topology, request, target);
	if (topology.isClosed())
		return setPlacedCones(t, topology, lengths, request, target);
	if (request.freeBoundary)
		return freeTheBoundary(topology, target);
	if (topology.isDisk())
		return setDisk(t, topology, lengths, request, target);
	spreadOverBoundary(t, lengths, 2 * kPi * topology.eulerCharacteristic, target);
	target.notes.push_back(
		"The boundary is prescribed: its curvature is proportional to its length.");
}

/// Existence: bounds at each vertex, and the sum where the boundary is free.
void checkAdmissible(const Topology& topology, const Target& target)
{
	int tooLarge = 0, worst = -1;
	double insideSum = 0.0;
	int boundaryCount = 0;
	bool anyFixed = false;
	for (int v = 0; v < static_cast<int>(target.fixed.size()); ++v) {
		const bool onBoundary = topology.boundary[at(v)] != 0;
		boundaryCount += onBoundary;
		if (target.fixed[at(v)]) {
			anyFixed = true;
			continue;
		}
		const double K = target.curvature[v];
		if (K >= (onBoundary ? kPi : 2 * kPi) && !target.circular) {
			++tooLarge;
			if (worst < 0 || K > target.curvature[worst])
				worst = v;
		}
		if (!onBoundary)
			insideSum += K;
	}
	if (tooLarge > 0) {
		const bool onBoundary = topology.boundary[at(worst)] != 0;
		throw InadmissibleCurvature(
			"No metric has curvature " + number(target.curvature[worst]) + " at " +
			(onBoundary ? "a boundary" : "an interior") + " vertex (" + std::to_string(tooLarge) +
			" such): it must be less than " +
			(onBoundary ? "pi = 3.14159265 on the boundary" : "2 pi = 6.28318531 inside") +
			". Choose more or weaker cones.");
	}
	const double bound = 2 * kPi * topology.eulerCharacteristic - kPi * boundaryCount;
	if (anyFixed && insideSum <= bound)
		throw InadmissibleCurvature(
			"The curvature inside adds up to " + number(insideSum) +
			", but with a free boundary of " + std::to_string(boundaryCount) +
			" vertices it must be more than 2 pi chi - pi (boundary vertices) = " + number(bound) +
			".");
}

} // namespace

std::string Topology::name() const
{
	if (isClosed())
		return genus == 0   ? "a closed surface of genus 0 (a sphere)"
			   : genus == 1 ? "a closed surface of genus 1 (a torus)"
							: "a closed surface of genus " + std::to_string(genus);
	if (isDisk())
		return "a disk";
	if (isAnnulus())
		return "an annulus";
	return "a surface of genus " + std::to_string(genus) + " with " + std::to_string(loops.size()) +
		   " boundary loop" + (loops.size() == 1 ? "" : "s");
}

Topology topologyOf(const Triangulation& t)
{
	Topology topology;
	topology.boundary = t.boundaryVertices();
	topology.eulerCharacteristic = t.eulerCharacteristic();
	for (int first : t.boundaryLoops()) {
		// Outer halfedges run with the surface on their right: collect and reverse.
		std::vector<int> loop;
		int h = first;
		do {
			loop.push_back(t.origin(h));
			h = t.next(h);
		} while (h != first);
		std::reverse(loop.begin(), loop.end());
		topology.loops.push_back(std::move(loop));
	}
	topology.genus =
		(2 - topology.eulerCharacteristic - static_cast<int>(topology.loops.size())) / 2;
	return topology;
}

Target chooseTarget(
	const Triangulation& t,
	const Topology& topology,
	const std::vector<double>& lengths,
	const std::vector<Point3>& positions,
	const TargetRequest& request)
{
	Target target;
	target.curvature = Eigen::VectorXd::Zero(t.vertexCount());
	target.fixed.assign(at(t.vertexCount()), 0);
	switch (request.mode) {
	case TargetCurvature::Automatic:
		setAutomatic(t, topology, lengths, request, target);
		break;
	case TargetCurvature::Flat:
		setFlat(topology, request, target);
		break;
	case TargetCurvature::Disk:
		setDisk(t, topology, lengths, request, target);
		break;
	case TargetCurvature::Rectangle:
		setRectangle(topology, positions, request, target);
		break;
	case TargetCurvature::SelectedCones:
		setCones(topology, request, target);
		break;
	case TargetCurvature::Prescribed:
		setPrescribed(topology, request, target);
		break;
	case TargetCurvature::PlacedCones:
		setPlacedCones(t, topology, lengths, request, target);
		break;
	}
	checkAdmissible(topology, target);
	return target;
}

namespace {

/// The loop's points in the plane through their mean that fits them best.
std::vector<Point2>
projectToBestPlane(const std::vector<int>& loop, const std::vector<Point3>& positions)
{
	Eigen::Vector3d mean = Eigen::Vector3d::Zero();
	for (int v : loop)
		mean += Eigen::Map<const Eigen::Vector3d>(positions[at(v)].data());
	mean /= static_cast<double>(loop.size());
	Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
	for (int v : loop) {
		const Eigen::Vector3d p = Eigen::Map<const Eigen::Vector3d>(positions[at(v)].data()) - mean;
		covariance += p * p.transpose();
	}
	const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(covariance);
	std::vector<Point2> points;
	for (int v : loop) {
		const Eigen::Vector3d p = Eigen::Map<const Eigen::Vector3d>(positions[at(v)].data()) - mean;
		points.push_back({axes.eigenvectors().col(2).dot(p), axes.eigenvectors().col(1).dot(p)});
	}
	return points;
}

std::array<int, 4>
quartersByLength(const std::vector<int>& loop, const std::vector<Point3>& positions)
{
	const std::size_t n = loop.size();
	std::vector<double> along(n + 1, 0.0);
	for (std::size_t i = 0; i < n; ++i)
		along[i + 1] =
			along[i] + distance(positions[at(loop[i])], positions[at(loop[(i + 1) % n])]);
	std::array<int, 4> corners;
	std::size_t previous = 0;
	for (std::size_t k = 0; k < 4; ++k) {
		const double wanted = along[n] * static_cast<double>(k) / 4;
		const auto above = std::lower_bound(along.begin(), along.end() - 1, wanted);
		std::size_t i = static_cast<std::size_t>(above - along.begin());
		i = std::min(std::max(i, k == 0 ? 0 : previous + 1), n - 4 + k);
		corners[k] = loop[i];
		previous = i;
	}
	return corners;
}

} // namespace

std::array<int, 4>
rectangleCorners(const std::vector<int>& loop, const std::vector<Point3>& positions)
{
	const std::vector<Point2> points = projectToBestPlane(loop, positions);
	const OrientedRectangle r = leastRectangle(points);
	const std::array<Point2, 4> wanted{
		{{r.low[0], r.low[1]},
		 {r.high[0], r.low[1]},
		 {r.high[0], r.high[1]},
		 {r.low[0], r.high[1]}}};
	std::array<std::size_t, 4> nearest;
	for (std::size_t k = 0; k < 4; ++k) {
		double least = std::numeric_limits<double>::infinity();
		for (std::size_t i = 0; i < points.size(); ++i) {
			const Point2 x = r.inFrame(points[i]);
			const double d = std::hypot(x[0] - wanted[k][0], x[1] - wanted[k][1]);
			if (d < least)
				least = d, nearest[k] = i;
		}
	}
	// In order along the loop, in either direction: exactly one descent in the cyclic sequence.
	int rises = 0, falls = 0;
	for (std::size_t k = 0; k < 4; ++k) {
		rises += nearest[(k + 1) % 4] > nearest[k];
		falls += nearest[(k + 1) % 4] < nearest[k];
	}
	if (rises + falls != 4 || (rises != 1 && falls != 1))
		return quartersByLength(loop, positions);
	std::sort(nearest.begin(), nearest.end());
	return {loop[nearest[0]], loop[nearest[1]], loop[nearest[2]], loop[nearest[3]]};
}

} // namespace ricci
