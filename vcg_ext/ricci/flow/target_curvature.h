// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_TARGET_CURVATURE_H
#define RICCI_TARGET_CURVATURE_H

#include "../options.h"
#include "../surface/triangulation.h"

#include <Eigen/Core>

#include <array>
#include <string>
#include <vector>

namespace ricci {

/// Topology of one connected surface.
struct Topology
{
	std::vector<char> boundary;          ///< [vertex] 1 on the boundary
	std::vector<std::vector<int>> loops; ///< vertices of each boundary loop, surface on the left
	int eulerCharacteristic = 0;
	int genus = 0;

	bool isClosed() const { return loops.empty(); }
	bool isDisk() const { return genus == 0 && loops.size() == 1; }
	bool isAnnulus() const { return genus == 0 && loops.size() == 2; }
	bool isTorus() const { return genus == 1 && loops.empty(); }

	/// "a closed surface of genus 2", "an annulus", ...
	std::string name() const;
};

Topology topologyOf(const Triangulation& t);

/// What the user chose beyond the mode.
struct TargetRequest
{
	TargetCurvature mode = TargetCurvature::Automatic;
	bool freeBoundary = true;
	std::vector<char> selected;       ///< [vertex] for Rectangle and SelectedCones
	std::vector<double> prescribed;   ///< [vertex] radians, for Prescribed
	double prescribedPrecision = 0.0; ///< relative rounding error of prescribed values
	int coneCount = 0;                ///< of placed cones, see ConeRequest
	double coneDistortion = 0.5;
	ConeRounding coneRounding = ConeRounding::Free;
	int coneVertices = -1; ///< cones may be placed at the first so many vertices; -1: at all
	std::vector<int> vertexNumbers; ///< [vertex] under which notes name it; empty: its own
};

/// A target curvature that Gauss-Bonnet allows.
struct Target
{
	Eigen::VectorXd curvature; ///< [vertex] radians; meaningless where fixed
	std::vector<char> fixed;   ///< [vertex] 1 where u keeps its value (free boundary)
	bool circular = false;     ///< boundary curvature to be adapted to a round disk
	std::array<int, 4> corners{-1, -1, -1, -1}; ///< of a rectangle, in boundary order
	bool isRectangle = false;
	std::vector<std::string> notes; ///< sentences for the log
};

/// Chooses the target (paper 5.2, 5.3) and checks that a metric with that curvature exists:
/// K < 2 pi inside and K < pi on the boundary; and sum K = 2 pi chi where all is prescribed, or
/// sum K inside > 2 pi chi - pi (number of boundary vertices) where the boundary is free.
/// \p lengths and \p positions choose the corners of a rectangle if none are selected.
/// \throw InvalidOption if the mode does not fit the topology or the selection
/// \throw InadmissibleCurvature with both numbers otherwise
Target chooseTarget(
	const Triangulation& t,
	const Topology& topology,
	const std::vector<double>& lengths,
	const std::vector<Point3>& positions,
	const TargetRequest& request);

/// Four vertices of \p loop for the corners of a rectangle: those nearest to the corners of the
/// rectangle of least area round the loop, in the plane that fits the loop best, so that a patch
/// with a four-cornered outline gets its own corners. Where these are not four different vertices
/// in order, the loop is divided into quarters of equal length.
std::array<int, 4>
rectangleCorners(const std::vector<int>& loop, const std::vector<Point3>& positions);

} // namespace ricci

#endif
