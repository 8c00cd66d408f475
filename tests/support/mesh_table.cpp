// SPDX-License-Identifier: GPL-3.0-or-later
// Prints a table of what the algorithm makes of meshes: one row for each mesh and target, with
// tabs between the columns; the last column is the refusal, if there is one.
#include "calls.h"
#include "flat_map.h"
#include "map_check.h"
#include "mesh_file.h"
#include "vcg_mesh.h"

#include <ricci/whole_map.h>

#include <vcg/complex/algorithms/parametrization/ricci_flow.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <filesystem>
#include <iostream>
#include <optional>
#include <utility>

namespace {

using namespace ricci;

const char* const kUsage =
	"usage: mesh_table [option...] MESH...\n"
	"  --target T           automatic, flat, disk, rectangle, cones; may be given several times\n"
	"  --cone-distortion X  that decides the number of cones\n"
	"  --method M           flips, fixed, swaps, thurston\n"
	"  --finish F           none, repair, least, stretch\n"
	"  --refine             give the map on the common refinement (method flips)\n"
	"  --packed             go on to the unit square; count overlaps there\n"
	"  --margin M           between the charts, with --packed\n"
	"  --obj FOLDER         write each result with 17 digits to FOLDER/MESH.TARGET.obj\n";

struct Arguments
{
	Options options;
	std::vector<std::pair<std::string, TargetCurvature>> targets;
	std::vector<std::string> meshes;
	std::string objFolder;
	bool packed = false;
	double margin = 0.0;
};

[[noreturn]] void fail(const std::string& why)
{
	std::cerr << why << "\n" << kUsage;
	std::exit(2);
}

/// The value that belongs to \p word in a list of names.
template<class Value>
Value choose(const std::string& word, std::initializer_list<std::pair<const char*, Value>> names)
{
	for (const auto& [name, value] : names)
		if (word == name)
			return value;
	fail("Unknown word: " + word);
}

Arguments parse(int argc, char** argv)
{
	Arguments a;
	for (int i = 1; i < argc; ++i) {
		const std::string word = argv[i];
		const auto value = [&]() -> std::string {
			if (++i >= argc)
				fail(word + " needs a value.");
			return argv[i];
		};
		if (word == "--target") {
			const std::string name = value();
			a.targets.emplace_back(
				name,
				choose<TargetCurvature>(
					name,
					{{"automatic", TargetCurvature::Automatic},
					 {"flat", TargetCurvature::Flat},
					 {"disk", TargetCurvature::Disk},
					 {"rectangle", TargetCurvature::Rectangle},
					 {"cones", TargetCurvature::PlacedCones}}));
		}
		else if (word == "--method")
			a.options.method = choose<Method>(
				value(),
				{{"flips", Method::IntrinsicFlips},
				 {"fixed", Method::FixedTriangles},
				 {"swaps", Method::EdgeSwaps},
				 {"thurston", Method::Thurston}});
		else if (word == "--finish")
			a.options.finish = choose<Finish>(
				value(),
				{{"none", Finish::None},
				 {"repair", Finish::Repair},
				 {"least", Finish::LeastDistortion},
				 {"stretch", Finish::LeastStretch}});
		else if (word == "--refine")
			a.options.output = OutputTriangulation::CommonRefinement;
		else if (word == "--packed")
			a.packed = true;
		else if (word == "--margin")
			a.margin = std::atof(value().c_str());
		else if (word == "--cone-distortion")
			a.options.cones.distortion = std::atof(value().c_str());
		else if (word == "--obj")
			a.objFolder = value();
		else if (word.rfind("--", 0) == 0)
			fail("Unknown option: " + word);
		else
			a.meshes.push_back(word);
	}
	if (a.meshes.empty())
		fail("No mesh.");
	if (a.targets.empty())
		a.targets.emplace_back("automatic", TargetCurvature::Automatic);
	return a;
}

void printHeader()
{
	std::printf("mesh\ttarget\tV\tF");
	for (const testing::Figure& figure : testing::figuresOf(Report()))
		std::printf("\t%s", figure.name);
	std::puts("\tseam_mismatch\tcpu_s\tuv_charts\tbetween_charts\twithin_charts\trefused");
}

/// What a run gives back: the input or its refinement, with its map.
struct Outcome
{
	Report report;
	SurfaceMesh drawn;
	testing::UV uv;
	std::vector<char> reversed;         ///< [face drawn]
	std::optional<double> seamMismatch; ///< none of a mesh that is not taken as it is
	double seconds = 0.0;               ///< of the processor
};

/// \param positions of the vertices that the map is of
void draw(const FlatMesh& map, const std::vector<Point3>& positions, Outcome& out)
{
	out.drawn.positions = map.onSurface(positions);
	for (const int f : map.points.indices())
		if (map.chart[f] >= 0) { // no degenerate face
			out.drawn.triangles.push_back(map.vertices[f]);
			out.uv.push_back(map.at(f));
		}
}

Outcome runCore(const SurfaceMesh& mesh, const Options& options)
{
	Outcome out;
	const std::clock_t start = std::clock();
	const WholeMap whole = chartsInPlane(mesh, {}, options);
	const Parametrization& flat = whole.map;
	out.seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
	out.report = flat.report;
	out.seamMismatch = testing::MapCheck(whole.opened.mesh, flat).seamMismatch;
	draw(flat.mesh, whole.opened.mesh.positions, out);
	out.reversed.assign(out.uv.size(), 0);
	return out;
}

/// The same by the facade for vcglib, which packs the charts.
Outcome runPacked(const SurfaceMesh& mesh, Options options, double margin)
{
	using Flow = vcg::tri::RicciFlow<testing::DoubleMesh>;
	testing::DoubleMesh m;
	testing::toVcg(mesh, m);
	options.chartMargin = margin;
	Outcome out;
	const std::clock_t start = std::clock();
	const Flow::Result flat = Flow::Compute(m, options);
	out.seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
	out.report = flat.report;
	const OpenedMesh opened = openMesh(mesh);
	const bool isTurned =
		std::find(opened.reversed.begin(), opened.reversed.end(), 1) != opened.reversed.end();
	if (opened.mesh.triangles == mesh.triangles && !isTurned)
		out.seamMismatch = testing::MapCheck(mesh, flat).seamMismatch;
	draw(flat.mesh, mesh.positions, out);
	std::vector<char> reversed(mesh.triangles.size(), 0);
	for (const Face f : opened.reversed.indices())
		reversed[positionOf(opened.face[positionOf(f)])] = opened.reversed[f];
	for (std::size_t f = 0; f < out.uv.size(); ++f)
		out.reversed.push_back(reversed[positionOf(flat.mesh.face[static_cast<int>(f)])]);
	return out;
}

void printResult(const Outcome& out, bool packed)
{
	for (const testing::Figure& figure : testing::figuresOf(out.report))
		std::printf(
			"\t%.9g", figure.value); // overlaps and occupancy are 0 where charts are not packed
	if (out.seamMismatch)
		std::printf("\t%.1e", *out.seamMismatch);
	else
		std::printf("\t-");
	std::printf("\t%.2f", out.seconds);
	if (packed) {
		const testing::CoveredTwice found(out.drawn, out.uv, out.reversed);
		std::printf("\t%d\t%ld\t%ld\t-\n", found.charts, found.betweenCharts, found.withinCharts);
	}
	else
		std::printf("\t-\t-\t-\t-\n");
}

/// \return whether a map was found
bool addRow(
	const Arguments& a,
	const std::string& path,
	const std::string& targetName,
	TargetCurvature target)
{
	const std::string name = std::filesystem::path(path).stem().string();
	std::printf("%s\t%s", name.c_str(), targetName.c_str());
	try {
		const SurfaceMesh mesh = testing::readMesh(path);
		std::printf("\t%zu\t%zu", mesh.positions.size(), mesh.triangles.size());
		std::fflush(stdout);
		Options options = a.options;
		options.target = target;
		const Outcome out = a.packed ? runPacked(mesh, options, a.margin) : runCore(mesh, options);
		printResult(out, a.packed);
		if (!a.objFolder.empty())
			testing::writeObj(
				(std::filesystem::path(a.objFolder) / (name + "." + targetName + ".obj")).string(),
				out.drawn,
				out.uv);
		return true;
	}
	catch (const std::exception& error) {
		for (std::size_t column = 0; column < testing::figuresOf(Report()).size() + 5; ++column)
			std::printf("\t-");
		std::printf("\t%s\n", error.what());
		return false;
	}
}

} // namespace

int main(int argc, char** argv)
{
	const Arguments a = parse(argc, argv);
	printHeader();
	bool allMapped = true;
	for (const std::string& mesh : a.meshes)
		for (const auto& [name, target] : a.targets) {
			allMapped &= addRow(a, mesh, name, target);
			std::fflush(stdout);
		}
	return allMapped ? 0 : 1;
}
