// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_ATTEMPT_H
#define RICCI_ATTEMPT_H

#include "../error.h"

#include <optional>

namespace ricci {

/// What \p action() returns. An error is no result; a stop of the run is a stop.
/// \throw Stopped
template<class Action>
auto attempt(Action action) -> std::optional<decltype(action())>
{
	try {
		return action();
	}
	catch (const Stopped&) {
		throw;
	}
	catch (const Error&) {
		return std::nullopt;
	}
}

} // namespace ricci

#endif
