// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_COARSE_FLOW_H
#define RICCI_COARSE_FLOW_H

#include "linear_flow.h"

#include <list>
#include <utility>

namespace ricci {

/// The linear problem of a surface on aggregates of its vertices, where the search for cones costs
/// little: the Galerkin restriction of the Laplacian to smoothed aggregates
/// [Vanek Mandel Brezina 1996]. Its vertices are the roots of the aggregates, between which areas and
/// curvatures are divided; its factors u are those of the surface to a few percent, more only at a
/// cone, where the surface's own is sharper.
struct CoarseFlow
{
	VertexArray<Vertex> roots; ///< by aggregate: a vertex of the surface
	LinearFlow flow;           ///< with arrays by aggregate in place of arrays by vertex

	CoarseFlow(VertexArray<Vertex> aggregateRoots, LinearSystem system) :
			roots(std::move(aggregateRoots)), flow(std::move(system))
	{
	}
};

/// Levels of aggregates, the coarsest first, each of aggregates of the next one's: those with at most
/// \p maxVertices, down to the first with at most \p enough.
/// \throw SolverFailed
std::list<CoarseFlow> coarseFlows(LinearFlow& fine, int maxVertices, int enough);

} // namespace ricci

#endif
