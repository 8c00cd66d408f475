// SPDX-License-Identifier: GPL-3.0-or-later
#include "charts_picture.h"

#include <ricci/base/numbers.h>
#include <ricci/metric/area.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace filter_ricci {

namespace {

/// Colours; one step is the root of 2 in area.
constexpr int kShades = 9, kMiddle = kShades / 2;

/// More sides on outlines than this would hide the charts.
constexpr std::size_t kMaxOutline = 100000;

std::string shadeColour(int shade)
{
	const int end[2][3] = {{33, 102, 172}, {178, 24, 43}}, grey = 240;
	std::string colour = "rgb(";
	for (int k = 0; k < 3; ++k)
		colour += (k == 0 ? "" : ",") + std::to_string(
											grey + (end[shade > kMiddle ? 1 : 0][k] - grey) *
													   std::abs(shade - kMiddle) / kMiddle);
	return colour + ")";
}

/// [triangle] its colour.
std::vector<int> shades(const ricci::FlatMesh& map)
{
	using ricci::operator-;
	std::vector<double> plane, space;
	double planeSum = 0.0, spaceSum = 0.0;
	for (int t = 0; t < map.size(); ++t) {
		const ricci::Triangle2 p = map.at(t);
		plane.push_back(0.5 * std::abs(ricci::cross(p[1] - p[0], p[2] - p[0])));
		space.push_back(ricci::euclideanArea(map.lengths[t]));
		planeSum += plane.back();
		spaceSum += space.back();
	}
	std::vector<int> result;
	for (std::size_t t = 0; t < plane.size(); ++t) {
		const double factor = plane[t] / planeSum / (space[t] / spaceSum);
		const double steps = std::isnan(factor) ? 0.0 : 2.0 * std::log2(factor);
		result.push_back(
			kMiddle +
			static_cast<int>(std::lround(std::clamp(steps, -kMiddle * 1.0, kMiddle * 1.0))));
	}
	return result;
}

/// From the plane to the cells.
class Frame
{
public:
	explicit Frame(const ricci::Box2& box) :
			m_corner{box.min[0], box.max[1]},
			m_scale(kPictureSize / std::max({box.width(), box.height(), 1e-300}))
	{
	}

	ricci::Point2 operator()(const ricci::Point2& p) const
	{
		return {m_scale * (p[0] - m_corner[0]), m_scale * (m_corner[1] - p[1])};
	}

private:
	ricci::Point2 m_corner;
	double m_scale;
};

/// The cell whose middle is the first one at x or beyond.
int cellAt(double x)
{
	return static_cast<int>(std::clamp(std::ceil(x - 0.5), 0.0, static_cast<double>(kPictureSize)));
}

using Cells = std::vector<signed char>; // row by row, -1 where there is no chart

void fill(const ricci::Triangle2& p, int shade, Cells& cells)
{
	const auto [low, high] = std::minmax({p[0][1], p[1][1], p[2][1]});
	for (int row = cellAt(low); row < cellAt(high); ++row) {
		double from = kPictureSize, to = 0.0;
		for (std::size_t k = 0; k < 3; ++k) {
			// In one direction for both triangles at the side: no cell is left between them.
			const auto& [a, b] = std::minmax(p[k], p[(k + 1) % 3]);
			const double t = (row + 0.5 - a[1]) / (b[1] - a[1]);
			if (t >= 0.0 && t <= 1.0) {
				from = std::min(from, a[0] + t * (b[0] - a[0]));
				to = std::max(to, a[0] + t * (b[0] - a[0]));
			}
		}
		for (int column = cellAt(from); column < cellAt(to); ++column)
			cells[static_cast<std::size_t>(row * kPictureSize + column)] =
				static_cast<signed char>(shade);
	}
}

/// All cells of one colour, by their runs in the rows.
std::string cellsOf(int shade, const Cells& cells)
{
	std::string path;
	for (int row = 0; row < kPictureSize; ++row)
		for (int column = 0, end; column < kPictureSize; column = end) {
			const auto at = [&](int i) {
				return cells[static_cast<std::size_t>(row * kPictureSize + i)];
			};
			for (end = column + 1; end < kPictureSize && at(end) == at(column);)
				++end;
			const std::string run = std::to_string(end - column);
			if (at(column) == shade)
				path += "M" + std::to_string(column) + " " + std::to_string(row) + "h" + run +
						"v1h-" + run + "z";
		}
	return path.empty() ? path : "<path fill=\"" + shadeColour(shade) + "\" d=\"" + path + "\"/>\n";
}

std::string outlines(const ricci::FlatMesh& map, const Frame& frame)
{
	std::vector<std::pair<int, int>> sides;
	for (const ricci::Triangle& t : map.points)
		for (std::size_t k = 0; k < 3; ++k)
			sides.emplace_back(t[k], t[(k + 1) % 3]);
	std::sort(sides.begin(), sides.end());
	std::string path;
	std::size_t count = 0;
	for (const auto& [a, b] : sides)
		if (!std::binary_search(sides.begin(), sides.end(), std::make_pair(b, a)) &&
			++count <= kMaxOutline) {
			const ricci::Point2 p = frame(map.place[a]), q = frame(map.place[b]);
			path += "M" + ricci::numberText(p[0], 5) + " " + ricci::numberText(p[1], 5) + "L" +
					ricci::numberText(q[0], 5) + " " + ricci::numberText(q[1], 5);
		}
	return count > kMaxOutline ? "" : "<path class=\"outline\" d=\"" + path + "\"/>\n";
}

std::string legend()
{
	std::string svg;
	const int width = kPictureSize / kShades, top = kPictureSize + 8;
	for (int shade = 0; shade < kShades; ++shade) {
		const int left = shade * width;
		svg += "<rect x=\"" + std::to_string(left) + "\" y=\"" + std::to_string(top) +
			   "\" width=\"" + std::to_string(width) + "\" height=\"10\" fill=\"" +
			   shadeColour(shade) + "\"/>\n";
		if (shade % 2 == 0)
			svg += "<text x=\"" + std::to_string(left + width / 2) + "\" y=\"" +
				   std::to_string(top + 24) + "\" text-anchor=\"middle\">" +
				   ricci::numberText(std::exp2(0.5 * (shade - kMiddle)), 3) + "</text>\n";
	}
	return svg;
}

} // namespace

std::string chartsPicture(const ricci::FlatMesh& map)
{
	const Frame frame(map.box());
	const std::vector<int> shade = shades(map);
	Cells cells(static_cast<std::size_t>(kPictureSize * kPictureSize), -1);
	for (int t = 0; t < map.size(); ++t) {
		const ricci::Triangle2 p = map.at(t);
		fill({frame(p[0]), frame(p[1]), frame(p[2])}, shade[static_cast<std::size_t>(t)], cells);
	}
	const std::string size = std::to_string(kPictureSize);
	std::string svg =
		"<svg class=\"charts\" viewBox=\"-1 -1 " + std::to_string(kPictureSize + 2) + " " +
		std::to_string(kPictureSize + 40) +
		"\" role=\"img\" xmlns=\"http://www.w3.org/2000/svg\">\n<rect class=\"frame\" width=\"" +
		size + "\" height=\"" + size + "\"/>\n<g shape-rendering=\"crispEdges\">\n";
	for (int i = 0; i < kShades; ++i)
		svg += cellsOf(i, cells);
	return svg + "</g>\n" + outlines(map, frame) + legend() + "</svg>\n";
}

} // namespace filter_ricci
