// SPDX-License-Identifier: GPL-3.0-or-later
// The folder texture: bakes an old texture for other coordinates. It knows flat meshes and pictures, and no
// flow.
// A picture that old texture coordinates show, baked for new ones.
#ifndef RICCI_CARRY_TEXTURE_H
#define RICCI_CARRY_TEXTURE_H

#include "../base/points.h"
#include "../mesh/surface_mesh.h"
#include "picture.h"

#include <array>
#include <vector>

namespace ricci {

/// What a face of the mesh shows. Coordinates have their origin at the lower left corner of the
/// picture, which fills the unit square and is repeated outside of it.
struct TexturedFace
{
	Triangle vertices{}; ///< tell which faces are neighbours
	Triangle2 uv{};      ///< old coordinates of the corners
	int picture = -1;    ///< that they lie in; -1: none, the corners have colours
	/// [corner] red, green, blue, alpha in [0, 1]; read where there is no picture
	std::array<std::array<float, 4>, 3> colour{};
};

/// A triangle of the new map: a part of a face, or all of it.
struct CarriedTriangle
{
	Triangle2 uv{}; ///< new coordinates, in the unit square
	int face = 0;
	/// [corner] its barycentric coordinates in the face
	std::array<Point3, 3> corners{Point3{1, 0, 0}, Point3{0, 1, 0}, Point3{0, 0, 1}};
};

struct CarriedMesh
{
	std::vector<TexturedFace> faces;
	std::vector<CarriedTriangle> triangles;
};

/// Texels beyond the edge of a chart that sampling may read while it mixes no more than 8 x 8 of them:
/// half of such a block from its middle, and a whole one to the next.
constexpr int kGutterTexels = 12;

/// For its owner, and a third of that and of four words for the blocks.
constexpr double kBytesOfOldTexel = 4.0 + (4.0 + 8.0) / 3.0;

/// Draws the picture that the new coordinates have to show. Every texel whose middle lies in a triangle
/// takes the mean of the old picture, bilinear between its texels, or between blocks of them where they are
/// many (footprints in picture_sampler.h), over the parallelogram that the
/// affine map from new to old coordinates makes of the texel; colours weigh by their alpha. Old texels
/// count only where their middle lies in the same chart of the old map (or where charts overlap), so
/// that nothing is taken from charts beside it or from between charts. Texels up to 1.5 outside of a
/// triangle take what the map shows when it is continued, if that is in the chart, all others the colour
/// of the nearest of them. Where triangles overlap, the first shows.
///
/// Samples are integers of 8 or 16 bits, mixed as they are stored. With equal coordinates and sizes the
/// result is the same bit for bit in every covered texel.
///
/// Memory: 4 bytes for each texel of the result, and kBytesOfOldTexel for each of the largest picture or 1
/// more for each of the result, whichever is more.
/// \param hasAlpha false: alpha is not read, and written as opaque
/// \param result size x size texels
/// \param threads that share the work; the result does not depend on it
template<class Sample>
void carryTexture(
	const CarriedMesh& mesh,
	const std::vector<PictureView<const Sample>>& pictures,
	bool hasAlpha,
	const PictureView<Sample>& result,
	int threads);

extern template void carryTexture(
	const CarriedMesh&,
	const std::vector<PictureView<const unsigned char>>&,
	bool,
	const PictureView<unsigned char>&,
	int);
extern template void carryTexture(
	const CarriedMesh&,
	const std::vector<PictureView<const unsigned short>>&,
	bool,
	const PictureView<unsigned short>&,
	int);

/// Means over the surface by area, of faces with pictures and an area there.
struct TexelDensity
{
	double before = 0.0; ///< texels for a unit of length
	double after = 0.0;
	double ratio = 0.0; ///< of after to before; 0 where there are no such faces
};

/// \param faceAreas in space
/// \param pictures [picture] width and height
/// \param size of the new picture
TexelDensity texelDensity(
	const CarriedMesh& mesh,
	const std::vector<double>& faceAreas,
	const std::vector<std::array<int, 2>>& pictures,
	int size);

} // namespace ricci

#endif
