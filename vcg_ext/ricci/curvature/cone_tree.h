// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_CONE_TREE_H
#define RICCI_CONE_TREE_H

#include "cone_model.h"
#include "cone_sites.h"

#include <vector>

namespace ricci {

/// An estimate of the seams of a map with cones: those that the surface has without them
/// (ConeSites::toCut()) and paths along edges, by each of which a cone joins what is there by the
/// shortest way [Takahashi Matsuyama 1980]. Lengths as those of ConeSites.
class SeamTree
{
public:
	/// Without cones.
	explicit SeamTree(const ConeSites& sites);

	/// With \p cones, the nearest to the tree first, and the first one first where there are no
	/// seams without cones.
	SeamTree(const ConeSites& sites, std::vector<Vertex> cones);

	double length() const { return m_length; }

	/// How much longer the tree becomes by a cone at \p v; infinite where it is empty.
	double distance(Vertex v) const { return m_distance[v]; }

	void add(Vertex cone);

	/// Takes the cone out again, and the path to it, up to where another one joins.
	/// \return the length of that; 0 where paths of other cones pass
	double remove(Vertex cone);

	/// What remove() would return.
	double ownLength(Vertex cone) const;

private:
	double lengthOfStep(Vertex v) const;
	void spread(const std::vector<Vertex>& from);

	const ConeSites* m_sites;
	double m_length;
	VertexArray<double> m_distance; // to the tree
	VertexArray<Vertex> m_next;     // on the way to the tree, and on it to where its paths began
	VertexArray<int> m_uses;        // cones at a vertex, and paths that go on from it
};

/// Moves cones towards the tree of their seams where that lowers the energy of the map and the price of
/// its seams together (see MapCost), in several rounds, and keeps the distortion (see
/// ConeModel::distortion()) at or below \p maxDistortion.
/// \param tree of the cones of \p model
void shortenConeTree(
	ConeModel& model, SeamTree& tree, const ConeSites& sites, double maxDistortion);

} // namespace ricci

#endif
