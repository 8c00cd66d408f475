// SPDX-License-Identifier: GPL-3.0-or-later
// With -mlong-double-64 long double is double, but the C library's functions still are those of 80
// bits: the tests' references call these instead.
#if defined(__linux__) && defined(__x86_64__) && __SIZEOF_LONG_DOUBLE__ == 8

#define RICCI_AS_DOUBLE(name)                                                                      \
	long double name##l(long double x) noexcept                                                    \
	{                                                                                              \
		return name(static_cast<double>(x));                                                       \
	}
#define RICCI_AS_DOUBLE_OF_TWO(name)                                                               \
	long double name##l(long double x, long double y) noexcept                                     \
	{                                                                                              \
		return name(static_cast<double>(x), static_cast<double>(y));                               \
	}

extern "C" {
RICCI_AS_DOUBLE(acos)
RICCI_AS_DOUBLE(acosh)
RICCI_AS_DOUBLE(asin)
RICCI_AS_DOUBLE(asinh)
RICCI_AS_DOUBLE(atan)
RICCI_AS_DOUBLE(atanh)
RICCI_AS_DOUBLE(cos)
RICCI_AS_DOUBLE(cosh)
RICCI_AS_DOUBLE(exp)
RICCI_AS_DOUBLE(expm1)
RICCI_AS_DOUBLE(log)
RICCI_AS_DOUBLE(log1p)
RICCI_AS_DOUBLE(sin)
RICCI_AS_DOUBLE(sinh)
RICCI_AS_DOUBLE(sqrt)
RICCI_AS_DOUBLE(tan)
RICCI_AS_DOUBLE(tanh)
RICCI_AS_DOUBLE_OF_TWO(atan2)
RICCI_AS_DOUBLE_OF_TWO(hypot)
RICCI_AS_DOUBLE_OF_TWO(pow)

void sincosl(long double x, long double* sine, long double* cosine) noexcept
{
	const volatile double angle = static_cast<double>(x); // or these are one call of sincosl
	*sine = sin(angle);
	*cosine = cos(angle);
}

long double cabsl(_Complex long double z) noexcept
{
	return hypot(static_cast<double>(__real__ z), static_cast<double>(__imag__ z));
}

long double cargl(_Complex long double z) noexcept
{
	return atan2(static_cast<double>(__imag__ z), static_cast<double>(__real__ z));
}
}

#endif
