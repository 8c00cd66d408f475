// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_LINE_SEARCH_H
#define RICCI_LINE_SEARCH_H

#include <algorithm>
#include <cmath>

namespace ricci {

/// Shortens a step until a function falls enough along it: by a share of what its slope promises
/// [Nocedal Wright 2006, 3.1, 3.5]. The next length is that of the lowest point of the parabola through
/// both values with the slope, within bounds.
struct LineSearch
{
	double shortest;                                 ///< the search fails below
	double minShortening = 0.1, maxShortening = 0.5; ///< factors from one length to the next

	/// \param length of the first step
	/// \param slope of the function at length 0, negative
	/// \param now its value there
	/// \param valueAt valueAt(length); where it is not finite, the step is shortened by maxShortening
	/// \param accepts accepts(), asked where the value is low enough
	/// \return the length, or 0
	template<class Value, class Accepts>
	double
	run(double length, double slope, double now, const Value& valueAt, const Accepts& accepts) const
	{
		constexpr double decrease = 1e-4;
		while (length >= shortest) {
			const double value = valueAt(length), promised = slope * length;
			if (value <= now + decrease * promised && accepts())
				return length;
			const double vertex = -promised / (2.0 * (value - now - promised));
			length *= std::isfinite(value) ? std::clamp(vertex, minShortening, maxShortening)
										   : maxShortening;
		}
		return 0.0;
	}

	template<class Value>
	double run(double length, double slope, double now, const Value& valueAt) const
	{
		return run(length, slope, now, valueAt, [] { return true; });
	}
};

} // namespace ricci

#endif
