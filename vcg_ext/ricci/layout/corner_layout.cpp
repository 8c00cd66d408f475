// SPDX-License-Identifier: GPL-3.0-or-later
#include "corner_layout.h"

#include "../base/memory_estimate.h"
#include "../base/task.h"
#include "../surface/normal_coordinates.h"
#include "sheets.h"

#include <algorithm>
#include <vector>

namespace ricci {

namespace {

/// The cut on the end triangulation. Its curves are the edges at which the surface is open: those of
/// the cut and of the surface's boundary, beyond which the triangulation may go on.
NormalCoordinates cutOnEnd(
	const FlowDomain& domain,
	const FlowResult& flow,
	const EdgeArray<char>& isCut)
{
	const Triangulation& t = domain.surface.triangulation;
	EdgeArray<char> isCurve = isCut;
	for (const Edge e : t.edges())
		if (t.isBoundary(e))
			isCurve[e] = 1;
	isCurve.resize(flow.history.input.edgeCount(), 0); // the surface's edges come first
	NormalCoordinates cut(flow.history.input, isCurve);
	std::size_t done = 0;
	for (const std::vector<Edge>* flips : {&flow.history.startFlips, &flow.history.flowFlips})
		for (const Edge e : *flips) {
			checkpointNowAndThen(done++);
			cut.flip(e);
		}
	return cut;
}

/// The parts into which the cut divides the end triangles, each drawn as the whole triangle: a sheet.
/// Those of one triangle are numbered from that at the corner from which parts of the cut emanate,
/// counter-clockwise, if there is one; then those that the cut cuts off at its corners, from the
/// outermost on.
class CutSheets
{
public:
	EndSheets sheets; ///< without an overlay

	CutSheets(const Triangulation& end, const NormalCoordinates& cut) :
			m_end(end), m_cut(cut), m_isDivided(end.faceCount(), 0), m_middle(end.faceCount()),
			m_cutOff(end.halfedgeCount())
	{
		int count = 0;
		sheets.endFace.reserve(end.faceCount());
		for (const Face f : end.faces()) {
			m_middle[f] = count;
			const auto h = end.halfedges(f);
			for (const Halfedge side : h)
				m_isDivided[f] |= cut.crossings(side.edge()) > 0;
			if (!m_isDivided[f]) {
				sheets.endFace.push_back(f);
				++count;
				continue;
			}
			const NormalCoordinates::CornerCurves c = cut.cornerCurves(h[0]);
			m_cutOff[h[0]] = count + 1 + c.emanateFromI + c.emanateFromJ + c.emanateFromK;
			m_cutOff[h[1]] = m_cutOff[h[0]] + c.cutOffI;
			m_cutOff[h[2]] = m_cutOff[h[1]] + c.cutOffJ;
			count = m_cutOff[h[2]] + c.cutOffK;
			sheets.endFace.resize(count, f);
		}
		glue();
	}

	/// The sheet on the left of end halfedge \p h, between its crossings \p i - 1 and \p i with the
	/// cut, counted from its origin.
	int beside(Halfedge h, int i) const
	{
		if (!m_isDivided[m_end.face(h)])
			return m_middle[m_end.face(h)];
		const NormalCoordinates::CornerCurves c = m_cut.cornerCurves(h);
		const int fromTarget = m_cut.crossings(h.edge()) - i;
		if (i < c.cutOffI)
			return m_cutOff[h] + i;
		if (fromTarget < c.cutOffJ)
			return m_cutOff[m_end.next(h)] + fromTarget;
		const int before = c.emanateFromK > 0 ? i - c.cutOffI : c.emanateFromJ;
		return m_middle[m_end.face(h)] + before;
	}

	/// How many sheets meet in the corner at the origin of \p h, from beside(h, 0) on.
	int countAt(Halfedge h) const
	{
		return m_isDivided[m_end.face(h)] ? m_cut.cornerCurves(h).emanateFromI + 1 : 1;
	}

private:
	/// Which of its triangle's halfedges end halfedge \p h is.
	int place(Halfedge h) const
	{
		const auto sides = m_end.halfedges(m_end.face(h));
		return static_cast<int>(std::find(sides.begin(), sides.end(), h) - sides.begin());
	}

	/// Along the end edges that are not on the cut.
	void glue()
	{
		std::vector<Triangle> triangles;
		triangles.reserve(sheets.endFace.values().size());
		for (const Face f : sheets.endFace) {
			const auto v = m_end.vertices(f);
			triangles.push_back({v[0].number(), v[1].number(), v[2].number()});
		}
		CornerArray<Corner> across(3 * triangles.size()); // [side of a sheet]
		for (const Edge e : m_end.edges()) {
			if (m_end.isBoundary(e) || m_cut.isCurve(e))
				continue;
			const Halfedge h = e.halfedge(), twin = h.twin();
			const int n = m_cut.crossings(e), own = place(h), other = place(twin);
			for (int i = 0; i <= n; ++i) {
				const Corner a(beside(h, i), own), b(beside(twin, n - i), other);
				across[a] = b;
				across[b] = a;
			}
		}
		sheets.triangulation = Triangulation(m_end.vertexCount(), triangles, across);
	}

	const Triangulation& m_end;
	const NormalCoordinates& m_cut;
	FaceArray<char> m_isDivided; // [end face]
	FaceArray<int> m_middle;     // [end face] its first sheet
	HalfedgeArray<int> m_cutOff; // [end halfedge] first sheet of those cut off at its origin
};

} // namespace

PlanarLayout layOutCorners(
	const FlowDomain& domain,
	const FlowResult& flow,
	const EdgeArray<char>& isCut)
{
	const Triangulation& t = domain.surface.triangulation;
	const Triangulation& end = flow.metric->triangulation();
	const NormalCoordinates cut = cutOnEnd(domain, flow, isCut);
	std::size_t crossings = 0;
	for (const Edge e : end.edges())
		crossings += static_cast<std::size_t>(cut.crossings(e));
	requireOverlayMemory(crossings, false);
	CutSheets parts(end, cut);
	takeMetric(flow, parts.sheets);
	PlanarLayout layout;
	layout.wedges = cornerWedges(t, isCut);
	layout.points.assign(layout.wedges.count, {0.0, 0.0});

	/// Calls \p use(wedge, sheet, k): corner k of the sheet is in this wedge of the surface.
	const auto eachCorner = [&](const auto& use) {
		for (const Face f : end.faces())
			for (std::size_t k = 0; k < 3; ++k) {
				const Halfedge h = end.halfedges(f)[k];
				const Vertex v = end.origin(h);
				if (v.number() >= t.vertexCount())
					continue;
				const int first = parts.beside(h, 0), count = parts.countAt(h);
				for (int i = 0; i < count; ++i) {
					const Halfedge corner =
						cut.hasCurves(v) ? cut.originalAtOrBefore(h, i) : t.halfedge(v);
					if (corner.number() < t.halfedgeCount() && !t.isExterior(corner))
						use(layout.wedges.of[corner], Face(first + i), k);
				}
			}
	};
	Face root; // on the domain's side of its boundary
	eachCorner([&](int, Face sheet, std::size_t) {
		if (!root.isValid())
			root = sheet;
	});
	checkpoint();
	const Triangulation& sheets = parts.sheets.triangulation;
	const PlanarLayout plane = layOutInPlane(
		sheets,
		parts.sheets.lengths,
		parts.sheets.angles,
		EdgeArray<char>(sheets.edgeCount(), 0),
		root);
	checkpoint();
	eachCorner([&](int wedge, Face sheet, std::size_t k) {
		layout.points[wedge] = plane[sheets.halfedges(sheet)[k]];
	});
	return layout;
}

} // namespace ricci
