// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_TESTS_SHAPES_H
#define RICCI_TESTS_SHAPES_H

#include <ricci/base/indexed.h>
#include <ricci/base/numbers.h>
#include <ricci/mesh/surface_mesh.h>

#include <array>
#include <functional>
#include <vector>

namespace ricci::testing {

/// Position of a number or an index in a std::vector.
inline std::size_t at(int index)
{
	return static_cast<std::size_t>(index);
}
template<class Self>
std::size_t at(const Index<Self>& index)
{
	return positionOf(index);
}

/// Area of a face, and of all.
double areaOf(const SurfaceMesh& mesh, std::size_t face);
double areaOf(const SurfaceMesh& mesh);

/// Number of places in a grid direction: open, or closed into a ring.
enum class Ends { Open, Joined };

/// The triangles of nu by nv cells, each cut along the diagonal from (i, j) to (i + 1, j + 1),
/// counter-clockwise in (i, j). \p vertex(i, j) is the vertex there, for 0 <= i <= nu, 0 <= j <= nv.
std::vector<Triangle> cells(int nu, int nv, const std::function<int(int, int)>& vertex);

/// Grid of (nu by nv) cells, each cut into two triangles along the diagonal from (i,j) to
/// (i+1,j+1), counter-clockwise in (u,v). \p point maps grid coordinates to space; along a joined
/// direction the last row of cells ends at the first row of vertices.
SurfaceMesh
grid(int nu, int nv, Ends alongU, Ends alongV, const std::function<Point3(int, int)>& point);

/// Flat rectangle, [0, width] x [0, height] at z = 0.
SurfaceMesh rectangle(int nx, int ny, double width, double height);

/// A bumpy square of n x n cells with sides of length 1.
SurfaceMesh hill(int n, double height);

/// A bumpy patch with a round outline that is not centred on anything.
SurfaceMesh bumpyPatch(int n);

/// \p mesh and two faces: a triangle on the edge from \p i to \p j of its boundary, on its right, whose
/// apex lies \p length along x from \p j, and one without area on the side from \p j to there.
SurfaceMesh withFlatTail(SurfaceMesh mesh, int i, int j, double length);

/// Torus of revolution, major radius R, minor radius r, outward orientation.
SurfaceMesh torus(double R, double r, int nu, int nv);

/// Flat ring between radii r1 < r2 at z = 0, counter-clockwise, radii in geometric progression.
SurfaceMesh ring(double r1, double r2, int around, int across);

/// Surface of revolution about the z axis, outward orientation, \p around vertices in each ring.
/// \param profile places (radius, z) from below to above; with radius 0 at an end a pole closes the
/// surface there, else it has a hole
SurfaceMesh revolved(const std::vector<std::array<double, 2>>& profile, int around);

/// Unit sphere with poles and, between them, \p rings - 1 rings of \p around vertices.
SurfaceMesh sphere(int rings, int around);

/// Unit sphere with \p rings vertices from pole to pole and \p around in each ring, whose north is a
/// tube of this \p radius and \p length with a round end. Its south has a hole at polar angle
/// \p hole, none if that is 0. Triangles are about as large everywhere as on the sphere, but the tube
/// has \p around of them in each ring.
SurfaceMesh sphereWithTube(double radius, double length, double hole, int rings, int around);

/// Regular tetrahedron with corners on the unit sphere, outward.
SurfaceMesh tetrahedron();

/// Closed surface of any genus: the skin of a slab of unit cubes, (2 genus + 1) x 3 x 1, with
/// \p genus separate cubes taken out; each square is cut into 2 (subdivision)^2 triangles.
SurfaceMesh perforatedSlab(int genus, int subdivision);

/// Rectangles of n by n unit cells with one side in common, on the z axis, at these angles.
struct Page
{
	double angle;
	bool isTurned; ///< orientation
};
SurfaceMesh bookOf(const std::vector<Page>& sheets, int n);

/// \p sheets rectangles of n by n unit cells with one side in common, on the z axis, at equal angles. The
/// second half of them has the orientation that the first half has once it is past that side.
SurfaceMesh book(int sheets, int n);

/// Klein bottle of nu by nv cells: \p point(i, j) for 0 <= i < nu, 0 <= j < nv; once round, j comes back
/// as -j.
SurfaceMesh kleinBottle(int nu, int nv, const std::function<Point3(int, int)>& point);

/// Moebius band of \p n squares.
SurfaceMesh moebiusBand(int n);

/// Seven triangles round a vertex, number 0, on the unit circle; six of them are equal, and the last one has
/// an angle of \p gap degrees there, between the vertices 7 and 1.
SurfaceMesh fanWithGap(double gap);

/// \p mesh with its faces 0, step, 2 step, ... reversed.
SurfaceMesh withReversedFaces(SurfaceMesh mesh, std::size_t step);

/// Both meshes in one, the second moved by \p shift along x.
SurfaceMesh sideBySide(const SurfaceMesh& a, const SurfaceMesh& b, double shift);

/// \p mesh without the faces at \p vertices (and without unreferenced vertices): opens one hole for
/// each vertex whose neighbours are not on the boundary or in the list.
SurfaceMesh withoutStars(const SurfaceMesh& mesh, const std::vector<int>& vertices);

/// The faces of \p mesh for which isKept(face), with their vertices in the order of these.
SurfaceMesh partOf(const SurfaceMesh& mesh, const std::function<bool(std::size_t)>& isKept);

SurfaceMesh scaled(SurfaceMesh mesh, double factor);

/// Each coordinate times its factor.
SurfaceMesh stretched(SurfaceMesh mesh, const Point3& factors);

/// Coordinates as floats hold them.
SurfaceMesh inFloats(SurfaceMesh mesh);

/// Turned by \p angles about x, then y, then z (radians).
SurfaceMesh turned(SurfaceMesh mesh, const std::array<double, 3>& angles);

/// A ring between radii 1 and 2 that goes round by \p turns, in the plane or along a screw of this \p pitch.
SurfaceMesh screw(double turns, int around, int across, double pitch = 0.0);

} // namespace ricci::testing

#endif
