// SPDX-License-Identifier: GPL-3.0-or-later
// A square of triangles with a picture of a known function.
#ifndef RICCI_TESTS_PAINTED_SQUARE_H
#define RICCI_TESTS_PAINTED_SQUARE_H

#include "support/flat_meshes.h"
#include "support/random.h"

#include <ricci/base/indexed.h>
#include <ricci/texture/carry_texture.h>
#include <ricci/texture/picture.h>

#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <numeric>
#include <vector>

namespace ricci::testing {

/// A picture that owns its samples.
template<class Sample>
struct Picture
{
	Picture(int w, int h) : width(w), height(h), rgba(4 * static_cast<std::size_t>(w * h), 0) {}

	PictureView<const Sample> view() const { return {width, height, rgba.data()}; }
	PictureView<Sample> target() { return {width, height, rgba.data()}; }
	Sample* at(int x, int y) { return &rgba[4 * static_cast<std::size_t>(y * width + x)]; }
	const Sample* at(int x, int y) const
	{
		return &rgba[4 * static_cast<std::size_t>(y * width + x)];
	}

	int width, height;
	std::vector<Sample> rgba;
};

/// The unit square of n x n cells of two triangles; the places of its corners are also its first map.
struct Square
{
	explicit Square(int n)
	{
		const SurfaceMesh mesh = rectangle(n, n, 1.0, 1.0);
		triangles = mesh.triangles;
		place = flatMesh(mesh).corners().values();
	}

	std::vector<Triangle> triangles;
	std::vector<Triangle2> place;
};

/// A square of two triangles from (x, y).
inline std::vector<Triangle2> box(double x, double y, double width, double height)
{
	const Point2 a{x, y}, b{x + width, y}, c{x + width, y + height}, d{x, y + height};
	return {Triangle2{a, b, c}, Triangle2{a, c, d}};
}

/// An atlas of one cell for two triangles, without space between them, in random order: as MeshLab's own.
inline std::vector<Triangle2> shatteredAtlas(std::size_t triangles, Random& random)
{
	std::vector<Triangle2> atlas(triangles);
	std::vector<std::size_t> order(triangles);
	std::iota(order.begin(), order.end(), std::size_t(0));
	random.shuffle(order);
	const int cells =
		static_cast<int>(std::ceil(std::sqrt(static_cast<double>((triangles + 1) / 2))));
	for (std::size_t i = 0; i < triangles; ++i) {
		const double side = 1.0 / cells;
		const double x = side * static_cast<double>(i / 2 % static_cast<std::size_t>(cells));
		const double y = side * static_cast<double>(i / 2 / static_cast<std::size_t>(cells));
		atlas[order[i]] = box(x, y, side, side)[i % 2];
	}
	return atlas;
}

/// Every triangle by itself, with another map in place of each corner.
inline std::vector<Triangle2>
mapped(const std::vector<Triangle2>& triangles, const std::function<Point2(const Point2&)>& map)
{
	std::vector<Triangle2> result = triangles;
	for (Triangle2& t : result)
		for (Point2& p : t)
			p = map(p);
	return result;
}

inline CarriedMesh carriedMesh(
	const Square& square, const std::vector<Triangle2>& old, const std::vector<Triangle2>& next)
{
	CarriedMesh mesh;
	for (std::size_t i = 0; i < old.size(); ++i) {
		TexturedFace face;
		face.vertices = square.triangles[i];
		face.uv = old[i];
		face.picture = 0;
		mesh.faces.push_back(face);
		CarriedTriangle triangle;
		triangle.uv = next[i];
		triangle.face = static_cast<int>(i);
		mesh.triangles.push_back(triangle);
	}
	return mesh;
}

/// The first triangle of an atlas that a texel's middle lies in, and where; -1: none.
struct Hit
{
	int triangle = -1;
	Point3 weights{};
};

/// visit(texel, hit) for the texels of a picture whose middles lie in a triangle of the atlas.
template<class Visit>
void forHits(const std::vector<Triangle2>& atlas, int width, int height, const Visit& visit)
{
	std::vector<Hit> found(static_cast<std::size_t>(width * height));
	for (std::size_t i = 0; i < atlas.size(); ++i) {
		const Triangle2 t = inTexels(atlas[i], width, height);
		forEachTexelOf(t, 1e-9, 0, std::max(width, height) - 1, [&](int x, int y) {
			if (x >= width || y >= height)
				return;
			Hit& hit = found[static_cast<std::size_t>(y * width + x)];
			if (hit.triangle < 0)
				hit = {static_cast<int>(i), nearestInTriangle(t, {x + 0.5, y + 0.5})};
		});
	}
	for (std::size_t i = 0; i < found.size(); ++i)
		if (found[i].triangle >= 0)
			visit(i, found[i]);
}

/// Where on the square a texel lies.
inline Point2 placeOf(const Square& square, const Hit& hit)
{
	return pointOf(square.place[positionOf(hit.triangle)], hit.weights);
}

/// A smooth function of the place on the square, between 0 and 1, of each of three channels.
inline double painted(const Point2& p, std::size_t channel)
{
	const double phase = 1.3 * static_cast<double>(channel);
	return 0.5 + 0.25 * std::sin(3.0 * p[0] + phase) + 0.25 * std::cos(4.0 * p[1] - phase);
}

/// Bounds of its derivatives: the gradient and the second derivatives along the axes.
constexpr double kGradient = 1.25, kSecond = 2.25 + 4.0;

/// That function in every texel of an atlas; black elsewhere.
template<class Sample>
Picture<Sample>
paint(const Square& square, const std::vector<Triangle2>& atlas, int width, int height)
{
	Picture<Sample> picture(width, height);
	forHits(atlas, width, height, [&](std::size_t texel, const Hit& hit) {
		for (std::size_t c = 0; c < 3; ++c)
			picture.rgba[4 * texel + c] = static_cast<Sample>(
				std::round(painted(placeOf(square, hit), c) * std::numeric_limits<Sample>::max()));
		picture.rgba[4 * texel + 3] = std::numeric_limits<Sample>::max();
	});
	return picture;
}

template<class Sample>
Picture<Sample> carried(
	const CarriedMesh& mesh,
	const std::vector<const Picture<Sample>*>& old,
	int size,
	bool hasAlpha = false,
	int threads = 1)
{
	std::vector<PictureView<const Sample>> views;
	for (const Picture<Sample>* picture : old)
		views.push_back(picture->view());
	Picture<Sample> result(size, size);
	carryTexture<Sample>(mesh, views, hasAlpha, result.target(), threads);
	return result;
}

/// Largest and root mean square difference from the function in the texels of the triangles.
struct Difference
{
	double worst = 0.0, rms = 0.0;
};

template<class Sample>
Difference difference(
	const Square& square, const std::vector<Triangle2>& atlas, const Picture<Sample>& picture)
{
	Difference d;
	double sum = 0.0, count = 0.0;
	forHits(atlas, picture.width, picture.height, [&](std::size_t texel, const Hit& hit) {
		for (std::size_t c = 0; c < 3; ++c) {
			const double sample = picture.rgba[4 * texel + c];
			const double off = std::abs(
				sample / std::numeric_limits<Sample>::max() - painted(placeOf(square, hit), c));
			d.worst = std::max(d.worst, off);
			sum += off * off;
			++count;
		}
	});
	d.rms = std::sqrt(sum / std::max(count, 1.0));
	return d;
}

} // namespace ricci::testing

#endif
