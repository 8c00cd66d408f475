// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_FLOATING_POINT_H
#define RICCI_FLOATING_POINT_H

#include <cfenv>
#include <cmath>

namespace ricci {

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
