// SPDX-License-Identifier: GPL-3.0-or-later
#include "prescribed_target.h"

#include "../base/convex_hull.h"
#include "../base/numbers.h"
#include "../base/tolerances.h"
#include "../error.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <string>

namespace ricci {

Target zeroTarget(const Topology& topology)
{
	Target target;
	target.curvature = VertexVector::Zero(topology.boundary.size());
	target.fixed.assign(topology.boundary.size(), 0);
	return target;
}

std::vector<Vertex> selectedVertices(const std::vector<char>& selected)
{
	std::vector<Vertex> vertices;
	for (std::size_t v = 0; v < selected.size(); ++v)
		if (selected[v])
			vertices.push_back(Vertex(static_cast<int>(v)));
	return vertices;
}

std::vector<Vertex> selectedCones(const std::vector<char>& selected)
{
	std::vector<Vertex> cones = selectedVertices(selected);
	if (cones.empty())
		throw InvalidOption(InvalidOption::NothingSelected);
	return cones;
}

void setPrescribed(const VertexInput& input, Target& target)
{
	std::size_t notFinite = 0;
	const double rounding = kPrescribedRounding * input.precision;
	for (const Vertex v : IndexRange<Vertex>(static_cast<int>(input.targetCurvature.size()))) {
		const double K = input.targetCurvature[positionOf(v)];
		notFinite += !std::isfinite(K);
		target.curvature[v] = std::abs(K) <= rounding ? 0.0 : K;
	}
	if (notFinite > 0)
		throw InadmissibleCurvature(InadmissibleCurvature::NotFinite, 0.0, 0.0, notFinite);
}

void checkVertexBounds(const Topology& topology, const Target& target)
{
	if (target.circular)
		return;
	const auto bound = [&](Vertex v) { return topology.boundary[v] ? kPi : 2 * kPi; };
	std::size_t tooLarge = 0;
	Vertex worst;
	for (const Vertex v : target.fixed.indices()) {
		if (target.fixed[v] || !(target.curvature[v] >= bound(v)))
			continue;
		++tooLarge;
		if (!worst.isValid() || target.curvature[v] > target.curvature[worst])
			worst = v;
	}
	if (tooLarge > 0)
		throw InadmissibleCurvature(
			topology.boundary[worst] ? InadmissibleCurvature::TooLargeOnBoundary
									 : InadmissibleCurvature::TooLargeInside,
			target.curvature[worst],
			bound(worst),
			tooLarge);
}

void checkFreeBoundary(const Topology& topology, const Target& target)
{
	if (!target.hasFixed())
		return;
	double insideSum = 0.0;
	std::size_t boundaryCount = 0;
	for (const Vertex v : topology.boundary.indices()) {
		if (topology.boundary[v])
			++boundaryCount;
		else
			insideSum += target.curvature[v];
	}
	const double bound = topology.type.totalCurvature() - kPi * static_cast<double>(boundaryCount);
	if (insideSum <= bound)
		throw InadmissibleCurvature(
			InadmissibleCurvature::FreeBoundary, insideSum, bound, boundaryCount);
}

namespace {

/// The loop's points in the plane through their mean that fits them best (principal components).
std::vector<Point2>
projectToBestPlane(const std::vector<Vertex>& loop, const VertexArray<Point3>& positions)
{
	const auto position = [&](Vertex v) {
		return Eigen::Map<const Eigen::Vector3d>(positions[v].data());
	};
	Eigen::Vector3d mean = Eigen::Vector3d::Zero();
	for (const Vertex v : loop)
		mean += position(v);
	mean /= static_cast<double>(loop.size());
	Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
	for (const Vertex v : loop) {
		const Eigen::Vector3d p = position(v) - mean;
		covariance += p * p.transpose();
	}
	const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(covariance);
	std::vector<Point2> points;
	for (const Vertex v : loop) {
		const Eigen::Vector3d p = position(v) - mean;
		points.push_back({axes.eigenvectors().col(2).dot(p), axes.eigenvectors().col(1).dot(p)});
	}
	return points;
}

/// Vertices that divide the loop into quarters of about the same length, from its first.
std::array<Vertex, 4>
quartersByLength(const std::vector<Vertex>& loop, const VertexArray<Point3>& positions)
{
	const std::size_t n = loop.size();
	std::vector<double> along(n + 1, 0.0);
	for (std::size_t i = 0; i < n; ++i)
		along[i + 1] = along[i] + distance(positions[loop[i]], positions[loop[(i + 1) % n]]);
	std::array<Vertex, 4> corners;
	std::size_t previous = 0;
	for (std::size_t k = 0; k < 4; ++k) {
		const double wanted = along[n] * static_cast<double>(k) / 4;
		const auto above = std::lower_bound(along.begin(), along.end() - 1, wanted);
		std::size_t i = static_cast<std::size_t>(above - along.begin());
		i = std::min(std::max(i, k == 0 ? 0 : previous + 1), n - 4 + k); // all four different
		corners[k] = loop[i];
		previous = i;
	}
	return corners;
}

} // namespace

std::array<Vertex, 4>
rectangleCorners(const std::vector<Vertex>& loop, const VertexArray<Point3>& positions)
{
	const std::vector<Point2> points = projectToBestPlane(loop, positions);
	const OrientedRectangle r = minAreaRectangle(points);
	const std::array<Point2, 4> wanted{
		{{r.min[0], r.min[1]}, {r.max[0], r.min[1]}, {r.max[0], r.max[1]}, {r.min[0], r.max[1]}}};
	std::array<std::size_t, 4> nearest{};
	for (std::size_t k = 0; k < 4; ++k) {
		double min = kInfinity;
		for (std::size_t i = 0; i < points.size(); ++i) {
			const double d = distance(r.inFrame(points[i]), wanted[k]);
			if (d < min) {
				min = d;
				nearest[k] = i;
			}
		}
	}
	// In order along the loop in either direction: the cyclic sequence falls once, or rises once.
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

namespace {

/// \param angle total angle at each selected vertex, radians
void setConesOfAngle(
	const Topology& topology, double angle, const std::vector<char>& selected, Target& target)
{
	if (!(angle > 0.0) || !std::isfinite(angle))
		throw InvalidOption(InvalidOption::ConeAngle, angle);
	const std::vector<Vertex> cones = selectedCones(selected);
	for (const Vertex v : cones)
		target.curvature[v] = (topology.boundary[v] ? kPi : 2 * kPi) - angle;
	target.notes.push_back(
		std::to_string(cones.size()) + " cones of angle " + numberText(angle * 180.0 / kPi, 9) +
		" degrees each.");
}

void keepBoundaryRadii(const Topology& topology, Target& target)
{
	target.fixed = topology.boundary;
	for (const Vertex v : target.fixed.indices())
		if (target.fixed[v])
			target.curvature[v] = 0.0;
	target.notes.push_back(
		"Free boundary: the boundary's circles keep their radii, at the scale at which the mesh "
		"has "
		"the area " +
		numberText(freeBoundaryArea(topology.type.eulerCharacteristic()), 9) + ".");
}

/// Gauss-Bonnet: the area is positive.
void checkArea(const Topology& topology, HyperbolicTarget mode, const Target& target)
{
	const double sum = target.curvature.sum();
	const double bound = topology.type.totalCurvature();
	if (sum > bound)
		return;
	throw InadmissibleCurvature(
		mode == HyperbolicTarget::HyperbolicMetric ? InadmissibleCurvature::HyperbolicSurface
												   : InadmissibleCurvature::HyperbolicSum,
		sum,
		bound,
		0,
		topology.type);
}

} // namespace

Target chooseHyperbolicTarget(
	const Topology& topology, const HyperbolicTargetOptions& options, const VertexInput& input)
{
	Target target = zeroTarget(topology);
	target.background = Background::HyperbolicPlane;
	switch (options.target) {
	case HyperbolicTarget::HyperbolicMetric:
		break;
	case HyperbolicTarget::SelectedCones:
		setConesOfAngle(topology, options.coneAngle, input.selected, target);
		break;
	case HyperbolicTarget::Prescribed:
		setPrescribed(input, target);
		break;
	}
	if (options.freeBoundary && !topology.type.isClosed())
		keepBoundaryRadii(topology, target);
	checkVertexBounds(topology, target);
	if (target.hasFixed())
		checkFreeBoundary(topology, target);
	else
		checkArea(topology, options.target, target);
	return target;
}

} // namespace ricci
