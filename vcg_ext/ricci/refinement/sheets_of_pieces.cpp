// SPDX-License-Identifier: GPL-3.0-or-later
#include "sheets_of_pieces.h"

#include "../base/disjoint_sets.h"

#include <tuple>
#include <utility>
#include <vector>

namespace ricci {

namespace {

class SheetMaker
{
public:
	SheetMaker(
		const OverlayPieces& pieces, const Triangulation& end, const EdgeArray<char>& isCut) :
			m_pieces(pieces),
			m_end(end), m_isCut(isCut), m_sets(pieces.count())
	{
	}

	EndSheets run()
	{
		for (const auto& link : m_pieces.links) {
			if (!link[1].isValid())
				continue;
			const PieceCorner& side = m_pieces.at(link[0]);
			if (!isOnCut(side, m_isCut) && !side.end.isValid())
				m_sets.merge(link[0].piece, link[1].piece);
		}
		do
			listSheets();
		while (!glue());
		m_sheets.triangulation = Triangulation(m_end.vertexCount(), m_triangles, m_glued);
		return std::move(m_sheets);
	}

private:
	/// One sheet for each set of pieces.
	void listSheets()
	{
		m_triangles.clear();
		m_sheets.endFace.clear();
		m_sheets.of.assign(m_pieces.count(), Face());
		for (const int p : m_sheets.of.indices()) {
			if (m_sets.find(p) != p)
				continue;
			const Face f = m_pieces.endFace[p];
			const auto corner = m_end.vertices(f);
			m_sheets.of[p] = Face(m_sheets.endFace.size());
			m_sheets.endFace.push_back(f);
			m_triangles.push_back({corner[0].number(), corner[1].number(), corner[2].number()});
		}
		for (const int p : m_sheets.of.indices())
			m_sheets.of[p] = m_sheets.of[m_sets.find(p)];
	}

	/// Number of the side of a piece's sheet that is end halfedge h.
	Corner sideOf(int piece, Halfedge h) const
	{
		return {m_sheets.of[piece].number(), static_cast<int>(m_end.corner(h).index())};
	}

	/// Glues the sheets. The cut is straight in another metric than the end edges and may cross one
	/// of them twice with no vertex between: it then cuts parts off that lie across one side of one
	/// sheet. They have one place in the layout and become one set.
	/// \return false if there are such parts
	bool glue()
	{
		CornerArray<int> pieceAcross(3 * m_sheets.endFace.size(), -1); // [side] of the other sheet
		m_glued.assign(3 * m_sheets.endFace.size(), Corner());
		bool fits = true;
		for (const auto& link : m_pieces.links) {
			if (!link[1].isValid())
				continue;
			const PieceCorner& side = m_pieces.at(link[0]);
			if (isOnCut(side, m_isCut) || !side.end.isValid())
				continue;
			const Corner a = sideOf(link[0].piece, side.end);
			const Corner b = sideOf(link[1].piece, side.end.twin());
			for (const auto& [from, to, piece] :
				 {std::tuple(a, b, link[1].piece), std::tuple(b, a, link[0].piece)}) {
				Corner& known = m_glued[from];
				if (known.isValid() && known != to) {
					m_sets.merge(pieceAcross[from], piece);
					fits = false;
				}
				known = to;
				pieceAcross[from] = piece;
			}
		}
		return fits;
	}

	const OverlayPieces& m_pieces;
	const Triangulation& m_end;
	const EdgeArray<char>& m_isCut;
	DisjointSets m_sets; // of pieces: those of one sheet
	EndSheets m_sheets;
	std::vector<Triangle> m_triangles; // [sheet]
	CornerArray<Corner> m_glued;       // [side of a sheet] the side across it
};

} // namespace

EndSheets
makeSheets(const OverlayPieces& pieces, const FlowResult& flow, const EdgeArray<char>& isCut)
{
	EndSheets sheets = SheetMaker(pieces, flow.metric->triangulation(), isCut).run();
	takeMetric(flow, sheets);
	return sheets;
}

} // namespace ricci
