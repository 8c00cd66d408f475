// SPDX-License-Identifier: GPL-3.0-or-later
#include "old_charts.h"

#include "../base/graphs.h"
#include "../base/task.h"
#include "../base/tolerances.h"
#include "../mesh/sides.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ricci {

namespace {

/// Texels this near to the side of a triangle count as on it: floats cannot tell.
constexpr double kBorder = 0.01;

bool same(const Point2& a, const Point2& b)
{
	return std::abs(a[0] - b[0]) <= kSameCoordinate && std::abs(a[1] - b[1]) <= kSameCoordinate;
}

/// Whether two sides of an edge have the same place in the same picture.
bool isSame(const std::vector<TexturedFace>& faces, Corner c, Corner d)
{
	const TexturedFace &f = faces[positionOf(c.face())], &g = faces[positionOf(d.face())];
	const bool sameWay = f.vertices[c.index()] == g.vertices[d.index()];
	const Corner first = sameWay ? d : d.next(), second = sameWay ? d.next() : d;
	return f.picture == g.picture && same(f.uv[c.index()], g.uv[first.index()]) &&
		   same(f.uv[c.next().index()], g.uv[second.index()]);
}

} // namespace

std::vector<int> oldCharts(const std::vector<TexturedFace>& faces)
{
	std::vector<Triangle> triangles;
	triangles.reserve(faces.size());
	for (const TexturedFace& face : faces)
		triangles.push_back(face.vertices);
	DisjointSets sets(static_cast<int>(faces.size()));
	std::size_t visited = 0;
	Sides(triangles).forEdges([&](const auto& edge) {
		std::vector<Corner> textured;
		for (const Corner c : edge)
			if (faces[positionOf(c.face())].picture >= 0)
				textured.push_back(c);
		for (std::size_t i = 0; i < textured.size(); ++i) {
			checkpointNowAndThen(visited++);
			// Of an edge with many faces the next few are looked at.
			for (std::size_t j = i + 1; j < std::min(i + 8, textured.size()); ++j)
				if (isSame(faces, textured[i], textured[j]))
					sets.merge(textured[i].face(), textured[j].face());
		}
	});
	std::vector<int> charts(faces.size());
	for (std::size_t f = 0; f < faces.size(); ++f)
		charts[f] = sets.find(static_cast<int>(f));
	return charts;
}

Triangle2 oldTexels(const TexturedFace& face, int width, int height)
{
	Triangle2 uv = face.uv;
	for (std::size_t k = 0; k < 2; ++k) {
		const double low = std::floor(std::min({uv[0][k], uv[1][k], uv[2][k]}));
		for (Point2& p : uv)
			p[k] = std::isfinite(p[k] - low) ? p[k] - low : 0.0;
	}
	return inTexels(uv, width, height);
}

OldOwners::OldOwners(
	const std::vector<TexturedFace>& faces,
	const std::vector<int>& charts,
	const std::vector<int>& shown,
	int width,
	int height) :
		m_blocks{width, height},
		m_owners(1), m_repeats(faces.size(), 0), m_isWhole(faces.size(), 0)
{
	const PictureView<const char> view{width, height, nullptr};
	std::vector<int>& owners = m_owners.front();
	owners.assign(view.texels(), kNone);
	const auto wrapped = [](int x, int length) { return ((x % length) + length) % length; };
	const int far = 3 * std::max(width, height);
	for (const bool border : {false, true}) {
		std::size_t visited = 0;
		for (std::size_t i = 0; i < shown.size(); ++i) {
			checkpointNowAndThen(64 * i);
			const std::size_t f = positionOf(shown[i]);
			const Triangle2 t = oldTexels(faces[f], width, height);
			const Box2 box = boxAround(t);
			const int key = keyOf(charts[f]);
			char &repeats = m_repeats[positionOf(charts[f])],
				 &isWhole = m_isWhole[positionOf(charts[f])];
			// They start in the picture, which v leaves at the top.
			if (box.max[0] > width + kBorder || box.min[1] < -kBorder)
				repeats = 1;
			if (box.width() > width + kBorder || box.height() > height + kBorder ||
				visited > kMaxLayers * owners.size())
				isWhole = 1;
			if (isWhole)
				continue;
			forEachTexelOf(t, border ? kBorder : -kBorder, -far, far, [&](int x, int y) {
				checkpointNowAndThen(visited++);
				int& owner = owners[view.index(wrapped(x, width), wrapped(y, height))];
				if (owner == kNone)
					owner = border ? key + 1 : key;
				else if (!border)
					owner = owner == key ? key : kOverlap;
				else if (owner == key + 1)
					owner = key;
				else if (owner % 2 == 1)
					owner = kOutlineOfTwo;
			});
		}
	}
}

void OldOwners::addLevels(int last)
{
	for (int level = 1; level <= last; ++level) {
		const std::vector<int>& finer = m_owners.back();
		std::vector<int> owners;
		m_blocks.forLevel(level, [&](const Block& block) {
			checkpointNowAndThen(owners.size());
			int owner = kNone;
			bool isFirst = true;
			m_blocks.forParts(block, [&](const Block& part) {
				const int own = finer[m_blocks.index(part)];
				owner = isFirst || own == owner ? own : kMixed;
				isFirst = false;
			});
			owners.push_back(owner);
		});
		m_owners.push_back(std::move(owners));
	}
}

} // namespace ricci
