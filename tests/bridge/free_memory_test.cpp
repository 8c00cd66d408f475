// SPDX-License-Identifier: GPL-3.0-or-later
#include <bridge/free_memory.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

using filter_ricci::freeMemory;

namespace {

/// A file system of its own, gone at the end.
class Root
{
public:
	/// Named after the test: others may run at the same time.
	Root() :
			m_path(
				std::filesystem::path(::testing::TempDir()) /
				("ricci_free_memory_" +
				 std::string(::testing::UnitTest::GetInstance()->current_test_info()->name())))
	{
		std::filesystem::remove_all(m_path);
		std::filesystem::create_directories(m_path);
	}
	~Root() { std::filesystem::remove_all(m_path); }

	void write(const std::string& name, const std::string& text) const
	{
		std::filesystem::create_directories((m_path / name).parent_path());
		std::ofstream(m_path / name) << text;
	}
	double freeMemory() const { return ::freeMemory(m_path.string() + "/"); }

private:
	std::filesystem::path m_path;
};

constexpr const char* kMachine = "MemTotal:        8000 kB\nMemFree:          100 kB\n"
								 "MemAvailable:    3000 kB\nSwapTotal:       2000 kB\n"
								 "SwapFree:        1000 kB\nHugePages_Total:       0\n";
constexpr double kOfMachine = 4000.0 * 1024.0;

} // namespace

TEST(FreeMemory, IsUnknownWithoutFiles)
{
	EXPECT_EQ(Root().freeMemory(), 0.0);
}

TEST(FreeMemory, IsThatOfTheMachineWithoutALimit)
{
	const Root root;
	root.write("proc/meminfo", kMachine);
	EXPECT_EQ(root.freeMemory(), kOfMachine);
	root.write("sys/fs/cgroup/memory.max", "max\n");
	root.write("sys/fs/cgroup/memory.current", "900000\n");
	EXPECT_EQ(root.freeMemory(), kOfMachine);
	root.write("sys/fs/cgroup/memory/memory.limit_in_bytes", "9223372036854771712\n");
	root.write("sys/fs/cgroup/memory/memory.usage_in_bytes", "197705728\n");
	EXPECT_EQ(root.freeMemory(), kOfMachine);
}

TEST(FreeMemory, IsWhatTheControlGroupLeaves)
{
	struct
	{
		const char *limit, *used, *stat, *files;
	} const versions[] = {
		{"sys/fs/cgroup/memory.max",
		 "sys/fs/cgroup/memory.current",
		 "sys/fs/cgroup/memory.stat",
		 "inactive_file"},
		{"sys/fs/cgroup/memory/memory.limit_in_bytes",
		 "sys/fs/cgroup/memory/memory.usage_in_bytes",
		 "sys/fs/cgroup/memory/memory.stat",
		 "total_inactive_file"}};
	for (const auto& version : versions) {
		SCOPED_TRACE(version.limit);
		const Root root;
		root.write("proc/meminfo", kMachine);
		root.write(version.limit, "1000000\n");
		EXPECT_EQ(root.freeMemory(), kOfMachine); // of no use without what is used
		root.write(version.used, "700000\n");
		EXPECT_EQ(root.freeMemory(), 300000.0);
		// Pages of files are given back.
		root.write(version.stat, std::string("cache 5\n") + version.files + " 200000\nshmem 7\n");
		EXPECT_EQ(root.freeMemory(), 500000.0);
		// Nothing left is not the same as unknown.
		root.write(version.used, "1300000\n");
		EXPECT_EQ(root.freeMemory(), 1.0);
	}
}

TEST(FreeMemory, IsWhatTheLimitOfTheAddressSpaceLeaves)
{
	const Root root;
	root.write("proc/meminfo", kMachine);
	const std::string head =
		"Limit                     Soft Limit           Hard Limit           Units\n"
		"Max cpu time              7                    unlimited            seconds\n";
	root.write("proc/self/statm", "100 50 20 10 0 5 0\n");
	root.write(
		"proc/self/limits",
		head + "Max address space         unlimited            unlimited            bytes\n");
	EXPECT_EQ(root.freeMemory(), kOfMachine);
	root.write(
		"proc/self/limits",
		head + "Max address space         1000000              unlimited            bytes\n");
	EXPECT_EQ(root.freeMemory(), 1000000.0 - 100 * 4096.0);
	root.write("proc/self/statm", "300 50 20 10 0 5 0\n");
	EXPECT_EQ(root.freeMemory(), 1.0);
}
