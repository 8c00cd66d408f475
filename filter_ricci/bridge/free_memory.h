// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef FILTER_RICCI_FREE_MEMORY_H
#define FILTER_RICCI_FREE_MEMORY_H

namespace filter_ricci {

/// Bytes that this process can still use before the system runs out of memory (swap included) or a
/// limit of its control group is reached; 0 if that is not known (other systems than Linux).
double freeMemory();

} // namespace filter_ricci

#endif
