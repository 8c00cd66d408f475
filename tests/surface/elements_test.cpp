// SPDX-License-Identifier: GPL-3.0-or-later
#include <ricci/surface/elements.h>
#include <ricci/surface/sides.h>
#include <ricci/surface/triangulation.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <type_traits>
#include <utility>

namespace ricci::testing {
namespace {

// What must not compile: an index of one kind, or a plain number, where another kind is meant.

/// Whether a \p From can be handed over where a \p To is expected, or be made into one by name.
template<class From, class To>
constexpr bool standsFor = std::is_convertible_v<From, To> || std::is_constructible_v<To, From> ||
						   std::is_assignable_v<To&, From>;

template<class A, class B>
constexpr bool areComparable =
	std::is_invocable_v<std::equal_to<>, A, B> || std::is_invocable_v<std::not_equal_to<>, A, B> ||
	std::is_invocable_v<std::less<>, A, B> || std::is_invocable_v<std::greater<>, A, B>;

template<class A, class B>
constexpr bool areStrangers =
	!standsFor<A, B> && !standsFor<B, A> && !areComparable<A, B> && !areComparable<B, A>;

static_assert(areStrangers<Halfedge, Edge> && areStrangers<Halfedge, Vertex>);
static_assert(areStrangers<Halfedge, Face> && areStrangers<Edge, Vertex>);
static_assert(areStrangers<Edge, Face> && areStrangers<Vertex, Face>);

/// Numbers become indices by name only, and the other way round by number() only.
template<class I>
constexpr bool isNoNumber =
	std::is_constructible_v<I, int>&& std::is_constructible_v<I, std::size_t> &&
	!std::is_constructible_v<I, double> && !std::is_convertible_v<int, I> &&
	!std::is_assignable_v<I&, int> && !standsFor<I, int> && !standsFor<I, std::size_t> &&
	!standsFor<I, bool> && !standsFor<I, double> && !areComparable<I, int> &&
	!areComparable<int, I> && !std::is_invocable_v<std::plus<>, I, int> &&
	!std::is_invocable_v<std::multiplies<>, int, I> && !std::is_invocable_v<std::modulus<>, I, int>;

static_assert(isNoNumber<Halfedge> && isNoNumber<Edge> && isNoNumber<Vertex> && isNoNumber<Face>);

struct At
{
	template<class Array, class I>
	auto operator()(Array&& array, I i) const -> decltype(array[i]);
};

/// Whether \p Function, called with \p First, takes indices of the kinds \p Own and no others.
template<class Function, class First, class... Own>
constexpr bool takesOnly =
	((std::is_invocable_v<Function, First, Vertex> == (std::is_same_v<Own, Vertex> || ...))) &&
	std::is_invocable_v<Function, First, Edge> == (std::is_same_v<Own, Edge> || ...) &&
	std::is_invocable_v<Function, First, Halfedge> == (std::is_same_v<Own, Halfedge> || ...) &&
	std::is_invocable_v<Function, First, Face> == (std::is_same_v<Own, Face> || ...) &&
	std::is_invocable_v<Function, First, int> == (std::is_same_v<Own, int> || ...);

template<class I>
constexpr bool hasArraysOfItsOwn =
	takesOnly<At, IndexedArray<I, double>&, I>&& takesOnly<At, const IndexedArray<I, double>&, I>;

static_assert(hasArraysOfItsOwn<Vertex> && hasArraysOfItsOwn<Edge>);
static_assert(hasArraysOfItsOwn<Halfedge> && hasArraysOfItsOwn<Face>);
static_assert(takesOnly<At, Array<double>&, int>);
static_assert(takesOnly<At, VertexVector&, Vertex> && takesOnly<At, const VertexVector&, Vertex>);

// Arrays of different kinds, and plain vectors, are no substitutes for each other.
static_assert(!standsFor<EdgeArray<double>, HalfedgeArray<double>>);
static_assert(!standsFor<EdgeArray<double>, VertexArray<double>>);
static_assert(!standsFor<EdgeArray<double>, std::vector<double>>);
static_assert(!std::is_convertible_v<std::vector<double>, EdgeArray<double>>);
static_assert(!std::is_convertible_v<int, EdgeArray<double>>);

/// Overloaded functions have no single type.
struct HalfedgeOf
{
	template<class I>
	auto operator()(const Triangulation& t, I i) const -> decltype(t.halfedge(i));
};
struct VerticesOf
{
	template<class I>
	auto operator()(const Triangulation& t, I i) const -> decltype(t.vertices(i));
};

template<class Function, class... Own>
constexpr bool ofTriangulation = takesOnly<Function, Triangulation&, Own...>;

static_assert(ofTriangulation<decltype(&Triangulation::next), Halfedge>);
static_assert(ofTriangulation<decltype(&Triangulation::origin), Halfedge>);
static_assert(ofTriangulation<decltype(&Triangulation::face), Halfedge>);
static_assert(ofTriangulation<decltype(&Triangulation::isExterior), Halfedge>);
static_assert(ofTriangulation<decltype(&Triangulation::loop), Halfedge>);
static_assert(ofTriangulation<decltype(&Triangulation::isFlippable), Edge>);
static_assert(ofTriangulation<decltype(&Triangulation::isBoundary), Edge>);
static_assert(ofTriangulation<decltype(&Triangulation::quad), Edge>);
static_assert(ofTriangulation<decltype(&Triangulation::flip), Edge>);
static_assert(ofTriangulation<decltype(&Triangulation::around), Vertex>);
static_assert(ofTriangulation<HalfedgeOf, Face, Vertex> && ofTriangulation<VerticesOf, Face>);

// An index costs what its number costs.
static_assert(sizeof(Halfedge) == sizeof(int) && std::is_trivially_copyable_v<Halfedge>);
static_assert(sizeof(Edge) == sizeof(int) && std::is_trivially_copyable_v<Edge>);

// The numbering is known at compile time.
static_assert(Halfedge(6).twin() == Halfedge(7) && Halfedge(7).twin() == Halfedge(6));
static_assert(Halfedge(6).edge() == Edge(3) && Halfedge(7).edge() == Edge(3));
static_assert(Halfedge(6).isFirst() && !Halfedge(7).isFirst());
static_assert(Edge(3).halfedge() == Halfedge(6));
static_assert(Vertex(2).number() == 2 && positionOf(Vertex(2)) == 2u && positionOf(2) == 2u);
static_assert(Vertex(0).isValid() && !Vertex().isValid() && Vertex() != Vertex(0));
static_assert(!Halfedge().edge().isValid() && !Edge().halfedge().isValid() && Edge() == Edge(-1));

TEST(Corner, StepsRoundItsTriangle)
{
	for (const int f : {0, 1, 7}) {
		EXPECT_EQ(Corner(f, 0).number(), 3 * f);
		for (const Corner c : cornersOf(f)) {
			EXPECT_EQ(c.face(), f);
			EXPECT_EQ(c.next().face(), f);
			EXPECT_EQ(c.next().index(), (c.index() + 1) % 3);
			EXPECT_EQ(c.next().previous(), c);
			EXPECT_EQ(c.next().next(), c.previous());
		}
	}
	Array<Triangle> triangles{{4, 5, 6}, {7, 8, 9}};
	EXPECT_EQ(triangles[Corner(1, 2)], 9);
	triangles[Corner(0, 1)] = 0;
	EXPECT_EQ(triangles[0][1], 0);
}

TEST(Sides, AreFoundByEdgeAndJoinedInPairsThatRunOppositeWays)
{
	// 12 has three sides; 23 has two that run opposite ways, 34 two that run the same way.
	const std::vector<Triangle> triangles{{1, 2, 0}, {3, 2, 1}, {1, 2, 9}, {2, 3, 4}, {3, 4, 5}};
	const Sides sides(triangles);
	using Ends = std::pair<int, int>;
	std::vector<Ends> edges;
	int count = 0, joined = 0;
	sides.forEdges([&](const auto& edge) {
		const auto endsOf = [&](Corner c) -> Ends {
			const Triangle& t = triangles[positionOf(c.face())];
			return std::minmax({t[c.index()], t[c.next().index()]});
		};
		edges.push_back(endsOf(*edge.begin()));
		EXPECT_TRUE(std::is_sorted(edge.begin(), edge.end()));
		for (const Corner c : edge) {
			EXPECT_EQ(endsOf(c), edges.back());
			joined += sides.across(c).isValid();
			++count;
		}
		if (edges.back() == Ends{1, 2}) {
			EXPECT_EQ(
				std::vector<Corner>(edge.begin(), edge.end()),
				(std::vector<Corner>{Corner(0, 0), Corner(1, 1), Corner(2, 0)}));
		}
	});
	EXPECT_EQ(
		edges,
		(std::vector<Ends>{
			{0, 1},
			{0, 2},
			{1, 2},
			{1, 3},
			{1, 9},
			{2, 3},
			{2, 4},
			{2, 9},
			{3, 4},
			{3, 5},
			{4, 5}}));
	EXPECT_EQ(count, 15);
	EXPECT_EQ(joined, 2);
	EXPECT_EQ(sides.across(Corner(1, 0)), Corner(3, 0));
	EXPECT_EQ(sides.across(Corner(3, 0)), Corner(1, 0));
	Sides({}).forEdges([](const auto&) { ADD_FAILURE(); });
}

} // namespace
} // namespace ricci::testing
