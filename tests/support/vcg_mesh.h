// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_TESTS_VCG_MESH_H
#define RICCI_TESTS_VCG_MESH_H

#include <ricci/layout/parametrization.h>
#include <ricci/mesh/surface_mesh.h>

#include <vcg/complex/complex.h>

namespace ricci::testing {

// VCG meshes like those of the hosts: single precision in MeshLab, double in PyMeshLab; wedge
// texture coordinates are float in both.

template<class Scalar>
struct VcgParts
{
	template<class T>
	using Coord = vcg::vertex::Coord<vcg::Point3<Scalar>, T>;
	template<class T>
	using VertexNormal = vcg::vertex::Normal<vcg::Point3<Scalar>, T>;
	template<class T>
	using Quality = vcg::vertex::Quality<Scalar, T>;
	template<class T>
	using FaceNormal = vcg::face::NormalAbs<vcg::Point3<Scalar>, T>;
};
template<class Scalar>
class VcgVertex;
template<class Scalar>
class VcgFace;
template<class Scalar>
class VcgEdge;
template<class Scalar>
struct VcgTypes :
		public vcg::UsedTypes<
			vcg::Use<VcgVertex<Scalar>>::template AsVertexType,
			vcg::Use<VcgEdge<Scalar>>::template AsEdgeType,
			vcg::Use<VcgFace<Scalar>>::template AsFaceType>
{
};
template<class Scalar>
class VcgVertex :
		public vcg::Vertex<
			VcgTypes<Scalar>,
			VcgParts<Scalar>::template Coord,
			VcgParts<Scalar>::template VertexNormal,
			VcgParts<Scalar>::template Quality,
			vcg::vertex::BitFlags>
{
};
template<class Scalar>
class VcgFace :
		public vcg::Face<
			VcgTypes<Scalar>,
			vcg::face::VertexRef,
			VcgParts<Scalar>::template FaceNormal,
			vcg::face::WedgeTexCoord2f,
			vcg::face::BitFlags>
{
};
template<class Scalar>
class VcgEdge : public vcg::Edge<VcgTypes<Scalar>, vcg::edge::VertexRef, vcg::edge::BitFlags>
{
};
template<class Scalar>
class VcgMesh :
		public vcg::tri::TriMesh<
			std::vector<VcgVertex<Scalar>>,
			std::vector<VcgFace<Scalar>>,
			std::vector<VcgEdge<Scalar>>>
{
public:
	// vcglib leaves its attributes behind.
	~VcgMesh() override { this->ClearAttributes(); }
};
using FloatMesh = VcgMesh<float>;
using DoubleMesh = VcgMesh<double>;

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
