// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_TESTS_VCG_MESH_H
#define RICCI_TESTS_VCG_MESH_H

#include <ricci/charts/parametrization.h>
#include <ricci/surface/surface_mesh.h>

#include <vcg/complex/complex.h>

namespace ricci::testing {

// VCG meshes like those of the hosts: single precision in MeshLab, double in PyMeshLab; wedge
// texture coordinates are float in both.

class FloatEdge;
class FloatFace;
class FloatVertex;
struct FloatTypes :
		public vcg::UsedTypes<
			vcg::Use<FloatVertex>::AsVertexType,
			vcg::Use<FloatEdge>::AsEdgeType,
			vcg::Use<FloatFace>::AsFaceType>
{
};
class FloatVertex :
		public vcg::Vertex<
			FloatTypes,
			vcg::vertex::Coord3f,
			vcg::vertex::Normal3f,
			vcg::vertex::Qualityf,
			vcg::vertex::BitFlags>
{
};
class FloatFace :
		public vcg::Face<
			FloatTypes,
			vcg::face::VertexRef,
			vcg::face::Normal3f,
			vcg::face::WedgeTexCoord2f,
			vcg::face::BitFlags>
{
};
class FloatEdge : public vcg::Edge<FloatTypes, vcg::edge::VertexRef, vcg::edge::BitFlags>
{
};
class FloatMesh :
		public vcg::tri::
			TriMesh<std::vector<FloatVertex>, std::vector<FloatFace>, std::vector<FloatEdge>>
{
public:
	// vcglib leaves its attributes behind.
	~FloatMesh() override { ClearAttributes(); }
};

class DoubleEdge;
class DoubleFace;
class DoubleVertex;
struct DoubleTypes :
		public vcg::UsedTypes<
			vcg::Use<DoubleVertex>::AsVertexType,
			vcg::Use<DoubleEdge>::AsEdgeType,
			vcg::Use<DoubleFace>::AsFaceType>
{
};
class DoubleVertex :
		public vcg::Vertex<
			DoubleTypes,
			vcg::vertex::Coord3d,
			vcg::vertex::Normal3d,
			vcg::vertex::Qualityd,
			vcg::vertex::BitFlags>
{
};
class DoubleFace :
		public vcg::Face<
			DoubleTypes,
			vcg::face::VertexRef,
			vcg::face::Normal3d,
			vcg::face::WedgeTexCoord2f,
			vcg::face::BitFlags>
{
};
class DoubleEdge : public vcg::Edge<DoubleTypes, vcg::edge::VertexRef, vcg::edge::BitFlags>
{
};
class DoubleMesh :
		public vcg::tri::
			TriMesh<std::vector<DoubleVertex>, std::vector<DoubleFace>, std::vector<DoubleEdge>>
{
public:
	// vcglib leaves its attributes behind.
	~DoubleMesh() override { ClearAttributes(); }
};

/// Fills the empty VCG mesh \p to.
template<class MeshType>
void toVcg(const SurfaceMesh& from, MeshType& to)
{
	using Scalar = typename MeshType::ScalarType;
	auto vertex = vcg::tri::Allocator<MeshType>::AddVertices(to, from.positions.size());
	for (const Point3& p : from.positions) {
		vertex->P() = typename MeshType::CoordType(
			static_cast<Scalar>(p[0]), static_cast<Scalar>(p[1]), static_cast<Scalar>(p[2]));
		vertex->N() = typename MeshType::CoordType(0, 0, 0); // vcglib leaves these unset
		vertex->Q() = 0;
		++vertex;
	}
	auto face = vcg::tri::Allocator<MeshType>::AddFaces(to, from.triangles.size());
	for (const Triangle& t : from.triangles) {
		for (int k = 0; k < 3; ++k) {
			face->V(k) = &to.vert[static_cast<std::size_t>(t[static_cast<std::size_t>(k)])];
			face->WT(k) = typename MeshType::FaceType::TexCoordType(0, 0);
			face->WT(k).N() = 0;
		}
		face->N() = typename MeshType::CoordType(0, 0, 0);
		++face;
	}
}

template<class MeshType>
SurfaceMesh fromVcg(const MeshType& from)
{
	SurfaceMesh mesh;
	for (const auto& v : from.vert)
		mesh.positions.push_back(
			{static_cast<double>(v.cP()[0]),
			 static_cast<double>(v.cP()[1]),
			 static_cast<double>(v.cP()[2])});
	for (const auto& f : from.face)
		if (!f.IsD())
			mesh.triangles.push_back(
				{static_cast<int>(vcg::tri::Index(from, f.cV(0))),
				 static_cast<int>(vcg::tri::Index(from, f.cV(1))),
				 static_cast<int>(vcg::tri::Index(from, f.cV(2)))});
	return mesh;
}

/// [face] what a map gives its corners, of each face its first triangle.
inline std::vector<Triangle2> wedgesOf(const Parametrization& map)
{
	std::vector<Triangle2> wedges;
	for (int f = map.mesh.size(); f-- > 0;) {
		const std::size_t face = static_cast<std::size_t>(map.mesh.face[f]);
		wedges.resize(std::max(wedges.size(), face + 1));
		wedges[face] = map.mesh.at(f);
	}
	return wedges;
}

} // namespace ricci::testing

#endif
