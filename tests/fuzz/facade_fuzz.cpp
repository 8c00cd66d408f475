// SPDX-License-Identifier: GPL-3.0-or-later
// Entry point of libFuzzer, which comes with clang.
#include "facade_check.h"

#include <cstdio>
#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
	const ricci::testing::Execution execution = ricci::testing::runFacade(data, size);
	if (!execution.defect.empty()) {
		std::fprintf(stderr, "DEFECT: %s\n", execution.defect.c_str());
		std::abort();
	}
	return 0;
}
