// SPDX-License-Identifier: GPL-3.0-or-later
#include "free_memory.h"

#include <algorithm>
#include <fstream>
#include <locale>
#include <string>

namespace filter_ricci {

namespace {

/// The number in a file that holds nothing else; -1 if there is none ("max").
double numberIn(const char* path)
{
	std::ifstream file(path);
	file.imbue(std::locale::classic());
	double number = -1.0;
	file >> number;
	return file ? number : -1.0;
}

} // namespace

double freeMemory()
{
	constexpr double kKilobyte = 1024.0;
	double free = 0.0;
	std::ifstream file("/proc/meminfo");
	file.imbue(std::locale::classic());
	std::string key, unit;
	double value = 0.0;
	while (file >> key >> value) {
		std::getline(file, unit);
		if (key == "MemAvailable:" || key == "SwapFree:")
			free += value * kKilobyte;
	}
	const double limit = numberIn("/sys/fs/cgroup/memory.max");
	const double used = numberIn("/sys/fs/cgroup/memory.current");
	if (free > 0.0 && limit >= 0.0 && used >= 0.0)
		free = std::min(free, std::max(limit - used, 1.0));
	return free;
}

} // namespace filter_ricci
