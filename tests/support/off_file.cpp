// SPDX-License-Identifier: GPL-3.0-or-later
#include "off_file.h"

#include <algorithm>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace ricci::testing {

namespace {

/// The next line with something in it besides a comment.
std::istringstream nextLine(std::istream& file, const std::string& path)
{
	std::string line;
	while (std::getline(file, line)) {
		line.erase(std::min(line.find('#'), line.size()));
		if (line.find_first_not_of(" \t\r") != std::string::npos)
			return std::istringstream(line);
	}
	throw std::runtime_error(path + " ends early.");
}

} // namespace

SurfaceMesh readOff(const std::string& path)
{
	std::ifstream file(path);
	if (!file)
		throw std::runtime_error(path + " cannot be opened.");
	std::string keyword;
	nextLine(file, path) >> keyword;
	if (keyword.size() < 3 || keyword.substr(keyword.size() - 3) != "OFF")
		throw std::runtime_error(path + " is not an OFF file.");
	int vertices = 0, faces = 0;
	nextLine(file, path) >> vertices >> faces;
	SurfaceMesh mesh;
	for (int v = 0; v < vertices; ++v) {
		Point3 p{};
		if (!(nextLine(file, path) >> p[0] >> p[1] >> p[2]))
			throw std::runtime_error(path + " has a vertex that is not three numbers.");
		mesh.positions.push_back(p);
	}
	for (int f = 0; f < faces; ++f) {
		std::istringstream line = nextLine(file, path);
		int size = 0, first = 0, before = 0;
		line >> size >> first >> before;
		for (int k = 2; k < size; ++k) {
			int v = -1;
			line >> v;
			mesh.triangles.push_back({first, before, v});
			before = v;
		}
		if (!line)
			throw std::runtime_error(path + " has a face with too few vertices.");
	}
	for (const Triangle& t : mesh.triangles)
		for (int v : t)
			if (v < 0 || v >= vertices)
				throw std::runtime_error(path + " has a face with a vertex that does not exist.");
	return mesh;
}

} // namespace ricci::testing
