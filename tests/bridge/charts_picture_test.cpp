// SPDX-License-Identifier: GPL-3.0-or-later
#include "bridge/charts_picture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>

namespace filter_ricci {
namespace {

/// A square of side 2 in the plane, of two triangles, and their sides on a surface on which the second is
/// \p scale times as large as the first.
ricci::FlatMesh square(double scale)
{
	ricci::FlatMesh map;
	map.place = {
		ricci::Point2{-1, -1}, ricci::Point2{1, -1}, ricci::Point2{1, 1}, ricci::Point2{-1, 1}};
	map.points = {ricci::Triangle{0, 1, 2}, ricci::Triangle{0, 2, 3}};
	map.vertices = map.points;
	map.chart = {0, 0};
	map.face = {0, 1};
	const double d = std::sqrt(8.0);
	map.lengths = {
		std::array<double, 3>{2, 2, d}, std::array<double, 3>{scale * d, scale * 2, scale * 2}};
	return map;
}

/// Cells of each colour.
std::map<std::string, int> cells(const std::string& svg)
{
	std::map<std::string, int> count;
	const std::string fill = "<path fill=\"", runs = "\" d=\"";
	for (auto at = svg.find(fill); at != std::string::npos; at = svg.find(fill, at)) {
		at += fill.size();
		const auto path = svg.find(runs, at) + runs.size(), last = svg.find('"', path);
		const std::string colour = svg.substr(at, path - runs.size() - at);
		const std::string d = svg.substr(path, last - path);
		for (auto run = d.find('h'); run != std::string::npos; run = d.find('h', run + 1))
			if (d[run + 1] != '-') // back again
				count[colour] += std::stoi(d.substr(run + 1));
	}
	return count;
}

TEST(ChartsPicture, IsOfOneColourWhereAreasKeepTheirRatios)
{
	const auto count = cells(chartsPicture(square(1.0)));
	ASSERT_EQ(count.size(), 1u);
	EXPECT_EQ(count.at("rgb(240,240,240)"), kPictureSize * kPictureSize);
}

TEST(ChartsPicture, ShowsWhatIsTooSmallInBlueAndWhatIsTooLargeInRed)
{
	// The shares on the surface are 1/10 and 9/10: factors of 5 and 5/9.
	const auto count = cells(chartsPicture(square(3.0)));
	ASSERT_EQ(count.size(), 2u);
	EXPECT_EQ(
		count.at("rgb(178,24,43)") + count.at("rgb(137,171,206)"), kPictureSize * kPictureSize);
	EXPECT_LE(std::abs(count.at("rgb(178,24,43)") - count.at("rgb(137,171,206)")), kPictureSize);
}

TEST(ChartsPicture, OutlinesTheChart)
{
	const std::string svg = chartsPicture(square(1.0));
	const auto outline = svg.find("class=\"outline\"");
	ASSERT_NE(outline, std::string::npos);
	const std::string path = svg.substr(outline, svg.find("/>", outline) - outline);
	EXPECT_EQ(std::count(path.begin(), path.end(), 'L'), 4); // the diagonal is inside
}

} // namespace
} // namespace filter_ricci
