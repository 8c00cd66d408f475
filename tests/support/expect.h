// SPDX-License-Identifier: GPL-3.0-or-later
// What several test programs expect.
#ifndef RICCI_TESTS_EXPECT_H
#define RICCI_TESTS_EXPECT_H

#include "flipped_flow.h"
#include "shapes.h"

#include <ricci/error.h>
#include <ricci/layout/planar_layout.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace ricci::testing {

/// The sentence of the error \p E with which a call ends; empty if it ends without one.
template<class E, class Call>
std::string sentenceOf(const Call& call)
{
	try {
		call();
	}
	catch (const E& error) {
		return error.what();
	}
	catch (const Error& error) {
		ADD_FAILURE() << "another kind of error: " << error.what();
	}
	return "";
}

inline void expectWords(const std::string& sentence, const std::vector<std::string>& words)
{
	for (const std::string& word : words)
		EXPECT_NE(sentence.find(word), std::string::npos) << word << " is not in: " << sentence;
}

/// The flow's target is reached, by its own word and by the lengths it gives, which \p Measure reads
/// (MetricMeasure or HyperbolicMeasure). \p mostFloor bounds what rounding may prevent.
template<class Measure>
void expectTarget(const FlippedFlow& flow, double mostFloor)
{
	const FlowResult& r = flow.result;
	EXPECT_LE(r.residual, std::max(1e-10, r.floor));
	EXPECT_LE(r.floor, mostFloor);
	EXPECT_EQ(r.metric->brokenTriangles(), 0);
	EXPECT_TRUE(r.u.allFinite());
	const Measure measure(r.metric->triangulation(), r.metric->lengths());
	EXPECT_EQ(measure.broken, 0);
	const IndependentError independent(flow);
	EXPECT_LE(independent.error, std::max(1e-10, r.floor) + independent.rounding);
}

/// The surface cut open is connected and has Euler characteristic 1: a disk. Boundary edges are no
/// cuts.
inline void expectOpensToADisk(const Triangulation& t, const std::vector<char>& isCut)
{
	ASSERT_EQ(static_cast<int>(isCut.size()), t.edgeCount());
	std::vector<char> seen(at(t.faceCount()), 0);
	std::vector<int> queue{0};
	seen[0] = 1;
	for (std::size_t head = 0; head < queue.size(); ++head)
		for (int h : t.halfedges(queue[head])) {
			const int g = Triangulation::twin(h);
			if (isCut[at(Triangulation::edge(h))] || t.isOuter(g) || seen[at(t.face(g))])
				continue;
			seen[at(t.face(g))] = 1;
			queue.push_back(t.face(g));
		}
	EXPECT_EQ(static_cast<int>(queue.size()), t.faceCount());
	int sectors = 0, cutEdges = 0;
	cornerSectors(t, isCut, sectors);
	for (int e = 0; e < t.edgeCount(); ++e)
		if (isCut[at(e)]) {
			++cutEdges;
			EXPECT_FALSE(t.isBoundaryEdge(e));
		}
	EXPECT_EQ(sectors - (t.edgeCount() + cutEdges) + t.faceCount(), 1);
}

} // namespace ricci::testing

#endif
