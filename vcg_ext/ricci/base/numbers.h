// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_NUMBERS_H
#define RICCI_NUMBERS_H

#include <charconv>
#include <string>

namespace ricci {

constexpr double kPi = 3.14159265358979323846;

/// pi less the double next to it.
constexpr double kPiLow = 1.2246467991473531772e-16;
constexpr double kQuarterTurn = 0.5 * kPi;

/// \p x with \p digits significant digits, as "%.*g" writes it in the C locale: never with the
/// host's decimal comma.
inline std::string
numberText(double x, int digits, std::chars_format format = std::chars_format::general)
{
	char text[64];
	const auto end = std::to_chars(text, text + sizeof text, x, format, digits);
	return std::string(text, end.ptr);
}

} // namespace ricci

#endif
