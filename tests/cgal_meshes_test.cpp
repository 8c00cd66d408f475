// SPDX-License-Identifier: GPL-3.0-or-later
// Meshes of Debian's package libcgal-demo, clean and dirty, of many topologies: each is mapped
// without a defect, or refused for a reason that holds.
#include "support/intrinsic.h"
#include "support/map_check.h"
#include "support/shapes.h"

#include <ricci/whole_map.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <ostream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>

namespace ricci::testing {
namespace {

/// The charts of any triangles before they are packed, on the mesh that openMesh() makes of these, with all faces
/// in the order in which they are counter-clockwise.
struct OpenedMap
{
	SurfaceMesh mesh;
	Parametrization map;

	OpenedMap(const SurfaceMesh& input, const VertexInput& values, const Options& options)
	{
		WholeMap whole = chartsInPlane(input, values, options);
		map = std::move(whole.map);
		mesh = whole.opened.mesh;
		for (const Face f : whole.opened.reversed.indices())
			if (whole.opened.reversed[f])
				std::swap(mesh.triangles[at(f)][1], mesh.triangles[at(f)][2]);
	}
};

const std::filesystem::path kFolder = std::filesystem::path(RICCI_CGAL_MESHES_DIR) / "data/meshes";

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

/// Reads an OFF file of text (with colours and normals left out), polygons as fans of triangles.
/// vcglib's importer stops the program at comments within the file, and makes some concave polygons
/// into duplicate triangles.
/// \throw std::runtime_error
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

/// What the whole algorithm makes of a mesh of unknown quality and topology, with intrinsic flips
/// and the common refinement as output.
struct PipelineCheck
{
	std::string refusal; ///< the algorithm's sentence; empty if the mesh was mapped
	std::string defect;  ///< what is wrong with the map, if it was; empty if nothing is
	/// Pieces that the map shrinks so much that the last digit of their places in the plane decides
	/// on their orientation. They are not a defect of the algorithm.
	int belowResolution = 0;
	Report report;

	/// The target depends on the topology of each component: flat inside with a free boundary, flat
	/// on a torus, elsewhere 2 pi chi shared by a few vertices.
	explicit PipelineCheck(const SurfaceMesh& mesh);

	bool isMapped() const { return refusal.empty(); }
};

/// Cones of a closed component for each 2 pi of its curvature, and at least: few and strong ones
/// shrink the rest of the surface below what one chart of doubles can hold.
constexpr int kConesPerTurn = 16, kMinCones = 4;

/// Curvature that every component admits, its boundary being free.
std::vector<double> admissibleCurvature(const SurfaceMesh& mesh)
{
	std::vector<double> curvature(mesh.positions.size(), 0.0);
	for (const Component& c : componentsOf(mesh)) {
		const Triangulation t(c.positions.size(), c.triangles);
		if (!t.boundaryLoops().empty())
			continue;
		const int count = c.vertex.size();
		const int chi = t.eulerCharacteristic();
		const int cones = std::min(chi > 0 ? kMinCones : kConesPerTurn * std::max(1, -chi), count);
		for (int i = 0; i < cones; ++i)
			curvature[at(c.vertex[Vertex(at(i) * at(count) / at(cones))])] = 2 * kPi * chi / cones;
	}
	return curvature;
}

std::string defectOf(const OpenedMap& opened, int& belowResolution)
{
	const Parametrization& flat = opened.map;
	const Report& report = flat.report;
	const FlatMesh& mesh = flat.mesh;
	const MapCheck check(opened.mesh, mesh, flat.targetCurvature);
	std::vector<char> covered(opened.mesh.triangles.size(), 0);
	for (int f : mesh.face)
		covered[at(f)] = 1;
	std::string defects;
	const auto require = [&](bool good, const char* name, double value) {
		if (good)
			return;
		char text[80];
		std::snprintf(text, sizeof text, "%s%s %.3g", defects.empty() ? "" : ", ", name, value);
		defects += text;
	};
	require(report.converged, "converged", report.converged);
	require(
		report.maxCurvatureError <= std::max(1e-9, report.residualFloor),
		"residual",
		report.maxCurvatureError);
	require(report.residualFloor <= 1e-8, "floor", report.residualFloor);
	require(report.brokenTriangles == 0, "broken", report.brokenTriangles);
	belowResolution = check.notPositiveByRounding;
	const int flipped = check.notPositive - check.notPositiveByRounding;
	require(flipped == 0, "flipped", flipped);
	require(report.flippedFaces == check.notPositive, "flipped by the report", report.flippedFaces);
	require(check.seamMismatch < 1e-9, "seam mismatch", check.seamMismatch);
	require(check.seamsInside == 0, "seams inside faces", check.seamsInside);
	require(check.minWeight >= -1e-12, "weight", check.minWeight);
	require(check.weightError < 1e-14, "sum of weights", check.weightError);
	require(
		check.eulerCharacteristic == report.eulerCharacteristic,
		"characteristic",
		check.eulerCharacteristic);
	require(check.boundaryLoops == report.boundaryLoops, "boundary loops", check.boundaryLoops);
	const auto lost = std::count(covered.begin(), covered.end(), 0);
	require(lost == 0, "faces lost", static_cast<double>(lost));
	bool finite = true;
	for (const Point2& p : mesh.place)
		finite &= std::isfinite(p[0]) && std::isfinite(p[1]);
	for (double u : flat.u)
		finite &= std::isfinite(u);
	require(finite, "finite", finite);
	return defects;
}

PipelineCheck::PipelineCheck(const SurfaceMesh& mesh)
{
	Options options;
	options.target = TargetCurvature::Prescribed;
	options.freeBoundary = true;
	options.epsilon = 1e-10;
	options.output = OutputTriangulation::CommonRefinement;
	options.charts = Charts::OfTheFlow; // such cuts may cross faces, the flow's own seams may not
	try {
		VertexInput input;
		input.targetCurvature = admissibleCurvature(mesh);
		const OpenedMap opened(mesh, input, options);
		report = opened.map.report;
		defect = defectOf(opened, belowResolution);
	}
	catch (const Error& error) {
		refusal = error.what();
	}
}

struct Case
{
	const char* name;
	int eulerCharacteristic;
};

std::ostream& operator<<(std::ostream& out, const Case& c)
{
	return out << c.name;
}

class CgalMeshes : public ::testing::TestWithParam<Case>
{
};

TEST_P(CgalMeshes, IsMapped)
{
	const Case& c = GetParam();
	const auto path = kFolder / (std::string(c.name) + ".off");
	if (!std::filesystem::exists(path))
		GTEST_SKIP() << "SKIPPED: " << path.string()
					 << " is missing; unpack_cgal_meshes.sh brings it";
	const PipelineCheck check(readOff(path.string()));
	EXPECT_EQ(check.refusal, "");
	EXPECT_EQ(check.defect, "");
	EXPECT_EQ(check.belowResolution, 0);
	EXPECT_EQ(check.report.eulerCharacteristic, c.eulerCharacteristic);
}

const Case kCases[] = {
	{"star", 2},          {"cube-meshed", 2},  {"knot2", 0},
	{"pinion", 0}, // needles
	{"joint", -2},        {"helmet", -4},      {"anchor", -6},
	{"turbine", -20},     {"mushroom", 1},     {"degtri_sliding", 1}, // faces without area
	{"three_peaks", 1},   {"boeing", 102}, // many components with many boundaries
	{"bones", 52},        {"ALSTOM_TEST4", 6}, {"elephant-with-holes", -110},
	{"fandisk", 2},       {"triangle", 1},     {"mesh_with_colors", 1},
	{"mpi", 0},             // concave polygons as fans
	{"polygon_mesh", -20}}; // two vertices of two and of three fans

INSTANTIATE_TEST_SUITE_P(
	Demo,
	CgalMeshes,
	::testing::ValuesIn(kCases),
	[](const ::testing::TestParamInfo<Case>& instance) {
		std::string name = instance.param.name;
		for (char& x : name)
			if (x == '-')
				x = '_';
		return name;
	});

} // namespace
} // namespace ricci::testing
