// SPDX-License-Identifier: GPL-3.0-or-later
// From the maps of components to the map of the whole mesh, also of those that have no hyperbolic metric, such as loose
// bolts beside a body with handles.
#ifndef RICCI_WHOLE_MAP_H
#define RICCI_WHOLE_MAP_H

#include "layout/parametrization.h"
#include "mesh/component.h"
#include "options.h"
#include "parametrize.h"

#include <functional>
#include <vector>

namespace ricci {

/// A mesh as it is opened, and a map that has no component yet: appendComponents() gives its arrays their sizes, and its
/// mesh the vertices of the opened one.
struct WholeMap
{
	OpenedMesh opened;
	std::vector<Component> components;
	VertexInput values; ///< of the vertices of the opened mesh
	Parametrization map;
};

/// Opens and checks \p mesh, sees whether memory will do, and logs what there is to note.
/// \throw InvalidMesh, TooLarge
WholeMap open(
	const SurfaceMesh& mesh, const VertexInput& input, const FlowOptions& options, OneSidedCut cut);

/// The charts of parametrizeEuclidean() before they are packed, in the plane each from the origin, in the
/// indices of the opened mesh.
WholeMap chartsInPlane(const SurfaceMesh& mesh, const VertexInput& input, const Options& options);

/// Appends the map of a component, in its indices, to that of the surface that it is a component of.
void append(const Component& component, Parametrization part, Parametrization& whole);

/// Of all of them together.
std::size_t faceCount(const std::vector<Component>& components);

/// Appends what \p flatten makes of each component, several of them at the same time in threads. A copy of an earlier
/// one (originals()) gets the map of that one: it looks the same, and costs nothing. The log has their lines in the order
/// of the components. Of several errors that of the first component is thrown; where there are several components, it
/// gets the component's data.
/// \param values of the vertices of \p opened: those of copies are equal
/// \param isInPlane a mirror image is a copy, too, and its charts are mirrored
void appendComponents(
	const OpenedMesh& opened,
	const VertexInput& values,
	const std::vector<Component>& components,
	const std::function<Parametrization(const Component&)>& flatten,
	bool isInPlane,
	Parametrization& whole);

/// Takes out of \p components, where there are several, those on which no metric of curvature -1 has the target
/// (Gauss-Bonnet), and those without a selected vertex where cones are asked for at selected vertices.
/// \param input of the vertices of \p opened
/// \return what was taken out
/// \throw if that is all: InadmissibleCurvature or InvalidOption, of the largest component
std::vector<Component> leaveOut(
	const OpenedMesh& opened,
	const VertexInput& input,
	const HyperbolicTargetOptions& options,
	std::vector<Component>& components);

/// Adds a packed map of components that were taken out to that of the others, as one chart more: in the square
/// inscribed in a disk of its own, and open along its seams, which are not isometries of the disk.
/// \param leftOut in the unit square
/// \param map before placeDisks()
void addBeside(Parametrization leftOut, Parametrization& map);

/// Gives a map of an opened mesh the indices of its input, and its triangles the input's order and orders
/// of corners. To be called last, once nothing asks any more which triangles are glued.
///
/// Vertices that were joined (OpenedMesh::joined) have the values of the one, and each face its own of them again.
///
/// A vertex takes the mean of its copies' distortion, weighted by the area of their faces, and the
/// curvature and u of the vertex itself. The refinement's points at copies become the vertex. Degenerate
/// faces become triangles of no chart: such a face lies at corners of a face with which it shares an edge,
/// or else a vertex, so that its three points are on one line; at the point 0 if there is none.
void toInputIndices(const SurfaceMesh& input, const OpenedMesh& opened, Parametrization& map);

} // namespace ricci

#endif
