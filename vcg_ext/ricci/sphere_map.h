// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_SPHERE_MAP_H
#define RICCI_SPHERE_MAP_H

#include "mesh/surface_mesh.h"
#include "options.h"
#include "progress.h"
#include "report.h"

#include <vector>

namespace ricci {

/// A closed surface of genus 0 on the unit sphere. The distortion is that of the map from the mesh's triangles to the
/// straight ones between the positions.
struct SphereMap : DistortionReport
{
	/// [vertex] on the unit sphere, copies behind the mesh's own vertices where the mesh had to be cut
	/// open; the origin at unused vertices.
	std::vector<Point3> positions;
	std::vector<int> vertex;         ///< [position] number of the vertex in the mesh
	std::vector<Triangle> triangles; ///< [face] into positions; those without area have them, too
	int pole = -1;                   ///< the vertex at which the surface was punctured
	int iterations = 0;              ///< Newton steps
	double maxCurvatureError = 0.0;  ///< of the flow, radians
	double offset = 0.0; ///< length of the mean of the positions, weighted by area: 0 if centred
	int flippedFaces =
		0; ///< logged where there are any; seen from the centre, against the orientation of the rest; also faces
		   ///< that span more than a hemisphere, which no straight triangle does
};

/// Maps a mesh of one closed component of genus 0 conformally to the unit sphere.
///
/// The surface is punctured at a vertex: an inversion of space about it, which is conformal, sends
/// it to infinity and its neighbours to the boundary of a disk; the flow makes the disk flat with
/// the boundary's metric kept (the Euclidean flow of the punctured surface), and the inverse
/// stereographic projection takes the plane to the sphere, the puncture to the pole. So every
/// polyhedron inscribed in a sphere is mapped to itself, up to a Moebius transformation
/// ([Springborn 2020] for the vertex at infinity). Of these transformations the one that brings the
/// conformal barycentre of the area to the centre is chosen, and of the rotations the one that turns
/// the vertices most nearly towards their places on the mesh.
///
/// Vertices that only faces without area use (see OpenedMesh) lie where another corner of such a face
/// does, or else at the pole.
/// \param options only epsilon and join are used; the flow has intrinsic flips
/// \throw InvalidMesh, InvalidOption (another topology), NotConverged, SolverFailed, TooLarge, Stopped
SphereMap mapToSphere(const SurfaceMesh& mesh, const Options& options);

} // namespace ricci

#endif
