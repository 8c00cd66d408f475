// SPDX-License-Identifier: GPL-3.0-or-later
// Where cones may lie, the tree of their seams, and the steps of the search for them.
#include "linearised.h"

#include <ricci/base/graphs.h>
#include <ricci/cones/cone_model.h>
#include <ricci/metric/area.h>

#include <set>
#include <tuple>

namespace ricci::testing {
namespace {

using Distances = std::vector<std::vector<double>>;

/// Length of the minimum spanning tree: edges by length, each that joins two parts, by Kruskal's algorithm.
/// \param distance [i][j] of the vertices
double treeLength(const Distances& distance)
{
	std::vector<std::tuple<double, std::size_t, std::size_t>> edges;
	std::vector<std::size_t> part;
	for (std::size_t i = 0; i < distance.size(); ++i) {
		part.push_back(i);
		for (std::size_t j = 0; j < i; ++j)
			edges.emplace_back(distance[i][j], i, j);
	}
	std::sort(edges.begin(), edges.end());
	double length = 0.0;
	for (const auto& [d, i, j] : edges)
		if (part[i] != part[j]) {
			length += d;
			std::replace(part.begin(), part.end(), std::size_t(part[i]), std::size_t(part[j]));
		}
	return length;
}

SurfaceMesh slab(int genus, int subdivision = 2)
{
	Random random(910);
	return shaken(perforatedSlab(genus, subdivision), 0.05, random);
}

/// The search's parts on one surface.
struct Search
{
	Linearised linear;
	ConeSites sites;
	ConeModel model;

	explicit Search(const SurfaceMesh& mesh, int vertices = -1, double energyFactor = 1.0) :
			linear({"", mesh}), sites(linear.surface, vertices),
			model(linear.flow, linear.total(), energyFactor)
	{
	}

	Search& with(const std::vector<Vertex>& cones)
	{
		model.append(cones);
		model.fit();
		return *this;
	}
	/// Five vertices, \p step apart.
	std::vector<Vertex> places(int step) const
	{
		std::vector<Vertex> vertices;
		for (int i = 0; i < 5; ++i)
			vertices.emplace_back(i * step % linear.flow.vertexCount());
		return vertices;
	}
	std::set<Vertex> cones() const
	{
		EXPECT_TRUE(
			!model.hasFixedSum() || std::abs(model.curvatures().sum() - model.total()) < 1e-10);
		return {model.vertices().begin(), model.vertices().end()};
	}
};

/// Each cone in turn that is nearest to what is there; taken out, it leaves the tree as if it had never been.
TEST(SeamTree, TakesTheNearestConesFirstAndForgetsThem)
{
	for (const int genus : {0, 1, 2}) {
		const Search search(slab(genus, 3));
		EXPECT_EQ(search.sites.cutLength() > 0.0, genus > 0);
		std::vector<Vertex> cones = search.places(17), left = cones;
		const auto expectSame = [&](const SeamTree& a, const SeamTree& b) {
			EXPECT_NEAR(a.length(), b.length(), 1e-12);
			for (const Vertex v : search.linear.surface.triangulation.vertices())
				EXPECT_NEAR(a.distance(v), b.distance(v), 1e-12);
		};
		SeamTree wanted(search.sites);
		while (!left.empty()) {
			const auto nearest =
				std::min_element(left.begin(), left.end(), [&](Vertex a, Vertex b) {
					return wanted.distance(a) < wanted.distance(b);
				});
			wanted.add(*nearest);
			EXPECT_EQ(wanted.distance(*nearest), 0.0);
			left.erase(nearest);
		}
		const SeamTree tree(search.sites, cones);
		expectSame(tree, wanted);
		for (const Vertex v : cones)
			EXPECT_NEAR(tree.ownLength(v), wanted.ownLength(v), 1e-12);
		for (std::size_t out = 1; out < cones.size(); ++out) {
			SeamTree without(search.sites);
			for (const Vertex v : cones)
				if (v != cones[out])
					without.add(v);
			SeamTree other = without;
			const double longer = without.distance(cones[out]);
			other.add(cones[out]);
			EXPECT_NEAR(other.length(), without.length() + longer, 1e-12);
			EXPECT_NEAR(other.ownLength(cones[out]), longer, 1e-12);
			EXPECT_NEAR(other.remove(cones[out]), longer, 1e-12);
			expectSame(other, without);
		}
	}
}

/// The seams without cones open a surface to a disk: 2 g + b - 1 loops or paths are in them.
TEST(ConeSites, SeamsWithoutConesBeginOnTheBoundary)
{
	const Search search(revolved({{1.0, 0.0}, {1.0, 0.5}, {1.0, 1.0}, {1.0, 1.5}}, 16));
	const EmbeddedSurface& cylinder = search.linear.surface;
	const double area = euclideanArea(cylinder.triangulation, cylinder.lengths);
	EXPECT_NEAR(search.sites.cutLength(), 1.5 / std::sqrt(area), 1e-9);
	for (const Vertex v : cylinder.triangulation.vertices())
		EXPECT_TRUE(!cylinder.topology.boundary[v] || search.sites.toCut()[v] == 0.0);
}

/// On a torus they are the shortest loop of each kind, round the tube and round the hole.
TEST(ConeSites, SeamsWithoutConesAreShort)
{
	const int around = 24, across = 12;
	const Search search(torus(3.0, 1.0, around, across));
	const EmbeddedSurface& surface = search.linear.surface;
	const double area = euclideanArea(surface.triangulation, surface.lengths);
	const double tube = 2 * across * std::sin(kPi / across);
	const double hole = 2 * around * 2.0 * std::sin(kPi / around);
	EXPECT_NEAR(search.sites.cutLength(), (tube + hole) / std::sqrt(area), 1e-9);
}

TEST(ConeSites, ChosenOnesKeepTheirSpanningTree)
{
	Random random(811);
	const Search search(slab(2, 6));
	VertexArray<Vertex> chosen;
	for (int v = 3; v < search.linear.flow.vertexCount(); v += 1 + random.index(40))
		chosen.push_back(Vertex(v));
	const ConeSites coarse(search.sites, chosen);
	EXPECT_EQ(coarse.count(), chosen.size());
	const auto distancesOf = [&](const ConeSites& sites, const auto& placeOf) {
		Distances d;
		for (const Vertex i : chosen.indices()) {
			const auto way = [&](Vertex from, const auto& visit) {
				for (const auto& [to, length] : sites.ways(from))
					visit(to, length, from);
			};
			const auto distance =
				shortestPaths<Vertex, Vertex>(sites.toCut().size(), {placeOf(i)}, way).distances();
			d.emplace_back();
			for (const Vertex j : chosen.indices())
				d.back().push_back(distance[placeOf(j)]);
		}
		return d;
	};
	const Distances exact = distancesOf(search.sites, [&](Vertex i) { return chosen[i]; });
	const Distances longer = distancesOf(coarse, [](Vertex i) { return i; });
	EXPECT_NEAR(treeLength(longer) / treeLength(exact), 1.0, 1e-12);
	for (std::size_t i = 0; i < exact.size(); ++i)
		for (std::size_t j = 0; j < exact.size(); ++j)
			EXPECT_GE(longer[i][j], exact[i][j] - 1e-12);
}

double cost(const ConeModel& model, const SeamTree& tree)
{
	return model.priceOf(model.energy()) + kSeamPrice * tree.length();
}

/// At first as few as carry the total; a negative one goes where it lowers the energy more than at most
/// vertices. After a fit the gradient is the same at all cones below their bound: curvature that moves from
/// there to another vertex changes the energy by the difference. Each cone more lies where that is largest.
TEST(ConeSearch, TheNextConeIsWhereTheGradientDiffersMost)
{
	for (const int genus : {0, 1, 2}) {
		Search search(slab(genus), 12);
		ConeModel& model = search.model;
		startCones(model, search.sites);
		EXPECT_EQ(model.size(), model.minSize());
		double energy = model.energy();
		if (genus == 2) {
			Search other(slab(genus));
			int better = 0;
			for (int v = 0; v < 12; ++v) {
				better += other.with({Vertex(v)}).model.energy() < energy;
				other.model.remove(0);
			}
			EXPECT_LT(better, 3);
		}
		while (model.size() < 12) {
			const VertexVector phi = model.gradient();
			double level = model.area().dot(phi), most = 0.0;
			for (int i = 0; i < model.size(); ++i)
				if (model.curvature(i) < 4.7) // a cone below its bound
					level = phi[model.vertex(i)];
			for (int v = 0; v < 12; ++v)
				if (!model.isCone(Vertex(v)))
					most = std::max(most, std::abs(phi[Vertex(v)] - level));
			ASSERT_TRUE(addCones(model, search.sites));
			const Vertex added = model.vertex(model.size() - 1);
			EXPECT_NEAR(std::abs(phi[added] - level), most, 1e-9 * most);
			EXPECT_LE(model.energy(), energy * (1 + 1e-9));
			energy = model.energy();
			EXPECT_EQ(static_cast<int>(search.cones().size()), model.size());
		}
		EXPECT_FALSE(addCones(model, search.sites)); // no vertex is left
		EXPECT_LT(search.cones().rbegin()->number(), 12);
	}
}

/// The steps of dropCostlyCones(), with what a cone saves from a fit without it.
/// \param dropped receives the number of each cone at its turn
std::vector<Vertex> withoutCostlyCones(ConeModel& model, SeamTree& tree, std::vector<int>& dropped)
{
	while (model.size() > model.minSize()) {
		const double present = model.energy();
		std::vector<double> loss;
		for (int i = 0; i < model.size(); ++i)
			model.tryWithout(i, [&] {
				loss.push_back(model.priceOf(present - model.energy()));
				return false;
			});
		for (int i = 0; i < model.size(); ++i)
			loss[at(i)] += kConePrice + kSeamPrice * tree.ownLength(model.vertex(i));
		const auto dearest = std::max_element(loss.begin(), loss.end());
		if (*dearest <= 0.0)
			break;
		dropped.push_back(static_cast<int>(dearest - loss.begin()));
		tree.remove(model.vertex(dropped.back()));
		model.remove(dropped.back());
		model.fit();
	}
	return model.vertices();
}

/// Whatever number it has: every cone is the first one once.
TEST(ConeSearch, TheConeWhosePriceExceedsMostWhatItSavesIsDroppedFirst)
{
	std::vector<int> dropped;
	int kept = 0;
	for (const int genus : {0, 1, 2}) {
		std::vector<Vertex> cones;
		for (int i = 0; i < 24; ++i)
			cones.emplace_back(2 * i);
		for (std::size_t turn = 0; turn < cones.size(); ++turn) {
			std::rotate(cones.begin(), cones.begin() + 1, cones.end());
			const double energyFactor = turn % 2 == 0 ? 1.0 : 3.0;
			Search search(slab(genus), -1, energyFactor), other(slab(genus), -1, energyFactor);
			SeamTree tree(search.sites, cones), own(other.sites, cones);
			EXPECT_TRUE(dropCostlyCones(search.with(cones).model, tree));
			EXPECT_EQ(
				search.model.vertices(), withoutCostlyCones(other.with(cones).model, own, dropped));
			EXPECT_EQ(tree.length(), own.length());
			EXPECT_FALSE(dropCostlyCones(search.model, tree)); // none is left
			kept += search.model.size() > search.model.minSize();
		}
	}
	EXPECT_GT(std::count(dropped.begin(), dropped.end(), 0), 10);
	EXPECT_GT(std::count(dropped.begin(), dropped.end(), 1), 10);
	EXPECT_GT(kept, 10);
}

/// Cones at random on needles, of which those near the tips come to their bound: where no other comes to it or leaves it
/// without one, the energy rises by what the model says.
TEST(ConeSearch, NeedsAreRisesOfTheEnergyWhileTheSameConesAreAtTheirBound)
{
	Random random(611);
	int compared = 0, held = 0,
		free = 0; // of those at their bound, and of others while some are there
	for (int turn = 0; turn < 60; ++turn) {
		const SurfaceMesh needle = stretched(sphere(24, 12), {1, 1, random.real(3.0, 12.0)});
		Search search(turn % 2 == 0 ? needle : withoutStars(needle, {0}));
		std::vector<Vertex> cones;
		for (const Vertex v : search.linear.surface.positions.indices())
			if (search.sites.isAllowed(v) && random.real(0.0, 1.0) < 0.05)
				cones.push_back(v);
		ConeModel& model = search.with(cones).model;
		if (model.size() <= model.minSize())
			continue;
		const auto bounded = [&] {
			std::set<Vertex> vertices;
			for (int i = 0; i < model.size(); ++i)
				if (model.curvature(i) > kMaxConeCurvature - 1e-9)
					vertices.insert(model.vertex(i));
			return vertices;
		};
		const Eigen::VectorXd needs = model.needs();
		const double present = model.energy();
		for (int i = 0; i < model.size(); ++i) {
			std::set<Vertex> before = bounded();
			const bool isHeld = before.erase(model.vertex(i)) > 0;
			model.tryWithout(i, [&] {
				if (bounded() == before) {
					EXPECT_NEAR(model.energy() - present, needs[i], 1e-8 * model.energy());
					++compared;
					held += isHeld;
					free += !isHeld && !before.empty();
				}
				return false;
			});
		}
	}
	EXPECT_GT(held, 5);
	EXPECT_GT(free, 20);
	EXPECT_GT(compared, held + free);
}

/// Two cones share the tip of a needle, which is more than one may have: without the other one is at its bound, and
/// the energy rises by more than it would without bounds.
TEST(ConeSearch, NoConeIsDroppedThatSavesMoreThanItsPrice)
{
	for (const double length : {2.0, 4.0, 8.0, 16.0, 32.0}) {
		const SurfaceMesh needle = // open at its foot
			withoutStars(stretched(sphere(60, 12), {1, 1, length}), {0});
		Search search(needle), other(needle);
		const VertexArray<Point3>& positions = search.linear.surface.positions;
		std::vector<Vertex> cones;
		for (const Vertex v : positions.indices())
			cones.push_back(v);
		std::stable_sort(cones.begin(), cones.end(), [&](Vertex a, Vertex b) {
			return positions[b][2] < positions[a][2];
		});
		cones.resize(2);
		ConeModel& model = search.with(cones).model;
		EXPECT_GT(model.curvatures().sum(), kMaxConeCurvature);
		SeamTree tree(search.sites, cones), own(other.sites, cones);
		const double before = cost(model, tree) + kConePrice * model.size();
		std::vector<int> dropped;
		dropCostlyCones(model, tree);
		EXPECT_LE(cost(model, tree) + kConePrice * model.size(), before * (1 + 1e-12));
		EXPECT_EQ(model.vertices(), withoutCostlyCones(other.with(cones).model, own, dropped));
	}
}

} // namespace
} // namespace ricci::testing
