// SPDX-License-Identifier: GPL-3.0-or-later
#include "pack.h"

#include "../base/convex_hull.h"
#include "../base/task.h"
#include "../base/tolerances.h"
#include "../error.h"
#include "pack_items.h"
#include "separate_charts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>

namespace ricci {

namespace {

/// Attempts to find the padding between charts, which grows with the square that holds them.
constexpr int kMaxAttempts = 60;

/// A lone chart lies along the axes if the square round it is wider by no more than this share. Nets of boxes, which
/// mostly are one chart, stay below it; a strip ten times as long as wide fills a tenth of the square in place of a sixth.
constexpr double kUprightCost = 0.1;

/// A square of cells, which take more room than outlines do, is wider by this factor than that of the boxes.
constexpr double kWider = 1.1;

/// Rounding may leave the unit square by one unit of the last place.
void clampToUnitSquare(Parametrization& map)
{
	for (Point2& p : map.mesh.place)
		for (double& x : p)
			x = std::min(std::max(x, 0.0), 1.0);
	for (Chart& chart : map.charts)
		for (Point2* p : {&chart.box.min, &chart.box.max})
			for (double& x : *p)
				x = std::min(std::max(x, 0.0), 1.0);
}

/// Charts in a square: their motions, the box round them and the padding between it and the square.
struct Packing
{
	std::vector<Motion> motions; ///< [chart]
	Box2 whole;
	double padding = 0.0;

	double side() const { return whole.extent() + 2.0 * padding; }
};

/// By boxes alone.
/// \return without motions where they do not fit with the margin
Packing packBoxes(const std::vector<Box2>& boxes, double margin)
{
	// The margin is a share of a square that grows with the margin.
	Packing packing;
	double size = 0.0;
	for (int attempt = 0; attempt == 0 || packing.padding < margin * size; ++attempt) {
		if (attempt == kMaxAttempts || !marginsMayFit(boxes.size(), margin))
			return {};
		packing = {};
		packing.padding = (1.0 + kMarginSpare) * margin * size;
		const std::vector<Point2> shift = sideBySide(boxes, packing.padding);
		for (std::size_t i = 0; i < boxes.size(); ++i) {
			packing.whole.add(boxes[i].min + shift[i]);
			packing.whole.add(boxes[i].max + shift[i]);
			packing.motions.push_back({1.0, asComplex(shift[i])});
		}
		size = packing.side();
	}
	return packing;
}

/// One chart, turned so that the square round it is smallest, or upright where that costs little.
Packing packAlone(const FlatMesh& mesh, bool isUpright)
{
	const OrientedRectangle r = minExtentRectangle(mesh.place.values());
	const Box2 box = mesh.box();
	Packing packing;
	if (isUpright && box.extent() <= (1.0 + kUprightCost) * r.extent()) {
		packing.motions.emplace_back();
		packing.whole = box;
		return packing;
	}
	packing.motions.push_back({{r.cosine, -r.sine}, {0.0, 0.0}});
	packing.whole.add(r.min);
	packing.whole.add(r.max);
	return packing;
}

/// By outlines.
/// \return without motions where the outlines need more than that square and some more
Packing packByOutlines(const FlatMesh& mesh, const ChartsToPack& charts, const PackSquare& square)
{
	const PackItems items = packItems(mesh, charts, square);
	const std::vector<Motion> motions = packOutlines(
		items.outlines, items.turns, kWider * square.side - square.padding, square.padding);
	if (motions.empty())
		return {};
	Packing packing;
	for (std::size_t k = 0; k < items.outlines.size(); ++k)
		for (const auto& ends : items.outlines[k])
			for (const Point2& p : ends)
				packing.whole.add(motions[k](p));
	for (std::size_t i = 0; i < items.itemOf.size(); ++i)
		packing.motions.push_back(items.motionOf(i, motions[items.itemOf[i]]));
	return packing;
}

/// Moves the charts and their boxes. A chart that is turned by less than a right angle gets its own box.
void place(const std::vector<Motion>& motions, const std::vector<Box2>& boxes, Parametrization& map)
{
	moveCharts(motions, map.mesh);
	std::vector<Box2> own = map.mesh.boxes(boxes.size());
	for (std::size_t i = 0; i < boxes.size(); ++i) {
		const Motion& motion = motions[i];
		Box2& box = map.charts[i].box;
		box = {};
		if (motion.turn.real() != 0.0 && motion.turn.imag() != 0.0)
			box = own[i];
		else
			for (const Point2& p : {boxes[i].min, boxes[i].max})
				box.add(motion(p));
	}
}

void requireFloats(const Array<Point2>& places)
{
	using Float = std::numeric_limits<float>;
	// The steps of floats become no smaller below the normal numbers.
	const double smallest =
		static_cast<double>(Float::min()) / static_cast<double>(Float::epsilon());
	double largest = 0.0;
	for (const Point2& p : places)
		for (double x : p) {
			if (!(std::abs(x) <= static_cast<double>(Float::max())))
				throw InvalidMesh(InvalidMesh::BeyondFloats);
			largest = std::max(largest, std::abs(x));
		}
	if (largest > 0.0 && largest < smallest)
		throw InvalidMesh(InvalidMesh::BeyondFloats);
}

/// packCharts() into the unit square, without cuts.
void packIntoSquare(Parametrization& map, const PackOptions& options, ChartTurns turns)
{
	const ChartsToPack charts = chartsToPack(options, turns, map.charts.size(), map.mesh);
	const std::vector<Box2>& boxes = charts.boxes;
	double margin = options.chartMargin;
	Packing packing = packBoxes(boxes, margin);
	while (packing.motions.empty())
		packing = packBoxes(boxes, margin *= 0.5);
	map.report.margin = margin;
	if (charts.turns != ChartTurns::None && packing.side() > 0.0 &&
		!(boxes.size() == 1 && (charts.isThin.front() || options.turns == ChartTurns::Quarter))) {
		const double padding = std::max(packing.padding, kMinPadding * packing.side());
		Packing turned =
			boxes.size() == 1
				? packAlone(map.mesh, charts.isUpright.front() != 0)
				: packByOutlines(
					  map.mesh, charts, {packing.side(), padding, boxes.size(), kInfinity});
		const double share = (1.0 + kMarginSpare) * margin; // of the square, on each side
		turned.padding = share / (1.0 - 2.0 * share) * turned.whole.extent();
		if (!turned.motions.empty() && turned.side() <= (1.0 - kWorthTurning) * packing.side())
			packing = std::move(turned);
	}
	const std::complex<double> corner(
		packing.whole.min[0] - packing.padding, packing.whole.min[1] - packing.padding);
	const double scale = 1.0 / packing.side();
	for (Motion& motion : packing.motions)
		motion = {scale * motion.turn, scale * (motion.shift - corner)};
	place(packing.motions, boxes, map);
	clampToUnitSquare(map);
	map.report.occupancy = map.mesh.planeArea();
}

/// packCharts() into the unit square, with cuts.
void packWithCuts(Parametrization& map, const PackOptions& options, ChartTurns turns)
{
	packIntoSquare(map, options, turns);
	if (std::min(turns, options.turns) == ChartTurns::None)
		return;
	const double area = map.mesh.area();
	const auto price = [&] {
		return kPackingPrice * std::log(std::sqrt(area) + map.report.seamLength);
	};
	// What cuts and packing change, where the map is not the best.
	std::optional<
		std::tuple<Array<Triangle>, Array<Point2>, Array<int>, std::vector<Chart>, Report>>
		best;
	double least = std::log(map.report.occupancy) - price(); // a better one is worth more
	double dearest = price() + kMaxLoss;
	const auto cut = [&] {
		if (price() >= dearest || std::log(kEnoughCovered) - price() <= least + kMinRoom)
			return false;
		const std::optional<ChartCut> next = findCutForPacking(map, area);
		if (!next)
			return false;
		if (!best)
			best.emplace(map.mesh.points, map.mesh.place, map.mesh.chart, map.charts, map.report);
		if (map.charts[positionOf(next->chart)].isMirrored)
			least += kMirroredSurcharge *
					 std::log1p(next->length / (std::sqrt(area) + map.report.seamLength));
		least += kMinRoom;
		cutChart(*next, turns == ChartTurns::Free, map);
		return true;
	};
	for (int vain = 0; cut();) {
		// As many more at once as were in vain: it takes longer to pack than to cut.
		const int end = 2 * vain;
		while (++vain < end && cut()) {
		}
		const double margin = map.report.margin;
		packIntoSquare(map, options, turns);
		if (map.report.margin < margin)
			break; // there is no room for so many charts
		if (const double reached = std::log(map.report.occupancy) - price(); reached > least) {
			best.reset();
			least = reached;
			dearest = price() + kMaxLoss;
			vain = 0;
		}
	}
	if (best)
		std::tie(map.mesh.points, map.mesh.place, map.mesh.chart, map.charts, map.report) =
			*std::move(best);
}

/// Scales a map and the boxes of its charts.
void scaleBy(double scale, Parametrization& map)
{
	for (Point2& p : map.mesh.place)
		p *= scale;
	for (Chart& chart : map.charts)
		for (Point2* p : {&chart.box.min, &chart.box.max})
			*p *= scale;
}

/// Charts of tiles, in units of these.
class Tiles
{
public:
	Tiles(const PackOptions& options, ChartTurns turns, Parametrization& map) :
			m_options(options), m_turns(turns), m_map(map)
	{
		const double area = map.mesh.area(), covered = map.mesh.planeArea();
		if (area > kMaxTiles * options.tileSide * options.tileSide)
			refuse(std::sqrt(area / (kLeastFilled * kMaxTiles)));
		if (options.tileSide > kLargest * std::sqrt(area))
			refuse(kLargest * std::sqrt(area));
		if (covered > 0.0)
			scaleBy(std::sqrt(area / covered) / options.tileSide, map);
		measure();
	}

	/// Cuts charts that are too long, until none is.
	void cutToFit(bool mayCut)
	{
		for (std::vector<std::size_t> tooLong; !(tooLong = findTooLong()).empty();) {
			for (const std::size_t chart : tooLong) {
				std::optional<ChartCut> cut;
				if (mayCut)
					cut = findCutToFit(m_map.mesh, m_charts.triangles[chart], m_room);
				if (!cut)
					refuse(m_options.tileSide * m_extents[chart] / m_room);
				cut->chart = static_cast<int>(chart);
				cutChart(
					*cut,
					m_turns == ChartTurns::Free && m_options.turns != ChartTurns::None,
					m_map);
			}
			measure();
		}
	}

	void pack()
	{
		// Tilted, it may be short enough.
		const std::vector<Box2>& boxes = m_charts.boxes;
		for (std::size_t i = 0; i < boxes.size(); ++i)
			if (m_charts.turns == ChartTurns::Free && boxes[i].extent() > m_room)
				m_charts.isUpright[i] = 0;
		const double side = 1.0 - m_padding;
		const PackItems items = packItems(
			m_map.mesh,
			m_charts,
			{side,
			 m_padding,
			 outlinesPerSquare(boxes.size(), m_map.mesh.planeArea()),
			 kLongestBox});
		const auto places = packIntoTiles(items.outlines, items.turns, side, m_padding);
		if (places.empty())
			throw InternalError("A chart does not fit into a tile");
		std::vector<Motion> motions;
		m_map.report.tiles = 1;
		for (std::size_t i = 0; i < boxes.size(); ++i) {
			const auto& [tile, motion] = places[items.itemOf[i]];
			motions.push_back(items.motionOf(i, motion));
			const int column = tile % kTilesInRow, row = tile / kTilesInRow;
			motions.back().shift +=
				std::complex<double>(0.5 * m_padding + column, 0.5 * m_padding + row);
			m_map.report.tiles = std::max(m_map.report.tiles, tile + 1);
		}
		if (m_map.report.tiles > kMaxTiles)
			refuse(m_options.tileSide * std::sqrt(kMore * m_map.report.tiles / kMaxTiles));
		place(motions, boxes, m_map);
		m_map.report.margin = m_options.chartMargin;
		m_map.report.occupancy = m_map.mesh.planeArea() / m_map.report.tiles;
	}

private:
	[[noreturn]] void refuse(double bound) const
	{
		throw InvalidOption(InvalidOption::TileSide, m_options.tileSide, bound);
	}

	void measure() { m_charts = chartsToPack(m_options, m_turns, m_map.charts.size(), m_map.mesh); }

	/// Fills m_extents.
	std::vector<std::size_t> findTooLong()
	{
		std::vector<std::size_t> tooLong;
		m_extents.clear();
		std::vector<std::vector<int>> pointsOf; // of charts, once they are asked for
		for (std::size_t i = 0; i < m_charts.boxes.size(); ++i) {
			double extent = m_charts.boxes[i].extent();
			if (extent > m_room && m_charts.turns == ChartTurns::Free && !m_charts.isThin[i]) {
				if (pointsOf.empty())
					pointsOf = m_map.mesh.pointsByChart(m_charts.boxes.size());
				std::vector<Point2> points;
				for (const int p : pointsOf[i])
					points.push_back(m_map.mesh.place[p]);
				extent = minExtentRectangle(std::move(points)).extent();
			}
			m_extents.push_back(extent);
			if (extent > m_room)
				tooLong.push_back(i);
		}
		return tooLong;
	}

	/// What a refusal suggests: tiles of which charts are likely to fill this share at least; and where charts took too
	/// many tiles, an area of each that is larger than would be enough by this factor.
	static constexpr double kLeastFilled = 1.0 / 3.0, kMore = 1.5;

	/// In a tile larger than so many square roots of the area floats would leave little of a chart. Boxes of small charts
	/// are no longer than the second, so that they find room beside others.
	static constexpr double kLargest = 1000.0, kLongestBox = 0.25;

	const PackOptions& m_options;
	ChartTurns m_turns;
	Parametrization& m_map;
	double m_padding = (1.0 + kMarginSpare) * std::max(m_options.chartMargin, kMinPadding);
	double m_room = (1.0 - kMarginSpare) * (1.0 - 2.0 * m_padding); // for the extent of a chart
	ChartsToPack m_charts;
	std::vector<double> m_extents; // [chart] as it may be turned
};

} // namespace

bool marginsMayFit(std::size_t charts, double margin)
{
	const double free = 1.0 - margin;
	return static_cast<double>(charts) * margin * margin <= free * free;
}

void packCharts(Parametrization& map, const PackOptions& options, ChartTurns turns, bool mayCut)
{
	if (options.tileSide > 0.0) {
		Tiles tiles(options, turns, map);
		tiles.cutToFit(mayCut);
		tiles.pack();
		return;
	}
	const Array<Point2> before = map.mesh.place;
	const double area = map.mesh.planeArea();
	if (mayCut)
		packWithCuts(map, options, turns);
	else
		packIntoSquare(map, options, turns);
	if (options.normalizeUV)
		return;
	if (map.charts.size() == 1) {
		map.mesh.place = before;
		packIntoSquare(map, options, ChartTurns::None);
	}
	const double covered = map.mesh.planeArea(),
				 scale = covered > 0.0 ? std::sqrt(area / covered) : 1.0;
	scaleBy(scale, map);
	requireFloats(map.mesh.place);
}

void placeDisks(Parametrization& map)
{
	const int perRow =
		static_cast<int>(std::ceil(std::sqrt(static_cast<double>(map.charts.size()))));
	const double side = 1.0 / perRow;
	std::vector<Motion> motions;
	for (Chart& chart : map.charts) {
		const int i = static_cast<int>(motions.size()), row = i / perRow;
		Box2& square = chart.box;
		square = {};
		square.min = {side * (i % perRow), side * row};
		square.max = {square.min[0] + side, square.min[1] + side};
		motions.push_back({0.5 * side, asComplex(square.centre())});
	}
	moveCharts(motions, map.mesh);
	clampToUnitSquare(map);
	map.report.occupancy = map.mesh.planeArea();
}

} // namespace ricci
