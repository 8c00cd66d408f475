/****************************************************************************
 * Generalized discrete Ricci flow on VCG meshes                             *
 * An extension of the VCG Library                                           *
 * SPDX-License-Identifier: GPL-3.0-or-later                                 *
 ****************************************************************************/
#ifndef __VCGLIB_RICCI_SEAMS
#define __VCGLIB_RICCI_SEAMS

#include <ricci/mesh/sides.h>

#include <vcg/complex/algorithms/parametrization/ricci_flow.h>

#include <vector>

namespace vcg {
namespace tri {

/**
 * @brief Seams for RicciFlow that a mesh has already: in its texture, or by what is selected.
 *
 * Each function reads the mesh and marks the sides of faces that are seams (RicciFlow::SideMarks); of
 * an edge one side is enough. The result is empty where there are none.
 */
template<class MeshType>
class RicciSeams
{
public:
	typedef RicciFlow<MeshType> Flow;
	typedef typename Flow::SideMarks SideMarks;
	typedef typename MeshType::FaceType FaceType;

	/// Edges at which the wedge texture coordinates of two faces jump, see ricci::jumpsOf(); the same edges are
	/// seams where RicciFlow::ReadMap() is handed to RicciFlow. Coordinates of vertices jump at no edge: a mesh
	/// that has only those is open at its seams.
	static SideMarks OfTexture(const MeshType& m)
	{
		if (!HasPerWedgeTexCoord(m))
			return SideMarks();
		const typename Flow::TextureMap map = Flow::ReadMap(m);
		const auto jumps = ricci::jumpsOf(map);
		return Between(
			m, [&](const FaceType& f, const Corners& a, const FaceType& g, const Corners& b) {
				const int i = int(Index(m, f)), j = int(Index(m, g));
				return jumps(ricci::Corner(i, a.low), ricci::Corner(j, b.low)) ||
					   jumps(ricci::Corner(i, a.high), ricci::Corner(j, b.high));
			});
	}

	/// Edges between faces that are selected and faces that are not.
	static SideMarks OfSelectedFaces(const MeshType& m)
	{
		return Between(m, [](const FaceType& f, const Corners&, const FaceType& g, const Corners&) {
			return f.IsS() != g.IsS();
		});
	}

	/// Edges that are selected in one of their faces (IsFaceEdgeS()).
	static SideMarks OfSelectedEdges(const MeshType& m)
	{
		SideMarks marks;
		for (size_t f = 0; f < m.face.size(); ++f)
			for (int k = 0; k < 3; ++k)
				if (!m.face[f].IsD() && m.face[f].IsFaceEdgeS(k))
					Mark(m, f, k, marks);
		return marks;
	}

private:
	/// Those of a face at the ends of an edge.
	struct Corners
	{
		int low, high;
	};

	static Corners CornersOf(const std::vector<ricci::Triangle>& triangles, ricci::Corner side)
	{
		const ricci::Triangle& t = triangles[size_t(side.face())];
		const int k = int(side.index()), next = int(side.next().index());
		return t[size_t(k)] < t[size_t(next)] ? Corners{k, next} : Corners{next, k};
	}

	static void Mark(const MeshType& m, size_t face, int k, SideMarks& marks)
	{
		marks.resize(m.face.size(), {0, 0, 0});
		marks[face][size_t(k)] = 1;
	}

	/// The edges for two of whose faces \p isSeam(face, its corners, other face, its corners) holds. Faces
	/// that use a vertex twice, or one that is not there, have none.
	template<class Predicate>
	static SideMarks Between(const MeshType& m, Predicate isSeam)
	{
		std::vector<ricci::Triangle> triangles;
		std::vector<size_t> number; // [triangle] in m.face
		for (size_t f = 0; f < m.face.size(); ++f) {
			if (m.face[f].IsD() || !Flow::HasItsVertices(m, m.face[f]))
				continue;
			ricci::Triangle t;
			for (int k = 0; k < 3; ++k)
				t[size_t(k)] = int(Index(m, m.face[f].cV(k)));
			if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0])
				continue;
			triangles.push_back(t);
			number.push_back(f);
		}
		SideMarks marks;
		ricci::Sides(triangles).forEdges([&](const auto& sides) {
			const ricci::Corner side = *sides.begin();
			const size_t first = number[size_t(side.face())];
			for (const ricci::Corner other : sides)
				if (other != side && isSeam(
										 m.face[first],
										 CornersOf(triangles, side),
										 m.face[number[size_t(other.face())]],
										 CornersOf(triangles, other)))
					Mark(m, first, int(side.index()), marks);
		});
		return marks;
	}
};

} // namespace tri
} // namespace vcg

#endif
