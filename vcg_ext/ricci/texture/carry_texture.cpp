// SPDX-License-Identifier: GPL-3.0-or-later
#include "carry_texture.h"

#include "../base/crew.h"
#include "../base/indexed.h"
#include "../base/parallel.h"
#include "../base/task.h"
#include "old_charts.h"
#include "picture_sampler.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ricci {

namespace {

/// Texels that a bilinear sample on the edge of a chart can read lie nearer.
constexpr double kContinued = 1.5;

/// Texels are drawn in squares of this many, whose triangles stay in the cache.
constexpr int kTile = 64;

/// Which triangle each texel shows.
class Sources
{
public:
	Sources(const CarriedMesh& mesh, int size) :
			m_view{size, size, nullptr}, m_sources(m_view.texels(), kNone)
	{
		const std::vector<CarriedTriangle>& triangles = mesh.triangles;
		for (std::size_t i = 0; i < triangles.size(); ++i) {
			checkpointNowAndThen(64 * i);
			forEachTexelOf(texels(triangles[i]), kOnSide, 0, size - 1, [&](int x, int y) {
				int& source = m_sources[m_view.index(x, y)];
				if (source == kNone)
					source = static_cast<int>(i);
			});
		}
		for (std::size_t i = 0; i < triangles.size(); ++i) {
			checkpointNowAndThen(64 * i);
			const Triangle2 t = texels(triangles[i]);
			forEachTexelOf(t, kContinued, 0, size - 1, [&](int x, int y) {
				int& source = m_sources[m_view.index(x, y)];
				if (source >= 0)
					return;
				const Point2 middle{x + 0.5, y + 0.5};
				const double apart = apartFrom(t, middle);
				if (apart > kContinued)
					return;
				if (source == kNone ||
					apart < apartFrom(texels(triangles[positionOf(beside(source))]), middle))
					source = -static_cast<int>(i) - 2;
			});
		}
	}

	/// -1: none
	int triangle(std::size_t texel) const
	{
		const int source = m_sources[texel];
		return source >= kNone ? source : beside(source);
	}
	/// Whether the texel's middle is in that triangle, not only near it.
	bool inside(std::size_t texel) const { return m_sources[texel] >= 0; }

	std::vector<char> covered() const
	{
		std::vector<char> covered(m_sources.size());
		for (std::size_t i = 0; i < m_sources.size(); ++i)
			covered[i] = m_sources[i] != kNone;
		return covered;
	}

private:
	Triangle2 texels(const CarriedTriangle& t) const
	{
		return inTexels(t.uv, m_view.width, m_view.height);
	}
	static double apartFrom(const Triangle2& t, const Point2& p)
	{
		return distance(p, pointOf(t, nearestInTriangle(t, p)));
	}
	static int beside(int source) { return -source - 2; }

	static constexpr int kNone = -1;

	PictureView<const char> m_view;
	std::vector<int> m_sources; // triangle; -triangle - 2 beside it
};

/// One triangle, with the maps to its face.
class TriangleMap
{
public:
	/// \param corners of the triangle in texels of the result
	TriangleMap(const Triangle2& corners, const CarriedTriangle& triangle, const Triangle2& old) :
			m_new(corners)
	{
		for (std::size_t k = 0; k < 3; ++k)
			m_old[k] = pointOf(old, triangle.corners[k]);
		m_area = doubledArea(m_new);
		double longest = 0.0;
		for (std::size_t k = 0; k < 3; ++k)
			longest = std::max(longest, distance(m_old[k], m_old[(k + 1) % 3]));
		// What a texel shows of its surroundings when it is larger than the triangle; without a bound
		// needles would be mixed from everywhere.
		m_reach = std::max(1.0, 4.0 * longest);
	}

	/// What the map makes of a texel.
	Footprint footprint() const
	{
		return {bounded(difference({1, 0})), bounded(difference({0, 1}))};
	}

	/// Barycentric coordinates of a point in the triangle, up to rounding.
	Point3 weights(const Point2& p) const { return nearestInTriangle(m_new, p); }

	Point2 old(const Point3& weights) const { return pointOf(m_old, weights); }

	/// The map continued to \p p beside the triangle.
	/// \param weights of the point of the triangle that is nearest to p
	/// \return the old place of this one where that of p would be far away
	Point2 continued(const Point2& p, const Point3& weights) const
	{
		const Point2 nearest = old(weights), step = difference(p - pointOf(m_new, weights));
		return length(step) <= m_reach ? nearest + step : nearest;
	}

private:
	/// The linear part of the map applied to d; 0 where the triangle has no area.
	Point2 difference(const Point2& d) const
	{
		if (m_area == 0.0)
			return {0, 0};
		const double s = cross(d, m_new[2] - m_new[0]) / m_area;
		const double t = cross(m_new[1] - m_new[0], d) / m_area;
		return s * (m_old[1] - m_old[0]) + t * (m_old[2] - m_old[0]);
	}

	Point2 bounded(const Point2& side) const
	{
		const double size = length(side);
		return size > m_reach ? m_reach / size * side : side;
	}

	Triangle2 m_new, m_old; // in texels
	double m_area = 0.0, m_reach = 0.0;
};

/// The colour of a point of a face without a picture.
template<class Sample>
void writeColour(
	const TexturedFace& face,
	const CarriedTriangle& triangle,
	const Point3& weights,
	bool hasAlpha,
	Sample* rgba)
{
	const double most = std::numeric_limits<Sample>::max();
	for (std::size_t c = 0; c < 4; ++c) {
		double colour = 0.0;
		for (std::size_t k = 0; k < 3; ++k)
			for (std::size_t j = 0; j < 3; ++j)
				colour +=
					weights[k] * triangle.corners[k][j] * static_cast<double>(face.colour[j][c]);
		rgba[c] = static_cast<Sample>(std::lround(std::clamp(most * colour, 0.0, most)));
	}
	if (!hasAlpha)
		rgba[3] = std::numeric_limits<Sample>::max();
}

/// Draws the texels of all triangles in one old picture after the other.
template<class Sample>
class TextureDrawing
{
public:
	TextureDrawing(
		const CarriedMesh& mesh,
		const Sources& sources,
		const std::vector<int>& charts,
		bool hasAlpha,
		const PictureView<Sample>& result,
		int threads) :
			m_mesh(mesh),
			m_sources(sources), m_charts(charts), m_hasAlpha(hasAlpha), m_result(result),
			m_threads(threads), m_inARow((result.width + kTile - 1) / kTile),
			m_rows((result.height + kTile - 1) / kTile),
			m_pictures(positionOf(m_inARow) * positionOf(m_rows))
	{
		const auto isAny = [](const std::vector<int>&) { return true; };
		forEachRun(isAny, [&](std::size_t tile, const Run&, const CarriedTriangle& triangle) {
			const int picture = m_mesh.faces[positionOf(triangle.face)].picture;
			if (!contains(m_pictures[tile], picture))
				m_pictures[tile].push_back(picture);
		});
	}

	/// [picture] the level of the largest blocks in which texels of the result read it
	std::vector<int> lastLevels(const std::vector<PictureView<const Sample>>& pictures) const
	{
		std::vector<int> levels(pictures.size(), 0);
		for (std::size_t i = 0; i < m_mesh.triangles.size(); ++i) {
			checkpointNowAndThen(i);
			const CarriedTriangle& triangle = m_mesh.triangles[i];
			const int picture = m_mesh.faces[positionOf(triangle.face)].picture;
			if (picture < 0)
				continue;
			const auto& [width, height, samples] = pictures[positionOf(picture)];
			int& level = levels[positionOf(picture)];
			level = std::max(level, mapOf(triangle, width, height).footprint().level());
		}
		for (std::size_t i = 0; i < levels.size(); ++i)
			levels[i] =
				std::min(levels[i], Blocks{pictures[i].width, pictures[i].height}.lastLevel());
		return levels;
	}

	/// The faces with one old picture.
	/// \param owners which chart each texel of it belongs to
	void draw(int picture, const OldOwners& owners, const PictureSampler<Sample>& sampler) const
	{
		forEachRunOf(picture, [&](const Run& run, const CarriedTriangle& triangle) {
			drawRun(run, triangle, owners, sampler);
		});
	}

	/// The faces without a picture.
	void drawColours() const
	{
		forEachRunOf(-1, [&](const Run& run, const CarriedTriangle& triangle) {
			const TriangleMap map = mapOf(triangle, 0, 0);
			for (int x = run.first; x < run.last; ++x)
				writeColour(
					m_mesh.faces[positionOf(triangle.face)],
					triangle,
					map.weights({x + 0.5, run.y + 0.5}),
					m_hasAlpha,
					m_result.rgba + 4 * m_result.index(x, run.y));
		});
	}

private:
	/// Texels of a row that show one triangle.
	struct Run
	{
		int y, first, last; // last is not in it
	};

	static bool contains(const std::vector<int>& numbers, int number)
	{
		return std::find(numbers.begin(), numbers.end(), number) != numbers.end();
	}

	/// Calls visit(tile, run, its triangle) for the runs of each tile, in many threads, where concerns(the tile's pictures).
	template<class Concerns, class Visit>
	void forEachRun(const Concerns& concerns, const Visit& visit) const
	{
		tasksInParallel(m_rows, m_threads, [&](int row) {
			for (int i = 0; i < m_inARow; ++i) {
				const std::size_t tile = positionOf(row * m_inARow + i);
				if (!concerns(m_pictures[tile]))
					continue;
				advance(static_cast<double>(row) / m_rows, "Drawing the texture");
				const int end = std::min((i + 1) * kTile, m_result.width);
				for (int y = row * kTile; y < std::min((row + 1) * kTile, m_result.height); ++y)
					for (int x = i * kTile; x < end;) {
						const int number = m_sources.triangle(m_result.index(x, y)), first = x;
						do
							++x;
						while (x < end && m_sources.triangle(m_result.index(x, y)) == number);
						if (number >= 0)
							visit(tile, Run{y, first, x}, m_mesh.triangles[positionOf(number)]);
					}
			}
		});
	}

	/// Calls visit(run, its triangle) for the runs of the faces with a picture; -1: without one.
	template<class Visit>
	void forEachRunOf(int picture, const Visit& visit) const
	{
		const auto shows = [&](const std::vector<int>& pictures) {
			return contains(pictures, picture);
		};
		forEachRun(shows, [&](std::size_t, const Run& run, const CarriedTriangle& triangle) {
			if (m_mesh.faces[positionOf(triangle.face)].picture == picture)
				visit(run, triangle);
		});
	}

	/// \param width, height of its picture
	TriangleMap mapOf(const CarriedTriangle& triangle, int width, int height) const
	{
		return TriangleMap(
			inTexels(triangle.uv, m_result.width, m_result.height),
			triangle,
			oldTexels(m_mesh.faces[positionOf(triangle.face)], width, height));
	}

	void drawRun(
		const Run& run,
		const CarriedTriangle& triangle,
		const OldOwners& owners,
		const PictureSampler<Sample>& sampler) const
	{
		const TriangleMap map = mapOf(triangle, sampler.picture().width, sampler.picture().height);
		const OldOwners::Chart chart = owners.of(m_charts[positionOf(triangle.face)]);
		const Footprint footprint = map.footprint();
		for (int x = run.first; x < run.last; ++x) {
			const std::size_t texel = m_result.index(x, run.y);
			const Point2 middle{x + 0.5, run.y + 0.5};
			const Point3 weights = map.weights(middle);
			Sample* rgba = m_result.rgba + 4 * texel;
			if (!m_sources.inside(texel) &&
				sampler.mean(map.continued(middle, weights), footprint, chart, rgba))
				continue;
			const Point2 nearest = map.old(weights);
			if (!sampler.mean(nearest, footprint, chart, rgba))
				sampler.nearest(nearest, chart, rgba);
		}
	}

	const CarriedMesh& m_mesh;
	const Sources& m_sources;
	const std::vector<int>& m_charts;
	bool m_hasAlpha;
	const PictureView<Sample>& m_result;
	int m_threads;
	int m_inARow, m_rows;                     // of tiles
	std::vector<std::vector<int>> m_pictures; // [tile] that it shows; -1 for none
};

/// [picture] its faces; the last: those without one
std::vector<std::vector<int>> facesOfPictures(const CarriedMesh& mesh, std::size_t pictures)
{
	std::vector<std::vector<int>> faces(pictures + 1);
	for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
		const int picture = mesh.faces[f].picture;
		faces[picture < 0 ? pictures : positionOf(picture)].push_back(static_cast<int>(f));
	}
	return faces;
}

double area(const Triangle2& t)
{
	return 0.5 * std::abs(doubledArea(t));
}

} // namespace

template<class Sample>
void carryTexture(
	const CarriedMesh& mesh,
	const std::vector<PictureView<const Sample>>& pictures,
	bool hasAlpha,
	const PictureView<Sample>& result,
	int threads)
{
	const Crew crew;
	const std::vector<std::vector<int>> faces = facesOfPictures(mesh, pictures.size());
	const std::vector<int> charts = oldCharts(mesh.faces);
	std::vector<char> covered;
	{
		const Sources sources(mesh, result.width);
		const TextureDrawing<Sample> drawing(mesh, sources, charts, hasAlpha, result, threads);
		const std::vector<int> lastLevels = drawing.lastLevels(pictures);
		for (std::size_t i = 0; i < pictures.size(); ++i) {
			if (faces[i].empty())
				continue;
			const PictureView<const Sample>& view = pictures[i];
			OldOwners owners(mesh.faces, charts, faces[i], view.width, view.height);
			owners.addLevels(lastLevels[i]);
			drawing.draw(
				static_cast<int>(i), owners, PictureSampler<Sample>(view, hasAlpha, lastLevels[i]));
		}
		if (!faces.back().empty())
			drawing.drawColours();
		covered = sources.covered();
	}
	fillFromNearest(covered, result, threads);
}

template void carryTexture(
	const CarriedMesh&,
	const std::vector<PictureView<const unsigned char>>&,
	bool,
	const PictureView<unsigned char>&,
	int);
template void carryTexture(
	const CarriedMesh&,
	const std::vector<PictureView<const unsigned short>>&,
	bool,
	const PictureView<unsigned short>&,
	int);

TexelDensity texelDensity(
	const CarriedMesh& mesh,
	const std::vector<double>& faceAreas,
	const std::vector<std::array<int, 2>>& pictures,
	int size)
{
	double total = 0.0, before = 0.0, after = 0.0, ratio = 0.0;
	for (const CarriedTriangle& triangle : mesh.triangles) {
		const TexturedFace& face = mesh.faces[positionOf(triangle.face)];
		if (face.picture < 0)
			continue;
		const auto& [width, height] = pictures[positionOf(face.picture)];
		const Triangle2 old = oldTexels(face, width, height);
		const auto& c = triangle.corners;
		const double share =
			2.0 * area({{{c[0][1], c[0][2]}, {c[1][1], c[1][2]}, {c[2][1], c[2][2]}}});
		const double inSpace = share * faceAreas[positionOf(triangle.face)];
		const double oldArea = share * area(old);
		const double newArea = area(inTexels(triangle.uv, size, size));
		if (!(inSpace > 0.0 && oldArea > 0.0))
			continue;
		total += inSpace;
		before += std::sqrt(inSpace * oldArea);
		after += std::sqrt(inSpace * newArea);
		ratio += inSpace * std::sqrt(newArea / oldArea);
	}
	TexelDensity density;
	if (total > 0.0) {
		density.before = before / total;
		density.after = after / total;
		density.ratio = ratio / total;
	}
	return density;
}

} // namespace ricci
