// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_ELEMENTS_H
#define RICCI_ELEMENTS_H

#include "../base/indexed.h"

#include <Eigen/Core>

namespace ricci {

struct Vertex : Index<Vertex>
{
	using Index::Index;
};

struct Face : Index<Face>
{
	using Index::Index;
};

struct Edge;

/// One side of an edge. The two halfedges of edge e have the numbers 2 e and 2 e + 1.
struct Halfedge : Index<Halfedge>
{
	using Index::Index;

	/// The halfedge on the other side of the edge, which runs the other way.
	constexpr Halfedge twin() const { return Halfedge(number() ^ 1); }

	constexpr Edge edge() const;

	/// Whether this is edge().halfedge(), whose direction is that of the edge.
	constexpr bool isFirst() const { return number() % 2 == 0; }
};

struct Edge : Index<Edge>
{
	using Index::Index;

	/// The halfedge that gives the edge its direction; the other one is its twin.
	constexpr Halfedge halfedge() const { return Halfedge(2 * number()); }
};

constexpr Edge Halfedge::edge() const
{
	return Edge(number() >> 1);
}

template<class T>
using VertexArray = IndexedArray<Vertex, T>;
template<class T>
using EdgeArray = IndexedArray<Edge, T>;
template<class T>
using HalfedgeArray = IndexedArray<Halfedge, T>;
template<class T>
using FaceArray = IndexedArray<Face, T>;

/// A vector of the linear algebra with one entry for each vertex.
class VertexVector : public Eigen::VectorXd
{
public:
	VertexVector() = default;
	template<class Integer, class = std::enable_if_t<std::is_integral_v<Integer>>>
	explicit VertexVector(Integer size) : Eigen::VectorXd(static_cast<Eigen::Index>(size))
	{
	}
	template<class Derived>
	VertexVector(const Eigen::MatrixBase<Derived>& other) : Eigen::VectorXd(other)
	{
	}
	template<class Derived>
	VertexVector& operator=(const Eigen::MatrixBase<Derived>& other)
	{
		Eigen::VectorXd::operator=(other);
		return *this;
	}

	double& operator[](Vertex v) { return coeffRef(v.number()); }
	double operator[](Vertex v) const { return coeff(v.number()); }

	IndexRange<Vertex> indices() const { return IndexRange<Vertex>(static_cast<int>(size())); }
};

} // namespace ricci

#endif
