/****************************************************************************
 * Meshes made from the result of the discrete Ricci flow                    *
 * An extension of the VCG Library                                           *
 * SPDX-License-Identifier: GPL-3.0-or-later                                 *
 ****************************************************************************/
#ifndef __VCGLIB_RICCI_FLOW_LAYERS
#define __VCGLIB_RICCI_FLOW_LAYERS

#include "ricci_flow.h"

#include <ricci/error.h>
#include <ricci/math/disk_isometry.h>
#include <ricci/fuchsian/canonical_polygon.h>
#include <ricci/fuchsian/fuchsian_group.h>
#include <ricci/fuchsian/tiling.h>
#include <ricci/sphere_map.h>

#include <vcg/complex/allocate.h>
#include <vcg/complex/complex.h>
#include <vcg/space/color4.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <map>
#include <utility>
#include <vector>

namespace vcg {
namespace tri {

/**
 * @brief Meshes that show the result of RicciFlow: the layout in the plane, the map to the sphere, and
 * in the Poincaré disk the universal cover, the axes of the Fuchsian group and its canonical polygon.
 */
template<class MeshType>
class RicciFlowLayers
{
public:
	typedef typename MeshType::ScalarType ScalarType;
	typedef typename MeshType::CoordType CoordType;
	typedef typename MeshType::VertexType VertexType;
	typedef typename MeshType::VertexIterator VertexIterator;
	typedef typename MeshType::FaceType FaceType;
	typedef typename MeshType::FaceIterator FaceIterator;
	typedef typename RicciFlow<MeshType>::WedgeUV WedgeUV;
	typedef typename RicciFlow<MeshType>::Result Result;

	/// Fills the empty mesh \p flat with the layout: the vertices of \p m, once for each place that
	/// they have in the plane, at z = 0, with the distortion as their quality. Wedge texture
	/// coordinates are written if they are enabled on \p flat.
	static void BuildFlatMesh(const MeshType& m, const Result& r, MeshType& flat)
	{
		const LaidOut layout(m, r);
		const std::vector<Place>& places = layout.places;
		const std::vector<std::array<size_t, 3>>& faces = layout.faces;
		Allocator<MeshType>::AddVertices(flat, places.size());
		for (size_t i = 0; i < places.size(); ++i) {
			const ricci::Point2& p = places[i].second;
			flat.vert[i].P() = CoordType(ScalarType(p[0]), ScalarType(p[1]), ScalarType(0));
			flat.vert[i].N() = CoordType(0, 0, 1);
			flat.vert[i].Q() = layout.QualityAt(i);
		}
		FaceIterator fi = Allocator<MeshType>::AddFaces(flat, faces.size());
		for (size_t f = 0; f < faces.size(); ++f, ++fi) {
			for (int k = 0; k < 3; ++k)
				fi->V(k) = &flat.vert[faces[f][size_t(k)]];
			fi->N() = CoordType(0, 0, 1);
			if (HasPerWedgeTexCoord(flat))
				for (int k = 0; k < 3; ++k)
					RicciFlow<MeshType>::SetWedge(*fi, k, places[faces[f][size_t(k)]].second);
		}
	}

	/// Fills the empty mesh \p sphere with the vertices and faces of \p m, without the deleted ones
	/// but otherwise in their order, at their places on the unit sphere. Vertices without a face lie
	/// at the origin; vertices with several places have copies behind all others.
	static void BuildSphereMesh(const MeshType& m, const ricci::SphereMap& map, MeshType& sphere)
	{
		const size_t copies = map.vertex.size() - m.vert.size();
		std::vector<size_t> index(map.vertex.size(), 0);
		VertexIterator vi = Allocator<MeshType>::AddVertices(sphere, size_t(m.vn) + copies);
		size_t next = 0;
		for (size_t i = 0; i < map.vertex.size(); ++i) {
			const VertexType& v = m.vert[size_t(map.vertex[i])];
			if (v.IsD())
				continue;
			const ricci::Point3& p = map.positions[i];
			vi->P() = CoordType(ScalarType(p[0]), ScalarType(p[1]), ScalarType(p[2]));
			if (HasPerVertexColor(m) && HasPerVertexColor(sphere))
				vi->C() = v.cC();
			index[i] = next++;
			++vi;
		}
		FaceIterator fi = Allocator<MeshType>::AddFaces(sphere, map.triangles.size());
		for (const ricci::Triangle& t : map.triangles) {
			for (size_t k = 0; k < 3; ++k)
				fi->V(int(k)) = &sphere.vert[index[size_t(t[k])]];
			++fi;
		}
	}

	/// Fills the empty mesh \p cover with copies of the layout in the Poincaré disk: the component
	/// itself and \p rings rings of neighbours in its universal cover, all within the disk's square
	/// of the texture plane, at z = 0. Each copy has its own colour, where vertices or faces of
	/// \p cover have any.
	/// \throw ricci::InvalidOption CoverTooLarge if that is more than \p maxFaces faces
	static void BuildUniversalCover(
		const MeshType& m, const Result& r, int rings, size_t maxFaces, MeshType& cover)
	{
		const LaidOut layout(m, r);
		const size_t faces = layout.faces.size();
		std::vector<ricci::Tiling> tilings;
		size_t copies = 0;
		for (const ricci::FuchsianGroup& group : r.groups) {
			const size_t limit = maxFaces / std::max<size_t>(1, faces) + 2;
			tilings.push_back(ricci::tiling(group.sides, rings, int(limit)));
			copies = std::max(copies, tilings.back().deck.size());
		}
		if (copies * faces > maxFaces)
			throw ricci::InvalidOption(
				ricci::InvalidOption::CoverTooLarge, double(rings), 0.0, maxFaces);
		for (size_t copy = 0; copy < copies; ++copy)
			AddCopy(layout, r, tilings, copy, cover);
	}

	/// Fills the empty mesh \p curves with edges: the axes of the generators in the Poincaré disk,
	/// which are closed geodesics of the surface, each as a polyline of \p pieces edges. Rotations
	/// have no axis. Those of handles need HyperbolicParams::canonicalGenerators.
	static void BuildAxes(const Result& r, int pieces, MeshType& curves)
	{
		for (size_t i = 0; i < r.groups.size(); ++i) {
			const ricci::FuchsianGroup& group = r.groups[i];
			for (const auto* generators : {&group.handles, &group.peripheral})
				for (const ricci::DiskIsometry& g : *generators) {
					std::complex<double> from, to;
					if (g.axis(from, to))
						AddGeodesic(r.disks[i], from, to, pieces, curves);
				}
		}
	}

	/// Fills the empty mesh \p curves with edges: for each component a fundamental polygon whose
	/// sides are the letters of the canonical relation (see ricci::canonicalPolygon), 4 g for a
	/// closed surface of genus g, each as a polyline of \p pieces edges in the Poincaré disk. Needs
	/// HyperbolicParams::canonicalGenerators.
	static std::vector<ricci::CanonicalPolygon>
	BuildCanonicalPolygons(const Result& r, int pieces, MeshType& curves)
	{
		const auto klein = [](std::complex<double> z) { return 2.0 * z / (1.0 + std::norm(z)); };
		std::vector<ricci::CanonicalPolygon> polygons;
		for (size_t i = 0; i < r.groups.size(); ++i) {
			polygons.push_back(ricci::canonicalPolygon(r.groups[i]));
			const std::vector<std::complex<double>>& corners = polygons.back().corners;
			for (size_t k = 0; k < corners.size(); ++k)
				AddGeodesic(
					r.disks[i],
					klein(corners[k]),
					klein(corners[(k + 1) % corners.size()]),
					pieces,
					curves);
		}
		return polygons;
	}

private:
	typedef std::pair<size_t, ricci::Point2> Place; // vertex, point

	/// The layout on its own vertices: those of the mesh, once for each place that they have.
	struct LaidOut
	{
		LaidOut(const MeshType& m, const Result& r) :
				m_quality(r.refined.triangles.empty() ? r.vertexQC : r.refined.vertexQC)
		{
			for (size_t i = 0; i < r.refined.triangles.size(); ++i) {
				const ricci::Triangle& t = r.refined.triangles[i];
				Add({size_t(t[0]), size_t(t[1]), size_t(t[2])},
					r.refined.uv[i],
					r,
					size_t(r.refined.inputFace[i]));
			}
			for (size_t f = 0; f < m.face.size() && r.refined.triangles.empty(); ++f)
				if (!m.face[f].IsD())
					Add({Index(m, m.face[f].cV(0)),
						 Index(m, m.face[f].cV(1)),
						 Index(m, m.face[f].cV(2))},
						r.wedgeUV[f],
						r,
						f);
		}

		typename VertexType::QualityType QualityAt(size_t place) const
		{
			return typename VertexType::QualityType(m_quality[places[place].first]);
		}

		std::vector<Place> places;
		std::vector<std::array<size_t, 3>> faces; // indices of places
		std::vector<size_t> component;            // [place] hyperbolic flow

	private:
		void
		Add(const std::array<size_t, 3>& vertex,
			const WedgeUV& uv,
			const Result& r,
			size_t inputFace)
		{
			const size_t ofFace = r.component.empty() ? 0 : r.component[inputFace];
			std::array<size_t, 3> corner;
			for (size_t k = 0; k < 3; ++k) {
				const Place place(vertex[k], uv[k]);
				const auto found =
					m_index.insert(std::make_pair(std::make_pair(ofFace, place), places.size()));
				if (found.second) {
					places.push_back(place);
					component.push_back(ofFace);
				}
				corner[k] = found.first->second;
			}
			faces.push_back(corner);
		}

		std::map<std::pair<size_t, Place>, size_t> m_index; // component, place
		const std::vector<double>& m_quality;               // [vertex]
	};

	/// Adds the copies with the number \p copy of those components whose tilings have so many.
	static void AddCopy(
		const LaidOut& layout,
		const Result& r,
		const std::vector<ricci::Tiling>& tilings,
		size_t copy,
		MeshType& cover)
	{
		const auto isCopied = [&](size_t place) {
			return copy < tilings[layout.component[place]].deck.size();
		};
		std::vector<size_t> copied; // places
		for (size_t i = 0; i < layout.places.size(); ++i)
			if (isCopied(i))
				copied.push_back(i);
		std::vector<VertexType*> vertexAt(layout.places.size(), nullptr);
		VertexIterator vi = Allocator<MeshType>::AddVertices(cover, copied.size());
		for (size_t i : copied) {
			const size_t component = layout.component[i];
			const ricci::Point2 middle = Middle(r.disks[component]);
			const double radius = 0.5 * r.disks[component].width();
			const ricci::Point2& p = layout.places[i].second;
			const std::complex<double> z = tilings[component].deck[copy](
				std::complex<double>((p[0] - middle[0]) / radius, (p[1] - middle[1]) / radius));
			vi->P() = CoordType(
				ScalarType(middle[0] + radius * z.real()),
				ScalarType(middle[1] + radius * z.imag()),
				ScalarType(0));
			vi->N() = CoordType(0, 0, 1);
			vi->Q() = layout.QualityAt(i);
			if (HasPerVertexColor(cover))
				vi->C() = TileColor(copy);
			vertexAt[i] = &*vi++;
		}
		std::vector<const std::array<size_t, 3>*> faces;
		for (const std::array<size_t, 3>& face : layout.faces)
			if (isCopied(face[0])) // and so are its other corners, of the same component
				faces.push_back(&face);
		FaceIterator fi = Allocator<MeshType>::AddFaces(cover, faces.size());
		for (const std::array<size_t, 3>* face : faces) {
			for (int k = 0; k < 3; ++k)
				fi->V(k) = vertexAt[(*face)[size_t(k)]];
			fi->N() = CoordType(0, 0, 1);
			if (HasPerFaceColor(cover))
				fi->C() = TileColor(copy);
			++fi;
		}
	}

	static ricci::Point2 Middle(const ricci::Box2& box)
	{
		return {(box.min[0] + box.max[0]) / 2, (box.min[1] + box.max[1]) / 2};
	}

	/// Adds a polyline along the geodesic between two points of the Klein model, where it is
	/// straight, drawn in the Poincaré disk inscribed in the box \p disk.
	static void AddGeodesic(
		const ricci::Box2& disk,
		std::complex<double> from,
		std::complex<double> to,
		int pieces,
		MeshType& curves)
	{
		VertexIterator vi = Allocator<MeshType>::AddVertices(curves, size_t(pieces) + 1);
		std::vector<VertexType*> points;
		const ricci::Point2 middle = Middle(disk);
		const double radius = 0.5 * disk.width();
		for (int k = 0; k <= pieces; ++k, ++vi) {
			// Denser towards the ends, where the disk is smaller.
			const double t = 0.5 - 0.5 * std::cos(M_PI * k / pieces);
			const std::complex<double> klein = (1.0 - t) * from + t * to;
			const std::complex<double> z =
				klein / (1.0 + std::sqrt(std::max(0.0, 1.0 - std::norm(klein))));
			vi->P() = CoordType(
				ScalarType(middle[0] + z.real() * radius),
				ScalarType(middle[1] + z.imag() * radius),
				ScalarType(0));
			vi->N() = CoordType(0, 0, 1);
			points.push_back(&*vi);
		}
		typename MeshType::EdgeIterator ei = Allocator<MeshType>::AddEdges(curves, size_t(pieces));
		for (size_t k = 0; k < size_t(pieces); ++k, ++ei) {
			ei->V(0) = points[k];
			ei->V(1) = points[k + 1];
		}
	}

	/// Colours that differ for copies near each other in their order; the first one is grey.
	static Color4b TileColor(size_t copy)
	{
		if (copy == 0)
			return Color4b(200, 200, 200, 255);
		// Steps of the golden section round the circle of hues.
		const double hue = std::fmod(0.618033988749895 * double(copy), 1.0);
		Color4b color;
		color.SetHSVColor(float(hue), copy % 2 == 0 ? 0.3f : 0.5f, copy % 3 == 0 ? 0.8f : 0.95f);
		return color;
	}
};

} // namespace tri
} // namespace vcg

#endif
