// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_EXTENDED_COMPLEX_H
#define RICCI_EXTENDED_COMPLEX_H

#include "double_double.h"

#include <complex>

namespace ricci {

/// A complex number in extended precision, with the functions of std::complex, which is not specified
/// for such types.
class ExtendedComplex
{
public:
	constexpr ExtendedComplex() = default;
	constexpr ExtendedComplex(double real) : m_real(real) {}
	constexpr ExtendedComplex(DoubleDouble real, DoubleDouble imag = 0.0) :
			m_real(real), m_imag(imag)
	{
	}
	constexpr ExtendedComplex(std::complex<double> z) : m_real(z.real()), m_imag(z.imag()) {}

	explicit operator std::complex<double>() const
	{
		return {static_cast<double>(m_real), static_cast<double>(m_imag)};
	}

	constexpr DoubleDouble real() const { return m_real; }
	constexpr DoubleDouble imag() const { return m_imag; }

	friend ExtendedComplex operator-(const ExtendedComplex& z) { return {-z.m_real, -z.m_imag}; }

	friend ExtendedComplex operator+(const ExtendedComplex& z, const ExtendedComplex& w)
	{
		return {z.m_real + w.m_real, z.m_imag + w.m_imag};
	}

	friend ExtendedComplex operator-(const ExtendedComplex& z, const ExtendedComplex& w)
	{
		return {z.m_real - w.m_real, z.m_imag - w.m_imag};
	}

	friend ExtendedComplex operator*(const ExtendedComplex& z, const ExtendedComplex& w)
	{
		return {
			z.m_real * w.m_real - z.m_imag * w.m_imag, z.m_real * w.m_imag + z.m_imag * w.m_real};
	}

	friend ExtendedComplex operator*(DoubleDouble x, const ExtendedComplex& z)
	{
		return {x * z.m_real, x * z.m_imag};
	}

	friend ExtendedComplex operator*(double x, const ExtendedComplex& z)
	{
		return {x * z.m_real, x * z.m_imag};
	}

	friend ExtendedComplex operator/(const ExtendedComplex& z, DoubleDouble x)
	{
		return {z.m_real / x, z.m_imag / x};
	}

	friend ExtendedComplex operator/(const ExtendedComplex& z, const ExtendedComplex& w)
	{
		return z * conj(w) / norm(w);
	}

	ExtendedComplex& operator+=(const ExtendedComplex& z) { return *this = *this + z; }

	friend bool operator==(const ExtendedComplex& z, const ExtendedComplex& w)
	{
		return z.m_real == w.m_real && z.m_imag == w.m_imag;
	}

	friend ExtendedComplex conj(const ExtendedComplex& z) { return {z.m_real, -z.m_imag}; }

	/// The square of the absolute value.
	friend DoubleDouble norm(const ExtendedComplex& z)
	{
		return z.m_real * z.m_real + z.m_imag * z.m_imag;
	}

	friend DoubleDouble abs(const ExtendedComplex& z) { return sqrt(norm(z)); }

	friend DoubleDouble arg(const ExtendedComplex& z) { return atan2(z.m_imag, z.m_real); }

private:
	DoubleDouble m_real, m_imag;
};

/// The complex number \p r exp(i \p angle), as std::polar.
inline ExtendedComplex polar(DoubleDouble r, DoubleDouble angle)
{
	const SineAndCosine turn = sineAndCosine(angle);
	return {r * turn.cosine, r * turn.sine};
}

/// The complex numbers with parts of type \p T.
template<class T>
struct ComplexOf
{
	using Type = std::complex<T>;
};

template<>
struct ComplexOf<DoubleDouble>
{
	using Type = ExtendedComplex;
};

} // namespace ricci

#endif
