// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_TEXT_H
#define RICCI_TEXT_H

#include <charconv>
#include <string>

namespace ricci {

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
