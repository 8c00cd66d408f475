/****************************************************************************
 * Generalized discrete Ricci flow on VCG meshes                             *
 * An extension of the VCG Library                                           *
 * SPDX-License-Identifier: GPL-3.0-or-later                                 *
 ****************************************************************************/
#ifndef __VCGLIB_RICCI_FLOW
#define __VCGLIB_RICCI_FLOW

#include <ricci/error.h>
#include <ricci/options.h>
#include <ricci/parametrize.h>
#include <ricci/progress.h>
#include <ricci/report.h>

#include <vcg/complex/allocate.h>
#include <vcg/complex/complex.h>
#include <vcg/space/rect_packer.h>

#include <algorithm>
#include <array>
#include <cmath>
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
	typedef typename MeshType::ScalarType     ScalarType;
	typedef typename MeshType::CoordType      CoordType;
	typedef typename MeshType::VertexType     VertexType;
	typedef typename MeshType::VertexIterator VertexIterator;
	typedef typename MeshType::FaceType       FaceType;
	typedef typename MeshType::FaceIterator   FaceIterator;

	/// One point of the plane for each corner of a face.
	typedef std::array<ricci::Point2, 3> WedgeUV;

	struct Params : public ricci::Options
	{
		/// Fit the charts into [0,1]^2, all with one scale and their aspect kept; false: keep the scale
		/// at which a chart has the area of its component (or its boundary the input's length).
		bool normalizeUV = true;
	};

	/// Everything that a run computed, indexed like the mesh's face and vertex vectors (deleted
	/// elements included; their entries mean nothing).
	struct Result
	{
		ricci::Report            report;
		std::vector<std::string> notes;   ///< what was done without being asked
		std::vector<WedgeUV>     wedgeUV; ///< [face][corner] charts packed, normalised if asked
		std::vector<double>      vertexQC; ///< area-weighted mean of sigma1 / sigma2 round the vertex
		std::vector<double>      faceQC;
		std::vector<double>      u;               ///< ln radius of the vertex circle
		std::vector<double>      targetCurvature; ///< radians
	};

	/// Computes; \p m is only read: positions, faces, selected vertices (Rectangle, SelectedCones),
	/// vertex quality as curvature in radians (Prescribed).
	/// \throw ricci::Error and its derived classes, with a sentence for the user
	static Result Compute(const MeshType& m, const Params& par, ricci::Progress& progress)
	{
		std::vector<int>        faceIndex; // [compact] -> index in m.face
		const ricci::SurfaceMesh mesh  = ReadSurface(m, faceIndex);
		const ricci::VertexInput input = ReadVertexInput(m, par);
		ricci::Parametrization   flat  = ricci::parametrizeEuclidean(mesh, input, par, progress);

		Result r;
		r.report = flat.report;
		r.notes  = flat.notes;
		PackCharts(flat, par.normalizeUV);
		r.wedgeUV.resize(m.face.size());
		r.faceQC.assign(m.face.size(), 1.0);
		for (size_t f = 0; f < faceIndex.size(); ++f) {
			r.wedgeUV[size_t(faceIndex[f])] = flat.uv[f];
			r.faceQC[size_t(faceIndex[f])]  = flat.faceQC[f];
		}
		r.vertexQC        = std::move(flat.vertexQC);
		r.u               = std::move(flat.u);
		r.targetCurvature = std::move(flat.targetCurvature);
		return r;
	}

	/// Writes wedge texture coordinates, texture index 0. They must be enabled on \p m.
	static void WriteWedgeTexCoord(MeshType& m, const Result& r)
	{
		RequirePerFaceWedgeTexCoord(m);
		for (size_t f = 0; f < m.face.size(); ++f) {
			if (m.face[f].IsD())
				continue;
			for (int k = 0; k < 3; ++k) {
				typedef typename FaceType::TexCoordType::ScalarType TexScalar;
				m.face[f].WT(k).U() = TexScalar(r.wedgeUV[f][size_t(k)][0]);
				m.face[f].WT(k).V() = TexScalar(r.wedgeUV[f][size_t(k)][1]);
				m.face[f].WT(k).N() = 0;
			}
		}
	}

	/// Writes the distortion as vertex quality (and as face quality where that is enabled), and the
	/// per-vertex attributes of type ScalarType "ricci_u" and "ricci_target_curvature".
	static void WriteVertexQuality(MeshType& m, const Result& r)
	{
		RequirePerVertexQuality(m);
		typename MeshType::template PerVertexAttributeHandle<ScalarType> u =
			Allocator<MeshType>::template GetPerVertexAttribute<ScalarType>(m, "ricci_u");
		typename MeshType::template PerVertexAttributeHandle<ScalarType> target =
			Allocator<MeshType>::template GetPerVertexAttribute<ScalarType>(
				m, "ricci_target_curvature");
		for (size_t v = 0; v < m.vert.size(); ++v) {
			if (m.vert[v].IsD())
				continue;
			m.vert[v].Q() = typename VertexType::QualityType(r.vertexQC[v]);
			u[v]          = ScalarType(r.u[v]);
			target[v]     = ScalarType(r.targetCurvature[v]);
		}
	}

	/// Fills the empty mesh \p flat with the layout: its vertices are the vertices of \p m, once for
	/// each place they have in the plane, at z = 0, with their quality; wedge texture coordinates are
	/// written where they are enabled on \p flat.
	static void BuildFlatMesh(const MeshType& m, const Result& r, MeshType& flat)
	{
		typedef std::pair<size_t, ricci::Point2> Place; // vertex, point
		std::map<Place, size_t>                  index;
		std::vector<Place>                       places;
		std::vector<std::array<size_t, 3>>       faces;
		for (size_t f = 0; f < m.face.size(); ++f) {
			if (m.face[f].IsD())
				continue;
			std::array<size_t, 3> corner;
			for (int k = 0; k < 3; ++k) {
				const Place place(Index(m, m.face[f].cV(k)), r.wedgeUV[f][size_t(k)]);
				const auto  found = index.insert(std::make_pair(place, places.size()));
				if (found.second)
					places.push_back(place);
				corner[size_t(k)] = found.first->second;
			}
			faces.push_back(corner);
		}
		Allocator<MeshType>::AddVertices(flat, places.size());
		for (size_t i = 0; i < places.size(); ++i) {
			const ricci::Point2& p = places[i].second;
			flat.vert[i].P()       = CoordType(ScalarType(p[0]), ScalarType(p[1]), ScalarType(0));
			flat.vert[i].N()       = CoordType(0, 0, 1);
			flat.vert[i].Q() = typename VertexType::QualityType(r.vertexQC[places[i].first]);
		}
		FaceIterator fi = Allocator<MeshType>::AddFaces(flat, faces.size());
		for (size_t f = 0; f < faces.size(); ++f, ++fi) {
			for (int k = 0; k < 3; ++k)
				fi->V(k) = &flat.vert[faces[f][size_t(k)]];
			fi->N() = CoordType(0, 0, 1);
			if (HasPerWedgeTexCoord(flat))
				for (int k = 0; k < 3; ++k) {
					typedef typename FaceType::TexCoordType::ScalarType TexScalar;
					fi->WT(k).U() = TexScalar(places[faces[f][size_t(k)]].second[0]);
					fi->WT(k).V() = TexScalar(places[faces[f][size_t(k)]].second[1]);
					fi->WT(k).N() = 0;
				}
		}
	}

private:
	static ricci::SurfaceMesh ReadSurface(const MeshType& m, std::vector<int>& faceIndex)
	{
		ricci::SurfaceMesh mesh;
		mesh.positions.resize(m.vert.size());
		for (size_t v = 0; v < m.vert.size(); ++v)
			if (!m.vert[v].IsD()) // a deleted vertex may hold anything
				for (int k = 0; k < 3; ++k)
					mesh.positions[v][size_t(k)] = double(m.vert[v].cP()[k]);
		for (size_t f = 0; f < m.face.size(); ++f) {
			if (m.face[f].IsD())
				continue;
			ricci::Triangle t;
			for (int k = 0; k < 3; ++k)
				t[size_t(k)] = int(Index(m, m.face[f].cV(k)));
			mesh.triangles.push_back(t);
			faceIndex.push_back(int(f));
		}
		if (m.vn == 0)
			mesh.positions.clear();
		return mesh;
	}

	static ricci::VertexInput ReadVertexInput(const MeshType& m, const Params& par)
	{
		typedef typename VertexType::QualityType QualityType;
		ricci::VertexInput                       input;
		if (par.target == ricci::TargetCurvature::Rectangle ||
			par.target == ricci::TargetCurvature::SelectedCones)
			for (size_t v = 0; v < m.vert.size(); ++v)
				input.selected.push_back(!m.vert[v].IsD() && m.vert[v].IsS());
		if (par.target == ricci::TargetCurvature::Prescribed)
			for (size_t v = 0; v < m.vert.size(); ++v)
				input.targetCurvature.push_back(m.vert[v].IsD() ? 0.0 : double(m.vert[v].cQ()));
		input.precision = double(std::numeric_limits<QualityType>::epsilon());
		return input;
	}

	typedef Box2<double> Box;

	static Box ChartBox(const ricci::Parametrization& flat, const ricci::Chart& chart)
	{
		Box box;
		for (int f : chart.faces)
			for (const ricci::Point2& p : flat.uv[size_t(f)])
				box.Add(Point2d(p[0], p[1]));
		return box;
	}

	/// Moves and scales all points of \p chart: p -> scale p + shift.
	static void
	Transform(ricci::Parametrization& flat, const ricci::Chart& chart, double scale, Point2d shift)
	{
		for (int f : chart.faces)
			for (ricci::Point2& p : flat.uv[size_t(f)])
				p = {scale * p[0] + shift[0], scale * p[1] + shift[1]};
	}

	/// Places the charts' bounding boxes side by side, then scales the whole into [0,1]^2 if asked.
	static void PackCharts(ricci::Parametrization& flat, bool normalize)
	{
		std::vector<Box> boxes;
		for (const ricci::Chart& chart : flat.charts)
			boxes.push_back(ChartBox(flat, chart));
		if (flat.charts.size() > 1) {
			std::vector<Similarity2<double>> place = PackBoxes(boxes);
			for (size_t i = 0; i < place.size(); ++i) // undo the common scale
				Transform(flat, flat.charts[i], 1.0, place[i].tra / place[i].sca);
		}
		if (!normalize)
			return;
		Box whole;
		for (const ricci::Chart& chart : flat.charts)
			whole.Add(ChartBox(flat, chart));
		const double size = std::max(whole.DimX(), whole.DimY());
		for (const ricci::Chart& chart : flat.charts)
			Transform(flat, chart, 1.0 / size, -whole.min / size);
		for (WedgeUV& face : flat.uv) // rounding may leave the square by one unit
			for (ricci::Point2& p : face)
				for (double& x : p)
					x = std::min(std::max(x, 0.0), 1.0);
	}

	/// vcglib's rectangle packer on a grid fine enough for the number of boxes. It refuses what does
	/// not fit, so the wanted occupancy is lowered until it agrees.
	static std::vector<Similarity2<double>> PackBoxes(const std::vector<Box>& boxes)
	{
		const int grid = std::max(256, 16 * int(std::ceil(std::sqrt(double(boxes.size())))));
		double    area = 0.0, longest = 0.0;
		for (const Box& box : boxes) {
			area += box.DimX() * box.DimY();
			longest = std::max(longest, std::max(box.DimX(), box.DimY()));
		}
		// A box must stay below the grid's own size.
		const double most = (grid - 2) / longest / grid * std::sqrt(area);
		double       occupancy = std::min(0.9, most * most);
		std::vector<Similarity2<double>> place;
		Point2d                          covered;
		while (!RectPacker<double>::PackOccupancy(
			boxes, Point2i(grid, grid), occupancy, place, covered))
			occupancy *= 0.85;
		return place;
	}
};

} // namespace tri
} // namespace vcg

#endif
