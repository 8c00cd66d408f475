// SPDX-License-Identifier: GPL-3.0-or-later
// Prints a table of what the algorithm with intrinsic flips and the common refinement makes of
// meshes: one row for each mesh, with tabulators between the columns. "bad" rows say what is wrong
// with the map.
#include "off_file.h"
#include "pipeline_check.h"

#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>

namespace {

using namespace ricci;

/// \return whether the mesh was mapped without a defect or refused
bool addRow(const std::string& path)
{
	std::printf("%s", std::filesystem::path(path).stem().string().c_str());
	std::fflush(stdout);
	try {
		const SurfaceMesh mesh = testing::readOff(path);
		std::printf("\t%zu\t%zu", mesh.positions.size(), mesh.triangles.size());
		std::fflush(stdout);
		const testing::PipelineCheck check(mesh);
		const Report& r = check.report;
		if (!check.isMapped()) {
			std::printf("\t-\trefused\t-\t-\t-\t-\t-\t-\t%s\n", check.refusal.c_str());
			return true;
		}
		const bool good = check.defect.empty();
		std::printf(
			"\t%d\t%s\t%d\t%.1e\t%d\t%d\t%d\t%d\t%s\n",
			r.eulerCharacteristic,
			good ? "solved" : "bad",
			r.iterations,
			r.maxCurvatureError,
			r.flips,
			r.flippedFaces - check.belowResolution,
			check.belowResolution,
			r.refinementPoints,
			good ? "-" : check.defect.c_str());
		return good;
	}
	catch (const std::exception& error) {
		std::printf("\t-\t-\t-\tunreadable\t-\t-\t-\t-\t-\t-\t%s\n", error.what());
		return false;
	}
}

} // namespace

int main(int argc, char** argv)
{
	if (argc < 2) {
		std::fprintf(stderr, "usage: refinement_table MESH.off...\n");
		return 2;
	}
	std::puts("mesh\tV\tF\tchi\tverdict\titerations\tresidual\tflips\tflipped\tbelow_"
			  "resolution\trefined_points\twhy");
	bool good = true;
	for (int i = 1; i < argc; ++i) {
		good &= addRow(argv[i]);
		std::fflush(stdout);
	}
	return good ? 0 : 1;
}
