// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_COARSE_FLOW_H
#define RICCI_COARSE_FLOW_H

#include "linear_flow.h"

namespace ricci {

/// The linear problem of a surface on aggregates of its vertices, where the search for cones costs
/// little. Its Laplacian is that of functions which are constant on every aggregate, weakened evenly
/// until the curvature of the surface gives factors u of the right size (overcorrection
/// [Braess 1995]). They are those of the surface to some percent, but for a cone's own aggregate.
struct CoarseFlow
{
	VertexArray<Vertex> roots; ///< by aggregate: the vertex of the surface from which it grew
	LinearFlow flow;           ///< with arrays by aggregate in place of arrays by vertex

	/// \param vertices to take together until there are at most so many
	/// \throw SolverFailed
	CoarseFlow(LinearFlow& fine, int vertices);
};

} // namespace ricci

#endif
