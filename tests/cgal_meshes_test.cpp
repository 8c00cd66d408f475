// SPDX-License-Identifier: GPL-3.0-or-later
// Meshes of Debian's package libcgal-demo, clean and dirty, of many topologies: each is mapped
// without a defect, or refused for a reason that holds.
#include "support/off_file.h"
#include "support/pipeline_check.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <ostream>
#include <string>

namespace ricci::testing {
namespace {

const std::filesystem::path kFolder = std::filesystem::path(RICCI_CGAL_MESHES_DIR) / "data/meshes";

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
