// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/packed.h"
#include "support/random_surface.h"
#include "support/shapes.h"
#include "support/transform.h"

#include <ricci/error.h>
#include <ricci/flow/cone_placement.h>
#include <ricci/flow/target_curvature.h>
#include <ricci/metric/delaunay_start.h>
#include <ricci/parametrize.h>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace ricci::testing {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kQuarter = 0.5 * kPi;

PlacedCones place(const Packed& p, int count, ConeRounding rounding = ConeRounding::Free)
{
	ConeRequest request;
	request.count = count;
	request.rounding = rounding;
	return placeCones(p.triangulation, p.lengths, request);
}

double sum(const std::vector<double>& x)
{
	double s = 0.0;
	for (double a : x)
		s += a;
	return s;
}

void expectAdmissible(const Packed& p, const PlacedCones& cones)
{
	const auto boundary = p.triangulation.boundaryVertices();
	ASSERT_EQ(cones.vertices.size(), cones.curvatures.size());
	for (std::size_t i = 0; i < cones.vertices.size(); ++i) {
		EXPECT_LE(cones.curvatures[i], 1.5 * kPi);
		EXPECT_NE(cones.curvatures[i], 0.0);
		EXPECT_FALSE(boundary[at(cones.vertices[i])]);
		if (i > 0) {
			EXPECT_LT(cones.vertices[i - 1], cones.vertices[i]);
		}
	}
}

/// The linear flow on a closed surface by dense matrices.
struct DenseFlow
{
	Eigen::MatrixXd laplacian;
	Eigen::VectorXd curvature, area;

	explicit DenseFlow(const Packed& p)
	{
		const DelaunayStart start = delaunayStart({p.triangulation, p.lengths}, {});
		const Packed delaunay(start.mesh.triangulation, start.mesh.lengths);
		const int n = p.triangulation.vertexCount();
		Eigen::VectorXd u(n);
		for (int v = 0; v < n; ++v)
			u[v] = std::log(start.radii[at(v)]);
		GeometricCurvatureMap<Euclidean> map(
			inversiveDistancePacking(start.mesh.triangulation, start.mesh.lengths, start.radii));
		// By central differences of the curvature, so that neither Hessian nor solver are trusted.
		laplacian.resize(n, n);
		const double step = 1e-6;
		for (int v = 0; v < n; ++v) {
			Eigen::VectorXd moved = u;
			moved[v] += step;
			map.evaluate(moved);
			laplacian.col(v) = map.curvature();
			moved[v] -= 2 * step;
			map.evaluate(moved);
			laplacian.col(v) = (laplacian.col(v) - map.curvature()).eval() / (2 * step);
		}
		map.evaluate(u);
		curvature = map.curvature();
		area.setZero(n);
		const Triangulation& t = start.mesh.triangulation;
		for (int f = 0; f < t.faceCount(); ++f) {
			double l[3];
			for (std::size_t k = 0; k < 3; ++k)
				l[k] = start.mesh.lengths[at(Triangulation::edge(t.halfedges(f)[k]))];
			const double s = 0.5 * (l[0] + l[1] + l[2]);
			const double heron = std::sqrt(s * (s - l[0]) * (s - l[1]) * (s - l[2]));
			for (int h : t.halfedges(f))
				area[t.origin(h)] += heron / 3.0;
		}
		area /= area.sum();
	}

	double distortion(const std::vector<int>& vertices, const std::vector<double>& values) const
	{
		Eigen::VectorXd rhs = -curvature;
		for (std::size_t i = 0; i < vertices.size(); ++i)
			rhs[vertices[i]] += values[i];
		Eigen::VectorXd u = laplacian.completeOrthogonalDecomposition().solve(rhs);
		u.array() -= area.dot(u);
		return 2.0 * std::sqrt(area.dot(u.cwiseProduct(u)));
	}
};

TEST(ConePlacement, IsAdmissibleOnClosedSurfacesOfEveryGenus)
{
	Random random(700);
	for (int genus = 0; genus <= 3; ++genus) {
		const Packed p(shaken(perforatedSlab(genus, 3), 0.04, random));
		const int chi = 2 - 2 * genus;
		for (ConeRounding rounding : {ConeRounding::Free, ConeRounding::QuarterTurns})
			for (int count : {0, 4, 9}) {
				SCOPED_TRACE("genus " + std::to_string(genus) + ", " + std::to_string(count));
				const PlacedCones cones = place(p, count, rounding);
				expectAdmissible(p, cones);
				EXPECT_NEAR(sum(cones.curvatures), 2 * kPi * chi, 1e-11);
				if (count > 0) {
					EXPECT_LE(static_cast<int>(cones.vertices.size()), count);
				}
				if (rounding == ConeRounding::Free)
					continue;
				for (double k : cones.curvatures)
					EXPECT_NEAR(k / kQuarter, std::round(k / kQuarter), 1e-12);
			}
	}
}

TEST(ConePlacement, FindsTheCornersOfABox)
{
	// A box is flat but for its eight corners of pi/2: no area has to change.
	for (int subdivision : {2, 3, 4, 6}) {
		const Packed p(perforatedSlab(0, subdivision));
		GeometricCurvatureMap<Euclidean> map = p.map();
		map.evaluate(p.u());
		for (ConeRounding rounding : {ConeRounding::Free, ConeRounding::QuarterTurns}) {
			const PlacedCones cones = place(p, 8, rounding);
			ASSERT_EQ(cones.vertices.size(), 8u);
			for (std::size_t i = 0; i < 8; ++i) {
				EXPECT_NEAR(cones.curvatures[i], kQuarter, 1e-9);
				EXPECT_NEAR(map.curvature()[cones.vertices[i]], kQuarter, 1e-9);
			}
			EXPECT_LT(cones.distortion, 1e-9);
		}
	}
}

TEST(ConePlacement, PredictsTheDistortionOfTheLinearFlow)
{
	Random random(701);
	for (int genus : {0, 2}) {
		const Packed p(shaken(perforatedSlab(genus, 2), 0.05, random));
		const DenseFlow flow(p);
		const PlacedCones cones = place(p, 6);
		const double own = flow.distortion(cones.vertices, cones.curvatures);
		EXPECT_NEAR(cones.distortion, own, 1e-6 * (1.0 + own));
		// The curvatures are the best for these vertices: moving some from one to another costs.
		for (std::size_t i = 0; i < cones.vertices.size(); ++i)
			for (std::size_t j = 0; j < cones.vertices.size(); ++j) {
				std::vector<double> other = cones.curvatures;
				other[i] += 0.05;
				other[j] -= 0.05;
				const bool allowed = other[i] <= 1.5 * kPi;
				if (i != j && allowed) {
					EXPECT_GT(flow.distortion(cones.vertices, other), own);
				}
			}
	}
}

TEST(ConePlacement, DistortionFallsAsConesAreAdded)
{
	Random random(702);
	for (int genus = 0; genus <= 2; ++genus) {
		const Packed p(shaken(perforatedSlab(genus, 4), 0.05, random));
		double before = 1e300;
		for (int count : {3, 6, 12, 24}) {
			const PlacedCones cones = place(p, count);
			EXPECT_LT(cones.distortion, before) << "genus " << genus << ", " << count << " cones";
			before = cones.distortion;
		}
	}
}

TEST(ConePlacement, CountsAsManyAsTheDistortionAsksFor)
{
	Random random(703);
	const Packed p(shaken(perforatedSlab(1, 4), 0.05, random));
	std::size_t before = 0;
	for (double distortion : {0.8, 0.4, 0.2}) {
		ConeRequest request;
		request.distortion = distortion;
		const PlacedCones cones = placeCones(p.triangulation, p.lengths, request);
		EXPECT_LE(cones.distortion, distortion);
		EXPECT_GE(cones.vertices.size(), before);
		before = cones.vertices.size();
	}
}

TEST(ConePlacement, TheFlowReachesThePredictedDistortion)
{
	// The linear problem is that of smooth surfaces; the flow's own distortion agrees with it where
	// the mesh resolves the factor.
	Random random(704);
	const SurfaceMesh mesh = shaken(perforatedSlab(0, 8), 0.01, random);
	const PlacedCones cones = place(Packed(mesh), 6);
	Options options;
	options.target = TargetCurvature::PlacedCones;
	options.coneCount = 6;
	options.output = OutputTriangulation::CommonRefinement;
	Progress silent;
	const Parametrization map = parametrizeEuclidean(mesh, {}, options, silent);
	EXPECT_EQ(map.report.cones, static_cast<int>(cones.vertices.size()));
	EXPECT_NEAR(map.report.areaDistortionSpread, cones.distortion, 0.1 * cones.distortion);
}

TEST(ConePlacement, LowersTheDistortionInsideABoundary)
{
	Random random(705);
	for (const SurfaceMesh& mesh :
		 {withoutStars(shaken(perforatedSlab(0, 4), 0.05, random), {0}),
		  withoutStars(shaken(perforatedSlab(1, 4), 0.05, random), {0, 40})}) {
		const Packed p(mesh);
		for (ConeBoundary boundary : {ConeBoundary::Fixed, ConeBoundary::Prescribed}) {
			ConeRequest request;
			request.boundary = boundary;
			double before = 1e300;
			for (int count : {1, 4, 10}) {
				request.count = count;
				const PlacedCones cones = placeCones(p.triangulation, p.lengths, request);
				expectAdmissible(p, cones);
				EXPECT_LT(cones.distortion, before);
				before = cones.distortion;
			}
		}
		// With a prescribed boundary all curvatures together obey Gauss-Bonnet.
		TargetRequest request;
		request.mode = TargetCurvature::PlacedCones;
		request.freeBoundary = false;
		request.coneCount = 3;
		const Topology topology = topologyOf(p.triangulation);
		const Target target =
			chooseTarget(p.triangulation, topology, p.lengths, mesh.positions, request);
		EXPECT_NEAR(target.curvature.sum(), 2 * kPi * topology.eulerCharacteristic, 1e-10);
	}
}

/// Length of the least tree of edge paths between \p vertices, by all shortest paths.
double treeLength(const Packed& p, const std::vector<int>& vertices)
{
	const int n = p.triangulation.vertexCount();
	Eigen::MatrixXd d = Eigen::MatrixXd::Constant(n, n, 1e300);
	for (int e = 0; e < p.triangulation.edgeCount(); ++e) {
		const int a = p.triangulation.origin(2 * e), b = p.triangulation.target(2 * e);
		d(a, b) = d(b, a) = std::min(d(a, b), p.lengths[at(e)]);
	}
	for (int k = 0; k < n; ++k)
		for (int i = 0; i < n; ++i)
			d.row(i) = d.row(i).cwiseMin((d.row(k).array() + d(i, k)).matrix());
	double length = 0.0;
	std::vector<int> inside{vertices.front()}, outside(vertices.begin() + 1, vertices.end());
	while (!outside.empty()) {
		double least = 1e300;
		std::size_t next = 0;
		for (std::size_t i = 0; i < outside.size(); ++i)
			for (int v : inside)
				if (d(v, outside[i]) < least) {
					least = d(v, outside[i]);
					next = i;
				}
		length += least;
		inside.push_back(outside[next]);
		outside.erase(outside.begin() + static_cast<std::ptrdiff_t>(next));
	}
	return length;
}

TEST(ConePlacement, MovesConesForShorterSeamsWithinTheDistortion)
{
	Random random(708);
	double gained = 0.0;
	for (int trial = 0; trial < 4; ++trial) {
		const Packed p(shaken(perforatedSlab(0, 3), 0.12, random));
		for (int count : {0, 5, 8}) {
			ConeRequest request;
			request.count = count;
			request.distortion = 0.6;
			request.shortSeams = false;
			const PlacedCones apart = placeCones(p.triangulation, p.lengths, request);
			request.shortSeams = true;
			const PlacedCones near = placeCones(p.triangulation, p.lengths, request);
			expectAdmissible(p, near);
			EXPECT_NEAR(sum(near.curvatures), 4 * kPi, 1e-11);
			const double most = count > 0 ? kSeamAllowance * apart.distortion : request.distortion;
			EXPECT_LE(near.distortion, most * (1 + 1e-9));
			const double before = treeLength(p, apart.vertices),
						 after = treeLength(p, near.vertices);
			EXPECT_LE(after, before * (1 + 1e-12));
			gained += before - after;
		}
	}
	EXPECT_GT(gained, 0.0);
}

TEST(ConePlacement, ScaleChangesNothing)
{
	Random random(706);
	const SurfaceMesh mesh = shaken(perforatedSlab(2, 3), 0.05, random);
	const PlacedCones a = place(Packed(mesh), 7), b = place(Packed(scaled(mesh, 1024.0)), 7);
	EXPECT_EQ(a.vertices, b.vertices);
	for (std::size_t i = 0; i < a.vertices.size(); ++i)
		EXPECT_NEAR(a.curvatures[i], b.curvatures[i], 1e-9);
}

TEST(ConePlacement, IsDeterministic)
{
	Random random(707);
	const Packed p(shaken(perforatedSlab(2, 3), 0.05, random));
	for (ConeRounding rounding : {ConeRounding::Free, ConeRounding::QuarterTurns}) {
		const PlacedCones first = place(p, 0, rounding);
		for (int i = 0; i < 3; ++i) {
			const PlacedCones again = place(p, 0, rounding);
			EXPECT_EQ(again.vertices, first.vertices);
			EXPECT_EQ(again.curvatures, first.curvatures);
		}
	}
}

TEST(ConePlacement, RefusesWhatNoMetricHas)
{
	// Two cones below 2 pi cannot carry the 4 pi of a sphere.
	EXPECT_THROW(place(Packed(perforatedSlab(0, 2)), 2), InvalidOption);
	EXPECT_NO_THROW(place(Packed(perforatedSlab(0, 2)), 3));
	EXPECT_NO_THROW(place(Packed(tetrahedron()), 4));
	EXPECT_THROW(place(Packed(tetrahedron()), 5), InvalidOption);
}

} // namespace
} // namespace ricci::testing
