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

/// Faces in old pictures, and their charts.
struct Old
{
	std::vector<TexturedFace> faces;
	std::vector<int> charts, all;

	explicit Old(std::vector<TexturedFace> textured) :
			faces(std::move(textured)), charts(oldCharts(faces)), all(faces.size())
	{
		std::iota(all.begin(), all.end(), 0);
	}
	Old(const Square& square, const std::vector<Triangle2>& old) :
			Old(carriedMesh(square, old, old).faces)
	{
	}

	std::size_t count() const { return std::set<int>(charts.begin(), charts.end()).size(); }
};

/// A thousand tiles, each with the whole picture in two triangles of one chart, in turns mirrored.
TEST(OldOwners, CostsNoMoreThanAFewPicturesWhereAllFacesShowAllOfIt)
{
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
	const Old old(faces);
	const int size = 256; // 65536 texels: one tick
	Listener ticks;
	const OldOwners owners =
		withListener(ticks, [&] { return OldOwners(old.faces, old.charts, old.all, size, size); });
	const int ofPictures = static_cast<int>(OldOwners::kMaxLayers) + 2, ofFaces = 2;
	EXPECT_LE(ticks.calls(), 2 * (ofPictures + ofFaces));
	EXPECT_GE(ticks.calls(), 2 * ofPictures - 4);
	for (const int chart : old.charts)
		for (std::size_t texel = 0; texel < size * size; texel += 37) {
			ASSERT_TRUE(owners.of(chart).has(texel));
			ASSERT_FALSE(owners.of(chart).repeats());
		}
}

/// By trying all; with one thread and with several.
TEST(NearestFill, IsTheNearest)
{
	Random random(731);
	for (int n : {0, 1, 2, 7, 40, 400}) {
		const int width = 37, height = 23;
		Picture<unsigned short> one(width, height);
		std::vector<char> covered(static_cast<std::size_t>(width * height), 0);
		std::vector<int> places;
		for (int i = 0; i < n; ++i) {
			places.push_back(random.index(width * height));
			covered[positionOf(places.back())] = 1;
			one.rgba[4 * positionOf(places.back())] =
				static_cast<unsigned short>(places.back() + 1);
		}
		Picture<unsigned short> many = one;
		fillFromNearest(covered, one.target(), 1);
		fillFromNearest(covered, many.target(), 5);
		EXPECT_EQ(one.rgba, many.rgba);
		for (int at = 0; at < width * height; ++at) {
			const auto square = [&](int other) {
				const int dx = other % width - at % width, dy = other / width - at / width;
				return dx * dx + dy * dy;
			};
			int least = std::numeric_limits<int>::max();
			for (int other : places)
				least = std::min(least, square(other));
			const int taken = one.rgba[4 * positionOf(at)] - 1;
			if (n == 0)
				EXPECT_EQ(taken, -1);
			else
				ASSERT_EQ(square(taken), least);
		}
		Listener impatient(1);
		EXPECT_THROW(
			withListener(impatient, [&] { fillFromNearest(covered, many.target(), 2); }),
			Cancelled);
	}
}

} // namespace
} // namespace ricci::testing
