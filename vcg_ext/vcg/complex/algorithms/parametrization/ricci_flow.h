/****************************************************************************
 * Generalized discrete Ricci flow on VCG meshes                             *
 * An extension of the VCG Library                                           *
 * SPDX-License-Identifier: GPL-3.0-or-later                                 *
 ****************************************************************************/
#ifndef __VCGLIB_RICCI_FLOW
#define __VCGLIB_RICCI_FLOW

#include <ricci/base/numbers.h>
#include <ricci/base/task.h>
#include <ricci/error.h>
#include <ricci/options.h>
#include <ricci/parametrize.h>
#include <ricci/sphere_map.h>

#include <vcg/complex/allocate.h>
#include <vcg/complex/allocate_all_or_none.h>
#include <vcg/complex/complex.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace vcg {
namespace tri {

/**
 * @brief Conformal parametrization by the generalized discrete Ricci flow.
 *
 * Reads a mesh, runs the algorithm of ricci/parametrize.h on arrays, and writes wedge texture
 * coordinates, quality and attributes. Computing and writing are separate, so that a failed or cancelled
 * run leaves the mesh as it was. ricci_flow_layers.h builds further meshes from the result.
 *
 * Y. Yang, R. Guo, F. Luo, S. Hu, X. Gu: Generalized Discrete Ricci Flow.
 * Computer Graphics Forum 28(7), 2009.
 */
template<class MeshType>
class RicciFlow
{
public:
	typedef typename MeshType::ScalarType ScalarType;
	typedef typename MeshType::CoordType CoordType;
	typedef typename MeshType::VertexType VertexType;
	typedef typename MeshType::FaceType FaceType;

	/// [face][k] 1 where the side from corner k is to be a seam, see ricci::SurfaceMesh::seam and
	/// ricci_seams.h. Faces behind its end have none but those that the flow finds.
	typedef ricci::SideMarks SideMarks;

	/// [face] its wedge texture coordinates, see ricci::SurfaceMesh::map and ReadMap(). All faces of the mesh's
	/// vector have one, or none has.
	typedef std::vector<ricci::MappedFace> TextureMap;

	/// [vertex] ricci::SurfaceMesh::part. All vertices of the mesh's vector have one, or none has.
	typedef std::vector<int> Parts;

	typedef ricci::Options Params;
	typedef ricci::HyperbolicOptions HyperbolicParams;

	/// Everything that a run computed, in the indices of the mesh's face and vertex vectors: entries of
	/// deleted vertices mean nothing, and new points of a refinement follow after all vertices.
	typedef ricci::Parametrization Result;

	/// Computes; \p m is only read: positions as PlaceOf() has them, faces, selected vertices (Rectangle,
	/// SelectedCones), vertex quality as curvature in radians (Prescribed).
	/// \throw what ricci::parametrizeEuclidean() does, and ricci::InvalidMesh DamagedFaces
	static Result Compute(
		const MeshType& m,
		const Params& par,
		const SideMarks& seams = SideMarks(),
		const TextureMap& map = TextureMap(),
		const Parts& parts = Parts())
	{
		return Run(
			m,
			{seams, map, parts},
			par.target == ricci::TargetCurvature::Rectangle ||
				par.target == ricci::TargetCurvature::SelectedCones,
			par.target == ricci::TargetCurvature::Prescribed,
			[&](const ricci::SurfaceMesh& mesh, const ricci::VertexInput& input) {
				return ricci::parametrizeEuclidean(mesh, input, par);
			});
	}

	/// Computes the hyperbolic flow; \p m is only read, as by Compute(). The Poincaré disk fills
	/// [0,1]^2; with several components each has a disk of its own, side by side.
	/// \throw what ricci::parametrizeHyperbolic() does, and ricci::InvalidMesh DamagedFaces
	static Result ComputeHyperbolic(
		const MeshType& m,
		const HyperbolicParams& par,
		const SideMarks& seams = SideMarks(),
		const TextureMap& map = TextureMap(),
		const Parts& parts = Parts())
	{
		return Run(
			m,
			{seams, map, parts},
			par.target == ricci::HyperbolicTarget::SelectedCones,
			par.target == ricci::HyperbolicTarget::Prescribed,
			[&](const ricci::SurfaceMesh& mesh, const ricci::VertexInput& input) {
				return ricci::parametrizeHyperbolic(mesh, input, par);
			});
	}

	/// Writes wedge texture coordinates, texture index 0. They must be enabled on \p m.
	static void WriteWedgeTexCoord(MeshType& m, const Result& r)
	{
		RequirePerFaceWedgeTexCoord(m);
		for (const int f : r.mesh.points.indices())
			for (int k = 0; k < 3; ++k)
				SetWedge(m.face[size_t(r.mesh.face[f])], k, r.mesh.at(ricci::Corner(f, k)));
	}

	/// Writes the distortion as vertex quality and the per-vertex attributes of type ScalarType
	/// "ricci_u" and "ricci_target_curvature". If memory runs out, nothing has changed, but attributes of
	/// these names and another type are gone.
	static void WriteVertexQuality(MeshType& m, const Result& r)
	{
		RequirePerVertexQuality(m);
		NewAttributes attributes(m);
		attributes.Keep();
		for (size_t v = 0; v < m.vert.size(); ++v)
			if (!m.vert[v].IsD())
				attributes.Set(m.vert[v], r.vertexQC[v], r.u[v], r.targetCurvature[v]);
	}

	/// Replaces the faces of \p m by those of the common refinement. New vertices take position,
	/// normal and colour from the input's face by interpolation and the distortion as quality; their
	/// custom attributes other than ricci_u are empty. A face keeps its number for its first piece,
	/// and every piece copies its face's data; only sides on a faux edge stay faux. Wedge texture
	/// coordinates must be enabled; adjacency becomes invalid. If memory runs out, nothing has
	/// changed.
	static void WriteRefinement(MeshType& m, const Result& r)
	{
		RequirePerFaceWedgeTexCoord(m);
		RequirePerVertexQuality(m);
		const ricci::FlatMesh& mesh = r.mesh;
		const std::vector<ricci::SurfacePoint>& points = mesh.source.values();
		const size_t oldVertices = m.vert.size(), oldFaces = m.face.size();
		std::vector<FaceSides> before;
		for (size_t f = 0; f < oldFaces; ++f)
			before.push_back(SidesOf(m, m.face[f]));
		// The first piece of a face takes its place, the others are appended.
		std::vector<size_t> slot;
		std::vector<char> taken(oldFaces, 0);
		size_t added = 0;
		for (const int f : mesh.face) {
			slot.push_back(taken[size_t(f)] ? oldFaces + added++ : size_t(f));
			taken[size_t(f)] = 1;
		}
		NewAttributes attributes(m);
		AllOrNone<MeshType>::Append(m, points.size() - oldVertices, added);
		attributes.Keep();
		for (size_t v = 0; v < oldVertices; ++v)
			if (!m.vert[v].IsD())
				attributes.Set(m.vert[v], r.vertexQC[v], r.u[v], r.targetCurvature[v]);
		for (size_t v = oldVertices; v < points.size(); ++v) {
			Interpolate(m, points[v], m.vert[v]);
			double logRadius = 0.0;
			for (size_t i = 0; i < 4; ++i)
				logRadius += points[v].weight[i] * r.u[size_t(points[v].vertex[i])];
			attributes.Set(m.vert[v], r.vertexQC[v], logRadius, 0.0);
		}
		for (const int i : mesh.vertices.indices()) {
			const size_t input = size_t(mesh.face[i]), own = slot[size_t(i)];
			FaceType& face = m.face[own];
			if (own >= oldFaces)
				face.ImportData(m.face[input]);
			face.ClearAllF();
			for (int k = 0; k < 3; ++k) {
				const ricci::Corner corner(i, k);
				const size_t v = size_t(mesh.vertices[corner]);
				face.V(k) = &m.vert[v];
				SetWedge(face, k, mesh.at(corner));
				face.ClearB(k);
				face.ClearFaceEdgeS(k);
				if (before[input].IsFaux(points[v], points[size_t(mesh.vertices[corner.next()])]))
					face.SetF(k);
			}
		}
	}

	/// Writes one wedge texture coordinate, texture index 0.
	static void SetWedge(FaceType& face, int k, const ricci::Point2& p)
	{
		typedef typename FaceType::TexCoordType::ScalarType TexScalar;
		face.WT(k).U() = TexScalar(p[0]);
		face.WT(k).V() = TexScalar(p[1]);
		face.WT(k).N() = 0;
	}

	/// Maps a mesh of one closed component of genus 0 to the unit sphere (see ricci::mapToSphere());
	/// \p m is only read. The result is indexed like the mesh's vertex vector.
	/// \throw what ricci::mapToSphere() does, and ricci::InvalidMesh DamagedFaces
	static ricci::SphereMap ComputeSphere(const MeshType& m, const Params& par)
	{
		std::vector<int> faceIndex;
		const ricci::DefaultFloatingPoint defaultEnvironment;
		return ricci::mapToSphere(ReadSurface(m, faceIndex, {{}, {}, {}}), par);
	}

	/// The texture coordinates of the mesh: of wedges, or else of vertices. Empty where it has none.
	static TextureMap ReadMap(const MeshType& m)
	{
		TextureMap map;
		const bool hasWedges = HasPerWedgeTexCoord(m);
		if (!hasWedges && !HasPerVertexTexCoord(m))
			return map;
		map.resize(m.face.size());
		for (size_t f = 0; f < m.face.size(); ++f) {
			const FaceType& face = m.face[f];
			if (face.IsD() || (!hasWedges && !HasItsVertices(m, face)))
				continue;
			for (int k = 0; k < 3; ++k)
				map[f].uv[size_t(k)] =
					hasWedges
						? ricci::Point2{double(face.cWT(k).U()), double(face.cWT(k).V())}
						: ricci::Point2{double(face.cV(k)->cT().U()), double(face.cV(k)->cT().V())};
			map[f].picture = hasWedges ? face.cWT(0).N() : face.cV(0)->cT().N();
		}
		return map;
	}

	/// Where a vertex is seen, up to a translation: the matrix Tr that some types of meshes have is applied.
	static ricci::Point3 PlaceOf(const MeshType& m, const VertexType& v)
	{
		const ricci::Point3 p{double(v.cP()[0]), double(v.cP()[1]), double(v.cP()[2])};
		return Turned(m, p, 0);
	}

	/// Whether the face's vertices are in the mesh's vector and not deleted.
	static bool HasItsVertices(const MeshType& m, const FaceType& face)
	{
		const std::less<const VertexType*> before;
		for (int k = 0; k < 3; ++k) {
			const VertexType* v = face.cV(k);
			if (m.vert.empty() || before(v, &m.vert.front()) || before(&m.vert.back(), v) ||
				v->IsD())
				return false;
		}
		return true;
	}

private:
	typedef typename MeshType::template PerVertexAttributeHandle<ScalarType> VertexAttribute;

	template<class Mesh>
	static auto Turned(const Mesh& m, const ricci::Point3& p, int)
		-> decltype(void(m.Tr), ricci::Point3())
	{
		ricci::Point3 q;
		for (int i = 0; i < 3; ++i)
			q[size_t(i)] =
				double(m.Tr[i][0]) * p[0] + double(m.Tr[i][1]) * p[1] + double(m.Tr[i][2]) * p[2];
		return q;
	}

	template<class Mesh>
	static ricci::Point3 Turned(const Mesh&, const ricci::Point3& p, long)
	{
		return p;
	}

	/// What a mesh is opened by, and what is not to be joined.
	struct Openings
	{
		const SideMarks& seams;
		const TextureMap& map;
		const Parts& parts;
	};

	/// What \p parametrize gives, with the faces' indices in the mesh.
	template<class Parametrize>
	static Result
	Run(const MeshType& m,
		const Openings& openings,
		bool readSelection,
		bool readQuality,
		Parametrize parametrize)
	{
		const ricci::DefaultFloatingPoint defaultEnvironment;
		std::vector<int> faceIndex;
		const ricci::SurfaceMesh mesh = ReadSurface(m, faceIndex, openings);
		Result r = parametrize(mesh, ReadVertexInput(m, readSelection, readQuality));
		for (int& f : r.mesh.face)
			f = faceIndex[size_t(f)];
		return r;
	}

	/// The attribute of that name, replaced if there is one of another type.
	static VertexAttribute Attribute(MeshType& m, const char* name)
	{
		VertexAttribute found =
			Allocator<MeshType>::template FindPerVertexAttribute<ScalarType>(m, name);
		if (Allocator<MeshType>::IsValidHandle(m, found))
			return found;
		if (HasPerVertexAttribute(m, name))
			Allocator<MeshType>::DeletePerVertexAttribute(m, name);
		return Allocator<MeshType>::template AddPerVertexAttribute<ScalarType>(m, name);
	}

	/// The two attributes; those that were not there before disappear again unless kept.
	class NewAttributes
	{
	public:
		explicit NewAttributes(MeshType& m) : m_mesh(m)
		{
			m_hadU = HasPerVertexAttribute(m, "ricci_u");
			m_hadTarget = HasPerVertexAttribute(m, "ricci_target_curvature");
			u = Attribute(m, "ricci_u");
			try {
				target = Attribute(m, "ricci_target_curvature");
			}
			catch (...) {
				Remove();
				throw;
			}
		}
		~NewAttributes()
		{
			if (!m_kept)
				Remove();
		}
		NewAttributes(const NewAttributes&) = delete;
		NewAttributes& operator=(const NewAttributes&) = delete;

		void Keep() { m_kept = true; }

		void Set(VertexType& v, double quality, double logRadius, double curvature)
		{
			v.Q() = typename VertexType::QualityType(quality);
			u[v] = ScalarType(logRadius);
			target[v] = ScalarType(curvature);
		}

	private:
		void Remove()
		{
			// By handle: a name would be copied, for which there may be no memory.
			if (!m_hadU)
				Allocator<MeshType>::DeletePerVertexAttribute(m_mesh, u);
			if (!m_hadTarget && Allocator<MeshType>::IsValidHandle(m_mesh, target))
				Allocator<MeshType>::DeletePerVertexAttribute(m_mesh, target);
		}

		MeshType& m_mesh;
		VertexAttribute u, target;
		bool m_hadU = false, m_hadTarget = false, m_kept = false;
	};

	/// A face's vertices and which of its sides are faux (inside a polygon).
	struct FaceSides
	{
		std::array<int, 3> vertex{0, 0, 0};
		std::array<bool, 3> faux{false, false, false};

		/// Whether both points lie on one faux side.
		bool IsFaux(const ricci::SurfacePoint& p, const ricci::SurfacePoint& q) const
		{
			for (size_t k = 0; k < 3; ++k)
				if (faux[k] && OnSide(p, k) && OnSide(q, k))
					return true;
			return false;
		}

		bool OnSide(const ricci::SurfacePoint& p, size_t k) const
		{
			for (size_t i = 0; i < 4; ++i)
				if (p.weight[i] != 0.0 && p.vertex[i] != vertex[k] &&
					p.vertex[i] != vertex[(k + 1) % 3])
					return false;
			return true;
		}
	};

	static FaceSides SidesOf(const MeshType& m, const FaceType& face)
	{
		FaceSides sides;
		for (int k = 0; k < 3 && !face.IsD(); ++k) {
			sides.vertex[size_t(k)] = int(Index(m, face.cV(k)));
			sides.faux[size_t(k)] = face.IsF(k);
		}
		return sides;
	}

	/// Position, normal, and the colour where there is any, at an affine combination of vertices of
	/// \p m.
	static void Interpolate(const MeshType& m, const ricci::SurfacePoint& p, VertexType& to)
	{
		double place[3] = {0, 0, 0}, normal[3] = {0, 0, 0}, colour[4] = {0, 0, 0, 0};
		for (size_t i = 0; i < 4; ++i) {
			if (p.weight[i] == 0.0)
				continue;
			const VertexType& v = m.vert[size_t(p.vertex[i])];
			for (int k = 0; k < 3; ++k) {
				place[k] += p.weight[i] * double(v.cP()[k]);
				normal[k] += p.weight[i] * double(v.cN()[k]);
			}
			if (HasPerVertexColor(m))
				for (int k = 0; k < 4; ++k)
					colour[k] += p.weight[i] * double(v.cC()[k]);
		}
		to.P() = CoordType(ScalarType(place[0]), ScalarType(place[1]), ScalarType(place[2]));
		to.N() = CoordType(ScalarType(normal[0]), ScalarType(normal[1]), ScalarType(normal[2]));
		to.N().Normalize();
		if (HasPerVertexColor(m))
			for (int k = 0; k < 4; ++k)
				to.C()[k] = static_cast<unsigned char>(
					std::min(255.0, std::max(0.0, std::round(colour[k]))));
	}

	/// \param faceIndex [face that is read] its index in m.face
	static ricci::SurfaceMesh
	ReadSurface(const MeshType& m, std::vector<int>& faceIndex, const Openings& openings)
	{
		const SideMarks& seams = openings.seams;
		ricci::SurfaceMesh mesh;
		mesh.positions.resize(m.vert.size());
		for (size_t v = 0; v < m.vert.size(); ++v)
			if (!m.vert[v].IsD()) // a deleted vertex may hold anything
				mesh.positions[v] = PlaceOf(m, m.vert[v]);
		mesh.part = openings.parts;
		mesh.absent = m.vert.size() - size_t(m.vn);
		size_t damaged = 0;
		bool hasPolygons = false;
		for (size_t f = 0; f < m.face.size(); ++f) {
			if (m.face[f].IsD())
				continue;
			if (!HasItsVertices(m, m.face[f])) {
				++damaged;
				continue;
			}
			ricci::Triangle t;
			for (int k = 0; k < 3; ++k)
				t[size_t(k)] = int(Index(m, m.face[f].cV(k)));
			mesh.triangles.push_back(t);
			std::array<char, 3> diagonal{0, 0, 0};
			for (int k = 0; k < 3; ++k)
				if (m.face[f].IsF(k)) {
					diagonal[size_t(k)] = 1;
					hasPolygons = true;
				}
			mesh.diagonal.push_back(diagonal);
			if (!seams.empty())
				mesh.seam.push_back(f < seams.size() ? seams[f] : std::array<char, 3>{0, 0, 0});
			if (!openings.map.empty())
				mesh.map.push_back(openings.map[f]);
			faceIndex.push_back(int(f));
		}
		if (damaged > 0)
			throw ricci::InvalidMesh(ricci::InvalidMesh::DamagedFaces, damaged);
		if (!hasPolygons)
			mesh.diagonal.clear();
		return mesh;
	}

	static ricci::VertexInput
	ReadVertexInput(const MeshType& m, bool readSelection, bool readQuality)
	{
		ricci::VertexInput input;
		for (size_t v = 0; v < m.vert.size() && readSelection; ++v)
			input.selected.push_back(!m.vert[v].IsD() && m.vert[v].IsS());
		for (size_t v = 0; v < m.vert.size() && readQuality; ++v)
			input.targetCurvature.push_back(m.vert[v].IsD() ? 0.0 : double(m.vert[v].cQ()));
		// A quality of type double may have come from a file that holds floats.
		input.precision = double(std::numeric_limits<float>::epsilon());
		return input;
	}
};

} // namespace tri
} // namespace vcg

#endif
