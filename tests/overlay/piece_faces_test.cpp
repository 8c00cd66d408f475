// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/closed_flows.h"

#include <ricci/overlay/piece_faces.h>

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace ricci::testing {
namespace {

using Weights = std::array<double, 3>;

/// Share of a triangle that a polygon with these affine coordinates covers, positive if it is
/// counter-clockwise.
double shareOf(const std::vector<Weights>& polygon)
{
	double area = 0.0;
	for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
		const Weights &a = polygon[0], &b = polygon[k], &c = polygon[k + 1];
		area += (b[1] - a[1]) * (c[2] - a[2]) - (b[2] - a[2]) * (c[1] - a[1]);
	}
	return area;
}

Weights inInputTriangle(const Triangulation& t, Face f, const SurfacePoint& p)
{
	Weights w{0, 0, 0};
	const auto corner = t.vertices(f);
	for (std::size_t i = 0; i < 4; ++i)
		for (std::size_t k = 0; k < 3; ++k)
			if (Vertex(p.vertex[i]) == corner[k])
				w[k] += p.weight[i];
	return w;
}

/// The pieces in one triangle cover it once.
TEST(PieceFaces, TileTheTrianglesOfTheInputAndOfTheEnd)
{
	Random random(820);
	for (const FlippedFlow& flow : closedFlows(random)) {
		const Triangulation& input = flow.base();
		const Triangulation& end = flow.result.metric->triangulation();
		const LinkedPieces linked =
			linkPieces(divideStartTriangles(flow.result), input, end, input.faceCount());
		const OverlayPieces& pieces = linked.pieces;
		FaceArray<double> ofInput(input.faceCount(), 0.0), ofEnd(end.faceCount(), 0.0);
		for (int p = 0; p < pieces.count(); ++p) {
			std::vector<Weights> onInput, onEnd;
			for (int i = 0; i < pieces.size(p); ++i) {
				onInput.push_back(inInputTriangle(
					input, linked.inputFace[p], pieces.nodes[pieces(p, i).node].point));
				onEnd.push_back(inEndTriangle(linked, end, p, i));
				for (const Weights& w : {onInput.back(), onEnd.back()})
					EXPECT_NEAR(w[0] + w[1] + w[2], 1.0, 1e-12);
			}
			const double inputShare = shareOf(onInput), endShare = shareOf(onEnd);
			EXPECT_GT(inputShare, -1e-12);
			EXPECT_GT(endShare, -1e-12);
			ofInput[linked.inputFace[p]] += inputShare;
			ofEnd[linked.endFace[p]] += endShare;
		}
		for (const double share : ofInput)
			EXPECT_NEAR(share, 1.0, 1e-9);
		for (const double share : ofEnd)
			EXPECT_NEAR(share, 1.0, 1e-9);
	}
}

TEST(PieceFaces, ForgetWhatIsNotKept)
{
	Random random(821);
	int moved = 0, border = 0;
	for (const FlippedFlow& flow : closedFlows(random)) {
		const Triangulation& input = flow.base();
		const Triangulation& end = flow.result.metric->triangulation();
		const OverlayPieces all = divideStartTriangles(flow.result);
		const LinkedPieces whole = linkPieces(all, input, end, input.faceCount());
		const int kept = input.faceCount() / 2;
		const LinkedPieces half = linkPieces(all, input, end, kept);
		int wanted = 0;
		for (const int p : whole.inputFace.indices())
			if (whole.inputFace[p] < Face(kept)) {
				ASSERT_LT(wanted, half.pieces.count());
				EXPECT_EQ(half.inputFace[wanted], whole.inputFace[p]);
				EXPECT_EQ(half.endFace[wanted], whole.endFace[p]);
				EXPECT_EQ(half.pieces(wanted, 0).node, whole.pieces(p, 0).node);
				moved += p != wanted;
				++wanted;
			}
		EXPECT_EQ(half.pieces.count(), wanted);
		EXPECT_EQ(half.inputFace.size(), wanted);
		for (const auto& link : half.links) {
			if (!link[0].isValid())
				continue; // of pieces that are forgotten
			const PieceCorner& side = half.at(link[0]);
			if (link[1].isValid()) {
				EXPECT_EQ(half.at(link[1]).side, side.side);
				continue;
			}
			++border;
			ASSERT_TRUE(side.input.isValid()); // the border runs along edges of the input
			EXPECT_GE(input.face(side.input.twin()), Face(kept));
		}
	}
	EXPECT_GT(moved, 50);
	EXPECT_GT(border, 50);
}

} // namespace
} // namespace ricci::testing
