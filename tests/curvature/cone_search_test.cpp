// SPDX-License-Identifier: GPL-3.0-or-later
#include "linearised.h"

#include "support/random_surface.h"
#include "support/shapes.h"

#include <ricci/base/numbers.h>
#include <ricci/curvature/cone_search.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

namespace ricci::testing {
namespace {

/// The search's parts on one surface.
struct Search
{
	Linearised linear;
	ConeSites sites;
	ConeModel model;

	Search(const SurfaceMesh& mesh, int genus, int vertices = -1) :
			linear({"", mesh, ConeBoundary::Fixed}), sites(linear.surface, vertices),
			model(linear.flow, 2 * kPi * (2 - 2 * genus))
	{
	}

	double sum() const
	{
		double s = 0.0;
		for (int i = 0; i < model.size(); ++i)
			s += model.curvature(i);
		return s;
	}

	std::set<Vertex> cones() const
	{
		std::set<Vertex> vertices;
		for (int i = 0; i < model.size(); ++i)
			vertices.insert(model.vertex(i));
		return vertices;
	}
};

SurfaceMesh shakenSlab(int genus)
{
	Random random(910);
	return shaken(perforatedSlab(genus, 2), 0.05, random);
}

/// The eight corners of a box.
std::vector<Vertex> corners(const Search& search)
{
	std::vector<Vertex> found;
	const VertexVector& own = search.linear.flow.curvature();
	for (const Vertex v : own.indices())
		if (own[v] > 1.0)
			found.push_back(v);
	return found;
}

TEST(ConeSearch, StartsWithTheFewestConesThatCarryTheTotal)
{
	for (int genus = 0; genus <= 2; ++genus) {
		Search search(shakenSlab(genus), genus);
		startCones(search.model, search.sites);
		EXPECT_EQ(search.model.size(), search.model.minSize());
		EXPECT_EQ(static_cast<int>(search.cones().size()), search.model.size());
		EXPECT_NEAR(search.sum(), 2 * kPi * (2 - 2 * genus), 1e-11);
		for (int i = 0; i < search.model.size(); ++i)
			EXPECT_LE(search.model.curvature(i), 1.5 * kPi);
	}
}

/// A negative total goes where it lowers the energy more than at any other vertex.
TEST(ConeSearch, TheFirstOfOneConeIsTheBestOfAll)
{
	Search search(shakenSlab(2), 2);
	startCones(search.model, search.sites);
	ASSERT_EQ(search.model.size(), 1);
	const double energy = search.model.energy();
	Search other(shakenSlab(2), 2);
	std::vector<double> energies;
	for (const Vertex v : other.model.area().indices()) {
		other.model.append({v});
		other.model.fit();
		energies.push_back(other.model.energy());
		other.model.remove(0);
	}
	// The gradient at equal shares is what decides: few vertices are better in the end.
	int better = 0;
	for (const double e : energies)
		better += e < energy;
	EXPECT_LT(better, static_cast<int>(energies.size()) / 4);
}

TEST(ConeSearch, EachConeMoreLowersTheEnergyUntilNoVertexIsLeft)
{
	for (int genus : {0, 1, 2}) {
		Search search(shakenSlab(genus), genus, 12);
		startCones(search.model, search.sites);
		double energy = search.model.energy();
		while (search.model.size() < 12) {
			ASSERT_TRUE(addCones(search.model, search.sites));
			EXPECT_LE(search.model.energy(), energy * (1 + 1e-9));
			energy = search.model.energy();
			EXPECT_NEAR(search.sum(), 2 * kPi * (2 - 2 * genus), 1e-10);
		}
		EXPECT_FALSE(addCones(search.model, search.sites));
		EXPECT_EQ(search.cones().size(), 12u);
		EXPECT_LT(search.cones().rbegin()->number(), 12);
	}
}

/// After a fit the gradient is the same at all cones below their bound. Curvature that moves from there
/// to another vertex changes the energy by the difference of the gradient.
TEST(ConeSearch, TheNextConeIsWhereTheGradientDiffersMost)
{
	for (int genus : {0, 2}) {
		Search search(shakenSlab(genus), genus);
		startCones(search.model, search.sites);
		for (int count = search.model.size(); count < 9; ++count) {
			const VertexVector phi = search.model.gradient();
			int free = 0; // a cone below its bound
			while (search.model.curvature(free) > 4.7)
				ASSERT_LT(++free, count);
			const double level = phi[search.model.vertex(free)];
			double most = 0.0;
			for (const Vertex v : phi.indices())
				if (!search.model.isCone(v))
					most = std::max(most, std::abs(phi[v] - level));
			ASSERT_TRUE(addCones(search.model, search.sites));
			const Vertex added = search.model.vertex(count);
			EXPECT_NEAR(std::abs(phi[added] - level), most, 1e-9 * most);
		}
	}
}

/// With seven of the eight corners of a box as cones, the eighth takes the distortion away.
TEST(ConeSearch, FindsTheCornerOfABoxThatIsMissing)
{
	for (std::size_t missing = 0; missing < 8; ++missing) {
		Search search(perforatedSlab(0, 3), 0);
		std::vector<Vertex> all = corners(search);
		ASSERT_EQ(all.size(), 8u);
		const Vertex last = all[missing];
		all.erase(all.begin() + static_cast<std::ptrdiff_t>(missing));
		search.model.append(all);
		search.model.fit();
		EXPECT_GT(search.model.distortion(), 0.01);
		ASSERT_TRUE(addCones(search.model, search.sites));
		relocateCones(search.model, search.sites);
		EXPECT_TRUE(search.model.isCone(last));
		EXPECT_LT(search.model.exactDistortion(), 1e-9);
	}
}

TEST(ConeSearch, ConesMoveWhereTheEnergyIsLower)
{
	for (int genus : {0, 1, 2}) {
		Search search(shakenSlab(genus), genus);
		search.model.append(
			{Vertex(0), Vertex(1), Vertex(2), Vertex(3), Vertex(4)}); // side by side
		search.model.fit();
		const double before = search.model.energy();
		relocateCones(search.model, search.sites);
		EXPECT_LT(search.model.energy(), 0.9 * before);
		EXPECT_EQ(search.cones().size(), 5u);
		EXPECT_NEAR(search.sum(), 2 * kPi * (2 - 2 * genus), 1e-10);
		// What is left moves no more, but for the end of the rounds.
		const double after = search.model.energy();
		relocateCones(search.model, search.sites);
		EXPECT_LE(search.model.energy(), after);
	}
}

/// From one place they move until none gains where the field of the others is best for it.
TEST(ConeSearch, ConesMoveToFarPlaces)
{
	for (const int genus : {0, 1, 2, 3})
		for (const int from : {0, 20, 40}) {
			Search search(shakenSlab(genus), genus);
			ConeModel& model = search.model;
			std::vector<Vertex> start;
			for (int i = 0; i < 8; ++i)
				start.emplace_back(from + i);
			model.append(start);
			model.fit();
			relocateCones(model, search.sites, 100);
			for (int i = 0; i < model.size(); ++i) {
				const double own = model.curvature(i), present = model.energy();
				if (std::abs(own) <= 0.3) // these are placed anew
					continue;
				const VertexVector others = own * (model.gradient() - own * model.field(i));
				Vertex best = model.vertex(i);
				for (const Vertex v : others.indices())
					if (!model.isCone(v) && others[v] < others[best])
						best = v;
				if (others[model.vertex(i)] - others[best] <= 0.0025 * present)
					continue;
				EXPECT_FALSE(model.tryMove(
					i, {best}, [&](Vertex, double energy) { return energy < 0.995 * present; }))
					<< genus << " " << from;
			}
		}
}

/// Cones in flat places of a box carry nothing.
TEST(ConeSearch, ConesThatCarryNothingAreTakenOut)
{
	for (const bool drops : {false, true}) {
		Search search(perforatedSlab(0, 3), 0);
		const std::vector<Vertex> all = corners(search);
		search.model.append(all);
		for (const Vertex v : {Vertex(20), Vertex(33), Vertex(41)})
			if (!search.model.isCone(v))
				search.model.append({v});
		search.model.fit();
		ASSERT_GT(search.model.size(), 9);
		if (drops)
			dropCones(search.model, search.sites, 1e-5);
		else
			removeWeakCones(search.model);
		EXPECT_EQ(search.cones(), std::set<Vertex>(all.begin(), all.end()));
		EXPECT_LT(search.model.exactDistortion(), 1e-9);
	}
}

TEST(ConeSearch, NoMoreConesAreDroppedThanTheDistortionAllows)
{
	Search search(shakenSlab(0), 0);
	startCones(search.model, search.sites);
	while (search.model.size() < 14)
		ASSERT_TRUE(addCones(search.model, search.sites));
	const double wanted = 2.0 * search.model.distortion();
	dropCones(search.model, search.sites, wanted);
	EXPECT_LT(search.model.size(), 14);
	EXPECT_GE(search.model.size(), search.model.minSize());
	EXPECT_LE(search.model.distortion(), wanted);
	// Where anything will do, as few are left as carry the total.
	dropCones(search.model, search.sites, 1e9);
	EXPECT_EQ(search.model.size(), 3);
}

} // namespace
} // namespace ricci::testing
