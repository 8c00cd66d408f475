// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_NUMBERS_H
#define RICCI_NUMBERS_H

#include <algorithm>
#include <cfenv>
#include <charconv>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace ricci {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

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

/// "1 face was", "12 faces were".
inline std::string counted(std::size_t n, const std::string& one, const std::string& many)
{
	return std::to_string(n) + " " + (n == 1 ? one : many);
}

/// The upper one of two.
inline double median(std::vector<double> values)
{
	const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
	std::nth_element(values.begin(), middle, values.end());
	return *middle;
}

/// The default floating-point environment while it lives, and the caller's own afterwards. The
/// algorithm goes through infinities on purpose (a trial step of the line search out of range), so
/// a host that traps floating-point exceptions, or rounds otherwise than to nearest, must neither
/// be interrupted nor get other results.
class DefaultFloatingPoint
{
public:
	DefaultFloatingPoint()
	{
		std::fegetenv(&m_caller);
		std::fesetenv(FE_DFL_ENV);
	}
	~DefaultFloatingPoint() { std::fesetenv(&m_caller); }
	DefaultFloatingPoint(const DefaultFloatingPoint&) = delete;
	DefaultFloatingPoint& operator=(const DefaultFloatingPoint&) = delete;

private:
	std::fenv_t m_caller;
};

/// Through memory, because GCC 12 takes double(float(x)) for x where it vectorizes.
inline double roundedToFloat(double x)
{
	const volatile float rounded = static_cast<float>(x);
	return static_cast<double>(rounded);
}

/// The step of floats just below \p x > 0.
inline double floatStep(double x)
{
	const auto above = static_cast<float>(x);
	return static_cast<double>(above) - static_cast<double>(std::nextafter(above, 0.0F));
}

} // namespace ricci

#endif
