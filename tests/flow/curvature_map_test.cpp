// SPDX-License-Identifier: GPL-3.0-or-later
// The curvature of a packing and its derivative, in both backgrounds.
#include "support/intrinsic.h"
#include "support/matrices.h"
#include "support/random_surface.h"
#include "support/shapes.h"
#include "support/wide.h"

#include <ricci/base/numbers.h>
#include <ricci/flow/curvature_map.h>
#include <ricci/metric/geometry.h>

#include <gtest/gtest.h>

namespace ricci::testing {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

using Map = GeometricCurvatureMap<Euclidean>;
using HyperbolicMap = GeometricCurvatureMap<Hyperbolic>;

/// Two triangles of a flat torus, one of them cut into three by a second vertex: loops at the first
/// vertex, and several edges between the two.
Packed twoVertexTorus()
{
	// Square lattice with a sheared second vector; first triangle (0,0) (1,0) (1.2,1), with a point
	// inside, second (0,0) (1.2,1) (0.2,1). Sides 3 f + k.
	const std::vector<Triangle> triangles{{0, 0, 1}, {0, 0, 1}, {0, 0, 1}, {0, 0, 0}};
	// Side 0 of faces 0, 1, 2: bottom, right, diagonal. Sides 1 and 2 lead to the inner vertex.
	// Face 3: diagonal, top, left.
	const Triangulation t = glued(2, triangles, {10, 5, 7, 11, 8, 1, 9, 2, 4, 6, 0, 3});
	const Point3 corner[]{{0, 0, 0}, {1, 0, 0}, {1.2, 1, 0}}, inside{0.7, 0.3, 0};
	EdgeArray<double> lengths(t.edgeCount(), 0.0);
	for (int f = 0; f < 3; ++f) {
		const auto h = t.halfedges(Face(f));
		lengths[h[0].edge()] = distance(corner[f], corner[(f + 1) % 3]);
		lengths[h[1].edge()] = distance(corner[(f + 1) % 3], inside);
		lengths[h[2].edge()] = distance(corner[f], inside);
	}
	return Packed(t, lengths);
}

/// The whole Hessian with all vertices unknown, both triangles.
Eigen::MatrixXd denseHessian(const CurvatureMap& map)
{
	FactoredHessian hessian(VertexArray<char>(map.triangulation().vertexCount(), 0), false);
	hessian.fill(map);
	const Eigen::MatrixXd lower = hessian.matrix();
	return lower.selfadjointView<Eigen::Lower>();
}

/// Closed, with boundaries, of several genera, and with angles down to 1e-3 degrees.
std::vector<Packed> surfaces()
{
	Random random(50);
	return {
		Packed(tetrahedron()),
		Packed(bumpyTorus(8, 6, random)),
		Packed(sliverDisk(7, 3.0, random)),
		Packed(ring(1, 3, 8, 3)),
		Packed(shaken(perforatedSlab(2, 1), 0.03, random)),
		twoVertexTorus()};
}

/// The packing's circles, the largest of hyperbolic size: u = \p largest.
VertexVector hyperbolicU(const Packed& mesh, double largest)
{
	const VertexVector u = mesh.u();
	return (u.array() + (largest - u.maxCoeff())).matrix();
}

VertexVector disturbed(VertexVector u, double spread, Random& random, double bound = HUGE_VAL)
{
	for (double& x : u)
		x = std::min(x + random.real(-spread, spread), bound);
	return u;
}

using Wide = long double;

/// Radii by Eq. 6, lengths by Eq. 4, and angles from three lengths, in extended precision.
struct Formulas
{
	bool isHyperbolic;
	const Triangulation& t;
	const EdgeArray<double>& delta;
	VertexArray<Wide> u;

	Formulas(const CurvatureMap& map, const VertexVector& at) :
			isHyperbolic(!map.scaleInvariant()), t(map.triangulation()), delta(map.delta()),
			u(std::vector<Wide>(at.begin(), at.end()))
	{
	}

	Wide s(Wide length) const { return isHyperbolic ? std::sinh(length) : length; }
	Wide radius(Vertex v) const
	{
		return isHyperbolic ? 2 * std::atanh(std::exp(u[v])) : std::exp(u[v]);
	}
	Wide length(Halfedge h) const
	{
		const Wide gi = radius(t.origin(h)), gj = radius(t.target(h)), half = s((gi + gj) / 2);
		const Wide lessOne =
			2 * half * half + delta[h.edge()] * s(gi) * s(gj); // l^2 / 2, cosh l - 1
		return isHyperbolic ? 2 * std::asinh(std::sqrt(lessOne / 2)) : std::sqrt(2 * lessOne);
	}
	/// Lengths from the origin of h, and of the side opposite.
	std::array<Wide, 3> lengths(Halfedge h) const
	{
		return {length(h), length(t.previous(h)), length(t.next(h))};
	}
	Wide angle(const std::array<Wide, 3>& l) const
	{
		const Wide half = (l[0] + l[1] + l[2]) / 2;
		const Wide sine = s(half - l[0]) * s(half - l[1]), cosine = s(half) * s(half - l[2]);
		return 2 * std::atan2(std::sqrt(sine), std::sqrt(cosine));
	}
	VertexArray<Wide> curvature() const
	{
		VertexArray<Wide> K;
		for (const char boundary : t.boundaryVertices())
			K.push_back((boundary ? 1 : 2) * std::acos(-1.0L));
		for (const Halfedge h : t.interiorHalfedges())
			K[t.origin(h)] -= angle(lengths(h));
		return K;
	}
};

/// Lengths, angles and curvature of \p map at \p u; and, where no triangle is broken, the Hessian, by
/// central differences of the curvature, extrapolated.
void expectFormulas(CurvatureMap& map, const VertexVector& u)
{
	map.evaluate(u);
	map.accept();
	Formulas formulas(map, u);
	const Triangulation& t = map.triangulation();
	double needle = 1.0;
	VertexVector defect(t.vertexCount());
	for (const Vertex v : t.vertices())
		defect[v] = t.boundaryVertices()[v] ? kPi : 2 * kPi;
	for (const Halfedge h : t.interiorHalfedges()) {
		const auto wide = formulas.lengths(h);
		const Wide longest = std::max({wide[0], wide[1], wide[2]});
		const Wide shortest = std::min({wide[0], wide[1], wide[2]});
		const Wide slack = wide[0] + wide[1] + wide[2] - 2 * longest;
		needle = std::max(needle, static_cast<double>(longest / shortest));
		const double l = map.lengths()[h.edge()], angle = map.angles()[h];
		EXPECT_NEAR(
			l / static_cast<double>(wide[0]), 1.0, 8 * kEpsilon * (1 + l + std::abs(u.minCoeff())));
		defect[t.origin(h)] -= angle;
		if (slack <= 0)
			continue;
		// Rounding of u and of the sides, relative to the slack of the triangle inequality: the
		// angle is a quotient of square roots of such slacks.
		const auto amplification = static_cast<double>(longest / std::min(slack, shortest));
		EXPECT_NEAR(
			angle,
			static_cast<double>(formulas.angle(wide)),
			32 * kEpsilon * (1 + amplification * angle) * (1 + l));
	}
	EXPECT_LT((map.curvature() - defect).lpNorm<Eigen::Infinity>(), 1e-14);
	for (const Halfedge h : t.exteriorHalfedges())
		EXPECT_EQ(map.angles()[h], 0.0);
	if (map.brokenTriangles() > 0)
		return;
	EXPECT_NEAR(map.needleRatio() / needle, 1.0, 1e-12);
	const Eigen::MatrixXd H = denseHessian(map);
	const double largest = H.cwiseAbs().maxCoeff();
	// A sliver's angles vary on the scale of the reciprocal of its weights.
	const Wide step = 1e-4L / std::max(1.0, largest) * std::min(1.0, std::abs(u.maxCoeff()));
	for (const Vertex j : u.indices()) {
		const auto slope = [&](Wide h) {
			const Wide x = formulas.u[j];
			formulas.u[j] = x + h;
			VertexArray<Wide> K = formulas.curvature();
			formulas.u[j] = x - h;
			const VertexArray<Wide> below = formulas.curvature();
			formulas.u[j] = x;
			for (const Vertex i : K.indices())
				K[i] = (K[i] - below[i]) / (2 * h);
			return K;
		};
		const auto coarse = slope(step), fine = slope(step / 2);
		for (const Vertex i : u.indices())
			EXPECT_NEAR(
				static_cast<double>((4 * fine[i] - coarse[i]) / 3),
				H(i.number(), j.number()),
				1e-9 * largest)
				<< "entry " << i.number() << ", " << j.number();
	}
}

TEST(CurvatureMap, FollowsTheLawOfCosinesAndItsDerivative)
{
	RICCI_NEEDS_WIDE_LONG_DOUBLE();
	Random random(41);
	int whole = 0;
	for (const Packed& mesh : surfaces()) {
		for (const double spread : {1e-3, 0.05}) {
			Map map = mesh.map();
			expectFormulas(map, disturbed(mesh.u(), spread, random));
			whole += map.brokenTriangles() == 0;
			EXPECT_TRUE(map.scaleInvariant());
		}
		for (const double largest : {-0.1, -4.0, -20.0}) {
			SCOPED_TRACE(largest);
			HyperbolicMap map(mesh.triangulation, mesh.delta);
			expectFormulas(map, disturbed(hyperbolicU(mesh, largest), 0.02, random, -1e-2));
			whole += map.brokenTriangles() == 0;
		}
	}
	EXPECT_GE(whole, 24);
}

/// Far from the start, where flips have changed the triangulation. Where every edge is weighted Delaunay no
/// triangle breaks and all weights are non-negative; the Hessian is positive definite, in the plane except for
/// constants.
template<class Geometry>
void expectConvexityAfterFlips(double largest)
{
	Random random(95);
	std::size_t flips = 0;
	for (const Packed& mesh : surfaces()) {
		if (!mesh.triangulation.boundaryLoops().empty())
			continue; // edges of the boundary cannot flip: triangles may break
		for (const double spread : {0.3, 1.0, 5.0}) {
			SCOPED_TRACE(spread);
			GeometricCurvatureMap<Geometry> map(mesh.triangulation, mesh.delta, true);
			const VertexVector u = disturbed(hyperbolicU(mesh, largest), spread, random, -1e-2);
			map.evaluate(disturbed(u, 1.0, random, -1e-2)); // what is rejected leaves no trace
			map.reject();
			EXPECT_EQ(map.delta(), mesh.delta);
			for (const Halfedge h : mesh.triangulation.halfedges()) {
				ASSERT_EQ(map.triangulation().next(h), mesh.triangulation.next(h));
				ASSERT_EQ(map.triangulation().origin(h), mesh.triangulation.origin(h));
			}
			map.evaluate(u);
			map.accept();
			flips += map.flips().size();
			EXPECT_EQ(map.brokenTriangles(), 0);
			const double most = *std::max_element(map.weights().begin(), map.weights().end());
			for (const double w : map.weights())
				EXPECT_GE(w, -1e-13 * most);
			if (spread < 2.0)
				expectFormulas(map, u);
			const Eigen::MatrixXd H = denseHessian(map);
			const Eigen::VectorXd scale = H.diagonal().cwiseSqrt().cwiseInverse();
			const Eigen::VectorXd eigenvalues =
				symmetricEigenvalues(scale.asDiagonal() * H * scale.asDiagonal());
			EXPECT_GT(eigenvalues[map.scaleInvariant() ? 1 : 0], 1e-13);
			const Eigen::VectorXd rows = H.rowwise().sum(), sizes = H.cwiseAbs().rowwise().sum();
			for (Eigen::Index i = 0; map.scaleInvariant() && i < H.rows(); ++i)
				EXPECT_NEAR(rows[i], 0.0, 16 * kEpsilon * sizes[i]);
		}
	}
	EXPECT_GT(flips, 50u);
}

TEST(CurvatureMap, EnergyIsStrictlyConvexWithFlips)
{
	RICCI_NEEDS_WIDE_LONG_DOUBLE();
	expectConvexityAfterFlips<Euclidean>(0.0);
	for (const double largest : {-0.2, -6.0})
		expectConvexityAfterFlips<Hyperbolic>(largest);
}

TEST(CurvatureMap, TheLowPartOfPiIsNotLost)
{
	// Left out or taken back, what a double of pi lacks would add up to 1e-12 and more over so many
	// vertices; the rounding of their angles cancels in the sum except for its root.
	Random random(47);
	const auto sum = [](const SurfaceMesh& mesh) {
		const Packed packed(mesh);
		Map map = packed.map();
		map.evaluate(packed.u());
		long double total = 0.0L;
		for (const double K : map.curvature())
			total += K;
		return std::abs(static_cast<double>(total));
	};
	const int n = 10000;
	const SurfaceMesh ring = grid(1, n, Ends::Open, Ends::Joined, [&](int i, int j) {
		const double a = 2 * kPi * (j + random.real(-0.2, 0.2)) / n;
		const double r = 1.0 + 2 * kPi / n * (i + random.real(-0.2, 0.2));
		return Point3{r * std::cos(a), r * std::sin(a), 0.0};
	});
	EXPECT_LT(sum(ring), 5e-13);
	EXPECT_LT(sum(bumpyTorus(120, 100, random)), 1e-12); // left out: 2.9e-12
}

TEST(CurvatureMap, BrokenTrianglesHaveTheAnglesPiZeroZeroAndNoDerivative)
{
	Random random(43);
	int broken = 0, checked = 0;
	for (int trial = 0; trial < 10; ++trial)
		for (const Packed& mesh : surfaces()) {
			Map map = mesh.map();
			map.evaluate(disturbed(mesh.u(), 3.0, random));
			const Triangulation& t = map.triangulation();
			FaceArray<char> weighed(t.faceCount(), 1);
			int count = 0;
			for (const Face f : t.faces()) {
				const auto h = t.halfedges(f);
				std::array<double, 3> l, angle;
				for (std::size_t k = 0; k < 3; ++k) {
					l[k] = map.lengths()[h[k].edge()];
					angle[k] = map.angles()[h[k]];
				}
				const auto longest =
					static_cast<std::size_t>(std::max_element(l.begin(), l.end()) - l.begin());
				const double slack = l[0] + l[1] + l[2] - 2 * l[longest];
				if (std::abs(slack) < 1e-12 * l[longest])
					continue;
				++checked;
				EXPECT_NEAR(angle[0] + angle[1] + angle[2], kPi, 1e-14);
				if (slack > 0) {
					EXPECT_LT(*std::max_element(angle.begin(), angle.end()), kPi);
					continue;
				}
				++count;
				weighed[f] = 0;
				EXPECT_EQ(angle[(longest + 2) % 3], kPi);
				EXPECT_EQ(angle[longest], 0.0);
				EXPECT_EQ(angle[(longest + 1) % 3], 0.0);
			}
			EXPECT_EQ(map.brokenTriangles(), count);
			broken += count;
			const auto hasWeight = [&](Halfedge h) {
				return !t.isExterior(h) && weighed[t.face(h)];
			};
			for (const Edge e : t.edges())
				if (!hasWeight(e.halfedge()) && !hasWeight(e.halfedge().twin())) {
					EXPECT_EQ(map.weights()[e], 0.0);
				}
		}
	EXPECT_GT(broken, 100);
	EXPECT_GT(checked, 1000);
}

} // namespace
} // namespace ricci::testing
