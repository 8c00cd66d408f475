// SPDX-License-Identifier: GPL-3.0-or-later
#include "painted_square.h"

#include "support/listener.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <utility>

namespace ricci::testing {
namespace {

/// A chart in the unit square, curved and turned, with room round it.
Point2 curved(const Point2& p)
{
	const double x = p[0] + 0.15 * p[1] * p[1], y = p[1] - 0.1 * p[0] * p[0];
	const double c = std::cos(0.4), s = std::sin(0.4);
	return {0.38 + 0.45 * (c * x - s * y), 0.12 + 0.45 * (s * x + c * y)};
}

template<class Sample>
Picture<Sample> noise(int width, int height, Random& random)
{
	Picture<Sample> picture(width, height);
	for (Sample& sample : picture.rgba)
		sample = static_cast<Sample>(random.index(std::numeric_limits<Sample>::max() + 1));
	return picture;
}

/// One colour everywhere.
template<class Sample>
Picture<Sample> plain(int width, int height, const std::array<Sample, 4>& colour)
{
	Picture<Sample> picture(width, height);
	for (std::size_t i = 0; i < picture.rgba.size(); ++i)
		picture.rgba[i] = colour[i % 4];
	return picture;
}

/// Two squares of four vertices and two faces each as one mesh.
CarriedMesh both(CarriedMesh mesh, const CarriedMesh& other)
{
	for (std::size_t i = 0; i < 2; ++i) {
		mesh.faces.push_back(other.faces[i]);
		for (int& v : mesh.faces.back().vertices)
			v += 4;
		mesh.triangles.push_back(other.triangles[i]);
		mesh.triangles.back().face += 2;
	}
	return mesh;
}

template<class Sample>
class CarryTextureOf : public ::testing::Test
{
};
using SampleTypes = ::testing::Types<unsigned char, unsigned short>;
TYPED_TEST_SUITE(CarryTextureOf, SampleTypes);

TYPED_TEST(CarryTextureOf, KeepsEveryBitWhereNothingChanges)
{
	Random random(741);
	const Square square(4);
	const int size = 96;
	const Picture<TypeParam> old = noise<TypeParam>(size, size, random);
	const auto check = [&](const std::vector<Triangle2>& atlas) {
		const Picture<TypeParam> result =
			carried<TypeParam>(carriedMesh(square, atlas, atlas), {&old}, size, true);
		const std::vector<Hit> found = hits(atlas, size, size);
		int equal = 0;
		for (std::size_t i = 0; i < found.size(); ++i) {
			if (found[i].triangle < 0)
				continue;
			const auto texel = static_cast<std::ptrdiff_t>(4 * i);
			++equal;
			ASSERT_TRUE(std::equal(
				result.rgba.begin() + texel,
				result.rgba.begin() + texel + 4,
				old.rgba.begin() + texel));
		}
		EXPECT_GT(equal, 1000);
	};
	check(square.place);
	check(mapped(square.place, curved));
	check(shatteredAtlas(32, random));
}

TYPED_TEST(CarryTextureOf, FollowsAFunctionFromOneChartToAnother)
{
	const Square square(12);
	const int oldSize = 160, size = 200;
	const Picture<TypeParam> old = paint<TypeParam>(square, square.place, oldSize, oldSize);
	const std::vector<Triangle2> atlas = mapped(square.place, curved);
	const Picture<TypeParam> result =
		carried<TypeParam>(carriedMesh(square, square.place, atlas), {&old}, size);
	const Difference d = difference(square, atlas, result);
	// A box of at most 2.3 texels in place of a point, a tent of one; at the edge the mean lies inside
	// by at most half of that.
	const double texel = 1.0 / oldSize, rounding = 1.0 / std::numeric_limits<TypeParam>::max();
	EXPECT_LT(d.worst, rounding + 0.5 * 2.3 * texel * kGradient);
	EXPECT_LT(d.rms, rounding + 0.1 * texel * kGradient);
}

TYPED_TEST(CarryTextureOf, TakesNothingFromNeighboursInAShatteredAtlas)
{
	Random random(742);
	const Square square(8);
	// 64 cells of 128 triangles, of 30 and of 7.5 texels.
	for (int oldSize : {240, 60}) {
		const std::vector<Triangle2> shattered = shatteredAtlas(128, random);
		const Picture<TypeParam> old = paint<TypeParam>(square, shattered, oldSize, oldSize);
		const std::vector<Triangle2> atlas = mapped(square.place, curved);
		const Picture<TypeParam> result =
			carried<TypeParam>(carriedMesh(square, shattered, atlas), {&old}, 200);
		const Difference d = difference(square, atlas, result);
		// A cell is as large in space as in the atlas. Instead of a texel beside the triangle one of its
		// own counts, which in a corner of half a right angle is at most 2.5 texels away.
		const double texel = 1.0 / oldSize, rounding = 1.0 / std::numeric_limits<TypeParam>::max();
		EXPECT_LT(d.worst, rounding + 2.5 * texel * kGradient);
		EXPECT_LT(d.rms, rounding + 0.4 * texel * kGradient);
	}
}

TYPED_TEST(CarryTextureOf, SeamsDoNotShow)
{
	Random random(743);
	const Square square(6);
	const int oldSize = 256, size = 300;
	const Picture<TypeParam> old = paint<TypeParam>(square, square.place, oldSize, oldSize);
	// The right half is a chart of its own, turned and moved away.
	std::vector<Triangle2> atlas = square.place;
	for (Triangle2& t : atlas) {
		const bool right = std::min({t[0][0], t[1][0], t[2][0]}) > 0.49;
		for (Point2& p : t)
			p = right ? Point2{0.95 - 0.4 * (p[0] - 0.5), 0.05 + 0.4 * (1.0 - p[1])}
					  : Point2{0.06 + 0.4 * p[0], 0.055 + 0.4 * p[1]};
	}
	const Picture<TypeParam> result =
		carried<TypeParam>(carriedMesh(square, square.place, atlas), {&old}, size);
	// What bilinear sampling reads on both sides of the seam, and on the outer border.
	const auto sample = [&](const Point2& uv, std::size_t channel) {
		const Point2 p = inTexels(uv, size, size);
		const int x = static_cast<int>(std::floor(p[0] - 0.5));
		const int y = static_cast<int>(std::floor(p[1] - 0.5));
		const double tx = p[0] - 0.5 - x, ty = p[1] - 0.5 - y;
		double sum = 0.0;
		for (int dy = 0; dy < 2; ++dy)
			for (int dx = 0; dx < 2; ++dx)
				sum += (dx == 0 ? 1 - tx : tx) * (dy == 0 ? 1 - ty : ty) *
					   result.at(x + dx, y + dy)[channel];
		return sum / std::numeric_limits<TypeParam>::max();
	};
	const double texel = 2.5 / size, rounding = 1.0 / std::numeric_limits<TypeParam>::max();
	for (int i = 0; i < 1000; ++i) {
		const double height = random.real(0.02, 0.98);
		const Point2 place{0.5, height};
		const Point2 left{0.06 + 0.4 * 0.5, 0.055 + 0.4 * height};
		const Point2 right{0.95, 0.05 + 0.4 * (1.0 - height)};
		for (std::size_t c = 0; c < 3; ++c) {
			// The old chart goes on across the new seam: only second derivatives are lost, to the mean
			// over a texel, a bilinear one of the old and one of the new picture.
			EXPECT_NEAR(sample(left, c), painted(place, c), 2 * rounding + kSecond * texel * texel);
			EXPECT_NEAR(
				sample(right, c), painted(place, c), 2 * rounding + kSecond * texel * texel);
		}
	}
}

TYPED_TEST(CarryTextureOf, MeanOfATexelIsThatOfItsArea)
{
	// A checkerboard of single texels, 8 of them in the width of one new texel.
	const int oldSize = 256, size = 32;
	constexpr double kMax = std::numeric_limits<TypeParam>::max();
	Picture<TypeParam> old(oldSize, oldSize);
	for (int y = 0; y < oldSize; ++y)
		for (int x = 0; x < oldSize; ++x)
			for (std::size_t c = 0; c < 3; ++c)
				old.at(x, y)[c] = static_cast<TypeParam>((x + y) % 2 == 0 ? 0 : kMax);
	const Square square(1);
	const Picture<TypeParam> result =
		carried<TypeParam>(carriedMesh(square, square.place, square.place), {&old}, size);
	for (int y = 1; y + 1 < size; ++y)
		for (int x = 1; x + 1 < size; ++x)
			EXPECT_NEAR(result.at(x, y)[0], 0.5 * kMax, 1.0);
	// Of two texels in the width of a new one as well.
	const Picture<TypeParam> half =
		carried<TypeParam>(carriedMesh(square, square.place, square.place), {&old}, oldSize / 2);
	for (int y = 1; y + 1 < half.height; ++y)
		for (int x = 1; x + 1 < half.width; ++x)
			EXPECT_NEAR(half.at(x, y)[0], 0.5 * kMax, 1.0);
}

/// Symmetric means of a linear function are its values, of whatever blocks they are taken.
TYPED_TEST(CarryTextureOf, MeansOfManyTexelsKeepLinearFunctions)
{
	constexpr double kMax = std::numeric_limits<TypeParam>::max();
	const Square square(1);
	const std::vector<Triangle2> atlas = mapped(square.place, [](const Point2& p) {
		return Point2{0.38 + 0.5 * p[0] - 0.3 * p[1], 0.12 + 0.3 * p[0] + 0.5 * p[1]};
	});
	for (const int oldSize : {250, 512, 1000}) {
		Picture<TypeParam> old(oldSize, oldSize);
		for (int y = 0; y < oldSize; ++y)
			for (int x = 0; x < oldSize; ++x) {
				old.at(x, y)[0] = static_cast<TypeParam>(std::lround(kMax * (x + 0.5) / oldSize));
				old.at(x, y)[1] = static_cast<TypeParam>(std::lround(kMax * (y + 0.5) / oldSize));
			}
		const int size = 30; // of 14, 29 and 57 old texels
		const Picture<TypeParam> result =
			carried<TypeParam>(carriedMesh(square, square.place, atlas), {&old}, size);
		int inside = 0;
		const std::vector<Hit> found = hits(atlas, size, size);
		for (std::size_t i = 0; i < found.size(); ++i) {
			if (found[i].triangle < 0)
				continue;
			const Point2 p = pointOf(square.place[positionOf(found[i].triangle)], found[i].weights);
			// Neither the texel nor a block beside it reach beyond the picture.
			if (std::min({p[0], p[1], 1.0 - p[0], 1.0 - p[1]}) < 0.12)
				continue;
			++inside;
			// Of the old picture, of words at up to four levels, and of the result.
			const double rounding = 0.5 + 4 * 0.5 * kMax / 65535.0 + 0.5 + 1e-6;
			EXPECT_NEAR(result.rgba[4 * i], kMax * p[0], rounding);
			EXPECT_NEAR(result.rgba[4 * i + 1], kMax * (1.0 - p[1]), rounding);
		}
		EXPECT_GT(inside, 100);
	}
}

/// Blocks of two charts are divided down to their texels.
TYPED_TEST(CarryTextureOf, TakesNothingFromTheOtherChartOfABlock)
{
	const int oldSize = 500, border = 203;
	Picture<TypeParam> old(oldSize, oldSize);
	for (int y = 0; y < oldSize; ++y)
		for (int x = 0; x < oldSize; ++x)
			old.at(x, y)[x < border ? 0 : 2] = 200;
	const Square square(1);
	const double width = static_cast<double>(border) / oldSize;
	const CarriedMesh mesh = both(
		carriedMesh(square, box(0, 0, width, 1), box(0.05, 0.05, 0.4, 0.9)),
		carriedMesh(square, box(width, 0, 1 - width, 1), box(0.55, 0.05, 0.4, 0.9)));
	for (const int size : {8, 20, 40}) {
		const Picture<TypeParam> result = carried<TypeParam>(mesh, {&old}, size);
		for (int y = 0; y < size; ++y)
			for (int x = 0; x < size; ++x)
				for (const std::size_t c : {0u, 2u})
					EXPECT_EQ(result.at(x, y)[c], (2 * x < size) == (c == 0) ? 200 : 0) << size;
	}
}

TYPED_TEST(CarryTextureOf, WeighsColoursByTheirAlpha)
{
	constexpr TypeParam kMax = std::numeric_limits<TypeParam>::max();
	const TypeParam blue = static_cast<TypeParam>(kMax / 3);
	// Transparent red beside opaque blue, in columns.
	Picture<TypeParam> old(64, 64);
	for (int y = 0; y < 64; ++y)
		for (int x = 0; x < 64; ++x) {
			TypeParam* texel = old.at(x, y);
			const bool opaque = x % 4 < 2;
			texel[0] = opaque ? 0 : kMax;
			texel[2] = opaque ? blue : 0;
			texel[3] = opaque ? kMax : 0;
		}
	const Square square(2);
	const CarriedMesh mesh = carriedMesh(square, square.place, mapped(square.place, curved));
	int mixed = 0;
	for (const int size : {40, 8}) { // of a few texels, and of blocks of them
		const Picture<TypeParam> result = carried<TypeParam>(mesh, {&old}, size, true);
		for (int i = 0; i < size * size; ++i) {
			const TypeParam* texel = &result.rgba[4 * positionOf(i)];
			if (texel[3] == 0)
				continue;
			EXPECT_EQ(texel[0], 0);
			EXPECT_EQ(texel[2], blue);
			mixed += texel[3] < kMax;
		}
	}
	EXPECT_GT(mixed, 100);
	const Picture<TypeParam> opaque = carried<TypeParam>(mesh, {&old}, 40, false);
	for (int i = 0; i < 40 * 40; ++i)
		EXPECT_EQ(opaque.rgba[static_cast<std::size_t>(4 * i + 3)], kMax);
}

TYPED_TEST(CarryTextureOf, GathersPicturesAndColoursOfCorners)
{
	constexpr TypeParam kMax = std::numeric_limits<TypeParam>::max();
	const Square square(2); // 8 triangles
	const Picture<TypeParam> one = plain<TypeParam>(30, 50, {10, 20, 30, kMax});
	const Picture<TypeParam> two = plain<TypeParam>(70, 40, {40, 50, 60, kMax});
	CarriedMesh mesh = carriedMesh(square, square.place, mapped(square.place, curved));
	for (std::size_t f = 0; f < 8; ++f) {
		mesh.faces[f].picture = static_cast<int>(f % 3) - 1;
		for (std::size_t k = 0; k < 3; ++k) {
			const Point2 p = square.place[f][k];
			mesh.faces[f].colour[k] = {
				static_cast<float>(p[0]), static_cast<float>(p[1]), 0.25f, 0.5f};
		}
	}
	const int size = 128;
	const Picture<TypeParam> result = carried<TypeParam>(mesh, {&one, &two}, size, true);
	std::vector<Triangle2> atlas;
	for (const CarriedTriangle& triangle : mesh.triangles)
		atlas.push_back(triangle.uv);
	const std::vector<Hit> found = hits(atlas, size, size);
	int counts[3] = {0, 0, 0};
	for (int i = 0; i < size * size; ++i) {
		const Hit& hit = found[static_cast<std::size_t>(i)];
		if (hit.triangle < 0)
			continue;
		const TypeParam* texel = &result.rgba[4 * positionOf(i)];
		const int picture = mesh.faces[positionOf(hit.triangle)].picture;
		++counts[picture + 1];
		if (picture >= 0) {
			EXPECT_EQ(texel[0], picture == 0 ? 10 : 40);
			EXPECT_EQ(texel[3], kMax);
			continue;
		}
		const Point2 p = pointOf(square.place[positionOf(hit.triangle)], hit.weights);
		EXPECT_NEAR(texel[0], p[0] * kMax, 0.51);
		EXPECT_NEAR(texel[1], p[1] * kMax, 0.51);
		EXPECT_NEAR(texel[2], 0.25 * kMax, 0.51);
		EXPECT_NEAR(texel[3], 0.5 * kMax, 0.51);
	}
	for (int count : counts)
		EXPECT_GT(count, 500);
}

TEST(CarryTexture, GutterServesThreeLevelsOfMipmaps)
{
	// Two charts of one colour each, with twice the gutter between them, at places off the grid of the
	// levels. Each has a hole of black in its old picture beside it.
	const int size = 256;
	const double gutter = 2.0 * kGutterTexels / size, left = 37.3 / size, width = 61.7 / size;
	const Square square(1);
	Picture<unsigned char> old(64, 64);
	for (int y = 0; y < 64; ++y)
		for (int x = 0; x < 64; ++x) {
			const bool one = x >= 8 && x < 24, two = x >= 40 && x < 56, in = y >= 8 && y < 56;
			if (in && (one || two))
				std::fill_n(old.at(x, y), 4, static_cast<unsigned char>(one ? 200 : 50));
		}
	const CarriedMesh mesh = both(
		carriedMesh(square, box(8.0 / 64, 8.0 / 64, 0.25, 0.75), box(left, 0.2, width, 0.6)),
		carriedMesh(
			square,
			box(40.0 / 64, 8.0 / 64, 0.25, 0.75),
			box(left + width + gutter, 0.2, width, 0.6)));
	Picture<unsigned char> level = carried<unsigned char>(mesh, {&old}, size);
	Random random(744);
	for (int depth = 0; depth <= 3; ++depth) {
		if (depth > 0) {
			Picture<unsigned char> next(level.width / 2, level.height / 2);
			for (int y = 0; y < next.height; ++y)
				for (int x = 0; x < next.width; ++x)
					for (std::size_t c = 0; c < 4; ++c)
						next.at(x, y)[c] = static_cast<unsigned char>(
							(level.at(2 * x, 2 * y)[c] + level.at(2 * x + 1, 2 * y)[c] +
							 level.at(2 * x, 2 * y + 1)[c] + level.at(2 * x + 1, 2 * y + 1)[c]) /
							4);
			level = next;
		}
		for (int i = 0; i < 4000; ++i) {
			const bool second = random.coin();
			const double share = random.index(3) == 0 ? random.index(2) : random.real(0.0, 1.0);
			const double rise = random.index(3) == 0 ? random.index(2) : random.real(0.0, 1.0);
			const Point2 p = inTexels(
				Point2{left + (second ? width + gutter : 0.0) + share * width, 0.2 + rise * 0.6},
				level.width,
				level.height);
			const int x = static_cast<int>(std::floor(p[0] - 0.5));
			const int y = static_cast<int>(std::floor(p[1] - 0.5));
			for (int dy = 0; dy < 2; ++dy)
				for (int dx = 0; dx < 2; ++dx)
					ASSERT_EQ(level.at(x + dx, y + dy)[0], second ? 50 : 200) << depth;
		}
	}
}

TEST(CarryTexture, DrawsChartsSmallerThanATexel)
{
	const Square square(1);
	const Picture<unsigned char> old = plain<unsigned char>(16, 16, {90, 90, 90, 255});
	const int size = 32; // no middle of a texel lies in the triangles
	const CarriedMesh mesh =
		carriedMesh(square, square.place, box(10.6 / size, 10.6 / size, 0.3 / size, 0.3 / size));
	const Picture<unsigned char> result = carried<unsigned char>(mesh, {&old}, size);
	for (std::size_t i = 0; i < result.rgba.size(); i += 4)
		ASSERT_EQ(result.rgba[i], 90);
}

TEST(CarryTexture, GoesThroughTheFacesOfARefinement)
{
	const Square square(3);
	const Picture<unsigned short> old = paint<unsigned short>(square, square.place, 64, 64);
	const CarriedMesh whole = carriedMesh(square, square.place, mapped(square.place, curved));
	CarriedMesh divided = whole;
	divided.triangles.clear();
	for (const CarriedTriangle& t : whole.triangles) {
		const Point3 inner{0.5, 0.3, 0.2};
		for (std::size_t k = 0; k < 3; ++k) {
			CarriedTriangle part = t;
			part.corners[k] = inner;
			part.uv[k] = pointOf(t.uv, inner);
			divided.triangles.push_back(part);
		}
	}
	const Picture<unsigned short> a = carried<unsigned short>(whole, {&old}, 100);
	const Picture<unsigned short> b = carried<unsigned short>(divided, {&old}, 100);
	for (std::size_t i = 0; i < a.rgba.size(); ++i)
		ASSERT_NEAR(a.rgba[i], b.rgba[i], 1);
}

TEST(CarryTexture, RepeatsThePicture)
{
	Random random(745);
	const Square square(3);
	const Picture<unsigned char> old = noise<unsigned char>(64, 64, random);
	const std::vector<Triangle2> atlas = mapped(square.place, curved);
	const std::vector<Triangle2> moved = mapped(square.place, [](const Point2& p) {
		return p + Point2{-3.0, 8.0};
	});
	const Picture<unsigned char> a =
		carried<unsigned char>(carriedMesh(square, square.place, atlas), {&old}, 80);
	const Picture<unsigned char> b =
		carried<unsigned char>(carriedMesh(square, moved, atlas), {&old}, 80);
	EXPECT_EQ(a.rgba, b.rgba);
	// Many times in one texel: the mean of all, to the rounding of the result and of the blocks.
	const std::vector<Triangle2> often = mapped(square.place, [](const Point2& p) {
		return Point2{900 * p[0], 900 * p[1]};
	});
	for (const auto& [width, height] : {std::pair(64, 64), std::pair(50, 37)}) {
		const Picture<unsigned char> tile = noise<unsigned char>(width, height, random);
		std::array<double, 3> mean{};
		for (std::size_t i = 0; i < tile.rgba.size(); ++i)
			if (i % 4 < 3)
				mean[i % 4] += tile.rgba[i] / static_cast<double>(width * height);
		const Picture<unsigned char> grey =
			carried<unsigned char>(carriedMesh(square, often, atlas), {&tile}, 16);
		for (std::size_t c = 0; c < 3; ++c)
			EXPECT_NEAR(grey.at(8, 8)[c], mean[c], 0.51);
	}
}

TEST(CarryTexture, TakesWhateverTheCoordinatesAre)
{
	Random random(746);
	const Square square(2);
	const Picture<unsigned char> old = noise<unsigned char>(16, 16, random);
	std::vector<Triangle2> wild = square.place;
	wild[0][0][0] = std::numeric_limits<double>::quiet_NaN();
	wild[1][1][1] = std::numeric_limits<double>::infinity();
	wild[2][0][0] = 1e30;
	wild[3] = {Point2{0.5, 0.5}, Point2{0.5, 0.5}, Point2{0.5, 0.5}};
	std::vector<Triangle2> atlas = mapped(square.place, curved);
	atlas[5] = {atlas[5][0], atlas[5][0], atlas[5][0]};
	atlas[6] = {Point2{-5, 3}, Point2{40, 0.5}, Point2{0.5, -100}};
	atlas[7][1][1] = std::numeric_limits<double>::quiet_NaN();
	EXPECT_NO_THROW(carried<unsigned char>(carriedMesh(square, wild, atlas), {&old}, 32, true));
}

TEST(CarryTexture, IsTheSameWithManyThreads)
{
	Random random(747);
	const Square square(9);
	const Picture<unsigned char> old = noise<unsigned char>(200, 100, random);
	const CarriedMesh mesh =
		carriedMesh(square, shatteredAtlas(162, random), mapped(square.place, curved));
	EXPECT_EQ(
		carried<unsigned char>(mesh, {&old}, 150, true, 1).rgba,
		carried<unsigned char>(mesh, {&old}, 150, true, 4).rgba);
}

TEST(CarryTexture, CanBeCancelled)
{
	const Square square(2);
	Picture<unsigned char> old(8, 8), result(8, 8);
	for (int after = 0; after < 6; ++after) {
		Listener impatient(after + 1);
		const Task task(impatient);
		EXPECT_THROW(
			carryTexture<unsigned char>(
				carriedMesh(square, square.place, square.place),
				{old.view()},
				false,
				result.target(),
				1),
			Cancelled);
	}
}

TEST(CarryTexture, VisitsOnlyTheTilesOfAPicture)
{
	// 64 cells, each one tile of the result and of a picture of its own.
	const int cells = 8, size = 64 * cells, pictures = cells * cells;
	const Square square(cells);
	CarriedMesh mesh = carriedMesh(square, square.place, square.place);
	std::vector<Picture<unsigned char>> old;
	std::vector<PictureView<const unsigned char>> views;
	old.reserve(positionOf(pictures));
	for (int i = 0; i < pictures; ++i)
		old.push_back(plain<unsigned char>(8, 8, {static_cast<unsigned char>(i), 0, 0, 255}));
	for (int i = 0; i < pictures; ++i) {
		views.push_back(old[positionOf(i)].view());
		mesh.faces[positionOf(2 * i)].picture = mesh.faces[positionOf(2 * i + 1)].picture = i;
	}
	Picture<unsigned char> result(size, size);
	Listener ticks;
	heard(
		ticks, [&] { return carryTexture<unsigned char>(mesh, views, false, result.target(), 1); });
	// All tiles of all pictures would be 64 * 64 of them, the rows of the fill are 512.
	EXPECT_LT(ticks.calls(), 512 + pictures * 16);
	Listener drawing(std::numeric_limits<int>::max(), "Drawing the texture");
	heard(drawing, [&] {
		return carryTexture<unsigned char>(mesh, views, false, result.target(), 1);
	});
	EXPECT_GE(drawing.calls(), cells); // a row of cells takes a row of tiles at least
	EXPECT_TRUE(std::is_sorted(drawing.fractions.begin(), drawing.fractions.end()));
	for (int y = 0; y < size; ++y)
		for (int x = 0; x < size; ++x)
			ASSERT_EQ(result.at(x, y)[0], (size - 1 - y) / 64 * cells + x / 64);
}

TEST(TexelDensityTest, CountsTexelsOfAUnitOfLength)
{
	const Square square(4); // of area 1
	const std::vector<Triangle2> atlas = mapped(square.place, [](const Point2& p) {
		return Point2{0.5 * p[0], 0.5 * p[1]};
	});
	const CarriedMesh mesh = carriedMesh(square, square.place, atlas);
	const std::vector<double> areas(mesh.faces.size(), 1.0 / 32.0);
	const TexelDensity density = texelDensity(mesh, areas, {{200, 50}}, 400);
	EXPECT_NEAR(density.before, 100.0, 1e-9); // sqrt(200 * 50)
	EXPECT_NEAR(density.after, 200.0, 1e-9);
	EXPECT_NEAR(density.ratio, 2.0, 1e-12);
	CarriedMesh coloured = mesh;
	for (TexturedFace& face : coloured.faces)
		face.picture = -1;
	EXPECT_EQ(texelDensity(coloured, areas, {}, 400).ratio, 0.0);
}

} // namespace
} // namespace ricci::testing
