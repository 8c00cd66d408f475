// SPDX-License-Identifier: GPL-3.0-or-later
#include "opened_mesh.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

namespace ricci {

namespace {

/// "1 face was", "12 faces were".
std::string counted(std::size_t n, const std::string& one, const std::string& many)
{
	return std::to_string(n) + " " + (n == 1 ? one : many);
}

} // namespace

void describe(const SurfaceMesh& mesh, const OpenedMesh& opened, std::vector<std::string>& notes)
{
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
		"edge whose faces had vertices of their own there was",
		"edges whose faces had vertices of their own there were",
		" joined: the vertices stay as they are, the map goes on across.");
	note(
		opened.piecesApart,
		"piece could be joined",
		"pieces could be joined",
		" to others, on which they lie along edges with vertices of their own.");
	note(
		std::count(opened.reversed.begin(), opened.reversed.end(), 1),
		"face was",
		"faces were",
		" oriented against the rest of the surface and counted as inverted.");
	note(
		opened.duplicateFaces,
		"face has the vertices of another and is a sheet of its",
		"faces have the vertices of another and are sheets of their",
		" own.");
	note(
		opened.cutEdges,
		"edge of more than two faces was",
		"edges of more than two faces were",
		" cut: sheets go on where they are smoothest.");
	note(opened.seamEdges, "edge is a seam", "edges are seams", ", as chosen.");
	note(
		opened.seamEdgesAdded,
		"seam of one edge alone goes on along one more",
		"seams of one edge alone go on along one more",
		": without it, nothing would come apart there.");
	note(
		opened.oneSidedComponents,
		"one-sided component was",
		"one-sided components were",
		" cut along short one-sided loops.");
	note(
		opened.splitVertices,
		"vertex has",
		"vertices have",
		" more than one fan of faces, each with a place of its own in the map.");
	note(
		static_cast<std::ptrdiff_t>(opened.degenerate.size()),
		"face has no area and is drawn as the line or the point that it is",
		"faces have no area and are drawn as the lines or the points that they are",
		".");
}

} // namespace ricci
