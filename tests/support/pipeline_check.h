// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_TESTS_PIPELINE_CHECK_H
#define RICCI_TESTS_PIPELINE_CHECK_H

#include <ricci/report.h>
#include <ricci/surface/surface_mesh.h>

#include <string>

namespace ricci::testing {

/// What the whole algorithm makes of a mesh of unknown quality and topology, with intrinsic flips
/// and the common refinement as output.
struct PipelineCheck
{
	std::string refusal; ///< the algorithm's sentence; empty if the mesh was mapped
	std::string defect;  ///< what is wrong with the map, if it was; empty if nothing is
	/// Pieces that the map shrinks so much that the last digit of their places in the plane decides
	/// on their orientation. They are no defect of the algorithm's.
	int belowResolution = 0;
	Report report;

	/// The target depends on the topology of each component: flat inside with a free boundary, flat
	/// on a torus, elsewhere 2 pi chi shared by a few vertices.
	explicit PipelineCheck(const SurfaceMesh& mesh);

	bool isMapped() const { return refusal.empty(); }
};

} // namespace ricci::testing

#endif
