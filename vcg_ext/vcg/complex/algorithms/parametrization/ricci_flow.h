/****************************************************************************
 * Generalized discrete Ricci flow on VCG meshes                             *
 * An extension of the VCG Library                                           *
 * SPDX-License-Identifier: GPL-3.0-or-later                                 *
 ****************************************************************************/
#ifndef __VCGLIB_RICCI_FLOW
#define __VCGLIB_RICCI_FLOW

#include <ricci/error.h>
#include <ricci/floating_point.h>
#include <ricci/layout/canonical_polygon.h>
#include <ricci/layout/distortion.h>
#include <ricci/options.h>
#include <ricci/parametrize.h>
#include <ricci/progress.h>
#include <ricci/report.h>
#include <ricci/sphere_map.h>

#include <vcg/complex/allocate.h>
#include <vcg/complex/complex.h>
#include <vcg/space/boxes_side_by_side.h>
#include <vcg/space/color4.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <functional>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace vcg {
namespace tri {

/**
 * @brief Conformal parametrization by the generalized discrete Ricci flow.
 *
 * Reads a mesh, runs the algorithm of ricci/parametrize.h on arrays, packs the charts, and writes
 * wedge texture coordinates, quality and attributes. Computing and writing are separate, so that a
 * failed or cancelled run leaves the mesh as it was.
 *
 * [1] Y. Yang, R. Guo, F. Luo, S. Hu, X. Gu: Generalized Discrete Ricci Flow.
 *     Computer Graphics Forum 28(7), 2009.
 */
template<class MeshType>
class RicciFlow
{
public:
	typedef typename MeshType::ScalarType ScalarType;
	typedef typename MeshType::CoordType CoordType;
	typedef typename MeshType::VertexType VertexType;
	typedef typename MeshType::VertexIterator VertexIterator;
	typedef typename MeshType::FaceType FaceType;
	typedef typename MeshType::FaceIterator FaceIterator;

	/// One point of the plane for each corner of a face.
	typedef std::array<ricci::Point2, 3> WedgeUV;

	struct Params : public ricci::Options
	{
		/// Fit the charts into [0,1]^2, all with one scale and their aspect kept; false: keep the
		/// scale at which a chart has the area of its component (or its boundary the input's
		/// length).
		bool normalizeUV = true;

		/// Least distance between the bounding boxes of two charts, and from them to the border of
		/// the square that holds all, as a share of its side; at most kMostMargin.
		double chartMargin = 0.0;
	};

	static constexpr double kMostMargin = 0.25;

	/// The hyperbolic flow takes these as they are.
	typedef ricci::HyperbolicOptions HyperbolicParams;

	/// Everything that a run computed, indexed like the mesh's face and vertex vectors (deleted
	/// elements included; their entries mean nothing).
	struct Result
	{
		ricci::Report report;
		std::vector<std::string> notes; ///< what was done without being asked
		std::vector<WedgeUV> wedgeUV;   ///< [face][corner] charts packed, normalised if asked
		std::vector<double> vertexQC;   ///< area-weighted mean of sigma1 / sigma2 round the vertex
		std::vector<double> u;          ///< ln radius of the vertex circle
		std::vector<double> targetCurvature; ///< radians
		/// Common refinement, if asked for; its points and faces index the mesh's vertex and face
		/// vectors, its points beyond them are new.
		ricci::RefinedMesh refined;
		/// Hyperbolic flow: one for each component, with the square that its disk fills in the
		/// texture plane.
		std::vector<ricci::FuchsianGroup> groups;
		std::vector<Box2<double>> disks;
	};

	/// Computes; \p m is only read: positions, faces, selected vertices (Rectangle, SelectedCones),
	/// vertex quality as curvature in radians (Prescribed).
	/// \throw ricci::Error and its derived classes, with a sentence for the user
	static Result Compute(const MeshType& m, const Params& par, ricci::Progress& progress)
	{
		const ricci::DefaultFloatingPoint defaultEnvironment;
		std::vector<int> faceIndex; // [compact] -> index in m.face
		const ricci::SurfaceMesh mesh = ReadSurface(m, faceIndex);
		const ricci::VertexInput input = ReadVertexInput(
			m,
			par.target == ricci::TargetCurvature::Rectangle ||
				par.target == ricci::TargetCurvature::SelectedCones,
			par.target == ricci::TargetCurvature::Prescribed);
		ricci::Parametrization flat = ricci::parametrizeEuclidean(mesh, input, par, progress);

		Result r;
		r.report = flat.report;
		r.notes = flat.notes;
		PackCharts(flat, par.normalizeUV, par.chartMargin);
		CountFlipped(flat, r.report);
		TakeOver(flat, m.face.size(), faceIndex, r);
		return r;
	}

	/// Computes the hyperbolic flow; \p m is only read, as by Compute(). The Poincaré disk fills
	/// [0,1]^2; with several components each has a disk of its own, side by side.
	/// \throw ricci::Error and its derived classes, with a sentence for the user
	static Result
	ComputeHyperbolic(const MeshType& m, const HyperbolicParams& par, ricci::Progress& progress)
	{
		const ricci::DefaultFloatingPoint defaultEnvironment;
		std::vector<int> faceIndex; // [compact] -> index in m.face
		const ricci::SurfaceMesh mesh = ReadSurface(m, faceIndex);
		const ricci::VertexInput input = ReadVertexInput(
			m,
			par.target == ricci::HyperbolicTarget::SelectedCones,
			par.target == ricci::HyperbolicTarget::Prescribed);
		ricci::Parametrization disk = ricci::parametrizeHyperbolic(mesh, input, par, progress);

		Result r;
		r.report = disk.report;
		r.notes = disk.notes;
		const int perRow = int(std::ceil(std::sqrt(double(disk.charts.size()))));
		const double side = 1.0 / perRow;
		for (size_t i = 0; i < disk.charts.size(); ++i) {
			const Point2d corner(side * double(int(i) % perRow), side * double(int(i) / perRow));
			r.disks.push_back(Box(corner, corner + Point2d(side, side)));
			r.groups.push_back(disk.charts[i].group);
			Transform(disk, disk.charts[i], 0.5 * side, r.disks[i].Center());
		}
		ClampToUnitSquare(disk);
		const int flipped = r.report.flippedFaces; // of geodesic triangles
		CountFlipped(disk, r.report);
		r.report.flippedFaces = flipped;
		TakeOver(disk, m.face.size(), faceIndex, r);
		return r;
	}

	/// Writes wedge texture coordinates, texture index 0. They must be enabled on \p m.
	static void WriteWedgeTexCoord(MeshType& m, const Result& r)
	{
		RequirePerFaceWedgeTexCoord(m);
		for (size_t f = 0; f < m.face.size(); ++f) {
			if (m.face[f].IsD())
				continue;
			for (int k = 0; k < 3; ++k)
				SetWedge(m.face[f], k, r.wedgeUV[f][size_t(k)]);
		}
	}

	/// Writes the distortion as vertex quality and the per-vertex attributes of type ScalarType
	/// "ricci_u" and "ricci_target_curvature". If memory runs out, nothing has changed.
	static void WriteVertexQuality(MeshType& m, const Result& r)
	{
		RequirePerVertexQuality(m);
		NewAttributes attributes(m);
		attributes.Keep();
		VertexAttribute& u = attributes.u;
		VertexAttribute& target = attributes.target;
		for (size_t v = 0; v < m.vert.size(); ++v) {
			if (m.vert[v].IsD())
				continue;
			m.vert[v].Q() = typename VertexType::QualityType(r.vertexQC[v]);
			u[v] = ScalarType(r.u[v]);
			target[v] = ScalarType(r.targetCurvature[v]);
		}
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
		const ricci::RefinedMesh& refined = r.refined;
		const size_t oldVertices = m.vert.size(), oldFaces = m.face.size();
		std::vector<FaceSides> before;
		for (size_t f = 0; f < oldFaces; ++f)
			before.push_back(SidesOf(m, m.face[f]));
		// The first piece of a face takes its place, the others are appended.
		std::vector<int> slot(refined.triangles.size(), -1);
		std::vector<char> taken(oldFaces, 0);
		size_t added = 0;
		for (size_t i = 0; i < refined.triangles.size(); ++i) {
			const size_t f = size_t(refined.inputFace[i]);
			slot[i] = taken[f] ? int(oldFaces + added++) : int(f);
			taken[f] = 1;
		}
		NewAttributes attributes(m);
		Append(m, refined.points.size() - oldVertices, added);
		attributes.Keep();
		VertexAttribute& u = attributes.u;
		VertexAttribute& target = attributes.target;

		for (size_t v = 0; v < oldVertices; ++v)
			if (!m.vert[v].IsD()) {
				u[v] = ScalarType(r.u[v]);
				target[v] = ScalarType(r.targetCurvature[v]);
			}
		for (size_t v = oldVertices; v < refined.points.size(); ++v) {
			Interpolate(m, refined.points[v], m.vert[v]);
			double logRadius = 0.0;
			for (size_t i = 0; i < 4; ++i)
				logRadius += refined.points[v].weight[i] * r.u[size_t(refined.points[v].vertex[i])];
			u[v] = ScalarType(logRadius);
			target[v] = ScalarType(0);
		}
		for (size_t v = 0; v < refined.points.size(); ++v)
			if (!m.vert[v].IsD())
				m.vert[v].Q() = typename VertexType::QualityType(refined.vertexQC[v]);
		for (size_t i = 0; i < refined.triangles.size(); ++i) {
			FaceType& face = m.face[size_t(slot[i])];
			if (size_t(slot[i]) >= oldFaces)
				face.ImportData(m.face[size_t(refined.inputFace[i])]);
			face.ClearAllF();
			for (int k = 0; k < 3; ++k) {
				const ricci::Triangle& t = refined.triangles[i];
				face.V(k) = &m.vert[size_t(t[size_t(k)])];
				SetWedge(face, k, refined.uv[i][size_t(k)]);
				face.ClearB(k);
				face.ClearFaceEdgeS(k);
				const ricci::SurfacePoint& p = refined.points[size_t(t[size_t(k)])];
				const ricci::SurfacePoint& q = refined.points[size_t(t[size_t(k + 1) % 3])];
				if (before[size_t(refined.inputFace[i])].IsFaux(p, q))
					face.SetF(k);
			}
		}
	}

	/// Fills the empty mesh \p flat with the layout: its vertices are the vertices of \p m, once
	/// for each place they have in the plane, at z = 0, with their quality; wedge texture
	/// coordinates are written where they are enabled on \p flat.
	static void BuildFlatMesh(const MeshType& m, const Result& r, MeshType& flat)
	{
		typedef std::pair<size_t, ricci::Point2> Place; // vertex, point
		std::map<Place, size_t> index;
		std::vector<Place> places;
		std::vector<std::array<size_t, 3>> faces;
		const auto addFace = [&](const std::array<size_t, 3>& vertex, const WedgeUV& uv) {
			std::array<size_t, 3> corner;
			for (size_t k = 0; k < 3; ++k) {
				const Place place(vertex[k], uv[k]);
				const auto found = index.insert(std::make_pair(place, places.size()));
				if (found.second)
					places.push_back(place);
				corner[k] = found.first->second;
			}
			faces.push_back(corner);
		};
		const bool refined = !r.refined.triangles.empty();
		const std::vector<double>& quality = refined ? r.refined.vertexQC : r.vertexQC;
		for (size_t i = 0; i < r.refined.triangles.size(); ++i) {
			const ricci::Triangle& t = r.refined.triangles[i];
			addFace({size_t(t[0]), size_t(t[1]), size_t(t[2])}, r.refined.uv[i]);
		}
		for (size_t f = 0; f < m.face.size() && !refined; ++f)
			if (!m.face[f].IsD())
				addFace(
					{Index(m, m.face[f].cV(0)),
					 Index(m, m.face[f].cV(1)),
					 Index(m, m.face[f].cV(2))},
					r.wedgeUV[f]);
		Allocator<MeshType>::AddVertices(flat, places.size());
		for (size_t i = 0; i < places.size(); ++i) {
			const ricci::Point2& p = places[i].second;
			flat.vert[i].P() = CoordType(ScalarType(p[0]), ScalarType(p[1]), ScalarType(0));
			flat.vert[i].N() = CoordType(0, 0, 1);
			flat.vert[i].Q() = typename VertexType::QualityType(quality[places[i].first]);
		}
		FaceIterator fi = Allocator<MeshType>::AddFaces(flat, faces.size());
		for (size_t f = 0; f < faces.size(); ++f, ++fi) {
			for (int k = 0; k < 3; ++k)
				fi->V(k) = &flat.vert[faces[f][size_t(k)]];
			fi->N() = CoordType(0, 0, 1);
			if (HasPerWedgeTexCoord(flat))
				for (int k = 0; k < 3; ++k)
					SetWedge(*fi, k, places[faces[f][size_t(k)]].second);
		}
	}

	/// Maps a mesh of one closed component of genus 0 to the unit sphere (see ricci::mapToSphere());
	/// \p m is only read. The result is indexed like the mesh's vertex vector.
	/// \throw ricci::Error and its derived classes, with a sentence for the user
	static ricci::SphereMap
	ComputeSphere(const MeshType& m, const Params& par, ricci::Progress& progress)
	{
		std::vector<int> faceIndex;
		const ricci::DefaultFloatingPoint defaultEnvironment;
		return ricci::mapToSphere(ReadSurface(m, faceIndex), par, progress);
	}

	/// Fills the empty mesh \p sphere with the vertices and faces of \p m, without the deleted ones
	/// but otherwise in their order, at their places on the unit sphere. Vertices without a face lie
	/// at the origin.
	static void BuildSphereMesh(const MeshType& m, const ricci::SphereMap& map, MeshType& sphere)
	{
		std::vector<size_t> index(m.vert.size(), 0);
		VertexIterator vi = Allocator<MeshType>::AddVertices(sphere, size_t(m.vn));
		size_t next = 0;
		for (size_t v = 0; v < m.vert.size(); ++v) {
			if (m.vert[v].IsD())
				continue;
			const ricci::Point3& p = map.positions[v];
			vi->P() = CoordType(ScalarType(p[0]), ScalarType(p[1]), ScalarType(p[2]));
			if (HasPerVertexColor(m) && HasPerVertexColor(sphere))
				vi->C() = m.vert[v].cC();
			index[v] = next++;
			++vi;
		}
		FaceIterator fi = Allocator<MeshType>::AddFaces(sphere, size_t(m.fn));
		for (size_t f = 0; f < m.face.size(); ++f) {
			if (m.face[f].IsD())
				continue;
			for (int k = 0; k < 3; ++k)
				fi->V(k) = &sphere.vert[index[Index(m, m.face[f].cV(k))]];
			++fi;
		}
	}

	/// Fills the empty mesh \p cover with copies of the layout in the Poincaré disk: the component
	/// itself and \p rings rings of neighbours in its universal cover, all within the disk's square
	/// of the texture plane, at z = 0. Each copy has its own colour, where vertices or faces of
	/// \p cover have any.
	/// \throw ricci::InvalidOption if that is more than \p mostFaces faces
	static void BuildUniversalCover(
		const MeshType& m, const Result& r, int rings, size_t mostFaces, MeshType& cover)
	{
		MeshType one;
		BuildFlatMesh(m, r, one);
		std::vector<int> chart(size_t(one.vn), 0); // by its square
		for (size_t v = 0; v < chart.size(); ++v)
			for (size_t i = 0; i < r.disks.size(); ++i)
				if (r.disks[i].IsIn(Point2d(one.vert[v].P()[0], one.vert[v].P()[1])))
					chart[v] = int(i);
		std::vector<ricci::Tiling> tilings;
		size_t most = 0;
		for (const ricci::FuchsianGroup& group : r.groups) {
			const size_t limit = mostFaces / std::max<size_t>(1, size_t(one.fn)) + 2;
			tilings.push_back(ricci::tiling(group.sides, rings, int(limit)));
			most = std::max(most, tilings.back().motions.size());
		}
		if (most * size_t(one.fn) > mostFaces)
			throw ricci::InvalidOption(
				"universal_cover: " + std::to_string(rings) + " rings would need more than " +
				std::to_string(mostFaces) + " faces. Ask for fewer rings, or simplify the mesh.");
		for (size_t copy = 0; copy < most; ++copy) {
			std::vector<VertexType*> place(size_t(one.vn), nullptr);
			size_t vertices = 0, faces = 0;
			const auto has = [&](int i) { return copy < tilings[size_t(i)].motions.size(); };
			for (size_t v = 0; v < place.size(); ++v)
				vertices += has(chart[v]);
			for (const FaceType& f : one.face)
				faces += has(chart[Index(one, f.cV(0))]);
			VertexIterator vi = Allocator<MeshType>::AddVertices(cover, vertices);
			for (size_t v = 0; v < place.size(); ++v) {
				if (!has(chart[v]))
					continue;
				const Box& square = r.disks[size_t(chart[v])];
				const double radius = 0.5 * square.DimX();
				const Point2d middle = square.Center();
				const std::complex<double> z =
					tilings[size_t(chart[v])].motions[copy](std::complex<double>(
						(double(one.vert[v].P()[0]) - middle[0]) / radius,
						(double(one.vert[v].P()[1]) - middle[1]) / radius));
				vi->P() = CoordType(
					ScalarType(middle[0] + radius * z.real()),
					ScalarType(middle[1] + radius * z.imag()),
					ScalarType(0));
				vi->N() = CoordType(0, 0, 1);
				vi->Q() = one.vert[v].Q();
				if (HasPerVertexColor(cover))
					vi->C() = TileColor(copy);
				place[v] = &*vi++;
			}
			FaceIterator fi = Allocator<MeshType>::AddFaces(cover, faces);
			for (const FaceType& f : one.face) {
				if (!has(chart[Index(one, f.cV(0))]))
					continue;
				for (int k = 0; k < 3; ++k)
					fi->V(k) = place[Index(one, f.cV(k))];
				fi->N() = CoordType(0, 0, 1);
				if (HasPerFaceColor(cover))
					fi->C() = TileColor(copy);
				++fi;
			}
		}
	}

	/// Fills the empty mesh \p curves with edges: the axes of the generators in the Poincaré disk,
	/// which are closed geodesics of the surface, each as a polyline of \p pieces edges. Rotations
	/// have no axis.
	static void BuildAxes(const Result& r, int pieces, MeshType& curves)
	{
		for (size_t i = 0; i < r.groups.size(); ++i) {
			std::vector<ricci::DiskIsometry> motions = r.groups[i].handles;
			motions.insert(motions.end(), r.groups[i].ends.begin(), r.groups[i].ends.end());
			for (const ricci::DiskIsometry& g : motions) {
				std::complex<double> from, to;
				if (!g.axis(from, to))
					continue;
				AddGeodesic(r.disks[i], from, to, pieces, curves);
			}
		}
	}

	/// Fills the empty mesh \p curves with edges: for each component a fundamental polygon whose
	/// sides are the letters of the canonical relation (see ricci::canonicalPolygon), 4 g for a
	/// closed surface of genus g, each as a polyline of \p pieces edges in the Poincaré disk.
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
	/// Adds a polyline along the geodesic between two points of the Klein model, where it is
	/// straight, as it is seen in the Poincaré disk inscribed in the box \p disk.
	static void AddGeodesic(
		const Box2d& disk,
		std::complex<double> from,
		std::complex<double> to,
		int pieces,
		MeshType& curves)
	{
		VertexIterator vi = Allocator<MeshType>::AddVertices(curves, size_t(pieces) + 1);
		std::vector<VertexType*> points;
		for (int k = 0; k <= pieces; ++k, ++vi) {
			// Denser towards the ends, where the disk is smaller.
			const double t = 0.5 - 0.5 * std::cos(M_PI * k / pieces);
			const std::complex<double> klein = (1.0 - t) * from + t * to;
			const std::complex<double> z =
				klein / (1.0 + std::sqrt(std::max(0.0, 1.0 - std::norm(klein))));
			const Point2d p = disk.Center() + Point2d(z.real(), z.imag()) * (0.5 * disk.DimX());
			vi->P() = CoordType(ScalarType(p[0]), ScalarType(p[1]), ScalarType(0));
			vi->N() = CoordType(0, 0, 1);
			points.push_back(&*vi);
		}
		typename MeshType::EdgeIterator ei = Allocator<MeshType>::AddEdges(curves, size_t(pieces));
		for (size_t k = 0; k < size_t(pieces); ++k, ++ei) {
			ei->V(0) = points[k];
			ei->V(1) = points[k + 1];
		}
	}

	/// Different for copies that are near to each other in their order; the first one is grey.
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

	typedef typename MeshType::template PerVertexAttributeHandle<ScalarType> VertexAttribute;

	/// The attribute of that name, made anew if there is one of another type.
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

		VertexAttribute u, target;

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

	/// Takes the attributes of a vector of elements away while it grows: vcglib would resize them
	/// after the vector, and copies their names on the way, for which there may be no memory any
	/// more. They get room before, and their size when they are put back.
	template<class Attributes, class Elements>
	class HeldAttributes
	{
	public:
		HeldAttributes(Attributes& attributes, const Elements& elements, size_t added) :
				m_attributes(attributes), m_elements(elements)
		{
			for (auto& attribute : attributes) {
				attribute._handle->Resize(elements.size() + added);
				attribute._handle->Resize(elements.size());
			}
			m_held.swap(attributes);
		}
		~HeldAttributes()
		{
			m_held.swap(m_attributes);
			for (auto& attribute : m_attributes)
				attribute._handle->Resize(m_elements.size());
		}
		HeldAttributes(const HeldAttributes&) = delete;
		HeldAttributes& operator=(const HeldAttributes&) = delete;

	private:
		Attributes m_held;
		Attributes& m_attributes;
		const Elements& m_elements;
	};

	/// Appends elements, all or none.
	static void Append(MeshType& m, size_t vertices, size_t faces)
	{
		const size_t oldVertices = m.vert.size();
		const HeldAttributes<decltype(m.vert_attr), decltype(m.vert)> ofVertices(
			m.vert_attr, m.vert, vertices);
		const HeldAttributes<decltype(m.face_attr), decltype(m.face)> ofFaces(
			m.face_attr, m.face, faces);
		if (vertices > 0)
			Allocator<MeshType>::AddVertices(m, vertices);
		try {
			if (faces > 0)
				Allocator<MeshType>::AddFaces(m, faces);
		}
		catch (...) {
			m.vert.resize(oldVertices);
			m.vn -= int(vertices);
			throw;
		}
	}

	static void SetWedge(FaceType& face, int k, const ricci::Point2& p)
	{
		typedef typename FaceType::TexCoordType::ScalarType TexScalar;
		face.WT(k).U() = TexScalar(p[0]);
		face.WT(k).V() = TexScalar(p[1]);
		face.WT(k).N() = 0;
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

	/// Texture coordinates are floats in every host.
	static void RequireFloats(const std::vector<WedgeUV>& faces)
	{
		for (const WedgeUV& face : faces)
			for (const ricci::Point2& p : face)
				for (double x : p)
					if (!(std::abs(x) <= double(std::numeric_limits<float>::max())))
						throw ricci::InvalidMesh(
							"The mesh is too large for texture coordinates in its own scale: "
							"choose "
							"normalize_uv, or run 'Transform: Scale, Normalize' first.");
	}

	/// Anew, because packing rounds.
	static void CountFlipped(const ricci::Parametrization& flat, ricci::Report& report)
	{
		if (flat.refined.triangles.empty()) {
			ricci::countFlipped(flat.uv, flat.reversed, report);
			return;
		}
		std::vector<char> reversed;
		for (int f : flat.refined.inputFace)
			reversed.push_back(flat.reversed[size_t(f)]);
		ricci::countFlipped(flat.refined.uv, reversed, report);
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

	static ricci::SurfaceMesh ReadSurface(const MeshType& m, std::vector<int>& faceIndex)
	{
		ricci::SurfaceMesh mesh;
		mesh.positions.resize(m.vert.size());
		for (size_t v = 0; v < m.vert.size(); ++v)
			if (!m.vert[v].IsD()) // a deleted vertex may hold anything
				for (int k = 0; k < 3; ++k)
					mesh.positions[v][size_t(k)] = double(m.vert[v].cP()[k]);
		mesh.absent = m.vert.size() - size_t(m.vn);
		size_t damaged = 0;
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
			faceIndex.push_back(int(f));
		}
		if (damaged > 0)
			throw ricci::InvalidMesh(
				std::to_string(damaged) + (damaged == 1 ? " face uses" : " faces use") +
				" vertices that are deleted or not in the mesh: open its file again.");
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

	typedef Box2<double> Box;

	static Box ChartBox(const ricci::Parametrization& flat, const ricci::Chart& chart)
	{
		Box box;
		for (int f : chart.faces)
			for (const ricci::Point2& p : flat.uv[size_t(f)])
				box.Add(Point2d(p[0], p[1]));
		for (int f : chart.refined)
			for (const ricci::Point2& p : flat.refined.uv[size_t(f)])
				box.Add(Point2d(p[0], p[1]));
		return box;
	}

	/// Moves and scales all points of \p chart: p -> scale p + shift.
	static void
	Transform(ricci::Parametrization& flat, const ricci::Chart& chart, double scale, Point2d shift)
	{
		const auto move = [&](WedgeUV& uv) {
			for (ricci::Point2& p : uv)
				p = {scale * p[0] + shift[0], scale * p[1] + shift[1]};
		};
		for (int f : chart.faces)
			move(flat.uv[size_t(f)]);
		for (int f : chart.refined)
			move(flat.refined.uv[size_t(f)]);
	}

	/// Places the charts' bounding boxes side by side, then scales the whole into [0,1]^2 if asked.
	static void PackCharts(ricci::Parametrization& flat, bool normalize, double margin)
	{
		if (!(margin >= 0.0 && margin <= kMostMargin))
			throw ricci::InvalidOption(
				"chart_margin must be between 0 and " + std::to_string(kMostMargin) + ".");
		std::vector<Box> boxes;
		for (const ricci::Chart& chart : flat.charts)
			boxes.push_back(ChartBox(flat, chart));
		// The margin is a share of a square that grows with the margin.
		std::vector<Point2d> shift;
		double size = 0.0, room = 0.0;
		Box whole;
		for (int attempt = 0; attempt == 0 || room < margin * size; ++attempt) {
			if (attempt == 60 || !BoxesSideBySide::MayFit(boxes.size(), margin))
				throw ricci::InvalidOption(
					"A chart_margin of " + std::to_string(margin) + " leaves no room for " +
					std::to_string(boxes.size()) + " charts: choose a smaller one.");
			room = (1.0 + 1e-6) * margin * size;
			shift = BoxesSideBySide::Shifts(boxes, room);
			whole = Box();
			for (size_t i = 0; i < boxes.size(); ++i) {
				whole.Add(boxes[i].min + shift[i]);
				whole.Add(boxes[i].max + shift[i]);
			}
			size = std::max(whole.DimX(), whole.DimY()) + 2.0 * room;
		}
		const Point2d corner = whole.min - Point2d(room, room);
		const double scale = normalize ? 1.0 / size : 1.0;
		for (size_t i = 0; i < boxes.size(); ++i)
			if (normalize || boxes.size() > 1)
				Transform(
					flat,
					flat.charts[i],
					scale,
					normalize ? (shift[i] - corner) * scale : shift[i]);
		if (!normalize) {
			RequireFloats(flat.uv);
			RequireFloats(flat.refined.uv);
			return;
		}
		ClampToUnitSquare(flat);
	}

	/// Rounding may leave the square by one unit.
	static void ClampToUnitSquare(ricci::Parametrization& flat)
	{
		for (std::vector<WedgeUV>* faces : {&flat.uv, &flat.refined.uv})
			for (WedgeUV& face : *faces)
				for (ricci::Point2& p : face)
					for (double& x : p)
						x = std::min(std::max(x, 0.0), 1.0);
	}

	/// The arrays of \p flat, in the indices of the mesh.
	static void TakeOver(
		ricci::Parametrization& flat, size_t faces, const std::vector<int>& faceIndex, Result& r)
	{
		r.wedgeUV.resize(faces);
		for (size_t f = 0; f < faceIndex.size(); ++f)
			r.wedgeUV[size_t(faceIndex[f])] = flat.uv[f];
		r.vertexQC = std::move(flat.vertexQC);
		r.u = std::move(flat.u);
		r.targetCurvature = std::move(flat.targetCurvature);
		r.refined = std::move(flat.refined);
		for (int& f : r.refined.inputFace)
			f = faceIndex[size_t(f)];
	}
};

} // namespace tri
} // namespace vcg

#endif
