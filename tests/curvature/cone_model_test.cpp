// SPDX-License-Identifier: GPL-3.0-or-later
#include "dense_flow.h"
#include "linearised.h"

#include "support/listener.h"
#include "support/random_surface.h"
#include "support/shapes.h"

#include <ricci/base/numbers.h>
#include <ricci/curvature/cone_model.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace ricci::testing {
namespace {

LinearCase closed(int genus, double noise = 0.05)
{
	Random random(900);
	return {"", shaken(perforatedSlab(genus, 2), noise, random), ConeBoundary::Fixed};
}

/// Five cones, the curvatures of which are given or fitted.
std::vector<Vertex> someVertices()
{
	return {Vertex(3), Vertex(40), Vertex(17), Vertex(29), Vertex(8)};
}

std::vector<double> curvaturesOf(const ConeModel& model)
{
	return {model.curvatures().begin(), model.curvatures().end()};
}

/// \p phi less its mean by area: fields of closed surfaces are known up to a constant.
VertexVector centred(VertexVector phi, const VertexVector& area)
{
	phi.array() -= area.dot(phi);
	return phi;
}

/// The factor of the metric with curvature \p k.
VertexVector factorOf(const DenseFlow& dense, const VertexVector& k)
{
	return dense.solve(k - dense.curvature);
}

/// The field phi with L phi = A u, up to a constant: L is symmetric.
VertexVector gradientOf(const DenseFlow& dense, const VertexVector& u)
{
	return dense.solve(dense.area.cwiseProduct(u));
}

VertexVector
conesAlone(const std::vector<Vertex>& vertices, const std::vector<double>& curvatures, int size)
{
	VertexVector k = VertexVector::Zero(size);
	for (std::size_t i = 0; i < vertices.size(); ++i)
		k[vertices[i]] += curvatures[i];
	return k;
}

VertexVector conesAlone(const ConeModel& model, int size)
{
	return conesAlone(model.vertices(), curvaturesOf(model), size);
}

/// No angle is below a right one: a cone has 3 pi / 2 at most.
TEST(ConeModel, NeedsAsManyConesAsTheTotalAsksFor)
{
	for (int genus = 0; genus <= 2; ++genus) {
		Linearised linear(closed(genus));
		const ConeModel model(linear.flow, 2 * kPi * (2 - 2 * genus));
		EXPECT_TRUE(model.hasFixedSum());
		EXPECT_EQ(
			model.minSize(),
			genus == 0   ? 3
			: genus == 1 ? 0
						 : 1); // ceil(4 pi / (3 pi / 2)) = 3
	}
	LinearCase open = closed(0);
	open.mesh = withoutStars(open.mesh, {0});
	Linearised linear(open);
	const ConeModel model(linear.flow, 2 * kPi);
	EXPECT_FALSE(model.hasFixedSum());
	EXPECT_EQ(model.minSize(), 0);
}

/// A box is flat but for its corners: with cones there u is 0, and the best curvatures are its own.
TEST(ConeModel, OfABoxIsExactWithConesAtItsCorners)
{
	Linearised linear({"", perforatedSlab(0, 3), ConeBoundary::Fixed});
	ConeModel model(linear.flow, 4 * kPi);
	const VertexVector& own = linear.flow.curvature();
	EXPECT_GT(model.distortion(), 0.1); // curvature is needed somewhere
	for (const Vertex v : own.indices())
		if (own[v] > 1.0)
			model.append({v});
	model.append({Vertex(static_cast<int>(
		std::find_if(own.begin(), own.end(), [](double k) { return std::abs(k) < 1e-9; }) -
		own.begin()))});
	ASSERT_EQ(model.size(), 9);
	model.fit();
	for (int i = 0; i < model.size(); ++i)
		EXPECT_NEAR(model.curvature(i), i < 8 ? kPi / 2 : 0.0, 1e-9);
	EXPECT_LT(model.exactDistortion(), 1e-12);
	EXPECT_LT(model.factor().lpNorm<Eigen::Infinity>(), 1e-12);
	EXPECT_LT(model.distortion(), 1e-6); // the root of a sum that cancels
}

/// Where nothing is curved no cone is any use.
TEST(ConeModel, OfAFlatTorusHasNothingToGain)
{
	// Of lengths alone: rows of equal triangles.
	const int n = 6;
	const SurfaceMesh grid = torus(3, 1, n, n);
	IntrinsicMesh flat = intrinsicMesh(grid);
	for (const Edge e : flat.lengths.indices())
		flat.lengths[e] = 1.0;
	Packed packed(flat.triangulation, flat.lengths);
	const EmbeddedSurface surface = surfaceOf(packed);
	InitialPacking start = initialPacking(surface, FlowOptions());
	LinearFlow flow(surface, start, ConeBoundary::Fixed);
	ConeModel model(flow, 0.0);
	EXPECT_LT(model.distortion(), 1e-6);
	model.append({Vertex(0), Vertex(7), Vertex(20)});
	model.fit();
	for (int i = 0; i < 3; ++i)
		EXPECT_NEAR(model.curvature(i), 0.0, 1e-9);
	EXPECT_LT(model.factor().lpNorm<Eigen::Infinity>(), 1e-12);
}

TEST(ConeModel, HasTheEnergyAndTheFactorOfTheDenseSystem)
{
	for (int genus : {0, 2}) {
		Linearised linear(closed(genus));
		const DenseFlow dense(linear.packed);
		ConeModel model(linear.flow, 2 * kPi * (2 - 2 * genus));
		model.append(someVertices());
		model.fit();
		const VertexVector u = factorOf(dense, conesAlone(model, linear.flow.vertexCount()));
		const double size = u.lpNorm<Eigen::Infinity>();
		EXPECT_LT((model.factor() - u).lpNorm<Eigen::Infinity>(), 1e-7 * size);
		const double distortion = dense.distortion(model.vertices(), curvaturesOf(model));
		EXPECT_GT(distortion, 0.01);
		EXPECT_NEAR(model.distortion(), distortion, 1e-6 * distortion);
		EXPECT_NEAR(model.exactDistortion(), distortion, 1e-6 * distortion);
		EXPECT_NEAR(0.25 * distortion * distortion, model.energy(), 1e-5 * model.energy());
	}
}

TEST(ConeModel, TheGradientIsTheAdjointField)
{
	for (int genus : {0, 2}) {
		const double total = 2 * kPi * (2 - 2 * genus);
		Linearised linear(closed(genus));
		const DenseFlow dense(linear.packed);
		ConeModel model(linear.flow, total);
		model.append(someVertices());
		model.fit();
		const int n = linear.flow.vertexCount();
		const VertexVector k = conesAlone(model, n);
		const auto expectSame = [&](const VertexVector& phi, const VertexVector& expected) {
			const VertexVector a = centred(phi, dense.area), b = centred(expected, dense.area);
			EXPECT_LT((a - b).lpNorm<Eigen::Infinity>(), 1e-6 * b.lpNorm<Eigen::Infinity>());
		};
		expectSame(model.gradient(), gradientOf(dense, factorOf(dense, k)));
		// At the cones of the best curvatures, none of which is at its bound, it is the same.
		for (int i = 1; i < model.size(); ++i)
			if (model.curvature(0) < 4.7 && model.curvature(i) < 4.7) {
				EXPECT_NEAR(
					model.gradient()[model.vertex(i)], model.gradient()[model.vertex(0)], 1e-9);
			}
		// All cones alike, and what is left spread by area.
		const double share = total / 7;
		VertexVector shares = (total - 5 * share) * dense.area;
		for (const Vertex v : model.vertices())
			shares[v] += share;
		expectSame(
			model.gradientAt(Eigen::VectorXd::Constant(model.size(), share)),
			gradientOf(dense, factorOf(dense, shares)));
		// The curvature of one cone spread by area.
		for (int i = 0; i < model.size(); ++i) {
			VertexVector others = k + model.curvature(i) * dense.area;
			others[model.vertex(i)] -= model.curvature(i);
			VertexVector phi(n);
			for (const Vertex v : phi.indices())
				phi[v] = model.gradient()[v] - model.curvature(i) * model.field(i)[v];
			expectSame(phi, gradientOf(dense, factorOf(dense, others)));
		}
	}
}

/// Of an open surface there is no constant: cones appear and go.
TEST(ConeModel, TheGradientIsTheDerivativeOfHalfTheEnergy)
{
	LinearCase open = closed(0);
	open.mesh = withoutStars(open.mesh, {0});
	Linearised linear(open);
	ConeModel model(linear.flow, 2 * kPi);
	const VertexVector before = model.gradient();
	const double energy = model.energy();
	int count = 0;
	for (const Vertex v : before.indices()) {
		if (linear.surface.topology.boundary[v])
			continue;
		model.append({v});
		model.fit();
		// The energy is E(0) + 2 phi k + G k^2, the least of which is at k = -phi / G.
		if (model.curvature(0) < 4.7) {
			EXPECT_NEAR(model.energy(), energy + before[v] * model.curvature(0), 1e-9 * energy);
			++count;
		}
		model.remove(0);
		model.fit();
		EXPECT_NEAR(model.energy(), energy, 1e-12 * energy);
		EXPECT_EQ(model.size(), 0);
		EXPECT_FALSE(model.isCone(v));
	}
	EXPECT_GT(count, 5);
}

TEST(ConeModel, SeveralConesAtATimeAreTheSameAsOneByOne)
{
	Linearised linear(closed(0));
	ConeModel together(linear.flow, 4 * kPi), single(linear.flow, 4 * kPi);
	together.append(someVertices());
	for (const Vertex v : someVertices())
		single.append({v});
	together.fit();
	single.fit();
	EXPECT_EQ(together.vertices(), single.vertices());
	for (int i = 0; i < 5; ++i)
		EXPECT_NEAR(together.curvature(i), single.curvature(i), 1e-10);
	EXPECT_NEAR(together.energy(), single.energy(), 1e-10);
}

/// The model with a cone elsewhere is that which has it there from the beginning; a trial that is not
/// taken leaves everything.
TEST(ConeModel, TrialsAreUndoneUnlessTheyAreTaken)
{
	Linearised linear(closed(0));
	ConeModel model(linear.flow, 4 * kPi), moved(linear.flow, 4 * kPi), less(linear.flow, 4 * kPi);
	const Vertex to(50);
	model.append(someVertices());
	model.fit();
	std::vector<Vertex> elsewhere = someVertices(), fewer = someVertices();
	elsewhere[2] = to;
	fewer.erase(fewer.begin() + 2);
	moved.append(elsewhere);
	moved.fit();
	less.append(fewer);
	less.fit();

	const std::vector<double> before = curvaturesOf(model);
	const VertexVector gradient = model.gradient();
	const auto expectUnchanged = [&] {
		EXPECT_EQ(model.vertices(), someVertices());
		EXPECT_EQ(curvaturesOf(model), before);
		EXPECT_LT((model.gradient() - gradient).lpNorm<Eigen::Infinity>(), 1e-13);
		EXPECT_TRUE(model.isCone(someVertices()[2]));
		EXPECT_FALSE(model.isCone(to));
	};
	const double there = moved.energy();
	EXPECT_FALSE(
		model.tryMove(2, {to}, [&](Vertex, double energy) { return energy < there - 1e-9; }));
	expectUnchanged();
	EXPECT_FALSE(model.tryWithout(2, [&] {
		EXPECT_EQ(model.vertices(), fewer);
		EXPECT_NEAR(model.energy(), less.energy(), 1e-10);
		model.append({to});
		return false;
	}));
	expectUnchanged();

	// Both bounds let the first two places pass, and the energies there are too high.
	const Vertex high(to.number() + 1), higher(to.number() + 2);
	ASSERT_FALSE(model.isCone(high) || model.isCone(higher));
	int asked = 0;
	EXPECT_TRUE(model.tryMove(2, {high, higher, to}, [&](Vertex v, double energy) {
		return v == to ? energy < there + 1e-9 : asked++ < 2 || asked == 3 || asked == 5;
	}));
	EXPECT_EQ(asked, 6);
	EXPECT_EQ(model.vertices(), elsewhere);
	EXPECT_TRUE(model.isCone(to));
	EXPECT_FALSE(model.isCone(someVertices()[2]));
	EXPECT_LT((model.gradient() - moved.gradient()).lpNorm<Eigen::Infinity>(), 1e-9);
	EXPECT_TRUE(model.tryWithout(2, [] { return true; }));
	EXPECT_EQ(model.vertices(), fewer);
	EXPECT_NEAR(model.energy(), less.energy(), 1e-10);
}

/// The rise of the lowest energy without a cone, which need() has from one matrix, by fits.
TEST(ConeModel, NeedIsByHowMuchTheEnergyRises)
{
	for (int genus : {0, 1, 2}) {
		Linearised linear(closed(genus, 0.1));
		ConeModel model(linear.flow, 2 * kPi * (2 - 2 * genus));
		// Where the surface is curved most, so that no cone is at its bound.
		std::vector<Vertex> vertices;
		for (const Vertex v : model.area().indices())
			vertices.push_back(v);
		const VertexVector& own = linear.flow.curvature();
		std::sort(vertices.begin(), vertices.end(), [&](Vertex v, Vertex w) {
			return std::abs(own[v]) > std::abs(own[w]);
		});
		vertices.resize(12);
		model.append(vertices);
		model.fit();
		for (const double k : curvaturesOf(model))
			ASSERT_LT(k, 4.7); // the bound plays no part
		std::vector<double> without;
		bool isBound = false;
		for (int i = 0; i < model.size(); ++i) {
			const VertexVector gradient = model.gradientWithout(i);
			model.tryWithout(i, [&] {
				without.push_back(model.energy());
				for (const double k : curvaturesOf(model))
					isBound |= k > 4.7;
				const VertexVector difference = gradient - model.gradient();
				EXPECT_LT(
					centred(difference, model.area()).lpNorm<Eigen::Infinity>(),
					1e-9 * gradient.lpNorm<Eigen::Infinity>());
				return false;
			});
		}
		ASSERT_FALSE(isBound);
		ASSERT_EQ(without.size(), 12u);
		for (int i = 0; i < model.size(); ++i)
			EXPECT_NEAR(model.need(i), without[at(i)] - model.energy(), 1e-10 * without[at(i)]);
	}
}

TEST(ConeModel, RoundedCurvaturesAreQuarterTurnsOfTheSameSum)
{
	Linearised linear(closed(0));
	ConeModel model(linear.flow, 4 * kPi);
	model.append(someVertices());
	model.fit();
	const std::vector<double> free = curvaturesOf(model);
	const double energy = model.energy();
	model.setRounding(ConeRounding::QuarterTurns);
	double sum = 0.0;
	for (const double k : curvaturesOf(model)) {
		EXPECT_NEAR(k, kPi / 2 * std::round(k / (kPi / 2)), 1e-12);
		sum += k;
	}
	EXPECT_NEAR(sum, 4 * kPi, 1e-12);
	EXPECT_GE(model.energy(), energy);
	model.setRounding(ConeRounding::Free);
	EXPECT_EQ(curvaturesOf(model), free);
}

TEST(ConeModel, TicksBeforeSolutions)
{
	Linearised linear(closed(0));
	Listener ticks;
	const Task task(ticks);
	ConeModel model(linear.flow, 4 * kPi);
	EXPECT_EQ(ticks.calls(), 1);
	model.append(someVertices()); // two at a time
	EXPECT_EQ(ticks.calls(), 4);
	model.fit();
	EXPECT_EQ(ticks.calls(), 4); // fits are small
}

std::vector<LinearCase> cases()
{
	Random random(770);
	const SurfaceMesh sphere = shaken(perforatedSlab(0, 3), 0.05, random);
	return {
		{"sphere", sphere, ConeBoundary::Fixed},
		{"genus 2", shaken(perforatedSlab(2, 2), 0.05, random), ConeBoundary::Fixed},
		{"disk, fixed boundary", withoutStars(sphere, {0}), ConeBoundary::Fixed},
		{"disk, prescribed boundary", withoutStars(sphere, {0}), ConeBoundary::Prescribed}};
}

/// Different vertices inside.
std::vector<Vertex>
verticesInside(const EmbeddedSurface& surface, std::size_t count, Random& random)
{
	std::vector<Vertex> chosen;
	while (chosen.size() < count) {
		const Vertex v(random.index(surface.triangulation.vertexCount()));
		if (!surface.topology.boundary[v] &&
			std::find(chosen.begin(), chosen.end(), v) == chosen.end())
			chosen.push_back(v);
	}
	return chosen;
}

double totalOf(const EmbeddedSurface& surface)
{
	return 2 * kPi * surface.topology.type.eulerCharacteristic();
}

/// The lowest energy with cones at these vertices.
double energyOf(Linearised& linear, const std::vector<Vertex>& cones)
{
	ConeModel model(linear.flow, totalOf(linear.surface));
	model.append(cones);
	model.fit();
	return model.energy();
}

/// With few cones it is a sum of fields, with many another solution.
TEST(ConeModel, TheGradientIsTheSameForFewAndManyCones)
{
	Random random(771);
	for (const LinearCase& c : cases()) {
		SCOPED_TRACE(c.name);
		Linearised linear(c);
		ConeModel model(linear.flow, totalOf(linear.surface));
		for (int count : {20, 50}) {
			model.append(verticesInside(linear.surface, at(count), random));
			model.fit();
			const VertexVector difference =
				model.gradient() - linear.flow.gradient(linear.flow.factor(
									   conesAlone(model, linear.flow.vertexCount())));
			if (model.hasFixedSum())
				EXPECT_LT(centred(difference, model.area()).lpNorm<Eigen::Infinity>(), 1e-8);
			else
				EXPECT_LT(difference.lpNorm<Eigen::Infinity>(), 1e-8);
		}
	}
}

/// At the lowest energy with bounds, more curvature changes it nowhere where a cone is below its bound, by as
/// much everywhere if the sum is fixed, and lowers it where one is at its bound.
TEST(ConeModel, CurvaturesAreTheBestWithNoneAboveTheBound)
{
	Random random(773);
	int held = 0;
	for (const LinearCase& c : cases()) {
		SCOPED_TRACE(c.name);
		Linearised linear(c);
		const DenseFlow dense(linear.packed);
		for (int trial = 0; trial < 20; ++trial) {
			ConeModel model(linear.flow, totalOf(linear.surface));
			std::vector<Vertex> cones =
				verticesInside(linear.surface, at(5 + random.index(8)), random);
			const Vertex last = cones.back();
			cones.pop_back();
			model.append(cones);
			model.fit();
			if (model.hasFixedSum()) {
				EXPECT_NEAR(model.curvatures().sum(), model.total(), 1e-10);
			}
			// Not only from the beginning: from the bounds that were reached before.
			model.append({last});
			model.remove(0);
			model.fit();
			const VertexVector& phi = model.gradient();
			double level = 0.0;
			for (int i = 0; model.hasFixedSum() && i < model.size(); ++i)
				if (model.curvature(i) < kMaxConeCurvature)
					level = phi[model.vertex(i)];
			const double size = phi.lpNorm<Eigen::Infinity>();
			for (int i = 0; i < model.size(); ++i) {
				const double slope = phi[model.vertex(i)] - level;
				if (model.curvature(i) < kMaxConeCurvature) {
					EXPECT_NEAR(slope, 0.0, 1e-9 * size);
				}
				else {
					EXPECT_EQ(model.curvature(i), kMaxConeCurvature);
					EXPECT_LT(slope, 1e-9 * size);
					++held;
				}
			}
		}
	}
	EXPECT_GT(held, 20);
}

/// With others at their bound, need() is no more than that.
TEST(ConeModel, NeedIsABoundOfTheRise)
{
	Random random(775);
	int held = 0, alone = 0;
	for (const LinearCase& c : cases()) {
		SCOPED_TRACE(c.name);
		Linearised linear(c);
		for (int trial = 0; trial < 60; ++trial) {
			ConeModel model(linear.flow, totalOf(linear.surface));
			model.append(verticesInside(linear.surface, at(5 + random.index(8)), random));
			model.fit();
			const double before = model.energy();
			const Eigen::VectorXd k = model.curvatures();
			const auto isHeld = [](double x) { return x == kMaxConeCurvature; };
			for (int i = 0; i < model.size(); ++i) {
				const double need = model.need(i);
				bool isAlone = true; // none of the others is at its bound, before or after
				double rise = 0.0;
				model.tryWithout(i, [&] {
					rise = model.energy() - before;
					const Eigen::VectorXd& after = model.curvatures();
					isAlone = std::none_of(after.begin(), after.end(), isHeld) &&
							  std::count_if(k.begin(), k.end(), isHeld) == isHeld(k[i]);
					return false;
				});
				EXPECT_LT(need, rise + 1e-9 * before);
				if (isAlone) {
					EXPECT_NEAR(need, rise, 1e-9 * (rise + before));
				}
				held += isHeld(k[i]);
				alone += isAlone;
			}
		}
	}
	EXPECT_GT(held, 20);
	EXPECT_GT(alone, 100);
}

/// A sphere needs three cones: two carry what they can.
TEST(ConeModel, TooFewConesAreAllAtTheirBound)
{
	Linearised linear(closed(0));
	ConeModel model(linear.flow, 4 * kPi);
	model.append({Vertex(3), Vertex(40)});
	model.fit();
	EXPECT_EQ(curvaturesOf(model), std::vector<double>(2, kMaxConeCurvature));
	model.append({Vertex(17), Vertex(29)});
	model.fit();
	EXPECT_NEAR(model.curvatures().sum(), 4 * kPi, 1e-12);
}

/// Cones that no digit of the energy tells apart share what one of them would have.
TEST(ConeModel, TwinsAreFittedAsOneCone)
{
	Random random(774);
	SurfaceMesh mesh = shaken(perforatedSlab(0, 3), 0.05, random);
	// One more vertex, very near to another one, in the middle of a triangle.
	const Triangle t = mesh.triangles[10];
	Point3 near = mesh.positions[at(t[0])];
	for (std::size_t k = 0; k < 3; ++k)
		near[k] += 1e-9 * (mesh.positions[at(t[1])][k] + mesh.positions[at(t[2])][k] - 2 * near[k]);
	const int twin = static_cast<int>(mesh.positions.size());
	mesh.positions.push_back(near);
	mesh.triangles[10] = {t[0], t[1], twin};
	mesh.triangles.push_back({t[1], t[2], twin});
	mesh.triangles.push_back({t[2], t[0], twin});
	Linearised linear({"", mesh, ConeBoundary::Fixed});
	const auto fitted = [&](const std::vector<Vertex>& vertices) {
		ConeModel model(linear.flow, 4 * kPi);
		model.append(vertices);
		model.fit();
		return std::pair{model.energy(), curvaturesOf(model)};
	};
	std::vector<Vertex> cones;
	for (const Vertex v : verticesInside(linear.surface, 6, random))
		if (v != Vertex(t[0]) && v != Vertex(twin))
			cones.push_back(v);
	cones.push_back(Vertex(t[0]));
	const auto [energy, k] = fitted(cones);
	cones.push_back(Vertex(twin));
	const auto [both, shares] = fitted(cones);
	EXPECT_NEAR(both, energy, 1e-4 * energy);
	const std::size_t last = k.size() - 1;
	EXPECT_NEAR(shares[last] + shares[last + 1], k[last], 1e-3);
	for (std::size_t i = 0; i < last; ++i)
		EXPECT_NEAR(shares[i], k[i], 1e-3);
}

/// The bound that spares a solution decides as the energy itself does.
TEST(ConeModel, AMoveIsMadeWhereTheEnergyIsLow)
{
	Random random(772);
	int moved = 0, stayed = 0, held = 0;
	for (const LinearCase& c : cases()) {
		SCOPED_TRACE(c.name);
		Linearised linear(c);
		for (int trial = 0; trial < 60; ++trial) {
			std::vector<Vertex> cones =
				verticesInside(linear.surface, at(5 + random.index(3)), random);
			const Vertex to = cones.back();
			cones.pop_back();
			ConeModel model(linear.flow, totalOf(linear.surface));
			model.append(cones);
			model.fit();
			const double before = model.energy(), wanted = random.real(0.5, 1.0) * before;
			cones[2] = to;
			const double after = energyOf(linear, cones);
			if (std::abs(after - wanted) < 1e-6 * before)
				continue;
			const double most = model.curvatures().maxCoeff();
			std::vector<double> seen; // bounds, and in the end the energy itself
			const bool hasMoved = model.tryMove(2, {to}, [&](Vertex, double energy) {
				seen.push_back(energy);
				return energy < wanted;
			});
			EXPECT_EQ(hasMoved, after < wanted);
			for (const double bound : seen)
				EXPECT_LT(bound, after + 1e-9 * (1.0 + before));
			held += most == kMaxConeCurvature;
			EXPECT_NEAR(model.energy(), hasMoved ? after : before, 1e-9 * (1.0 + before));
			EXPECT_EQ(model.isCone(to), hasMoved);
			(hasMoved ? moved : stayed) += 1;
		}
	}
	EXPECT_GT(moved, 10);
	EXPECT_GT(stayed, 10);
	EXPECT_GT(held, 10);
}

} // namespace
} // namespace ricci::testing
