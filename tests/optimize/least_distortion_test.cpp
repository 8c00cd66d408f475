// SPDX-License-Identifier: GPL-3.0-or-later
#include "flat_maps.h"
#include "support/complex.h"
#include "support/flipped_flow.h"
#include "support/random_surface.h"

#include <ricci/measure/distortion.h>
#include <ricci/numerics/iteration.h>
#include <ricci/optimize/least_distortion.h>
#include <ricci/optimize/mean_distortion.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace ricci::testing {
namespace {

/// A map of a mesh's own triangles to the plane, cut open.
struct CutMap
{
	SurfaceMesh mesh;
	FlatMesh flat;
	bool boundaryMoves = true;

	/// The flow's map, cut along random ways.
	CutMap(const SurfaceMesh& m, const TargetRequest& request, Random& random) : mesh(m)
	{
		const FlippedFlow flow(m, request);
		Component component;
		component.positions = VertexArray<Point3>(m.positions);
		component.triangles = m.triangles;
		flat =
			flatMeshOf(component, flow.domain, flow.refinement(flow.cutAnywhere(random)).corners);
	}

	/// A disk whose vertices are at \p places.
	CutMap(const SurfaceMesh& m, const std::vector<Point2>& places) :
			mesh(m), flat(flatDisk(m, places))
	{
	}

	bool improve() { return leastDistortion(flat, groups(), false); }

	PointGroups groups() const
	{
		return joinedPoints(flat, [&](int) { return boundaryMoves; });
	}
	int flipped() const { return notCounterClockwise(flat); }

	double extent() const { return flat.box().extent(); }
};

SurfaceMesh wavyDisk(int n, Random& random)
{
	SurfaceMesh mesh = randomPlanarDisk(n, random);
	for (Point3& p : mesh.positions)
		p[2] = 0.2 * std::sin(7 * p[0]) * std::cos(5 * p[1]);
	return mesh;
}

/// Without flipped triangles: a sphere with cones of pi, whose seams turn; a torus, whose seams are translations; a
/// disk with a free boundary and a cone inside, whose seam ends there.
std::vector<CutMap> validMapsWithSeams(Random& random)
{
	const SurfaceMesh slab = shaken(perforatedSlab(0, 6), 0.02, random);
	const SurfaceMesh open = withoutStars(slab, {7});
	std::vector<double> curvature(open.positions.size(), 0.0);
	curvature[50] = 0.7;
	std::vector<CutMap> maps;
	maps.emplace_back(slab, conesAt(slab, {0, 57, 110, 163}), random);
	maps.emplace_back(bumpyTorus(20, 12, random), requestOf(TargetCurvature::Flat), random);
	maps.emplace_back(open, prescribed(curvature, true), random);
	for (const CutMap& map : maps)
		EXPECT_EQ(map.flipped(), 0);
	return maps;
}

/// An energy at the points of a map.
struct Measured
{
	MeanDistortion energy;
	const NumberedPoints& points;
	Eigen::VectorXcd start; ///< [number of a point]

	explicit Measured(const CutMap& d) :
			energy(d.flat, d.groups(), false), points(energy.points()), start(points.number.size())
	{
		place(d.flat);
	}

	void place(const FlatMesh& flat)
	{
		for (const int p : flat.place.indices())
			start[points.number[p]] = asComplex(flat.place[p]);
	}

	/// The points after the unknowns have moved by \p d.
	Eigen::VectorXcd moved(const Eigen::VectorXcd& d) const
	{
		Eigen::VectorXcd position = start;
		for (int p = 0; p < points.moving; ++p)
			position[p] += points.turn[p] * d[points.unknown[p]];
		return position;
	}
};

double energyOf(const CutMap& d)
{
	Measured m(d);
	return m.energy.evaluate(m.start);
}

Eigen::VectorXcd randomVector(Eigen::Index size, double bound, Random& random)
{
	Eigen::VectorXcd vector(size);
	for (Complex& z : vector)
		z = {random.real(-bound, bound), random.real(-bound, bound)};
	return vector;
}

/// Displacements of the unknowns of about this size, and so small that nothing is about to turn.
Eigen::VectorXcd shake(Measured& measured, double size, Random& random)
{
	Eigen::VectorXcd d = randomVector(measured.points.unknowns, size, random);
	while (!std::isfinite(measured.energy.evaluate(measured.moved(d))))
		d *= 0.5;
	return 0.5 * d;
}

/// dE along \p d at \p from, extrapolated from central differences.
double difference(Measured& m, const Eigen::VectorXcd& from, const Eigen::VectorXcd& d, double step)
{
	const auto central = [&](double h) {
		const Eigen::VectorXcd ahead = from + h * d, behind = from - h * d;
		return (m.energy.evaluate(m.moved(ahead)) - m.energy.evaluate(m.moved(behind))) / (2 * h);
	};
	return (4 * central(step / 2) - central(step)) / 3;
}

// ---- The energy ---------------------------------------------------------------------------------

TEST(MeanDistortion, IsTheWeightedMeanOfTheDilatations)
{
	Random random(611);
	for (CutMap& d : validMapsWithSeams(random)) {
		Measured m(d);
		Array<double> area, ring(d.flat.vertexCount(), 0.0);
		double total = 0.0;
		const auto corners = [&](int f) {
			const Triangle& v = d.flat.vertices[f];
			return std::array<Point3, 3>{
				d.mesh.positions[at(v[0])], d.mesh.positions[at(v[1])], d.mesh.positions[at(v[2])]};
		};
		for (const int f : d.flat.points.indices()) {
			area.push_back(triangleArea(corners(f)));
			total += area[f];
			for (const int v : d.flat.vertices[f])
				ring[v] += area[f];
		}
		double sum = 0.0, weights = 0.0;
		for (const int f : area.indices()) {
			const double K = quasiConformalDistortion(corners(f), d.flat.at(f));
			double weight = 0.05 / area.size() + 0.15 * area[f] / total;
			for (const int v : d.flat.vertices[f])
				weight += 0.8 * area[f] / ring[v] / ring.size();
			const double mu = (K - 1) / (K + 1), m2 = (mu * mu + 1e-6) / (1 + 1e-6);
			sum += weight * std::pow(2 * std::sqrt(m2) / (1 - std::sqrt(m2)), 1.25);
			weights += weight;
		}
		EXPECT_NEAR(weights, 1.0, 1e-12);
		EXPECT_NEAR(m.energy.evaluate(m.start) / sum, 1.0, 1e-10);
	}
}

TEST(MeanDistortion, GradientIsThatOfDifferences)
{
	Random random(612);
	int compared = 0;
	for (CutMap& d : validMapsWithSeams(random)) {
		Measured m(d);
		for (int round = 0; round < 3; ++round) {
			const Eigen::VectorXcd from = shake(m, 0.02 * d.extent(), random);
			const Eigen::VectorXcd position = m.moved(from);
			const double value = m.energy.evaluate(position);
			Eigen::VectorXcd gradient;
			m.energy.gradient(gradient);
			double height = kInfinity; // the least of a triangle
			for (const int f : d.flat.points.indices()) {
				const Triangle& c = m.energy.corners(f);
				const Complex a = position[c[0]], b = position[c[1]] - a, e = position[c[2]] - a;
				const double longest = std::max({std::abs(b), std::abs(e), std::abs(e - b)});
				height = std::min(height, (std::conj(b) * e).imag() / longest);
			}
			for (int k = 0; k < 5; ++k) {
				Eigen::VectorXcd along = randomVector(m.points.unknowns, 1.0, random);
				if (k > 0) // a seam vertex alone, or any other one
					along = along.cwiseProduct(Eigen::VectorXcd::Unit(
						m.points.unknowns,
						k % 2 ? m.points.unknown
									[m.points.unknowns +
									 random.index(m.points.moving - m.points.unknowns)]
							  : random.index(m.points.unknowns)));
				const double slope = 2 * LimitedMemoryBfgs::dot(gradient, along);
				const double step = 1e-4 * height / along.cwiseAbs().maxCoeff();
				const double rounding = 1e-15 * value / (step * std::abs(slope));
				EXPECT_LT(rounding, 1e-3);
				EXPECT_NEAR(difference(m, from, along, step) / slope, 1.0, 1e-7 + 10.0 * rounding);
				++compared;
			}
		}
	}
	EXPECT_EQ(compared, 45); // no map is left out
}

TEST(MeanDistortion, IsInfiniteWhereATriangleIsNotCounterClockwise)
{
	Random random(613);
	const SurfaceMesh mesh = wavyDisk(5, random);
	const std::vector<Point2> places = fromAbove(mesh);
	// A corner of a triangle exactly on the opposite side, then beyond it.
	const Triangle& t = mesh.triangles[20];
	const Point2 a = places[at(t[0])], b = places[at(t[1])], c = places[at(t[2])];
	const CutMap d(mesh, places);
	Measured m(d);
	EXPECT_TRUE(std::isfinite(m.energy.evaluate(m.start)));
	for (const double share : {1.0, 1.5}) {
		CutMap other = d;
		const Point2 foot{
			c[0] + share * ((a[0] + b[0]) / 2 - c[0]), c[1] + share * ((a[1] + b[1]) / 2 - c[1])};
		other.flat.place[t[2]] = foot;
		ASSERT_GT(other.flipped(), 0);
		m.place(other.flat);
		EXPECT_EQ(m.energy.evaluate(m.start), kInfinity);
	}
}

TEST(DistortionLaplacian, IsTheRealPartOfTheReweightedSquares)
{
	Random random(615);
	for (CutMap& d : validMapsWithSeams(random)) {
		Measured m(d);
		DistortionLaplacian laplacian(m.energy);
		ASSERT_TRUE(std::isfinite(m.energy.evaluate(m.start)));
		ASSERT_TRUE(laplacian.factorize());
		const Eigen::VectorXcd rhs = randomVector(m.points.unknowns, 1.0, random);
		Eigen::VectorXcd x;
		laplacian.solve(rhs, x, 1e-14);
		// y = Re(B^H diag(s) B) x for real vectors x, with f_zbar = B x, by faces.
		const auto product = [&](const Eigen::VectorXd& real) {
			Eigen::VectorXcd y = Eigen::VectorXcd::Zero(real.size());
			for (const int f : d.flat.points.indices()) {
				Complex fzbar = 0.0;
				const auto each = [&](const auto& use) {
					for (std::size_t k = 0; k < 3; ++k)
						if (const int p = m.energy.corners(f)[k]; m.points.unknown[p] >= 0)
							use(m.points.unknown[p], m.energy.slopes(f)[k] * m.points.turn[p]);
				};
				each([&](int u, Complex slope) { fzbar += slope * real[u]; });
				each([&](int u, Complex slope) {
					y[u] += m.energy.stiffness(f) * std::conj(slope) * fzbar;
				});
			}
			return Eigen::VectorXd(y.real());
		};
		EXPECT_LT((product(x.real()) - rhs.real()).norm(), 1e-9 * rhs.norm());
		EXPECT_LT((product(x.imag()) - rhs.imag()).norm(), 1e-9 * rhs.norm());
	}
}

TEST(LimitedMemoryBfgs, TakesTheLastStepBackFromItsChange)
{
	Random random(616);
	const auto vector = [&](Eigen::Index n) { return randomVector(n, 1.0, random); };
	const auto scale = [](const Eigen::VectorXcd& rhs, Eigen::VectorXcd& x) { x = 0.3 * rhs; };
	LimitedMemoryBfgs bfgs(7, 3);
	Eigen::VectorXcd direction;
	const Eigen::VectorXcd gradient = vector(7);
	bfgs.direction(gradient, scale, direction);
	EXPECT_LT((direction + 0.3 * gradient).norm(), 1e-15);
	int remembered = 0;
	for (int round = 0; round < 8; ++round) {
		const Eigen::VectorXcd step = vector(7), change = vector(7) + step;
		const double product = LimitedMemoryBfgs::dot(step, change);
		EXPECT_NEAR(product, (step.adjoint() * change)(0).real(), 1e-13);
		bfgs.remember(step, change);
		if (!(product > 0.0))
			continue;
		++remembered;
		bfgs.direction(change, scale, direction); // the secant equation
		EXPECT_LT((direction + step).norm(), 1e-12);
		bfgs.direction(gradient, scale, direction);
		EXPECT_LT(LimitedMemoryBfgs::dot(gradient, direction), 0.0);
	}
	EXPECT_GT(remembered, 2);
	// A step along which the function bends down is not remembered.
	const Eigen::VectorXcd before = direction, step = vector(7);
	bfgs.remember(step, -step);
	bfgs.direction(gradient, scale, direction);
	EXPECT_EQ((direction - before).norm(), 0.0);
}

// ---- The whole ----------------------------------------------------------------------------------

TEST(LeastDistortion, ComesAsLowAsALongDescentByGradients)
{
	Random random(623);
	for (int n : {5, 8}) {
		const SurfaceMesh mesh = wavyDisk(n, random);
		CutMap d(mesh, fromAbove(mesh));
		Measured m(d);
		Eigen::VectorXcd x = Eigen::VectorXcd::Zero(m.points.unknowns), gradient, trial;
		double value = m.energy.evaluate(m.start), step = 1e-3;
		const double before = value;
		for (int i = 0; i < 20000 && step > 1e-14; ++i) {
			m.energy.gradient(gradient);
			const double fall = gradient.squaredNorm();
			while (step > 1e-14) {
				trial = x - step * gradient;
				const double next = m.energy.evaluate(m.moved(trial));
				if (next <= value - 0.5 * step * fall) {
					value = next;
					x = trial;
					step *= 1.5;
					break;
				}
				step *= 0.5;
			}
		}
		EXPECT_FALSE(d.improve());
		EXPECT_LT(value, 0.9 * before);
		EXPECT_LT(energyOf(d), 1.01 * value);
	}
}

/// Across every seam the same motion leads from one side to the other as before, and what is fixed stays.
TEST(LeastStretch, LowersTheEnergyWithSeamsAsTheyAre)
{
	Random random(631);
	for (CutMap& d : validMapsWithSeams(random)) {
		const FlatMesh start = d.flat;
		const PointGroups groups = d.groups();
		EXPECT_FALSE(leastStretch(d.flat, groups));
		EXPECT_EQ(d.flipped(), 0);
		EXPECT_LT(costOf(d.flat, 0.0).energy, costOf(start, 0.0).energy - 1e-3);
		for (const int p : start.place.indices())
			EXPECT_TRUE(!groups.fixed[groups.group[p]] || d.flat.place[p] == start.place[p]);
		const auto along = [](const FlatMesh& flat, Corner side) {
			return asComplex(flat.at(side.next())) - asComplex(flat.at(side));
		};
		int seams = 0;
		for (const Corner side : start.across.indices()) {
			const Corner other = start.across[side];
			if (!other.isValid() || start.joined(side).isValid())
				continue;
			++seams;
			const Complex turn = along(start, side) / -along(start, other);
			EXPECT_NEAR(
				std::abs(along(d.flat, side) + turn * along(d.flat, other)),
				0.0,
				1e-9 * d.extent());
		}
		EXPECT_GT(seams, 0);
	}
}

TEST(LeastDistortion, LeavesALayoutWithNothingToMove)
{
	const SurfaceMesh mesh = rectangle(1, 1, 2.0, 1.0);
	CutMap d(mesh, {{0, 0}, {0, 1}, {1, 0}, {1, 2}});
	ASSERT_EQ(d.flipped(), 0);
	d.boundaryMoves = false;
	const Array<Point2> start = d.flat.place;
	EXPECT_FALSE(d.improve());
	EXPECT_TRUE(std::isfinite(energyOf(d)));
	EXPECT_EQ(d.flat.place, start);
	EXPECT_FALSE(leastStretch(d.flat, d.groups()));
	EXPECT_EQ(d.flat.place, start);
}

} // namespace
} // namespace ricci::testing
