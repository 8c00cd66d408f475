// SPDX-License-Identifier: GPL-3.0-or-later
// Maps at the façade in the mesh's own size, and what writing them makes of the mesh.
#ifndef RICCI_TESTS_WRITTEN_H
#define RICCI_TESTS_WRITTEN_H

#include "flat_map.h"
#include "shapes.h"
#include "vcg_mesh.h"

#include <vcg/complex/algorithms/parametrization/ricci_flow.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <vector>

namespace ricci::testing {

inline Options unscaled(OutputTriangulation output = OutputTriangulation::KeepMesh)
{
	Options params;
	params.output = output;
	params.normalizeUV = false;
	params.charts = Charts::WithoutOverlap; // not cut to fill a square, nor turned
	params.turns = ChartTurns::None;
	return params;
}

inline Parametrization
compute(const SurfaceMesh& mesh, const Options& params, const SideMarks& seams = {})
{
	DoubleMesh m;
	toVcg(mesh, m);
	return vcg::tri::RicciFlow<DoubleMesh>::Compute(m, params, seams);
}

/// After writing, the mesh has its vertices at their places, every face in its own place, and of a refinement no
/// vertex besides the crossings: pieces meet at the mesh's own vertices.
inline void
expectWritten(const SurfaceMesh& mesh, OutputTriangulation output, const Parametrization& r)
{
	using Flow = vcg::tri::RicciFlow<DoubleMesh>;
	DoubleMesh m;
	toVcg(mesh, m);
	if (output == OutputTriangulation::KeepMesh) {
		Flow::WriteWedgeTexCoord(m, r);
		Flow::WriteVertexQuality(m, r);
		EXPECT_EQ(fromVcg(m).positions, mesh.positions);
		EXPECT_EQ(fromVcg(m).triangles, mesh.triangles);
		return;
	}
	Flow::WriteRefinement(m, r);
	EXPECT_EQ(at(m.VN()), mesh.positions.size() + at(r.report.refinementPoints));
	const SurfaceMesh after = fromVcg(m);
	for (std::size_t v = 0; v < mesh.positions.size(); ++v)
		EXPECT_EQ(after.positions[v], mesh.positions[v]);
	SurfaceMesh pieces = after;
	pieces.triangles = r.mesh.vertices.values();
	std::vector<double> area(mesh.triangles.size(), 0.0);
	for (const int i : r.mesh.points.indices())
		area[at(r.mesh.face[i])] += areaOf(pieces, at(i));
	std::set<int> used, usedBefore;
	for (const Triangle& t : after.triangles)
		used.insert(t.begin(), t.end());
	for (std::size_t f = 0; f < area.size(); ++f) {
		EXPECT_NEAR(area[f], areaOf(mesh, f), 1e-9);
		usedBefore.insert(mesh.triangles[f].begin(), mesh.triangles[f].end());
	}
	EXPECT_TRUE(std::includes(used.begin(), used.end(), usedBefore.begin(), usedBefore.end()));
}

} // namespace ricci::testing

#endif
