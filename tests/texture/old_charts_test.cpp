// SPDX-License-Identifier: GPL-3.0-or-later
#include "painted_square.h"

#include "support/listener.h"

#include <ricci/texture/old_charts.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>

namespace ricci::testing {
namespace {

std::vector<TexturedFace> facesOf(const Square& square, const std::vector<Triangle2>& old)
{
	return carriedMesh(square, old, old).faces;
}

std::size_t chartsOf(const std::vector<TexturedFace>& faces)
{
	const std::vector<int> charts = oldCharts(faces);
	return std::set<int>(charts.begin(), charts.end()).size();
}

std::vector<int> allOf(const std::vector<TexturedFace>& faces)
{
	std::vector<int> numbers(faces.size());
	std::iota(numbers.begin(), numbers.end(), 0);
	return numbers;
}

TEST(OldCharts, AreJoinedByEqualCoordinates)
{
	const Square square(6);
	std::vector<TexturedFace> faces = facesOf(square, square.place);
	EXPECT_EQ(chartsOf(faces), 1u);
	// The right half moves away.
	for (TexturedFace& face : faces)
		if (std::min({face.uv[0][0], face.uv[1][0], face.uv[2][0]}) > 0.49)
			for (Point2& p : face.uv)
				p[0] += 0.25;
	EXPECT_EQ(chartsOf(faces), 2u);
	// It stays, but in another picture.
	faces = facesOf(square, square.place);
	for (TexturedFace& face : faces)
		if (std::min({face.uv[0][0], face.uv[1][0], face.uv[2][0]}) > 0.49)
			face.picture = 1;
	EXPECT_EQ(chartsOf(faces), 2u);
}

TEST(OldCharts, TouchInAShatteredAtlas)
{
	Random random(733);
	const Square square(5);
	EXPECT_EQ(chartsOf(facesOf(square, shatteredAtlas(50, random))), 50u);
}

TEST(OldOwners, KnowTheTexelsOfEachChart)
{
	Random random(734);
	const Square square(4);
	const std::vector<TexturedFace> faces = facesOf(square, shatteredAtlas(32, random));
	const std::vector<int> charts = oldCharts(faces);
	const int size = 80; // the diagonals of the cells of 20 x 20 run through middles of texels
	const OldOwners owners(faces, charts, allOf(faces), size, size);
	for (int y = 0; y < size; ++y)
		for (int x = 0; x < size; ++x) {
			const bool onDiagonal = x % 20 == 19 - y % 20;
			int count = 0;
			for (std::size_t f = 0; f < faces.size(); ++f) {
				if (!owners.of(charts[f]).has(static_cast<std::size_t>(y * size + x)))
					continue;
				++count;
				const Point3 w =
					nearestInTriangle(oldTexels(faces[f], size, size), {x + 0.5, y + 0.5});
				EXPECT_GT(std::min({w[0], w[1], w[2]}), 0.0);
			}
			EXPECT_EQ(count, onDiagonal ? 0 : 1);
		}
}

TEST(OldOwners, KnowTheBlocksOfEachChart)
{
	Random random(735);
	const Square square(4);
	const std::vector<TexturedFace> faces = facesOf(square, shatteredAtlas(32, random));
	const std::vector<int> charts = oldCharts(faces);
	const Blocks blocks{83, 57};
	OldOwners owners(faces, charts, allOf(faces), blocks.width, blocks.height);
	owners.addLevels(blocks.lastLevel());
	int whole = 0, parts = 0;
	for (const int chart : charts)
		for (int level = 0; level <= blocks.lastLevel(); ++level)
			blocks.forLevel(level, [&](const Block& b) {
				const int side = 1 << level;
				int all = 0, own = 0;
				for (int y = b.y * side; y < std::min((b.y + 1) * side, blocks.height); ++y)
					for (int x = b.x * side; x < std::min((b.x + 1) * side, blocks.width); ++x) {
						++all;
						own += owners.of(chart).has(blocks.index({0, x, y}));
					}
				ASSERT_EQ(blocks.texels(b), all);
				switch (owners.of(chart).of(level, blocks.index(b))) {
				case OldOwners::Share::All:
					EXPECT_EQ(own, all);
					break;
				case OldOwners::Share::None:
					EXPECT_EQ(own, 0);
					break;
				case OldOwners::Share::Part: // what overlaps is own and may look like a part
					EXPECT_LT(own, all);
					++parts;
				}
				whole += level > 0 && own == all;
			});
	EXPECT_GT(whole, 100);
	EXPECT_GT(parts, 100);
}

TEST(OldOwners, ShareWhatOverlaps)
{
	const Square square(1);
	std::vector<TexturedFace> faces = facesOf(square, square.place);
	faces[1].uv = {Point2{1, 0}, Point2{0, 0}, Point2{1, 1}}; // on the first one, turned over
	faces[1].vertices = {4, 5, 6};
	const std::vector<int> charts = oldCharts(faces);
	const OldOwners owners(faces, charts, allOf(faces), 10, 10);
	const std::size_t middle = 6 * 10 + 7;
	EXPECT_TRUE(owners.of(charts[0]).has(middle));
	EXPECT_TRUE(owners.of(charts[1]).has(middle));
}

TEST(OldOwners, CostsNoMoreThanAFewPicturesWhereAllFacesShowAllOfIt)
{
	// A thousand tiles, each with the whole picture in two triangles of one chart, in turns mirrored.
	std::vector<TexturedFace> faces;
	const std::vector<Triangle2> whole = box(0.0, 0.0, 1.0, 1.0);
	for (int tile = 0; tile < 1000; ++tile)
		for (const int half : {0, 1}) {
			TexturedFace face;
			face.picture = 0;
			const int v = 4 * tile;
			face.vertices = half == 0 ? Triangle{v, v + 1, v + 2} : Triangle{v, v + 2, v + 3};
			face.uv = whole[positionOf(half)];
			if (tile % 2 == 1)
				for (Point2& p : face.uv)
					p[0] = 1.0 - p[0];
			faces.push_back(face);
		}
	const std::vector<int> charts = oldCharts(faces);
	const int size = 256; // 65536 texels: one tick
	Listener ticks;
	const Task task(ticks);
	const OldOwners owners(faces, charts, allOf(faces), size, size);
	const int ofPictures = static_cast<int>(OldOwners::kMaxLayers) + 2, ofFaces = 2;
	EXPECT_LE(ticks.calls(), 2 * (ofPictures + ofFaces));
	EXPECT_GE(ticks.calls(), 2 * ofPictures - 4);
	for (const int chart : charts)
		for (std::size_t texel = 0; texel < size * size; texel += 37) {
			ASSERT_TRUE(owners.of(chart).has(texel));
			ASSERT_FALSE(owners.of(chart).repeats());
		}
}

TEST(OldTexels, StartInTheFirstPicture)
{
	TexturedFace face;
	face.uv = {Point2{-3.75, 7.25}, Point2{-3.25, 7.25}, Point2{-3.75, 7.5}};
	const Triangle2 t = oldTexels(face, 100, 200);
	EXPECT_DOUBLE_EQ(t[0][0], 25.0);
	EXPECT_DOUBLE_EQ(t[0][1], 150.0);
	EXPECT_DOUBLE_EQ(t[2][1], 100.0);
	face.uv[1][0] = std::numeric_limits<double>::quiet_NaN();
	for (const Point2& p : oldTexels(face, 100, 200))
		EXPECT_TRUE(std::isfinite(p[0]));
}

} // namespace
} // namespace ricci::testing
