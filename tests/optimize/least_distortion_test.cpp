// SPDX-License-Identifier: GPL-3.0-or-later
#include "flat_maps.h"
#include "support/complex.h"
#include "support/flipped_flow.h"
#include "support/intrinsic.h"
#include "support/random_surface.h"
#include "support/shapes.h"

#include <ricci/measure/distortion.h>
#include <ricci/numerics/iteration.h>
#include <ricci/optimize/least_distortion.h>
#include <ricci/optimize/mean_distortion.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace ricci::testing {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A map of a mesh's own triangles to the plane, cut open.
struct CutMap
{
	SurfaceMesh mesh;
	FlatMesh flat;
	VertexArray<char> cones;
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
		cones = flow.cones();
	}

	/// A disk whose vertices are at \p places.
	CutMap(const SurfaceMesh& m, const std::vector<Point2>& places) :
			mesh(m), flat(flatDisk(m, places)), cones(m.positions.size(), 0)
	{
	}

	Descent improve() { return leastDistortion(flat, cones, boundaryMoves, false); }

	PointGroups groups() const
	{
		return joinedPoints(flat, cones, [this](int) { return boundaryMoves; });
	}
	NumberedPoints points() const { return {flat, groups()}; }

	int flipped() const { return notCounterClockwise(flat); }

	double extent() const { return flat.box().extent(); }

	Distortion measured() const
	{
		std::vector<Triangle2> plane;
		for (const int f : flat.points.indices())
			plane.push_back(flat.at(f));
		return measureDistortion(flat.vertices, mesh.positions, Array<Triangle2>(plane));
	}
};

/// The seams and the boundary of a map.
struct Borders
{
	std::vector<Corner> seams; ///< sides
	Array<int> seamsAt;        ///< [vertex]
	Array<char> boundary;      ///< [vertex]

	explicit Borders(const FlatMesh& flat) :
			seamsAt(flat.vertexCount(), 0), boundary(flat.vertexCount(), 0)
	{
		for (int c = 0; c < 3 * flat.points.size(); ++c) {
			const Corner side(c);
			if (!flat.across[side].isValid())
				boundary[flat.vertices[side]] = boundary[flat.vertices[side.next()]] = 1;
			else if (!flat.joined(side).isValid()) {
				seams.push_back(side);
				++seamsAt[flat.vertices[side]];
			}
		}
	}
};

SurfaceMesh wavyDisk(int n, Random& random)
{
	SurfaceMesh mesh = randomPlanarDisk(n, random);
	for (Point3& p : mesh.positions)
		p[2] = 0.2 * std::sin(7 * p[0]) * std::cos(5 * p[1]);
	return mesh;
}

/// A sphere with cones of pi, whose seams turn; a torus, whose seams are translations; a disk with
/// a free boundary and a cone inside, whose seam ends there.
std::vector<CutMap> mapsWithSeams(Random& random)
{
	const SurfaceMesh slab = shaken(perforatedSlab(0, 6), 0.02, random);
	const SurfaceMesh open = withoutStars(slab, {7});
	std::vector<double> curvature(open.positions.size(), 0.0);
	curvature[50] = 0.7;
	std::vector<CutMap> maps;
	maps.emplace_back(slab, conesAt(slab, {0, 57, 110, 163}), random);
	maps.emplace_back(bumpyTorus(20, 12, random), requestOf(TargetCurvature::Flat), random);
	maps.emplace_back(open, prescribed(curvature, true), random);
	return maps;
}

/// Those of them in which no triangle is flipped.
std::vector<CutMap> validMapsWithSeams(Random& random)
{
	std::vector<CutMap> valid;
	for (CutMap& map : mapsWithSeams(random))
		if (map.flipped() == 0)
			valid.push_back(std::move(map));
	EXPECT_GE(valid.size(), 2u);
	return valid;
}

/// Maps of surfaces of every kind to which the automatic target leads, where no straight triangle
/// is flipped.
std::vector<CutMap> mapsOfEveryKind(Random& random)
{
	std::vector<CutMap> maps;
	for (const SurfaceMesh& mesh : surfacesOfEveryKind(random)) {
		TargetRequest request = requestOf(TargetCurvature::Automatic);
		request.options.cones.distortion = 1.0;
		CutMap map(mesh, request, random);
		if (map.flipped() == 0)
			maps.push_back(std::move(map));
	}
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

// ---- The points that move -----------------------------------------------------------------------

TEST(NumberedPoints, MoveAsTheirSeamsAllow)
{
	Random random(601);
	for (const CutMap& d : mapsWithSeams(random)) {
		const NumberedPoints points = d.points();
		const Borders borders(d.flat);
		std::vector<int> seen;
		int images = 0, free = 0, stay = 0;
		const Adjacency<int, int> pointsAt(d.flat.vertexCount(), [&](const auto& add) {
			for (int c = 0; c < 3 * d.flat.points.size(); ++c)
				add(d.flat.vertices[Corner(c)], points.number[d.flat.points[Corner(c)]]);
		});
		for (const Vertex v : d.cones.indices()) {
			const auto all = pointsAt[v.number()];
			const int seams = borders.seamsAt[v.number()];
			std::vector<int> copies(all.begin(), all.end());
			std::sort(copies.begin(), copies.end());
			copies.erase(std::unique(copies.begin(), copies.end()), copies.end());
			seen.insert(seen.end(), copies.begin(), copies.end());
			if (seams == 2 && !d.cones[v] && !borders.boundary[v.number()]) {
				ASSERT_EQ(copies.size(), 2u);
				EXPECT_LT(copies[0], points.unknowns);
				EXPECT_EQ(points.unknown[copies[1]], copies[0]);
				EXPECT_GE(copies[1], points.unknowns);
				++images;
			}
			else if (seams == 0 && !d.cones[v]) {
				ASSERT_EQ(copies.size(), 1u);
				EXPECT_EQ(points.unknown[copies[0]], copies[0]);
				++free;
			}
			else
				for (const int copy : copies) {
					EXPECT_EQ(points.unknown[copy], -1);
					++stay;
				}
		}
		EXPECT_EQ(points.unknowns, free + images);
		EXPECT_EQ(points.moving, free + 2 * images);
		EXPECT_GT(images, 2);
		EXPECT_GT(stay, 0);
		std::sort(seen.begin(), seen.end());
		for (int p = 0; p < static_cast<int>(seen.size()); ++p)
			EXPECT_EQ(seen[at(p)], p);
		EXPECT_EQ(static_cast<int>(seen.size()), d.flat.place.size());
	}
}

TEST(NumberedPoints, CopiesTurnAsTheEdgesOfTheirSeam)
{
	Random random(602);
	for (const CutMap& d : mapsWithSeams(random)) {
		const NumberedPoints points = d.points();
		const Borders borders(d.flat);
		const auto alongSide = [&](Corner from, Corner to) {
			return asComplex(d.flat.place[d.flat.points[to]] - d.flat.place[d.flat.points[from]]);
		};
		int compared = 0;
		for (const Corner side : borders.seams) {
			const Corner across = d.flat.across[side];
			const int p = points.number[d.flat.points[side]];
			const int q = points.number[d.flat.points[across.next()]];
			if (p >= points.unknowns || points.unknown[q] != p)
				continue;
			const Complex left = alongSide(side, side.next());
			const Complex right = alongSide(across.next(), across);
			EXPECT_LT(std::abs(right / left - points.turn[q]), 1e-9);
			EXPECT_NEAR(std::abs(points.turn[q]), 1.0, 1e-15);
			++compared;
		}
		EXPECT_GT(compared, 2);
	}
}

TEST(NumberedPoints, BoundaryStaysOrTwoFarPointsDo)
{
	Random random(603);
	const SurfaceMesh mesh = wavyDisk(8, random);
	CutMap d(mesh, fromAbove(mesh));
	const NumberedPoints free = d.points();
	ASSERT_EQ(free.unknowns, d.flat.vertexCount() - 2);
	std::vector<Point2> pinned;
	for (const int p : free.number.indices())
		if (free.unknown[free.number[p]] < 0)
			pinned.push_back(d.flat.place[p]);
	EXPECT_GT(distance(pinned[0], pinned[1]), 1.2); // in a unit square
	d.boundaryMoves = false;
	const NumberedPoints held = d.points();
	const Borders borders(d.flat);
	for (const int v : held.number.indices())
		EXPECT_EQ(held.unknown[held.number[v]] < 0, borders.boundary[v] != 0);
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

TEST(LeastDistortion, FallsWithoutTurningATriangle)
{
	Random random(621);
	std::vector<CutMap> maps = mapsOfEveryKind(random);
	EXPECT_GE(maps.size(), 8u);
	int better = 0;
	for (CutMap& d : maps) {
		const Distortion before = d.measured();
		Measured m(d);
		const double start = m.energy.evaluate(m.start);
		const Descent result = d.improve();
		EXPECT_EQ(d.flipped(), 0);
		EXPECT_LE(result.after, result.before);
		EXPECT_NEAR(result.before / start, 1.0, 1e-12); // the points have other numbers there
		m.place(d.flat);
		EXPECT_NEAR(m.energy.evaluate(m.start) / result.after, 1.0, 1e-12);
		EXPECT_GT(result.steps, 0);
		better += d.measured().qcVertexMean < before.qcVertexMean;
	}
	EXPECT_EQ(better, static_cast<int>(maps.size()));
}

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
		const Descent result = d.improve();
		EXPECT_LT(value, 0.9 * before);
		EXPECT_LT(result.after, 1.01 * value);
	}
}

TEST(LeastDistortion, KeepsAConformalMap)
{
	Random random(624);
	const SurfaceMesh mesh = randomPlanarDisk(14, random);
	std::vector<Point2> places = fromAbove(mesh);
	const Complex turn = std::polar(3.0, 0.7), shift(5.0, -2.0);
	for (Point2& p : places)
		p = asPoint(turn * asComplex(p) + shift);
	for (const bool boundaryMoves : {true, false}) {
		CutMap d(mesh, places);
		d.boundaryMoves = boundaryMoves;
		const FlatMesh start = d.flat;
		const Descent result = d.improve();
		EXPECT_NEAR(result.after / result.before, 1.0, 1e-9);
		for (const int p : start.place.indices())
			EXPECT_LT(distance(d.flat.place[p], start.place[p]), 1e-9 * d.extent());
	}
}

TEST(LeastDistortion, KeepsSeamsIsometricAndConesInPlace)
{
	Random random(625);
	int seams = 0, moved = 0;
	for (CutMap& d : validMapsWithSeams(random)) {
		const FlatMesh start = d.flat;
		const Borders borders(start);
		EXPECT_GT(d.improve().steps, 0);
		const auto transition = [&](const FlatMesh& flat, Corner side) {
			const auto along = [&](Corner c) {
				return asComplex(flat.place[flat.points[c.next()]] - flat.place[flat.points[c]]);
			};
			return -along(d.flat.across[side]) / along(side);
		};
		for (const Corner side : borders.seams) {
			const Complex then = transition(start, side), after = transition(d.flat, side);
			EXPECT_LT(std::abs(std::abs(after) - 1.0), 1e-12 + 2 * std::abs(std::abs(then) - 1.0));
			EXPECT_LT(std::abs(after - then), 1e-10);
			moved += d.flat.place[d.flat.points[side]] != start.place[start.points[side]];
			++seams;
		}
		const NumberedPoints points = d.points();
		for (int c = 0; c < 3 * start.points.size(); ++c) {
			const int p = start.points[Corner(c)];
			if (d.cones[Vertex(start.vertices[Corner(c)])] ||
				points.unknown[points.number[p]] < 0) {
				EXPECT_EQ(d.flat.place[p], start.place[p]);
			}
		}
	}
	EXPECT_GT(seams, 30);
	EXPECT_GT(moved, 15);
}

/// All others get better, and none of them turns.
TEST(LeastDistortion, ATurnedTriangleDoesNotCount)
{
	Random random(629);
	const SurfaceMesh mesh = wavyDisk(8, random);
	std::vector<Point2> places = fromAbove(mesh);
	const Triangle& t = mesh.triangles[40];
	places[at(t[0])] = {
		(places[at(t[1])][0] + places[at(t[2])][0]) / 2 * 2 - places[at(t[0])][0],
		(places[at(t[1])][1] + places[at(t[2])][1]) / 2 * 2 - places[at(t[0])][1]};
	CutMap d(mesh, places);
	const int flipped = d.flipped();
	ASSERT_GT(flipped, 0);
	const Descent result = d.improve();
	EXPECT_GT(result.steps, 0);
	EXPECT_LT(result.after, result.before);
	EXPECT_LE(d.flipped(), flipped);
}

TEST(LeastDistortion, LeavesALayoutWithNothingToMove)
{
	const SurfaceMesh mesh = rectangle(1, 1, 2.0, 1.0);
	CutMap d(mesh, {{0, 0}, {0, 1}, {1, 0}, {1, 2}});
	ASSERT_EQ(d.flipped(), 0);
	d.boundaryMoves = false;
	const Array<Point2> start = d.flat.place;
	const Descent result = d.improve();
	EXPECT_EQ(result.steps, 0);
	EXPECT_EQ(result.before, result.after);
	EXPECT_TRUE(std::isfinite(result.after));
	EXPECT_EQ(d.flat.place, start);
}

TEST(LeastDistortion, DoesNotTurnTrianglesWithoutAreaInSpace)
{
	// Corners of some triangles are moved onto the opposite side, in space only.
	Random random(630);
	SurfaceMesh mesh = wavyDisk(12, random);
	const std::vector<Point2> places = fromAbove(mesh);
	for (std::size_t f = 30; f < mesh.triangles.size(); f += 60) {
		const Triangle& t = mesh.triangles[f];
		for (std::size_t k = 0; k < 3; ++k)
			mesh.positions[at(t[0])][k] =
				(mesh.positions[at(t[1])][k] + mesh.positions[at(t[2])][k]) / 2;
	}
	CutMap d(mesh, places);
	const Descent result = d.improve();
	EXPECT_GT(result.steps, 2);
	EXPECT_LT(result.after, 0.95 * result.before);
	EXPECT_EQ(d.flipped(), 0);
	for (const Point2& p : d.flat.place)
		EXPECT_TRUE(std::isfinite(p[0]) && std::isfinite(p[1]));
}

} // namespace
} // namespace ricci::testing
