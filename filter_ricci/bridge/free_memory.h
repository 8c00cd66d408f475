// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef FILTER_RICCI_FREE_MEMORY_H
#define FILTER_RICCI_FREE_MEMORY_H

#include <string>

namespace filter_ricci {

/// Bytes that the machine can still give, the pages of files that were read counted as free; 0 where that cannot be
/// asked. On Linux no more than the control group of the process (version 1 or 2, as a container sees it) and the
/// limit of its address space (ulimit -v) leave.
/// \param root of the file system of Linux, with a slash at its end
double freeMemory(const std::string& root = "/");

} // namespace filter_ricci

#endif
