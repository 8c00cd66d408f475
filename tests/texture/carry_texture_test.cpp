// SPDX-License-Identifier: GPL-3.0-or-later
#include "painted_square.h"

#include "support/listener.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

namespace ricci::testing {
namespace {

/// A chart in the unit square, curved and turned, with space around it.
Point2 curved(const Point2& p)
{
	const double x = p[0] + 0.15 * p[1] * p[1], y = p[1] - 0.1 * p[0] * p[0];
	const double c = std::cos(0.4), s = std::sin(0.4);
	return {0.38 + 0.45 * (c * x - s * y), 0.12 + 0.45 * (s * x + c * y)};
}

/// The colour of each texel by its place: colour(x, y, channel).
template<class Sample, class Colour>
Picture<Sample> pictureOf(int width, int height, const Colour& colour)
{
	Picture<Sample> picture(width, height);
	for (int y = 0; y < height; ++y)
		for (int x = 0; x < width; ++x)
			for (std::size_t c = 0; c < 4; ++c)
				picture.at(x, y)[c] = static_cast<Sample>(colour(x, y, c));
	return picture;
}

template<class Sample>
Picture<Sample> noise(int width, int height, Random& random)
{
	return pictureOf<Sample>(width, height, [&](int, int, std::size_t) {
		return random.index(std::numeric_limits<Sample>::max() + 1);
	});
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
constexpr Sample kMax = std::numeric_limits<Sample>::max();
template<class Sample>
constexpr double kRounding = 1.0 / kMax<Sample>;

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
	for (const std::vector<Triangle2>& atlas :
		 {square.place, mapped(square.place, curved), shatteredAtlas(32, random)}) {
		const Picture<TypeParam> result =
			carried<TypeParam>(carriedMesh(square, atlas, atlas), {&old}, size, true);
		int equal = 0;
		forHits(atlas, size, size, [&](std::size_t texel, const Hit&) {
			const auto i = static_cast<std::ptrdiff_t>(4 * texel);
			EXPECT_TRUE(std::equal(
				result.rgba.begin() + i, result.rgba.begin() + i + 4, old.rgba.begin() + i));
			++equal;
		});
		EXPECT_GT(equal, 1000);
	}
}

/// From one chart, and from 64 cells of 128 triangles, of 30 and of 7.5 texels. A cell is as large in space as in the
/// atlas. In place of a point counts a box of at most 2.3 texels, a tent of one; at the edge the mean lies inside by at
/// most half of that. Instead of a texel beside the triangle one of its own counts, which in a corner of half a right
/// angle is at most 2.5 texels away.
TYPED_TEST(CarryTextureOf, FollowsAFunctionFromAnyAtlasToAChart)
{
	Random random(742);
	const Square square(8);
	const std::vector<Triangle2> atlas = mapped(square.place, curved);
	const struct
	{
		std::vector<Triangle2> old;
		int size;
		double worst, rms; ///< texels
	} cases[] = {
		{square.place, 160, 0.5 * 2.3, 0.1},
		{shatteredAtlas(128, random), 240, 2.5, 0.4},
		{shatteredAtlas(128, random), 60, 2.5, 0.4}};
	for (const auto& c : cases) {
		SCOPED_TRACE(c.size);
		const Picture<TypeParam> old = paint<TypeParam>(square, c.old, c.size, c.size);
		const Difference d = difference(
			square, atlas, carried<TypeParam>(carriedMesh(square, c.old, atlas), {&old}, 200));
		EXPECT_LT(d.worst, kRounding<TypeParam> + c.worst / c.size * kGradient);
		EXPECT_LT(d.rms, kRounding<TypeParam> + c.rms / c.size * kGradient);
	}
}

/// The right half is a chart of its own, turned and moved away. What bilinear sampling reads on both sides of the
/// seam: the old chart goes on across it, so only second derivatives are lost, to the mean over a texel, a bilinear
/// one of the old and one of the new picture.
TYPED_TEST(CarryTextureOf, SeamsDoNotShow)
{
	Random random(743);
	const Square square(6);
	const int oldSize = 256, size = 300;
	const Picture<TypeParam> old = paint<TypeParam>(square, square.place, oldSize, oldSize);
	const auto rightOf = [](const Point2& p) {
		return Point2{0.95 - 0.4 * (p[0] - 0.5), 0.05 + 0.4 * (1.0 - p[1])};
	};
	const auto leftOf = [](const Point2& p) {
		return Point2{0.06 + 0.4 * p[0], 0.055 + 0.4 * p[1]};
	};
	std::vector<Triangle2> atlas = square.place;
	for (Triangle2& t : atlas) {
		const bool isRight = std::min({t[0][0], t[1][0], t[2][0]}) > 0.49;
		for (Point2& p : t)
			p = isRight ? rightOf(p) : leftOf(p);
	}
	const Picture<TypeParam> result =
		carried<TypeParam>(carriedMesh(square, square.place, atlas), {&old}, size);
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
		return sum * kRounding<TypeParam>;
	};
	const double texel = 2.5 / size;
	for (int i = 0; i < 1000; ++i) {
		const Point2 place{0.5, random.real(0.02, 0.98)};
		for (const Point2& uv : {leftOf(place), rightOf(place)})
			for (std::size_t c = 0; c < 3; ++c)
				EXPECT_NEAR(
					sample(uv, c),
					painted(place, c),
					2 * kRounding<TypeParam> + kSecond * texel * texel);
	}
}

/// A checkerboard of single texels, 8 or two of them in the width of one new texel.
TYPED_TEST(CarryTextureOf, MeanOfATexelIsThatOfItsArea)
{
	const int oldSize = 256;
	const Picture<TypeParam> old =
		pictureOf<TypeParam>(oldSize, oldSize, [&](int x, int y, std::size_t c) {
			return (x + y) % 2 == 0 || c == 3 ? 0 : kMax<TypeParam>;
		});
	const Square square(1);
	for (const int size : {32, oldSize / 2}) {
		const Picture<TypeParam> result =
			carried<TypeParam>(carriedMesh(square, square.place, square.place), {&old}, size);
		for (int y = 1; y + 1 < size; ++y)
			for (int x = 1; x + 1 < size; ++x)
				EXPECT_NEAR(result.at(x, y)[0], 0.5 * kMax<TypeParam>, 1.0);
	}
}

/// Symmetric means of a linear function are its values, of whatever blocks they are taken: of 14, 29 and 57 old texels.
TYPED_TEST(CarryTextureOf, MeansOfManyTexelsKeepLinearFunctions)
{
	constexpr double kWhite = kMax<TypeParam>;
	const Square square(1);
	const std::vector<Triangle2> atlas = mapped(square.place, [](const Point2& p) {
		return Point2{0.38 + 0.5 * p[0] - 0.3 * p[1], 0.12 + 0.3 * p[0] + 0.5 * p[1]};
	});
	for (const int oldSize : {250, 512, 1000}) {
		const Picture<TypeParam> old =
			pictureOf<TypeParam>(oldSize, oldSize, [&](int x, int y, std::size_t c) {
				return c > 1 ? 0 : std::lround(kWhite * ((c == 0 ? x : y) + 0.5) / oldSize);
			});
		const int size = 30;
		const Picture<TypeParam> result =
			carried<TypeParam>(carriedMesh(square, square.place, atlas), {&old}, size);
		int inside = 0;
		forHits(atlas, size, size, [&](std::size_t texel, const Hit& hit) {
			const Point2 p = placeOf(square, hit);
			// Neither the texel nor a block beside it reach beyond the picture.
			if (std::min({p[0], p[1], 1.0 - p[0], 1.0 - p[1]}) < 0.12)
				return;
			++inside;
			// Of the old picture, of words at up to four levels, and of the result.
			const double rounding = 0.5 + 4 * 0.5 * kWhite / 65535.0 + 0.5 + 1e-6;
			EXPECT_NEAR(result.rgba[4 * texel], kWhite * p[0], rounding);
			EXPECT_NEAR(result.rgba[4 * texel + 1], kWhite * (1.0 - p[1]), rounding);
		});
		EXPECT_GT(inside, 100);
	}
}

/// Blocks of two charts are divided down to their texels.
TYPED_TEST(CarryTextureOf, TakesNothingFromTheOtherChartOfABlock)
{
	const int oldSize = 500, border = 203;
	const Picture<TypeParam> old =
		pictureOf<TypeParam>(oldSize, oldSize, [](int x, int, std::size_t c) {
			return c == (x < border ? 0u : 2u) ? 200 : 0;
		});
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

/// Transparent red beside opaque blue, in columns. Texels are of a few old ones, and of blocks of them.
TYPED_TEST(CarryTextureOf, WeighsColoursByTheirAlpha)
{
	constexpr TypeParam kWhite = kMax<TypeParam>, kBlue = static_cast<TypeParam>(kWhite / 3);
	const Picture<TypeParam> old = pictureOf<TypeParam>(64, 64, [&](int x, int, std::size_t c) {
		const bool opaque = x % 4 < 2;
		return c == 0             ? (opaque ? 0 : kWhite)
			   : c == 2           ? (opaque ? kBlue : 0)
			   : c == 3 && opaque ? kWhite
								  : 0;
	});
	const Square square(2);
	const CarriedMesh mesh = carriedMesh(square, square.place, mapped(square.place, curved));
	int mixed = 0;
	for (const int size : {40, 8}) {
		const Picture<TypeParam> result = carried<TypeParam>(mesh, {&old}, size, true);
		for (std::size_t i = 0; i < result.rgba.size(); i += 4) {
			const TypeParam* texel = &result.rgba[i];
			if (texel[3] == 0)
				continue;
			EXPECT_EQ(texel[0], 0);
			EXPECT_EQ(texel[2], kBlue);
			mixed += texel[3] < kWhite;
		}
	}
	EXPECT_GT(mixed, 100);
	const Picture<TypeParam> opaque = carried<TypeParam>(mesh, {&old}, 40, false);
	for (std::size_t i = 3; i < opaque.rgba.size(); i += 4)
		EXPECT_EQ(opaque.rgba[i], kWhite);
}

TYPED_TEST(CarryTextureOf, GathersPicturesAndColoursOfCorners)
{
	constexpr TypeParam kWhite = kMax<TypeParam>;
	const Square square(2); // 8 triangles
	const auto plain = [&](int width, int height, int first) {
		return pictureOf<TypeParam>(width, height, [&](int, int, std::size_t c) {
			return c == 3 ? kWhite : first + 10 * static_cast<int>(c);
		});
	};
	const Picture<TypeParam> one = plain(30, 50, 10), two = plain(70, 40, 40);
	const std::vector<Triangle2> atlas = mapped(square.place, curved);
	CarriedMesh mesh = carriedMesh(square, square.place, atlas);
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
	int counts[3] = {0, 0, 0};
	forHits(atlas, size, size, [&](std::size_t i, const Hit& hit) {
		const TypeParam* texel = &result.rgba[4 * i];
		const int picture = mesh.faces[positionOf(hit.triangle)].picture;
		++counts[picture + 1];
		if (picture >= 0) {
			EXPECT_EQ(texel[0], picture == 0 ? 10 : 40);
			EXPECT_EQ(texel[3], kWhite);
			return;
		}
		const Point2 p = placeOf(square, hit);
		const double wanted[] = {p[0], p[1], 0.25, 0.5};
		for (std::size_t c = 0; c < 4; ++c)
			EXPECT_NEAR(texel[c], wanted[c] * kWhite, 0.51);
	});
	for (int count : counts)
		EXPECT_GT(count, 500);
}

/// Two charts of one colour each, with twice the gutter between them, at places off the grid of the levels. Each has
/// a hole of black in its old picture beside it.
TEST(CarryTexture, GutterServesThreeLevelsOfMipmaps)
{
	const int size = 256;
	const double gutter = 2.0 * kGutterTexels / size, left = 37.3 / size, width = 61.7 / size;
	const Square square(1);
	const Picture<unsigned char> old =
		pictureOf<unsigned char>(64, 64, [](int x, int y, std::size_t) {
			const bool isIn = y >= 8 && y < 56;
			return isIn && x >= 8 && x < 24 ? 200 : isIn && x >= 40 && x < 56 ? 50 : 0;
		});
	const CarriedMesh mesh = both(
		carriedMesh(square, box(8.0 / 64, 8.0 / 64, 0.25, 0.75), box(left, 0.2, width, 0.6)),
		carriedMesh(
			square,
			box(40.0 / 64, 8.0 / 64, 0.25, 0.75),
			box(left + width + gutter, 0.2, width, 0.6)));
	Picture<unsigned char> level = carried<unsigned char>(mesh, {&old}, size);
	Random random(744);
	for (int depth = 0; depth <= 3; ++depth) {
		if (depth > 0)
			level = pictureOf<unsigned char>(
				level.width / 2, level.height / 2, [&](int x, int y, std::size_t c) {
					return (level.at(2 * x, 2 * y)[c] + level.at(2 * x + 1, 2 * y)[c] +
							level.at(2 * x, 2 * y + 1)[c] + level.at(2 * x + 1, 2 * y + 1)[c]) /
						   4;
				});
		for (int i = 0; i < 4000; ++i) {
			const auto share = [&] { // the ends among them
				return random.index(3) == 0 ? random.index(2) : random.real(0.0, 1.0);
			};
			const bool second = random.coin();
			const double x0 = left + (second ? width + gutter : 0.0) + share() * width;
			const Point2 p = inTexels(Point2{x0, 0.2 + share() * 0.6}, level.width, level.height);
			const int x = static_cast<int>(std::floor(p[0] - 0.5));
			const int y = static_cast<int>(std::floor(p[1] - 0.5));
			for (int dy = 0; dy < 2; ++dy)
				for (int dx = 0; dx < 2; ++dx)
					ASSERT_EQ(level.at(x + dx, y + dy)[0], second ? 50 : 200) << depth;
		}
	}
}

/// No middle of a texel lies in the triangles.
TEST(CarryTexture, DrawsChartsSmallerThanATexel)
{
	const Square square(1);
	const auto old =
		pictureOf<unsigned char>(16, 16, [](int, int, std::size_t c) { return c == 3 ? 255 : 90; });
	const int size = 32;
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
	for (const CarriedTriangle& t : whole.triangles)
		for (std::size_t k = 0; k < 3; ++k) {
			CarriedTriangle part = t;
			part.corners[k] = {0.5, 0.3, 0.2};
			part.uv[k] = pointOf(t.uv, part.corners[k]);
			divided.triangles.push_back(part);
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
	const auto by = [&](const std::function<Point2(const Point2&)>& map,
						const Picture<unsigned char>& picture,
						int size) {
		return carried<unsigned char>(
			carriedMesh(square, mapped(square.place, map), atlas), {&picture}, size);
	};
	EXPECT_EQ(
		by([](const Point2& p) { return p; }, old, 80).rgba,
		by(
			[](const Point2& p) {
				return p + Point2{-3.0, 8.0};
			},
			old,
			80)
			.rgba);
	// Many times in one texel: the mean of all, to the rounding of the result and of the blocks.
	for (const auto& [width, height] : {std::pair(64, 64), std::pair(50, 37)}) {
		const Picture<unsigned char> tile = noise<unsigned char>(width, height, random);
		const auto grey = by([](const Point2& p) { return 900.0 * p; }, tile, 16);
		for (std::size_t c = 0; c < 3; ++c) {
			double mean = 0.0;
			for (std::size_t i = c; i < tile.rgba.size(); i += 4)
				mean += tile.rgba[i] / static_cast<double>(width * height);
			EXPECT_NEAR(grey.at(8, 8)[c], mean, 0.51);
		}
	}
}

TEST(CarryTexture, TakesWhateverTheCoordinatesAre)
{
	Random random(746);
	const Square square(2);
	const Picture<unsigned char> old = noise<unsigned char>(16, 16, random);
	constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
	std::vector<Triangle2> wild = square.place, atlas = mapped(square.place, curved);
	wild[0][0][0] = kNaN;
	wild[1][1][1] = std::numeric_limits<double>::infinity();
	wild[2][0][0] = 1e30;
	wild[3] = {Point2{0.5, 0.5}, Point2{0.5, 0.5}, Point2{0.5, 0.5}};
	atlas[5] = {atlas[5][0], atlas[5][0], atlas[5][0]};
	atlas[6] = {Point2{-5, 3}, Point2{40, 0.5}, Point2{0.5, -100}};
	atlas[7][1][1] = kNaN;
	EXPECT_NO_THROW(carried<unsigned char>(carriedMesh(square, wild, atlas), {&old}, 32, true));
}

TEST(CarryTexture, IsTheSameWithManyThreadsAndCanBeCancelled)
{
	Random random(747);
	const Square square(9);
	const Picture<unsigned char> old = noise<unsigned char>(200, 100, random);
	const CarriedMesh mesh =
		carriedMesh(square, shatteredAtlas(162, random), mapped(square.place, curved));
	EXPECT_EQ(
		carried<unsigned char>(mesh, {&old}, 150, true, 1).rgba,
		carried<unsigned char>(mesh, {&old}, 150, true, 4).rgba);
	for (int after = 1; after < 7; ++after) {
		Listener impatient(after);
		EXPECT_THROW(
			withListener(impatient, [&] { carried<unsigned char>(mesh, {&old}, 8); }), Cancelled);
	}
}

/// 64 cells, each one tile of the result and of a picture of its own.
TEST(CarryTexture, VisitsOnlyTheTilesOfAPicture)
{
	const int cells = 8, size = 64 * cells, pictures = cells * cells;
	const Square square(cells);
	CarriedMesh mesh = carriedMesh(square, square.place, square.place);
	std::vector<Picture<unsigned char>> old;
	std::vector<const Picture<unsigned char>*> views;
	for (int i = 0; i < pictures; ++i) {
		old.push_back(pictureOf<unsigned char>(8, 8, [&](int, int, std::size_t c) {
			return c == 0 ? i : c == 3 ? 255 : 0;
		}));
		mesh.faces[positionOf(2 * i)].picture = mesh.faces[positionOf(2 * i + 1)].picture = i;
	}
	for (const Picture<unsigned char>& picture : old)
		views.push_back(&picture);
	Listener ticks, drawing(std::numeric_limits<int>::max(), "Drawing the texture");
	const auto result =
		withListener(ticks, [&] { return carried<unsigned char>(mesh, views, size); });
	// All tiles of all pictures would be 64 * 64 of them, the rows of the fill are 512.
	EXPECT_LT(ticks.calls(), 512 + pictures * 16);
	withListener(drawing, [&] { return carried<unsigned char>(mesh, views, size); });
	EXPECT_GE(drawing.calls(), cells); // a row of cells takes a row of tiles at least
	EXPECT_TRUE(std::is_sorted(drawing.fractions.begin(), drawing.fractions.end()));
	for (int y = 0; y < size; ++y)
		for (int x = 0; x < size; ++x)
			ASSERT_EQ(result.at(x, y)[0], x / 64 * cells + (size - 1 - y) / 64);
}

TEST(TexelDensityTest, CountsTexelsOfAUnitOfLength)
{
	const Square square(4); // of area 1
	CarriedMesh mesh = carriedMesh(
		square, square.place, mapped(square.place, [](const Point2& p) { return 0.5 * p; }));
	const std::vector<double> areas(mesh.faces.size(), 1.0 / 32.0);
	const TexelDensity density = texelDensity(mesh, areas, {{200, 50}}, 400);
	EXPECT_NEAR(density.before, 100.0, 1e-9); // sqrt(200 * 50)
	EXPECT_NEAR(density.after, 200.0, 1e-9);
	EXPECT_NEAR(density.ratio, 2.0, 1e-12);
	for (TexturedFace& face : mesh.faces)
		face.picture = -1; // coloured
	EXPECT_EQ(texelDensity(mesh, areas, {}, 400).ratio, 0.0);
}

} // namespace
} // namespace ricci::testing
