/****************************************************************************
 * Meshes made from the result of the discrete Ricci flow                    *
 * An extension of the VCG Library                                           *
 * SPDX-License-Identifier: GPL-3.0-or-later                                 *
 ****************************************************************************/
#ifndef __VCGLIB_RICCI_FLOW_LAYERS
#define __VCGLIB_RICCI_FLOW_LAYERS

#include "ricci_flow.h"

#include <ricci/base/task.h>
#include <ricci/error.h>
#include <ricci/hyperbolic/group_of_cut.h>
#include <ricci/layout/parametrization.h>
#include <ricci/numerics/disk_isometry.h>
#include <ricci/sphere_map.h>

#include <vcg/complex/allocate.h>
#include <vcg/complex/complex.h>
#include <vcg/space/color4.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <utility>
#include <vector>

namespace vcg {
namespace tri {

/**
 * The functions can be cancelled as the run itself (ricci::Task); what they have filled then is of no use.
 *
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
	typedef typename RicciFlow<MeshType>::Result Result;

	/// Fills the empty mesh \p flat with the layout: the vertices of the mesh, once for each point that
	/// they have in the plane, at z = 0, with the distortion as their quality. Wedge texture
	/// coordinates are written if they are enabled on \p flat.
	static void BuildFlatMesh(const Result& r, MeshType& flat)
	{
		const Points points(r);
		Allocator<MeshType>::AddVertices(flat, points.component.size());
		for (const int i : r.mesh.place.indices()) {
			ricci::checkpointNowAndThen(size_t(i));
			VertexType& v = flat.vert[size_t(i)];
			v.P() = PlaceOf(r.mesh.place[i]);
			v.N() = CoordType(0, 0, 1);
			v.Q() = points.QualityAt(i);
		}
		FaceIterator fi = Allocator<MeshType>::AddFaces(flat, size_t(r.mesh.size()));
		for (const int f : r.mesh.points.indices()) {
			ricci::checkpointNowAndThen(size_t(f));
			for (int k = 0; k < 3; ++k) {
				const ricci::Corner corner(f, k);
				fi->V(k) = &flat.vert[size_t(r.mesh.points[corner])];
				if (HasPerWedgeTexCoord(flat))
					RicciFlow<MeshType>::SetWedge(*fi, k, r.mesh.at(corner));
			}
			fi->N() = CoordType(0, 0, 1);
			++fi;
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
			ricci::checkpointNowAndThen(i);
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
	static void BuildUniversalCover(const Result& r, int rings, size_t maxFaces, MeshType& cover)
	{
		const Points points(r);
		const size_t faces = size_t(r.mesh.size());
		std::vector<ricci::Tiling> tilings;
		size_t copies = 0;
		for (const ricci::Chart& chart : r.charts) {
			const size_t limit = maxFaces / std::max<size_t>(1, faces) + 2;
			tilings.push_back(
				chart.middle < 0 ? ricci::tiling(chart.group.sides, rings, int(limit))
								 : tilings[size_t(chart.middle)]);
			copies = std::max(copies, tilings.back().deck.size());
		}
		if (copies * faces > maxFaces)
			throw ricci::InvalidOption(
				ricci::InvalidOption::CoverTooLarge, double(rings), 0.0, maxFaces);
		if (std::any_of(tilings.begin(), tilings.end(), [](const ricci::Tiling& tiling) {
				return !tiling.complete;
			}))
			ricci::logLine("Copies too near to the circle to be told apart are left out of the "
						   "universal cover.");
		for (size_t copy = 0; copy < copies; ++copy) {
			ricci::checkpoint();
			AddCopy(points, r, tilings, copy, cover);
		}
	}

	/// Fills the empty mesh \p curves with edges: the axes of the generators in the Poincaré disk,
	/// which are closed geodesics of the surface, each as a polyline of \p pieces edges. Rotations
	/// have no axis. Those of handles need HyperbolicParams::canonicalGenerators.
	static void BuildAxes(const Result& r, int pieces, MeshType& curves)
	{
		for (const ricci::Chart& chart : r.charts)
			for (const auto* generators : {&chart.group.handles, &chart.group.peripheral})
				for (const ricci::DiskIsometry& g : *generators) {
					ricci::checkpoint();
					std::complex<double> from, to;
					if (g.axis(from, to))
						AddGeodesic(chart.box, from, to, pieces, curves);
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
		for (const ricci::Chart& chart : r.charts) {
			if (chart.middle >= 0 || chart.group.sides.empty())
				continue; // a part of another's disk, or no sides to pair
			ricci::checkpoint();
			polygons.push_back(ricci::canonicalPolygon(chart.group));
			const std::vector<std::complex<double>>& corners = polygons.back().corners;
			for (size_t k = 0; k < corners.size(); ++k)
				AddGeodesic(
					chart.box,
					klein(corners[k]),
					klein(corners[(k + 1) % corners.size()]),
					pieces,
					curves);
		}
		return polygons;
	}

private:
	/// What the points of the layout belong to.
	struct Points
	{
		explicit Points(const Result& r) :
				component(size_t(r.mesh.place.size()), 0), m_vertex(component.size(), 0),
				m_quality(r.vertexQC)
		{
			// Degenerate faces, the last ones, have no chart, but points of others.
			for (int f = r.mesh.size(); f-- > 0;)
				for (size_t k = 0; k < 3; ++k) {
					const size_t p = size_t(r.mesh.points[f][k]);
					component[p] = size_t(std::max(0, r.mesh.chart[f]));
					m_vertex[p] = size_t(r.mesh.vertices[f][k]);
				}
			for (int f = 0; f < r.mesh.size(); ++f)
				if (r.mesh.chart[f] < 0) {
					size_t largest = 0;
					for (const int p : r.mesh.points[f])
						largest = std::max(largest, component[size_t(p)]);
					for (const int p : r.mesh.points[f])
						component[size_t(p)] = largest;
				}
		}

		typename VertexType::QualityType QualityAt(int point) const
		{
			return typename VertexType::QualityType(m_quality[m_vertex[size_t(point)]]);
		}

		std::vector<size_t> component; // [point] hyperbolic flow

	private:
		std::vector<size_t> m_vertex; // [point]
		const std::vector<double>& m_quality;
	};

	static CoordType PlaceOf(const ricci::Point2& p)
	{
		return CoordType(ScalarType(p[0]), ScalarType(p[1]), ScalarType(0));
	}

	/// Adds the copies with the number \p copy of those components whose tilings have so many.
	static void AddCopy(
		const Points& points,
		const Result& r,
		const std::vector<ricci::Tiling>& tilings,
		size_t copy,
		MeshType& cover)
	{
		const auto isCopied = [&](int point) {
			return copy < tilings[points.component[size_t(point)]].deck.size();
		};
		std::vector<int> copied; // points
		for (const int i : r.mesh.place.indices())
			if (isCopied(i))
				copied.push_back(i);
		std::vector<VertexType*> vertexAt(points.component.size(), nullptr);
		VertexIterator vi = Allocator<MeshType>::AddVertices(cover, copied.size());
		for (int i : copied) {
			const size_t component = points.component[size_t(i)];
			const ricci::Chart& chart = r.charts[component];
			const ricci::Point2& p = r.mesh.place[i];
			const auto inDisk = [](const ricci::Box2& square, const ricci::Point2& q) {
				return 2.0 / square.width() *
					   std::complex<double>(q[0] - square.centre()[0], q[1] - square.centre()[1]);
			};
			// The parts of a divided disk together, in that of the part in the middle.
			const ricci::Box2& disk =
				chart.middle < 0 ? chart.box : r.charts[size_t(chart.middle)].box;
			const ricci::Point2 middle = disk.centre();
			const double radius = 0.5 * disk.width();
			const std::complex<double> z = tilings[component].deck[copy](
				ricci::rounded(chart.place.inverse())(inDisk(chart.box, p)));
			vi->P() = PlaceOf({middle[0] + radius * z.real(), middle[1] + radius * z.imag()});
			vi->N() = CoordType(0, 0, 1);
			vi->Q() = points.QualityAt(i);
			if (HasPerVertexColor(cover))
				vi->C() = TileColor(copy);
			vertexAt[size_t(i)] = &*vi++;
		}
		std::vector<const ricci::Triangle*> faces;
		for (const ricci::Triangle& face : r.mesh.points)
			if (isCopied(face[0])) // and so are its other corners, of the same component
				faces.push_back(&face);
		FaceIterator fi = Allocator<MeshType>::AddFaces(cover, faces.size());
		for (const ricci::Triangle* face : faces) {
			for (int k = 0; k < 3; ++k)
				fi->V(k) = vertexAt[size_t((*face)[size_t(k)])];
			fi->N() = CoordType(0, 0, 1);
			if (HasPerFaceColor(cover))
				fi->C() = TileColor(copy);
			++fi;
		}
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
		const ricci::Point2 middle = disk.centre();
		const double radius = 0.5 * disk.width();
		for (int k = 0; k <= pieces; ++k, ++vi) {
			// Denser towards the ends, where the disk is smaller.
			const double t = 0.5 - 0.5 * std::cos(M_PI * k / pieces);
			const std::complex<double> klein = (1.0 - t) * from + t * to;
			const std::complex<double> z =
				klein / (1.0 + std::sqrt(std::max(0.0, 1.0 - std::norm(klein))));
			vi->P() = PlaceOf({middle[0] + z.real() * radius, middle[1] + z.imag() * radius});
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
