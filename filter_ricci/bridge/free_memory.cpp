// SPDX-License-Identifier: GPL-3.0-or-later
#include "free_memory.h"

#if defined(_WIN32)
#ifndef NOMINMAX
#define NOMINMAX
#endif
#include <windows.h>
#elif defined(__APPLE__)
#include <mach/mach.h>
#include <sys/sysctl.h>
#endif

#include <algorithm>
#include <fstream>
#include <locale>
#include <sstream>
#include <string>

namespace filter_ricci {

#if defined(_WIN32)

/// Of the machine, which gives memory to a process only as long as it could be paged out.
double freeMemory(const std::string&)
{
	MEMORYSTATUSEX status = {};
	status.dwLength = sizeof(status);
	if (!GlobalMemoryStatusEx(&status))
		return 0.0;
	return static_cast<double>(std::min(status.ullAvailPageFile, status.ullAvailVirtual));
}

#elif defined(__APPLE__)

/// Of the machine: pages that nobody holds or that can be dropped, and what is left of the swap files there are.
double freeMemory(const std::string&)
{
	vm_statistics64_data_t pages = {};
	mach_msg_type_number_t count = HOST_VM_INFO64_COUNT;
	vm_size_t size = 0;
	const mach_port_t host = mach_host_self();
	const bool isKnown =
		host_page_size(host, &size) == KERN_SUCCESS &&
		host_statistics64(host, HOST_VM_INFO64, reinterpret_cast<host_info64_t>(&pages), &count) ==
			KERN_SUCCESS;
	mach_port_deallocate(mach_task_self(), host);
	if (!isKnown)
		return 0.0;
	xsw_usage swap = {};
	std::size_t length = sizeof(swap);
	if (sysctlbyname("vm.swapusage", &swap, &length, nullptr, 0) != 0)
		swap = {};
	const double free =
		static_cast<double>(pages.free_count) + pages.inactive_count + pages.purgeable_count;
	return free * static_cast<double>(size) + static_cast<double>(swap.xsu_avail);
}

#else

namespace {

/// The number in a file that holds nothing else; -1 if there is none ("max").
double numberIn(const std::string& path)
{
	std::ifstream file(path);
	file.imbue(std::locale::classic());
	double number = -1.0;
	file >> number;
	return file ? number : -1.0;
}

/// The number behind \p key in a file of such pairs; 0 if there is none.
double numberBehind(const std::string& path, const std::string& key)
{
	std::ifstream file(path);
	file.imbue(std::locale::classic());
	std::string name, rest;
	double number = 0.0;
	while (file >> name >> number) {
		if (name == key)
			return number;
		std::getline(file, rest);
	}
	return 0.0;
}

/// Bytes that a limit of the address space (ulimit -v) leaves the process; -1 if there is none.
double freeAddresses(const std::string& root)
{
	constexpr double kPage = 4096.0; // the size is counted in pages; larger ones leave less
	const std::string key = "Max address space";
	std::ifstream limits(root + "proc/self/limits");
	const double pages = numberIn(root + "proc/self/statm");
	for (std::string line; std::getline(limits, line);) {
		if (line.compare(0, key.size(), key) != 0)
			continue;
		std::istringstream values(line.substr(key.size()));
		values.imbue(std::locale::classic());
		double limit = -1.0; // "unlimited" is not a number
		if (values >> limit && pages >= 0.0)
			return std::max(limit - kPage * pages, 1.0);
	}
	return -1.0;
}

/// Files of a control group that say how much memory it may have and has. What it has includes
/// pages of files, which the kernel gives back when it needs them.
struct ControlGroup
{
	const char *folder, *limit, *used, *files;
};
constexpr ControlGroup kControlGroups[] = {
	{"sys/fs/cgroup/", "memory.max", "memory.current", "inactive_file"},
	{"sys/fs/cgroup/memory/",
	 "memory.limit_in_bytes",
	 "memory.usage_in_bytes",
	 "total_inactive_file"}};

} // namespace

double freeMemory(const std::string& root)
{
	constexpr double kKilobyte = 1024.0;
	const std::string machine = root + "proc/meminfo";
	double free =
		kKilobyte * (numberBehind(machine, "MemAvailable:") + numberBehind(machine, "SwapFree:"));
	for (const ControlGroup& group : kControlGroups) {
		const std::string folder = root + group.folder;
		const double limit = numberIn(folder + group.limit), used = numberIn(folder + group.used);
		const double files = numberBehind(folder + "memory.stat", group.files);
		if (free > 0.0 && limit >= 0.0 && used >= 0.0)
			free = std::min(free, std::max(limit - std::max(used - files, 0.0), 1.0));
	}
	const double addresses = freeAddresses(root);
	if (free > 0.0 && addresses > 0.0)
		free = std::min(free, addresses);
	return free;
}

#endif

} // namespace filter_ricci
