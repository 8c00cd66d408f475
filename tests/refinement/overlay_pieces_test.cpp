// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/closed_flows.h"

#include <ricci/refinement/overlay_pieces.h>

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace ricci::testing {
namespace {

/// Weight of a vertex of the input in a point; 0 where it has none.
double weightOf(const SurfacePoint& p, Vertex v)
{
	double weight = 0.0;
	for (std::size_t i = 0; i < 4; ++i)
		if (Vertex(p.vertex[i]) == v)
			weight += p.weight[i];
	return weight;
}

/// Share of a triangle that a polygon with these affine coordinates covers, positive if it is
/// counter-clockwise.
double shareOf(const std::vector<std::array<double, 3>>& polygon)
{
	double area = 0.0;
	for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
		const auto &a = polygon[0], &b = polygon[k], &c = polygon[k + 1];
		area += (b[1] - a[1]) * (c[2] - a[2]) - (b[2] - a[2]) * (c[1] - a[1]);
	}
	return area;
}

/// Every side belongs to two pieces, which run along it in opposite directions; the pieces in one triangle of the
/// input or of the end cover it once, and they know the edges and corners that they lie at.
TEST(OverlayPieces, AreTheFacesOfASurfaceThatTileBothTriangulations)
{
	int crossings = 0;
	for (const std::uint64_t seed : {810u, 811u, 820u}) {
		Random random(seed);
		for (const FlippedFlow& flow : closedFlows(random)) {
			const OverlayPieces pieces = flow.pieces();
			const Triangulation& input = flow.base();
			const Triangulation& end = flow.result.metric->triangulation();
			EXPECT_EQ(
				pieces.nodes.size() - pieces.sideCount + pieces.count(),
				input.eulerCharacteristic());
			crossings += pieces.nodes.size() - input.vertexCount();
			Array<std::vector<std::array<int, 2>>> uses(pieces.sideCount); // nodes at its ends
			HalfedgeArray<int> inputCorners(input.halfedgeCount(), 0), endCorners = inputCorners;
			HalfedgeArray<double> covered(input.halfedgeCount(), 0.0); // share of it along sides
			FaceArray<double> ofInput(input.faceCount(), 0.0), ofEnd = ofInput;
			for (int p = 0; p < pieces.count(); ++p) {
				EXPECT_GE(pieces.size(p), 3);
				std::vector<std::array<double, 3>> onInput, onEnd;
				for (int i = 0; i < pieces.size(p); ++i) {
					const PieceCorner &c = pieces(p, i), &next = pieces(p, i + 1);
					const SurfacePoint &a = pieces.nodes[c.node].point,
									   &b = pieces.nodes[next.node].point;
					uses[c.side].push_back({c.node, next.node});
					ASSERT_EQ(c.inputCorner.isValid(), c.node < input.vertexCount());
					ASSERT_EQ(c.endCorner.isValid(), c.node < input.vertexCount());
					if (c.inputCorner.isValid()) {
						EXPECT_EQ(input.origin(c.inputCorner), Vertex(c.node));
						EXPECT_EQ(end.origin(c.endCorner), Vertex(c.node));
						++inputCorners[c.inputCorner];
						++endCorners[c.endCorner];
					}
					if (c.input.isValid()) {
						const Vertex from = input.origin(c.input), to = input.target(c.input);
						for (const SurfacePoint* x : {&a, &b})
							EXPECT_NEAR(weightOf(*x, from) + weightOf(*x, to), 1.0, 1e-14);
						EXPECT_GE(weightOf(b, to), weightOf(a, to));
						covered[c.input] += weightOf(b, to) - weightOf(a, to);
					}
					const auto corner = input.vertices(pieces.inputFace[p]);
					onInput.push_back(
						{weightOf(a, corner[0]), weightOf(a, corner[1]), weightOf(a, corner[2])});
					onEnd.push_back(inEndTriangle(pieces, end, p, i));
					for (const auto& w : {onInput.back(), onEnd.back()})
						EXPECT_NEAR(w[0] + w[1] + w[2], 1.0, 1e-12);
				}
				EXPECT_GT(shareOf(onInput), -1e-12);
				EXPECT_GT(shareOf(onEnd), -1e-12);
				ofInput[pieces.inputFace[p]] += shareOf(onInput);
				ofEnd[pieces.endFace[p]] += shareOf(onEnd);
			}
			for (const auto& ends : uses) {
				ASSERT_EQ(ends.size(), 2u);
				EXPECT_EQ(ends[0], (std::array<int, 2>{ends[1][1], ends[1][0]}));
			}
			for (const Halfedge h : input.halfedges()) {
				EXPECT_GE(inputCorners[h], 1);
				EXPECT_GE(endCorners[h], 1);
				EXPECT_NEAR(covered[h], 1.0, 1e-12);
			}
			for (const Face f : input.faces()) {
				EXPECT_NEAR(ofInput[f], 1.0, 1e-9);
				EXPECT_NEAR(ofEnd[f], 1.0, 1e-9);
			}
		}
	}
	EXPECT_GT(crossings, 600); // or the test says little
}

} // namespace
} // namespace ricci::testing
