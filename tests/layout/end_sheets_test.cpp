// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/closed_flows.h"
#include "support/expect.h"

#include <ricci/layout/end_sheets.h>

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace ricci::testing {
namespace {

/// The halfedge of a piece's sheet that is end halfedge h.
Halfedge inSheet(const EndSheets& sheets, const Triangulation& end, int piece, Halfedge h)
{
	const Face sheet = sheets.of[piece];
	if (sheets.endFace[sheet] != end.face(h))
		return Halfedge();
	return sheets.triangulation.halfedges(sheet)[end.corner(h).index()];
}

/// What links of pieces say: two pieces of one end triangle that meet off the cut have one sheet, and
/// two of neighbouring triangles have sheets that are glued there.
void expectGluedOffTheCut(
	const FlippedFlow& flow,
	const OverlayPieces& pieces,
	const EdgeArray<char>& isCut,
	const EndSheets& sheets)
{
	const Triangulation& end = flow.result.metric->triangulation();
	for (const int p : sheets.of.indices())
		EXPECT_EQ(sheets.endFace[sheets.of[p]], pieces.endFace[p]);
	for (const auto& link : pieces.links) {
		ASSERT_TRUE(link[1].isValid());
		const PieceCorner& side = pieces.at(link[0]);
		if (isOnCut(side, isCut))
			continue;
		if (!side.end.isValid()) {
			EXPECT_EQ(sheets.of[link[0].piece], sheets.of[link[1].piece]);
			continue;
		}
		const Halfedge h = inSheet(sheets, end, link[0].piece, side.end);
		ASSERT_TRUE(h.isValid());
		EXPECT_EQ(inSheet(sheets, end, link[1].piece, side.end.twin()), h.twin());
	}
}

/// Sides of the sheets are as long as the end's edges, and their angles fit by the law of cosines.
void expectMetricOfTheEnd(const FlippedFlow& flow, const EndSheets& sheets)
{
	const Triangulation& end = flow.result.metric->triangulation();
	const Triangulation& t = sheets.triangulation;
	for (const Face s : t.faces()) {
		const auto h = t.halfedges(s), original = end.halfedges(sheets.endFace[s]);
		for (std::size_t k = 0; k < 3; ++k) {
			EXPECT_EQ(t.origin(h[k]), end.origin(original[k]));
			EXPECT_EQ(
				sheets.lengths[h[k].edge()], flow.result.metric->lengths()[original[k].edge()]);
			const double a = sheets.lengths[h[k].edge()];
			const double b = sheets.lengths[h[(k + 2) % 3].edge()];
			const double c = sheets.lengths[h[(k + 1) % 3].edge()];
			EXPECT_NEAR(
				c * c,
				a * a + b * b - 2 * a * b * std::cos(sheets.angles[h[k]]),
				1e-9 * (a * a + b * b));
		}
	}
}

TEST(Sheets, WithoutACutAreTheTrianglesOfTheEnd)
{
	Random random(850);
	for (const FlippedFlow& flow : closedFlows(random)) {
		const OverlayPieces pieces = flow.pieces();
		const EdgeArray<char> noCut(flow.base().edgeCount(), 0);
		const EndSheets sheets = makeSheets(pieces, flow.result, noCut);
		const Triangulation& t = sheets.triangulation;
		EXPECT_EQ(t.faceCount(), flow.base().faceCount());
		EXPECT_EQ(t.edgeCount(), flow.base().edgeCount());
		EXPECT_TRUE(t.boundaryLoops().empty());
		EXPECT_EQ(t.eulerCharacteristic(), flow.base().eulerCharacteristic());
		FaceArray<int> drawn(t.faceCount(), 0);
		for (const Face f : sheets.endFace)
			++drawn[f];
		for (const int times : drawn)
			EXPECT_EQ(times, 1);
		expectGluedOffTheCut(flow, pieces, noCut, sheets);
		expectMetricOfTheEnd(flow, sheets);
	}
}

TEST(Sheets, OfASurfaceCutOpenAreADisk)
{
	Random random(851);
	int divided = 0;
	for (int round = 0; round < 5; ++round)
		for (const FlippedFlow& flow : closedFlows(random)) {
			const OverlayPieces pieces = flow.pieces();
			const EdgeArray<char> isCut = flow.cutAnywhere(random).isCut;
			const EndSheets sheets = makeSheets(pieces, flow.result, isCut);
			const Triangulation& t = sheets.triangulation;
			divided += t.faceCount() - flow.base().faceCount();
			expectOpensToADisk(t, EdgeArray<char>(t.edgeCount(), 0));
			expectGluedOffTheCut(flow, pieces, isCut, sheets);
			expectMetricOfTheEnd(flow, sheets);
		}
	EXPECT_GT(divided, 100); // triangles that the cut runs through
}

TEST(Sheets, OnlyInputEdgesAreOnTheCut)
{
	EdgeArray<char> isCut(3, 0);
	isCut[Edge(1)] = 1;
	PieceCorner side;
	EXPECT_FALSE(isOnCut(side, isCut));
	side.end = Edge(1).halfedge();
	EXPECT_FALSE(isOnCut(side, isCut));
	for (const Edge e : isCut.indices())
		for (const Halfedge h : {e.halfedge(), e.halfedge().twin()}) {
			side.input = h;
			EXPECT_EQ(isOnCut(side, isCut), e == Edge(1));
		}
}

} // namespace
} // namespace ricci::testing
