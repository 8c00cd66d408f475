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
	const char* refusal; ///< part of the sentence; nullptr if the mesh is to be mapped
};

std::ostream& operator<<(std::ostream& out, const Case& c)
{
	return out << c.name;
}

class CgalMeshes : public ::testing::TestWithParam<Case>
{
};

TEST_P(CgalMeshes, IsMappedOrRefused)
{
	const Case& c = GetParam();
	const auto path = kFolder / (std::string(c.name) + ".off");
	if (!std::filesystem::exists(path))
		GTEST_SKIP() << "SKIPPED: " << path.string()
					 << " is missing; unpack_cgal_meshes.sh brings it";
	const PipelineCheck check(readOff(path.string()));
	if (c.refusal) {
		EXPECT_NE(check.refusal.find(c.refusal), std::string::npos) << "refused: " << check.refusal;
		return;
	}
	EXPECT_EQ(check.refusal, "");
	EXPECT_EQ(check.defect, "");
	EXPECT_EQ(check.belowResolution, 0);
	EXPECT_EQ(check.report.eulerCharacteristic, c.eulerCharacteristic);
}

const Case kCases[] = {
	{"star", 2, nullptr},
	{"cube-meshed", 2, nullptr},
	{"knot2", 0, nullptr},
	{"pinion", 0, nullptr}, // needles
	{"joint", -2, nullptr},
	{"helmet", -4, nullptr},
	{"anchor", -6, nullptr},
	{"turbine", -20, nullptr},
	{"mushroom", 1, nullptr},
	{"degtri_sliding", 1, nullptr}, // faces without area
	{"three_peaks", 1, nullptr},
	{"boeing", 102, nullptr}, // many components with many boundaries
	{"bones", 52, nullptr},
	{"ALSTOM_TEST4", 6, nullptr},
	{"elephant-with-holes", -110, nullptr},
	{"fandisk", 2, nullptr},
	{"triangle", 1, nullptr},
	{"mesh_with_colors", 1, nullptr},
	{"mpi", 0, nullptr}, // concave polygons as fans
	{"polygon_mesh", 0, "2 non-manifold vertices"}};

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
