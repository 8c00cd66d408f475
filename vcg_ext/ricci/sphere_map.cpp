// SPDX-License-Identifier: GPL-3.0-or-later
#include "sphere_map.h"

#include "error.h"
#include "flow/target_curvature.h"
#include "layout/distortion.h"
#include "layout/moebius_centring.h"
#include "numbers.h"
#include "parametrize.h"
#include "surface/component.h"
#include "text.h"
#include "verify/flow_check.h"
#include "verify/sphere_check.h"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SVD>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace ricci {

namespace {

using Vector = Eigen::Vector3d;

/// Another vertex this much nearer to the puncture than its neighbours would dominate the inverted
/// surface.
constexpr double kNearest = 0.5;

/// What the check of the result allows.
constexpr double kCheckedRadius = 1e-12, kCheckedDegree = 1e-9;

/// Vertices that are tried for the puncture.
constexpr int kMostPoles = 100;

Vector vec(const Point3& p)
{
	return {p[0], p[1], p[2]};
}

/// Passes fractions on, within an interval, but no lines for the log: they would speak of the
/// punctured surface.
class Quiet : public Progress
{
public:
	explicit Quiet(Progress& listener) : m_listener(listener) {}
	bool update(double fraction, const std::string&) override
	{
		return m_listener.update(fraction, "Mapping to the sphere");
	}

private:
	Progress& m_listener;
};

/// The vertex whose star has the largest least angle, among those to whose place no other vertex
/// comes near.
int choosePole(const Component& c)
{
	const std::size_t n = c.positions.size();
	std::vector<double> least(n, std::numeric_limits<double>::infinity());
	std::vector<double> nearest(n, std::numeric_limits<double>::infinity());
	for (const Triangle& t : c.triangles) {
		double angle = std::numeric_limits<double>::infinity();
		for (std::size_t k = 0; k < 3; ++k) {
			const Vector o = vec(c.positions[at(t[k])]);
			const Vector a = vec(c.positions[at(t[(k + 1) % 3])]) - o;
			const Vector b = vec(c.positions[at(t[(k + 2) % 3])]) - o;
			angle = std::min(angle, std::atan2(a.cross(b).norm(), a.dot(b)));
			const double side = a.norm();
			for (int v : {t[k], t[(k + 1) % 3]})
				nearest[at(v)] = std::min(nearest[at(v)], side);
		}
		for (int v : t)
			least[at(v)] = std::min(least[at(v)], angle);
	}
	std::vector<int> order(n);
	std::iota(order.begin(), order.end(), 0);
	const auto tried = std::min<std::ptrdiff_t>(kMostPoles, static_cast<std::ptrdiff_t>(n));
	std::partial_sort(order.begin(), order.begin() + tried, order.end(), [&](int a, int b) {
		return least[at(a)] != least[at(b)] ? least[at(a)] > least[at(b)] : a < b;
	});
	for (auto candidate = order.begin(); candidate != order.begin() + tried; ++candidate) {
		const Point3& p = c.positions[at(*candidate)];
		bool alone = nearest[at(*candidate)] > 0.0;
		for (std::size_t v = 0; v < n && alone; ++v)
			alone = static_cast<int>(v) == *candidate ||
					distance(c.positions[v], p) >= kNearest * nearest[at(*candidate)];
		if (alone)
			return *candidate;
	}
	throw InvalidMesh(
		"The surface cannot be punctured for the map to the sphere: near its best vertices it "
		"touches itself. Remesh it, or separate its sheets.");
}

/// The component inverted about its pole, whose star is taken out.
SurfaceMesh punctured(const Component& c, int pole)
{
	const Vector centre = vec(c.positions[at(pole)]);
	SurfaceMesh disk;
	disk.absent = 1;
	double radius = 0.0, count = 0.0;
	for (const Triangle& t : c.triangles) {
		if (std::find(t.begin(), t.end(), pole) == t.end()) {
			disk.triangles.push_back(t);
			continue;
		}
		for (int v : t)
			if (v != pole) {
				radius += (vec(c.positions[at(v)]) - centre).norm();
				count += 1.0;
			}
	}
	radius /= count;
	for (const Point3& p : c.positions) {
		const Vector x = vec(p) - centre;
		const double square = x.squaredNorm();
		const Vector y = square > 0.0 ? Vector(x * (radius * radius / square)) : Vector::Zero();
		disk.positions.push_back({y[0], y[1], y[2]});
	}
	return disk;
}

/// The value below which half of the weight lies.
double weightedMedian(const std::vector<double>& values, const std::vector<double>& weights)
{
	std::vector<std::size_t> order(values.size());
	std::iota(order.begin(), order.end(), std::size_t(0));
	std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
		return values[a] != values[b] ? values[a] < values[b] : a < b;
	});
	const double half = 0.5 * std::accumulate(weights.begin(), weights.end(), 0.0);
	double sum = 0.0;
	for (std::size_t i : order)
		if ((sum += weights[i]) >= half)
			return values[i];
	return values[order.back()];
}

/// Inverse stereographic projection with the middle of the area at the equator. The plane is seen
/// from inside the sphere, so it is reflected.
std::vector<Point3>
toSphere(const std::vector<Point2>& plane, const std::vector<double>& weights, int pole)
{
	std::vector<double> x, y, r, w;
	for (std::size_t v = 0; v < plane.size(); ++v)
		if (static_cast<int>(v) != pole) {
			x.push_back(plane[v][0]);
			y.push_back(plane[v][1]);
			w.push_back(weights[v]);
		}
	const double cx = weightedMedian(x, w), cy = weightedMedian(y, w);
	for (std::size_t i = 0; i < x.size(); ++i)
		r.push_back(std::hypot(x[i] - cx, y[i] - cy));
	double unit = weightedMedian(r, w);
	if (!(unit > 0.0))
		unit = *std::max_element(r.begin(), r.end());
	std::vector<Point3> sphere(plane.size(), {0.0, 0.0, 1.0});
	for (std::size_t v = 0; v < plane.size(); ++v) {
		if (static_cast<int>(v) == pole)
			continue;
		const double a = (plane[v][0] - cx) / unit, b = (cy - plane[v][1]) / unit;
		const double square = a * a + b * b;
		sphere[v] = {2 * a / (1 + square), 2 * b / (1 + square), (square - 1) / (1 + square)};
	}
	return sphere;
}

/// Turns the points most nearly towards \p places, seen from their weighted mean (Kabsch 1976).
void alignWith(
	const std::vector<Point3>& places,
	const std::vector<double>& weights,
	std::vector<Point3>& points)
{
	Vector mean = Vector::Zero();
	double total = 0.0;
	for (std::size_t v = 0; v < places.size(); ++v) {
		mean += weights[v] * vec(places[v]);
		total += weights[v];
	}
	mean /= total;
	Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
	for (std::size_t v = 0; v < places.size(); ++v)
		covariance += weights[v] * (vec(places[v]) - mean) * vec(points[v]).transpose();
	const Eigen::JacobiSVD<Eigen::Matrix3d> svd(
		covariance, Eigen::ComputeFullU | Eigen::ComputeFullV);
	Eigen::Matrix3d sign = Eigen::Matrix3d::Identity();
	sign(2, 2) = (svd.matrixU() * svd.matrixV().transpose()).determinant() > 0.0 ? 1.0 : -1.0;
	const Eigen::Matrix3d rotation = svd.matrixU() * sign * svd.matrixV().transpose();
	for (Point3& p : points) {
		const Vector q = (rotation * vec(p)).normalized();
		p = {q[0], q[1], q[2]};
	}
}

/// Distortion and orientation of the straight triangles.
void measure(const Component& c, const std::vector<Point3>& sphere, SphereMap& map)
{
	std::vector<double> before, after;
	double sum = 0.0, areaSum = 0.0;
	for (const Triangle& t : c.triangles) {
		std::array<Point3, 3> own, image;
		for (std::size_t k = 0; k < 3; ++k) {
			own[k] = c.positions[at(t[k])];
			image[k] = sphere[at(t[k])];
		}
		const Vector a = vec(image[1]) - vec(image[0]), b = vec(image[2]) - vec(image[0]);
		const Vector normal = a.cross(b);
		map.flippedFaces += !(vec(image[0]).dot(normal) > 0.0);
		before.push_back(triangleArea(own));
		after.push_back(0.5 * normal.norm());
		const double base = a.norm();
		const double qc =
			base > 0.0
				? quasiConformalDistortion(
					  own, {{{0.0, 0.0}, {base, 0.0}, {a.dot(b) / base, normal.norm() / base}}})
				: std::numeric_limits<double>::infinity();
		if (!std::isfinite(qc))
			continue;
		sum += before.back() * qc;
		areaSum += before.back();
		map.qcMax = std::max(map.qcMax, qc);
	}
	if (areaSum > 0.0)
		map.qcAreaMean = sum / areaSum;
	const AreaDistortion area = areaDistortion(before, after);
	map.areaDistortionMean = area.mean;
	map.areaDistortionSpread = area.spread;
}

} // namespace

SphereMap mapToSphere(const SurfaceMesh& mesh, const Options& options, Progress& progress)
{
	std::vector<std::string> notes;
	const std::vector<Component> components = splitIntoComponents(mesh, notes);
	const Component& c = components.front();
	const Topology topology =
		topologyOf(Triangulation(static_cast<int>(c.positions.size()), c.triangles));
	if (components.size() > 1)
		throw InvalidOption(
			"The map to the sphere takes one closed surface of genus 0, but the mesh has " +
			std::to_string(components.size()) + " components: separate them first.");
	if (!topology.isClosed() || topology.genus != 0)
		throw InvalidOption(
			"The map to the sphere takes a closed surface of genus 0, but the surface is " +
			topology.name() + ".");

	const int pole = choosePole(c);
	const SurfaceMesh disk = punctured(c, pole);
	Options flow;
	flow.epsilon = options.epsilon;
	flow.maxIterations = options.maxIterations;
	Quiet quiet(progress);
	const Parametrization flat = parametrizeEuclidean(disk, {}, flow, quiet);
	std::vector<Point2> plane(c.positions.size(), {0.0, 0.0});
	for (std::size_t f = 0; f < disk.triangles.size(); ++f)
		for (std::size_t k = 0; k < 3; ++k)
			plane[at(disk.triangles[f][k])] = flat.uv[f][k];

	std::vector<double> weights(c.positions.size(), 0.0);
	for (const Triangle& t : c.triangles) {
		const double area =
			triangleArea({c.positions[at(t[0])], c.positions[at(t[1])], c.positions[at(t[2])]});
		for (int v : t)
			weights[at(v)] += area / 3.0;
	}
	std::vector<Point3> sphere = toSphere(plane, weights, pole);
	SphereMap map;
	map.pole = c.vertex[at(pole)];
	map.iterations = flat.report.iterations;
	map.maxCurvatureError = flat.report.maxCurvatureError;
	map.offset = centreByMoebius(sphere, weights);
	alignWith(c.positions, weights, sphere);
	measure(c, sphere, map);
	const SphereCheck check = checkSphere(c.triangles, sphere);
	if (!(check.radiusError <= kCheckedRadius) ||
		!(std::abs(check.degree - 1.0) <= kCheckedDegree) || check.turned > map.flippedFaces)
		failCheck(
			"the sphere is covered " + numberText(check.degree, 9) + " times, radii " +
			numberText(check.radiusError, 3) + " off, " + std::to_string(check.turned) +
			" faces turned round");
	map.positions.assign(mesh.positions.size(), {0.0, 0.0, 0.0});
	for (std::size_t v = 0; v < c.vertex.size(); ++v)
		map.positions[at(c.vertex[v])] = sphere[v];
	return map;
}

} // namespace ricci
