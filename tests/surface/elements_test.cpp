// SPDX-License-Identifier: GPL-3.0-or-later
#include <ricci/surface/elements.h>
#include <ricci/surface/triangulation.h>

#include <gtest/gtest.h>

#include <functional>
#include <type_traits>
#include <utility>
#include <vector>

namespace ricci::testing {
namespace {

// What must not compile: an index of one kind, or a plain number, where another kind is meant.

/// Whether a \p From can be handed over where a \p To is expected, or be made into one by name.
template<class From, class To>
constexpr bool standsFor = std::is_convertible_v<From, To> || std::is_constructible_v<To, From> ||
						   std::is_assignable_v<To&, From>;

template<class Array, class I, class = void>
constexpr bool isIndexable = false;
template<class Array, class I>
constexpr bool
	isIndexable<Array, I, std::void_t<decltype(std::declval<Array&>()[std::declval<I>()])>> = true;

template<class A, class B>
constexpr bool areComparable =
	std::is_invocable_v<std::equal_to<>, A, B> || std::is_invocable_v<std::not_equal_to<>, A, B> ||
	std::is_invocable_v<std::less<>, A, B> || std::is_invocable_v<std::greater<>, A, B>;

template<class A, class B>
constexpr bool areStrangers =
	!standsFor<A, B> && !standsFor<B, A> && !areComparable<A, B> && !areComparable<B, A>;

static_assert(areStrangers<Halfedge, Edge>);
static_assert(areStrangers<Halfedge, Vertex>);
static_assert(areStrangers<Halfedge, Face>);
static_assert(areStrangers<Edge, Vertex>);
static_assert(areStrangers<Edge, Face>);
static_assert(areStrangers<Vertex, Face>);

/// Numbers become indices by name only, and the other way round by number() only.
template<class I>
constexpr bool isNoNumber =
	std::is_constructible_v<I, int>&& std::is_constructible_v<I, std::size_t> &&
	!std::is_constructible_v<I, double> && !std::is_convertible_v<int, I> &&
	!std::is_assignable_v<I&, int> && !standsFor<I, int> && !standsFor<I, std::size_t> &&
	!standsFor<I, bool> && !standsFor<I, double> && !areComparable<I, int> &&
	!areComparable<int, I> && !std::is_invocable_v<std::plus<>, I, int> &&
	!std::is_invocable_v<std::multiplies<>, int, I> && !std::is_invocable_v<std::modulus<>, I, int>;

static_assert(isNoNumber<Halfedge>);
static_assert(isNoNumber<Edge>);
static_assert(isNoNumber<Vertex>);
static_assert(isNoNumber<Face>);

/// Whether arrays with one entry for each \p I take no other index.
template<class I>
constexpr bool hasArraysOfItsOwn =
	isIndexable<IndexedArray<I, double>, I>&& isIndexable<const IndexedArray<I, double>, I>&&
			isIndexable<IndexedArray<I, double>, Vertex> ==
		std::is_same_v<I, Vertex>&& isIndexable<IndexedArray<I, double>, Edge> ==
		std::is_same_v<I, Edge>&& isIndexable<IndexedArray<I, double>, Halfedge> ==
		std::is_same_v<I, Halfedge>&& isIndexable<IndexedArray<I, double>, Face> ==
		std::is_same_v<I, Face> &&
	!isIndexable<IndexedArray<I, double>, int> &&
	!isIndexable<IndexedArray<I, double>, std::size_t>;

static_assert(hasArraysOfItsOwn<Vertex>);
static_assert(hasArraysOfItsOwn<Edge>);
static_assert(hasArraysOfItsOwn<Halfedge>);
static_assert(hasArraysOfItsOwn<Face>);
static_assert(!isIndexable<EdgeArray<double>, Halfedge>);
static_assert(!isIndexable<EdgeArray<double>, int>);
static_assert(isIndexable<Array<double>, int>);
static_assert(!isIndexable<Array<double>, Edge>);

// Arrays of different kinds, and plain vectors, are no substitutes for each other.
static_assert(!standsFor<EdgeArray<double>, HalfedgeArray<double>>);
static_assert(!standsFor<EdgeArray<double>, VertexArray<double>>);
static_assert(!standsFor<EdgeArray<double>, std::vector<double>>);
static_assert(!std::is_convertible_v<std::vector<double>, EdgeArray<double>>);
static_assert(!std::is_convertible_v<int, EdgeArray<double>>);

static_assert(isIndexable<VertexVector, Vertex> && isIndexable<const VertexVector, Vertex>);
static_assert(!isIndexable<VertexVector, int> && !isIndexable<const VertexVector, int>);
static_assert(!isIndexable<VertexVector, Edge> && !isIndexable<VertexVector, Halfedge>);

// The functions of a triangulation take their own kind only.
template<class Function, class... Arguments>
constexpr bool isCallable = std::is_invocable_v<Function, const Triangulation&, Arguments...>;

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

static_assert(isCallable<decltype(&Triangulation::next), Halfedge>);
static_assert(!isCallable<decltype(&Triangulation::next), Edge>);
static_assert(!isCallable<decltype(&Triangulation::next), int>);
static_assert(isCallable<decltype(&Triangulation::origin), Halfedge>);
static_assert(!isCallable<decltype(&Triangulation::origin), Vertex>);
static_assert(isCallable<decltype(&Triangulation::face), Halfedge>);
static_assert(!isCallable<decltype(&Triangulation::face), Face>);
static_assert(isCallable<decltype(&Triangulation::isFlippable), Edge>);
static_assert(!isCallable<decltype(&Triangulation::isFlippable), Halfedge>);
static_assert(!isCallable<decltype(&Triangulation::isFlippable), int>);
static_assert(isCallable<decltype(&Triangulation::isBoundary), Edge>);
static_assert(!isCallable<decltype(&Triangulation::isBoundary), Vertex>);
static_assert(!isCallable<decltype(&Triangulation::isBoundary), Halfedge>);
static_assert(isCallable<decltype(&Triangulation::isExterior), Halfedge>);
static_assert(!isCallable<decltype(&Triangulation::isExterior), Edge>);
static_assert(isCallable<decltype(&Triangulation::around), Vertex>);
static_assert(!isCallable<decltype(&Triangulation::around), Halfedge>);
static_assert(!isCallable<decltype(&Triangulation::around), int>);
static_assert(isCallable<decltype(&Triangulation::loop), Halfedge>);
static_assert(!isCallable<decltype(&Triangulation::loop), Face>);
static_assert(isCallable<decltype(&Triangulation::quad), Edge>);
static_assert(!isCallable<decltype(&Triangulation::quad), Halfedge>);
static_assert(isCallable<HalfedgeOf, Face> && isCallable<HalfedgeOf, Vertex>);
static_assert(!isCallable<HalfedgeOf, Edge> && !isCallable<HalfedgeOf, int>);
static_assert(isCallable<VerticesOf, Face>);
static_assert(!isCallable<VerticesOf, Edge> && !isCallable<VerticesOf, int>);
static_assert(std::is_invocable_v<decltype(&Triangulation::flip), Triangulation&, Edge>);
static_assert(!std::is_invocable_v<decltype(&Triangulation::flip), Triangulation&, Halfedge>);
static_assert(!std::is_invocable_v<decltype(&Triangulation::flip), Triangulation&, int>);

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
static_assert(!Halfedge().edge().isValid() && !Edge().halfedge().isValid());

TEST(Elements, HalfedgesArePairsOfOneEdge)
{
	for (int number = 0; number < 20; ++number) {
		const Halfedge h(number);
		EXPECT_EQ(h.twin().twin(), h);
		EXPECT_NE(h.twin(), h);
		EXPECT_EQ(h.twin().edge(), h.edge());
		EXPECT_NE(h.isFirst(), h.twin().isFirst());
		EXPECT_EQ(h.isFirst() ? h : h.twin(), h.edge().halfedge());
	}
}

TEST(Elements, AreOrderedByTheirNumbers)
{
	for (int a = -1; a < 4; ++a)
		for (int b = -1; b < 4; ++b) {
			EXPECT_EQ(Edge(a) == Edge(b), a == b);
			EXPECT_EQ(Edge(a) != Edge(b), a != b);
			EXPECT_EQ(Edge(a) < Edge(b), a < b);
			EXPECT_EQ(Edge(a) > Edge(b), a > b);
			EXPECT_EQ(Edge(a) <= Edge(b), a <= b);
			EXPECT_EQ(Edge(a) >= Edge(b), a >= b);
		}
	EXPECT_EQ(Edge(), Edge(-1));
}

TEST(Elements, RangesCountUp)
{
	std::vector<int> numbers;
	for (const Face f : IndexRange<Face>(3, 7))
		numbers.push_back(f.number());
	EXPECT_EQ(numbers, (std::vector<int>{3, 4, 5, 6}));
	EXPECT_EQ(IndexRange<Face>(3, 7).size(), 4);
	for (const Face f : IndexRange<Face>(0))
		ADD_FAILURE() << f.number();
	const Triangulation t(4, {{0, 1, 2}, {0, 2, 3}});
	EXPECT_EQ(t.vertices().size(), t.vertexCount());
	EXPECT_EQ(t.edges().size(), t.edgeCount());
	EXPECT_EQ(t.faces().size(), t.faceCount());
	EXPECT_EQ(t.halfedges().size(), t.halfedgeCount());
}

TEST(Elements, ArraysHoldTheirValuesInTheOrderOfTheIndices)
{
	EdgeArray<int> array(3, 5);
	array[Edge(1)] = 7;
	array.push_back(9);
	EXPECT_EQ(array.size(), 4);
	EXPECT_EQ(array.values(), (std::vector<int>{5, 7, 5, 9}));
	EXPECT_EQ(array, EdgeArray<int>(array.values()));
	EXPECT_EQ(array, (EdgeArray<int>{5, 7, 5, 9}));
	EXPECT_NE(array, (EdgeArray<int>{5, 7, 5}));
	int sum = 0;
	for (const Edge e : array.indices())
		sum += array[e] * (e.number() + 1);
	EXPECT_EQ(sum, 5 + 14 + 15 + 36);
	array.resize(5, 1);
	EXPECT_EQ(array.back(), 1);
	array.assign(2, 8);
	EXPECT_EQ(array.values(), (std::vector<int>{8, 8}));
	array.clear();
	EXPECT_TRUE(array.empty());
}

TEST(Elements, VectorsOfTheLinearAlgebraHaveAnEntryForEachVertex)
{
	VertexVector x(3);
	for (const Vertex v : x.indices())
		x[v] = v.number() + 1;
	EXPECT_EQ(x.sum(), 6.0);
	const VertexVector y = 2.0 * x - VertexVector(Eigen::VectorXd::Ones(3));
	EXPECT_EQ(y[Vertex(0)], 1.0);
	EXPECT_EQ(y[Vertex(2)], 5.0);
	x = y + x;
	EXPECT_EQ(x[Vertex(1)], 5.0);
	EXPECT_EQ(VertexVector().size(), 0);
}

} // namespace
} // namespace ricci::testing
