// SPDX-License-Identifier: GPL-3.0-or-later
#include "corner_layout.h"

#include "../base/graphs.h"
#include "../base/task.h"
#include "../mesh/normal_coordinates.h"

#include <vector>

namespace ricci {

void takeMetric(const FlowResult& flow, EndSheets& sheets)
{
	const Triangulation& end = flow.metric->triangulation();
	const Triangulation& t = sheets.triangulation;
	sheets.lengths.resize(t.edgeCount());
	sheets.angles.resize(t.halfedgeCount(), 0.0);
	for (const Face s : t.faces()) {
		const auto h = t.halfedges(s), original = end.halfedges(sheets.endFace[s]);
		for (std::size_t k = 0; k < 3; ++k) {
			sheets.lengths[h[k].edge()] = flow.metric->lengths()[original[k].edge()];
			sheets.angles[h[k]] = flow.metric->angles()[original[k]];
		}
	}
}

PlanarLayout layOutInPlane(const EndSheets& sheets, Face root)
{
	const EdgeArray<char> noCut(sheets.triangulation.edgeCount(), 0);
	return layOutInPlane(sheets.triangulation, sheets.lengths, sheets.angles, noCut, root);
}

HyperbolicLayout layOutInDisk(const EndSheets& sheets)
{
	const EdgeArray<char> noCut(sheets.triangulation.edgeCount(), 0);
	return layOutInDisk(sheets.triangulation, sheets.lengths, sheets.angles, noCut);
}

namespace {

/// The cut on the end triangulation. Its curves are the edges at which the surface is open: those of
/// the cut and of the surface's boundary, beyond which the triangulation may go on.
NormalCoordinates
cutOnEnd(const FlowDomain& domain, const FlowResult& flow, const EdgeArray<char>& isCut)
{
	const Triangulation& t = domain.surface.triangulation;
	EdgeArray<char> isCurve = isCut;
	for (const Edge e : t.edges())
		if (t.isBoundary(e))
			isCurve[e] = 1;
	const Triangulation& input = flow.input(domain.solved());
	isCurve.resize(input.edgeCount(), 0); // the surface's edges come first
	NormalCoordinates cut(input, isCurve);
	std::size_t done = 0;
	for (const std::vector<Edge>* flips : {&flow.start.flips, &flow.flips})
		for (const Edge e : *flips) {
			checkpointNowAndThen(done++);
			cut.flip(e);
		}
	std::size_t crossings = 0;
	for (const Edge e : cut.triangulation().edges())
		crossings += static_cast<std::size_t>(cut.crossings(e));
	requireOverlayMemory(crossings, false);
	return cut;
}

/// The parts into which the cut divides the end triangles, each drawn as the whole triangle: a sheet.
/// Those of one triangle are numbered from that at the corner from which parts of the cut emanate,
/// counter-clockwise, if there is one; then those that the cut cuts off at its corners, from the
/// outermost on.
class CutSheets
{
public:
	CutSheets(const Triangulation& end, const NormalCoordinates& cut) :
			m_end(end), m_cut(cut), m_isDivided(end.faceCount(), 0), m_middle(end.faceCount()),
			m_cutOff(end.halfedgeCount())
	{
		m_endFace.reserve(end.faceCount());
		for (const Face f : end.faces()) {
			int count = m_middle[f] = m_endFace.size();
			const auto h = end.halfedges(f);
			for (const Halfedge side : h)
				m_isDivided[f] |= cut.crossings(side.edge()) > 0;
			if (m_isDivided[f]) {
				const NormalCoordinates::CornerCurves c = cut.cornerCurves(h[0]);
				m_cutOff[h[0]] = count + 1 + c.emanateFromI + c.emanateFromJ + c.emanateFromK;
				m_cutOff[h[1]] = m_cutOff[h[0]] + c.cutOffI;
				m_cutOff[h[2]] = m_cutOff[h[1]] + c.cutOffJ;
				count = m_cutOff[h[2]] + c.cutOffK - 1;
			}
			m_endFace.resize(count + 1, f);
		}
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

	/// The sheets on the same side of the surface's boundary as \p root, glued along the end edges
	/// that are not on the cut.
	/// \param number becomes [sheet] its face; none beyond the boundary
	EndSheets glued(int root, Array<Face>& number) const
	{
		CornerArray<Corner> across(3 * m_endFace.size()); // [side of a sheet]
		DisjointSets joined(m_endFace.size());
		for (const Edge e : m_end.edges()) {
			if (m_end.isBoundary(e) || m_cut.isCurve(e))
				continue;
			const Halfedge h = e.halfedge(), twin = h.twin();
			const int n = m_cut.crossings(e);
			for (int i = 0; i <= n; ++i) {
				const Corner a = sideOf(beside(h, i), h), b = sideOf(beside(twin, n - i), twin);
				across[a] = b;
				across[b] = a;
				joined.merge(a.face(), b.face());
			}
		}
		EndSheets sheets;
		number.assign(m_endFace.size(), Face());
		std::vector<Triangle> triangles;
		for (const int sheet : m_endFace.indices())
			if (joined.find(sheet) == joined.find(root)) {
				number[sheet] = Face(triangles.size());
				sheets.endFace.push_back(m_endFace[sheet]);
				const auto v = m_end.vertices(m_endFace[sheet]);
				triangles.push_back({v[0].number(), v[1].number(), v[2].number()});
			}
		CornerArray<Corner> glued;
		for (const int sheet : number.indices())
			if (number[sheet].isValid())
				for (const Corner c : cornersOf(sheet)) {
					const Corner other = across[c];
					glued.push_back(
						other.isValid()
							? Corner(number[other.face()].number(), static_cast<int>(other.index()))
							: Corner());
				}
		sheets.triangulation = Triangulation(m_end.vertexCount(), triangles, glued);
		return sheets;
	}

private:
	/// The side of a sheet that is end halfedge \p h.
	Corner sideOf(int sheet, Halfedge h) const
	{
		return {sheet, static_cast<int>(m_end.corner(h).index())};
	}

	const Triangulation& m_end;
	const NormalCoordinates& m_cut;
	Array<Face> m_endFace;       // [sheet]
	FaceArray<char> m_isDivided; // [end face]
	FaceArray<int> m_middle;     // [end face] its first sheet
	HalfedgeArray<int> m_cutOff; // [end halfedge] first sheet of those cut off at its origin
};

/// The end triangles, open along the cut, and what the surface has of them.
class CornersOnSheets
{
public:
	CornersOnSheets(
		const FlowDomain& domain, const FlowResult& flow, const EdgeArray<char>& isCut) :
			m_surface(domain.surface.triangulation),
			m_end(flow.metric->triangulation()), m_isCut(isCut),
			m_cut(cutOnEnd(domain, flow, isCut)), m_parts(m_end, m_cut)
	{
		int root = -1;
		eachCorner([&](Halfedge, int sheet, std::size_t) { root = root < 0 ? sheet : root; });
		m_sheets = m_parts.glued(root, m_number);
		m_root = m_number[root];
		takeMetric(flow, m_sheets);
	}

	SurfaceLayout inPlane() const
	{
		const PlanarLayout plane = layOutInPlane(m_sheets, m_root);
		checkpoint();
		return {layout([&](Halfedge h) { return plane[h]; }), {}, {}};
	}

	SurfaceLayout inDisk() const
	{
		const HyperbolicLayout disk = layOutInDisk(m_sheets);
		return {
			layout([&](Halfedge h) { return asPoint(std::complex<double>(disk[h].origin())); }),
			pairing(disk),
			{}};
	}

private:
	/// \param place gives the point at the corner of a sheet that a halfedge of the sheets leaves
	template<class Place>
	PlanarLayout layout(const Place& place) const
	{
		PlanarLayout layout = cornerWedges(m_surface, m_isCut);
		eachCorner([&](Halfedge corner, int sheet, std::size_t k) {
			layout[corner] = place(m_sheets.triangulation.halfedges(m_number[sheet])[k]);
		});
		return layout;
	}

	/// How \p disk goes on across the cut.
	EdgeArray<SidePairing> pairing(const HyperbolicLayout& disk) const
	{
		const Triangulation& sheets = m_sheets.triangulation;
		EdgeArray<SidePairing> pairing(m_surface.edgeCount());
		const auto curves = m_cut.trace();
		for (const Edge e : m_surface.edges()) {
			if (!m_isCut[e])
				continue;
			// Through an end triangle.
			const auto offer = [&](Halfedge side, int onLeft, int onRight) {
				const Face left = m_number[m_parts.beside(side, onLeft)];
				const Face right = m_number[m_parts.beside(side, onRight)];
				pairing[e].offer(disk[sheets.halfedge(left)], disk[sheets.halfedge(right)]);
			};
			for (const auto& [side, i] : curves[e].crossings)
				offer(side, i + 1, i);
			if (!curves[e].crossings.empty()) { // the last triangle is entered there
				const auto& [side, i] = curves[e].crossings.back();
				const int back = m_cut.crossings(side.edge()) - 1 - i;
				offer(side.twin(), back, back + 1);
				continue;
			}
			const auto inSheet = [&](Halfedge h) {
				const Face sheet = m_number[m_parts.beside(h, 0)];
				return sheets.halfedges(sheet)[m_end.corner(h).index()];
			};
			const Halfedge h = inSheet(curves[e].first), twin = inSheet(curves[e].first.twin());
			offerPairing(disk, m_sheets.lengths[h.edge()], h, twin, pairing[e]);
		}
		return pairing;
	}

	/// Calls \p use(corner, sheet, k): corner k of the sheet is in the wedge of this corner of the surface.
	template<class Use>
	void eachCorner(const Use& use) const
	{
		for (const Face f : m_end.faces())
			for (std::size_t k = 0; k < 3; ++k) {
				const Halfedge h = m_end.halfedges(f)[k];
				const Vertex v = m_end.origin(h);
				if (v.number() >= m_surface.vertexCount())
					continue;
				const int first = m_parts.beside(h, 0), count = m_parts.countAt(h);
				for (int i = 0; i < count; ++i) {
					const Halfedge corner =
						m_cut.hasCurves(v) ? m_cut.originalAtOrBefore(h, i) : m_surface.halfedge(v);
					if (corner.number() < m_surface.halfedgeCount() &&
						!m_surface.isExterior(corner))
						use(corner, first + i, k);
				}
			}
	}

	const Triangulation& m_surface;
	const Triangulation& m_end;
	const EdgeArray<char>& m_isCut;
	const NormalCoordinates m_cut;
	const CutSheets m_parts;
	Array<Face> m_number; // [sheet of m_parts] its face in m_sheets
	EndSheets m_sheets;
	Face m_root;
};

/// A layout of \p from on \p t, which has the same vertices, boundary and cut but other edges between: the
/// wedge that begins at an edge of the cut or the boundary keeps its point, and so does a vertex off them.
PlanarLayout carriedTo(
	const Triangulation& t,
	const EdgeArray<char>& isCut,
	const Triangulation& from,
	const PlanarLayout& layout)
{
	PlanarLayout carried = cornerWedges(t, isCut);
	for (const Halfedge h : t.interiorHalfedges())
		if (const Halfedge any = from.halfedge(t.origin(h)); !from.isExterior(any))
			carried[h] = layout[any];
	for (const Halfedge h : t.interiorHalfedges())
		if (isCut[h.edge()] || t.isBoundary(h.edge()))
			carried[h] = layout[h];
	return carried;
}

} // namespace

SurfaceLayout
layOutCorners(const FlowDomain& domain, const FlowResult& flow, const EdgeArray<char>& isCut)
{
	if (flow.target.background == Background::HyperbolicPlane)
		return CornersOnSheets(domain, flow, isCut).inDisk();
	if (flow.flipCount() > 0 || flow.doubled || domain.holes > 0)
		return CornersOnSheets(domain, flow, isCut).inPlane();
	const CurvatureMap& metric = *flow.metric;
	const Triangulation& end = metric.triangulation();
	const PlanarLayout plane = layOutInPlane(end, metric.lengths(), metric.angles(), isCut);
	return {carriedTo(domain.surface.triangulation, isCut, end, plane), {}, {}};
}

} // namespace ricci
