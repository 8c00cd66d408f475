// SPDX-License-Identifier: GPL-3.0-or-later
#include "linearised.h"

#include <ricci/cones/cone_model.h>

namespace ricci::testing {
namespace {

constexpr double kBelowBound = 4.7; ///< a cone with less curvature is not at its bound

std::vector<LinearCase> cases()
{
	std::vector<LinearCase> all = linearCases(770, 3, 2, 2, 0.05);
	all.resize(4);
	return all;
}

/// A closed surface of some 60 vertices.
LinearCase closed(int genus)
{
	Random random(900);
	return {"", shaken(perforatedSlab(genus, 2), 0.05, random)};
}

const std::vector<Vertex> kFive{Vertex(3), Vertex(40), Vertex(17), Vertex(29), Vertex(8)};

/// The lowest energy with cones at these vertices.
ConeModel fitted(Linearised& linear, const std::vector<Vertex>& cones)
{
	ConeModel model(linear.flow, linear.total());
	model.append(cones);
	model.fit();
	return model;
}

VertexVector whole(const ConeModel& model)
{
	return spreadOut(model.vertices(), model.curvatures(), static_cast<int>(model.area().size()));
}

TEST(ConeModel, HasTheEnergyTheFactorAndTheFieldsOfTheDenseSystem)
{
	for (const int genus : {0, 2}) {
		Linearised linear(closed(genus));
		const DenseFlow dense(linear);
		const double total = linear.total();
		ConeModel model = fitted(linear, kFive);
		EXPECT_TRUE(model.hasFixedSum());
		EXPECT_EQ(model.minSize(), genus == 0 ? 3 : 1); // ceil(4 pi / (3 pi / 2)) = 3
		EXPECT_NEAR(model.curvatures().sum(), total, 1e-10);
		const VertexVector k = whole(model), u = dense.factor(k);
		EXPECT_LT(relativeDifference(model.factor(), u, dense.area), 1e-7);
		const double distortion = 2.0 * std::sqrt(dense.area.dot(u.cwiseProduct(u)));
		EXPECT_GT(distortion, 0.01);
		EXPECT_NEAR(model.distortion(), distortion, 1e-6 * distortion);
		EXPECT_NEAR(model.exactDistortion(), distortion, 1e-6 * distortion);
		EXPECT_NEAR(0.25 * distortion * distortion, model.energy(), 1e-5 * model.energy());

		const auto expectField = [&](const VertexVector& phi, const VertexVector& curvature) {
			const VertexVector wanted = dense.gradient(dense.factor(curvature));
			EXPECT_LT(relativeDifference(phi, wanted, dense.area), 1e-6);
		};
		expectField(model.gradient(), k);
		// All cones alike, and what is left spread by area.
		const double share = total / 7;
		VertexVector shares = (total - 5 * share) * dense.area;
		for (const Vertex v : kFive)
			shares[v] += share;
		expectField(model.gradientAt(Eigen::VectorXd::Constant(5, share)), shares);
		for (int i = 0; i < 5; ++i) { // the curvature of one cone spread by area
			VertexVector others = k + model.curvature(i) * dense.area;
			others[model.vertex(i)] -= model.curvature(i);
			expectField(model.gradient() - model.curvature(i) * model.field(i), others);
		}
	}
}

/// Of an open surface there is no constant: cones appear and go.
TEST(ConeModel, TheGradientIsTheDerivativeOfHalfTheEnergy)
{
	LinearCase open = closed(0);
	open.mesh = withoutStars(open.mesh, {0});
	Linearised linear(open);
	ConeModel model(linear.flow, linear.total());
	EXPECT_FALSE(model.hasFixedSum());
	EXPECT_EQ(model.minSize(), 0);
	const VertexVector before = model.gradient();
	const double energy = model.energy();
	int count = 0;
	for (const Vertex v : before.indices()) {
		if (linear.surface.topology.boundary[v])
			continue;
		model.append({v});
		model.fit();
		// The energy is E(0) + 2 phi k + G k^2, the least of which is at k = -phi / G.
		if (model.curvature(0) < kBelowBound) {
			EXPECT_NEAR(model.energy(), energy + before[v] * model.curvature(0), 1e-9 * energy);
			++count;
		}
		model.remove(0);
		model.fit();
		EXPECT_NEAR(model.energy(), energy, 1e-12 * energy);
		EXPECT_FALSE(model.isCone(v));
	}
	EXPECT_GT(count, 5);
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
		for (int trial = 0; trial < 20; ++trial) {
			std::vector<Vertex> cones = linear.verticesInside(5 + random.index(8), random);
			const Vertex last = cones.back();
			cones.pop_back();
			ConeModel model = fitted(linear, cones);
			// Not only from the beginning: from the bounds that were reached before.
			model.append({last});
			model.remove(0);
			model.fit();
			if (model.hasFixedSum()) {
				EXPECT_NEAR(model.curvatures().sum(), model.total(), 1e-10);
			}
			const VertexVector& phi = model.gradient();
			double level = 0.0;
			for (int i = 0; model.hasFixedSum() && i < model.size(); ++i)
				if (model.curvature(i) < kMaxConeCurvature)
					level = phi[model.vertex(i)];
			const double size = phi.lpNorm<Eigen::Infinity>();
			for (int i = 0; i < model.size(); ++i) {
				const double slope = phi[model.vertex(i)] - level;
				EXPECT_LE(model.curvature(i), kMaxConeCurvature);
				EXPECT_LT(slope, 1e-9 * size);
				if (model.curvature(i) < kMaxConeCurvature) {
					EXPECT_GT(slope, -1e-9 * size);
				}
				else
					++held;
			}
		}
	}
	EXPECT_GT(held, 20);
	// A sphere needs three cones: two carry what they can.
	Linearised linear(closed(0));
	ConeModel few = fitted(linear, {Vertex(3), Vertex(40)});
	EXPECT_EQ(few.curvatures(), Eigen::VectorXd::Constant(2, kMaxConeCurvature));
	few.append({Vertex(17), Vertex(29)});
	few.fit();
	EXPECT_NEAR(few.curvatures().sum(), 4 * kPi, 1e-12);
}

/// The rise of the lowest energy without a cone, which need() has from one matrix, by fits: with others at
/// their bound, need() is no more than that.
TEST(ConeModel, NeedIsByHowMuchTheEnergyRises)
{
	Random random(775);
	int held = 0, alone = 0;
	for (const LinearCase& c : cases()) {
		SCOPED_TRACE(c.name);
		Linearised linear(c);
		for (int trial = 0; trial < 60; ++trial) {
			ConeModel model = fitted(linear, linear.verticesInside(5 + random.index(8), random));
			const double before = model.energy();
			const Eigen::VectorXd k = model.curvatures();
			const auto isHeld = [](double x) { return x == kMaxConeCurvature; };
			for (int i = 0; i < model.size(); ++i) {
				const double need = model.need(i);
				const VertexVector gradient = model.gradientWithout(i);
				bool isAlone = true; // none of the others is at its bound, before or after
				double rise = 0.0, change = 0.0;
				model.tryWithout(i, [&] {
					rise = model.energy() - before;
					const Eigen::VectorXd& after = model.curvatures();
					isAlone = std::none_of(after.begin(), after.end(), isHeld) &&
							  std::count_if(k.begin(), k.end(), isHeld) == isHeld(k[i]);
					change = relativeDifference(gradient, model.gradient(), model.area());
					return false;
				});
				EXPECT_LT(need, rise + 1e-9 * before);
				if (isAlone) {
					EXPECT_NEAR(need, rise, 1e-9 * (rise + before));
					EXPECT_TRUE(isHeld(k[i]) || change < 1e-8) << change;
				}
				held += isHeld(k[i]);
				alone += isAlone;
			}
		}
	}
	EXPECT_GT(held, 20);
	EXPECT_GT(alone, 100);
}

/// Cones that no digit of the energy tells apart share what one of them would have.
TEST(ConeModel, TwinsAreFittedAsOneCone)
{
	LinearCase c = cases()[0];
	// One more vertex, very near to another one, in the middle of a triangle.
	const Triangle t = c.mesh.triangles[10];
	const auto place = [&](std::size_t k) { return c.mesh.positions[at(t[k])]; };
	const int twin = static_cast<int>(c.mesh.positions.size());
	c.mesh.positions.push_back(place(0) + 1e-9 * (place(1) - place(0) + place(2) - place(0)));
	c.mesh.triangles[10] = {t[0], t[1], twin};
	c.mesh.triangles.push_back({t[1], t[2], twin});
	c.mesh.triangles.push_back({t[2], t[0], twin});
	Linearised linear(c);
	Random random(774);
	std::vector<Vertex> cones;
	for (const Vertex v : linear.verticesInside(6, random))
		if (v != Vertex(t[0]) && v != Vertex(twin))
			cones.push_back(v);
	cones.push_back(Vertex(t[0]));
	const ConeModel one = fitted(linear, cones);
	cones.push_back(Vertex(twin));
	const ConeModel both = fitted(linear, cones);
	EXPECT_NEAR(both.energy(), one.energy(), 1e-4 * one.energy());
	const int last = one.size() - 1;
	EXPECT_NEAR(both.curvature(last) + both.curvature(last + 1), one.curvature(last), 1e-3);
	for (int i = 0; i < last; ++i)
		EXPECT_NEAR(both.curvature(i), one.curvature(i), 1e-3);
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
			std::vector<Vertex> cones = linear.verticesInside(5 + random.index(3), random);
			const Vertex to = cones.back();
			cones.pop_back();
			ConeModel model = fitted(linear, cones);
			const double before = model.energy(), wanted = random.real(0.5, 1.0) * before;
			cones[2] = to;
			const double after = fitted(linear, cones).energy();
			if (std::abs(after - wanted) < 1e-6 * before)
				continue;
			held += model.curvatures().maxCoeff() == kMaxConeCurvature;
			const bool hasMoved = model.tryMove(2, {to}, [&](Vertex, double energy) {
				EXPECT_LT(energy, after + 1e-9 * (1.0 + before)); // bounds, in the end itself
				return energy < wanted;
			});
			EXPECT_EQ(hasMoved, after < wanted);
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
