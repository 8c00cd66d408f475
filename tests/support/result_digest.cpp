// SPDX-License-Identifier: GPL-3.0-or-later
// Prints what runs on meshes give back, a line for each number and a digest of all arrays: what a change that
// should change nothing is compared by, bit for bit.
#include "bytes.h"
#include "calls.h"
#include "mesh_file.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>

namespace {

using namespace ricci;
using testing::inDisk;
using testing::with;

using AnyOptions = decltype(testing::Call::options);

const std::vector<std::pair<std::string, AnyOptions>> kCases = {
	{"default", Options()},
	{"refined", with([](Options& o) { o.output = OutputTriangulation::CommonRefinement; })},
	{"placed", with([](Options& o) { o.target = TargetCurvature::PlacedCones; })},
	{"counted", with([](Options& o) { o.cones.count = 9; })},
	{"spread", with([](Options& o) { o.cones.distortion = 0.2; })},
	{"quarter", with([](Options& o) {
		 o.target = TargetCurvature::PlacedCones;
		 o.cones.rounding = ConeRounding::QuarterTurns;
	 })},
	{"flat", with([](Options& o) { o.target = TargetCurvature::Flat; })},
	{"disk", with([](Options& o) { o.target = TargetCurvature::Disk; })},
	{"rectangle", with([](Options& o) { o.target = TargetCurvature::Rectangle; })},
	{"prescribed_boundary", with([](Options& o) { o.freeBoundary = false; })},
	{"capped", with([](Options& o) { o.holes = Holes::Capped; })},
	{"strips_unscaled", with([](Options& o) {
		 o.charts = Charts::CutForPacking;
		 o.chartMargin = 0.01;
	 })},
	{"no_surgery", with([](Options& o) { o.method = Method::FixedTriangles; })},
	{"edge_swap", with([](Options& o) { o.method = Method::EdgeSwaps; })},
	{"thurston", with([](Options& o) { o.method = Method::Thurston; })},
	{"hyperbolic", inDisk([](HyperbolicOptions& o) { o.canonicalGenerators = true; })},
	{"hyperbolic_refined",
	 inDisk([](HyperbolicOptions& o) { o.output = OutputTriangulation::CommonRefinement; })},
	{"hyperbolic_no_surgery",
	 inDisk([](HyperbolicOptions& o) { o.method = Method::FixedTriangles; })},
	{"sphere", testing::SphereOptions()}};

/// FNV-1a of the bytes.
std::uint64_t digestOf(const std::string& bytes)
{
	std::uint64_t value = 14695981039346656037ull;
	for (const char byte : bytes)
		value = (value ^ static_cast<unsigned char>(byte)) * 1099511628211ull;
	return value;
}

void print(const testing::Call& call)
{
	const char* const run = call.name.c_str();
	try {
		const testing::Outcome outcome = outcomeOf(call);
		for (const testing::Figure& figure : figuresOf(outcome))
			std::printf("%s\t%s\t%.17g\n", run, figure.name, figure.value);
		testing::Bytes u;
		u.addAll(outcome.map.u);
		std::printf("%s\tu\t%016llx\n", run, (unsigned long long) (digestOf(u.all)));
		std::printf("%s\tall\t%016llx\n", run, (unsigned long long) (digestOf(bitsOf(outcome))));
	}
	catch (const std::exception& e) {
		std::printf("%s\trefused\t%s\n", run, e.what());
	}
	std::fflush(stdout);
}

} // namespace

/// result_digest [--case NAME]... MESH...
int main(int argc, char** argv)
{
	std::vector<std::string> wanted, meshes;
	for (int i = 1; i < argc; ++i)
		if (std::string(argv[i]) == "--case" && i + 1 < argc)
			wanted.push_back(argv[++i]);
		else
			meshes.push_back(argv[i]);
	for (const std::string& path : meshes)
		try {
			const SurfaceMesh mesh = testing::readMesh(path);
			const std::string name = std::filesystem::path(path).stem().string() + "\t";
			for (const auto& [run, options] : kCases)
				if (wanted.empty() || std::find(wanted.begin(), wanted.end(), run) != wanted.end())
					print({name + run, mesh, options});
		}
		catch (const std::exception& e) {
			std::fprintf(stderr, "%s: %s\n", path.c_str(), e.what());
			return 2;
		}
}
