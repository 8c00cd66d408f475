// SPDX-License-Identifier: GPL-3.0-or-later
#include "../base/numbers.h"
#include "opened_mesh.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace ricci {

std::vector<std::string> openingNotes(const SurfaceMesh& mesh, const OpenedMesh& opened)
{
	std::vector<std::string> notes;
	std::vector<char> isUsed(mesh.positions.size(), 0);
	for (const Triangle& t : mesh.triangles)
		for (const int v : t)
			isUsed[positionOf(v)] = 1;
	const auto note = [&](std::ptrdiff_t n,
						  const std::string& one,
						  const std::string& many,
						  const std::string& rest) {
		if (n > 0)
			notes.push_back(counted(static_cast<std::size_t>(n), one, many) + rest);
	};
	const std::ptrdiff_t unused =
		std::count(isUsed.begin(), isUsed.end(), 0) - static_cast<std::ptrdiff_t>(mesh.absent);
	note(
		unused,
		"vertex belongs to no face and is",
		"vertices belong to no face and are",
		" left out.");
	note(
		opened.joinedEdges,
		"edge whose faces did not share vertices was",
		"edges whose faces did not share vertices were",
		" joined: the map continues there, and the vertices stay separate.");
	note(
		opened.piecesApart,
		"piece touches others along edges without sharing vertices and",
		"pieces touch others along edges without sharing vertices and",
		" could be joined.");
	note(
		std::count(opened.reversed.begin(), opened.reversed.end(), 1),
		"face was",
		"faces were",
		" turned over for the map: inverted winding (inconsistent normals).");
	note(
		opened.duplicateFaces,
		"face duplicates another and is a separate sheet",
		"faces duplicate others and are separate sheets",
		".");
	note(
		opened.cutEdges,
		"edge with more than two faces was",
		"edges with more than two faces were",
		" cut: the sheets continue where they are smoothest.");
	note(opened.seamEdges, "edge is a chosen seam", "edges are chosen seams", ".");
	note(
		opened.seamEdgesAdded,
		"seam of a single edge was",
		"seams of a single edge were",
		" extended by another edge, because a single edge does not open.");
	note(
		opened.oneSidedComponents,
		"one-sided component was",
		"one-sided components were",
		" cut along short one-sided loops.");
	note(
		opened.splitVertices,
		"vertex has",
		"vertices have",
		" more than one triangle fan, each with its own place in the map.");
	note(
		static_cast<std::ptrdiff_t>(opened.degenerate.size()),
		"face has no area and is drawn as a line or a point",
		"faces have no area and are drawn as lines or points",
		".");
	return notes;
}

} // namespace ricci
