// SPDX-License-Identifier: GPL-3.0-or-later
#include "points.h"

namespace ricci {

namespace {

/// A number as an exact sum of doubles: each term is added with all its rounding errors kept
/// (Grow-Expansion of [Shewchuk 1997]).
class Expansion
{
public:
	void addProduct(double x, double y)
	{
		const double product = x * y;
		add(product);
		add(std::fma(x, y, -product));
	}

	/// Sign of the sum: that of its largest non-zero term, since the terms do not overlap.
	int sign() const
	{
		for (std::size_t i = m_size; i-- > 0;)
			if (m_terms[i] != 0.0)
				return m_terms[i] > 0.0 ? 1 : -1;
		return 0;
	}

private:
	/// Terms stay non-overlapping and of increasing magnitude.
	void add(double term)
	{
		for (std::size_t i = 0; i < m_size; ++i) {
			const double sum = m_terms[i] + term, virtualTerm = sum - m_terms[i];
			m_terms[i] = (m_terms[i] - (sum - virtualTerm)) + (term - virtualTerm);
			term = sum;
		}
		m_terms[m_size++] = term;
	}

	std::array<double, 12> m_terms;
	std::size_t m_size = 0;
};

/// \p area(s, s - a, s - b, s - c) of a triangle with the sides a <= b <= c, s half the perimeter.
template<class Area>
double ofSides(const std::array<double, 3>& l, Area area)
{
	// Without branches: no processor could predict them.
	const double low = std::min(l[0], l[1]), high = std::max(l[0], l[1]);
	const double a = std::min(low, l[2]), c = std::max(high, l[2]);
	const double b = std::max(low, std::min(high, l[2]));
	// Kahan's order of operations: nothing cancels but the sides themselves.
	const double twiceShortest = std::max(0.0, a - (c - b)); // 2 (s - c)
	return area(0.5 * (c + (b + a)), 0.5 * twiceShortest, 0.5 * (a + (c - b)), 0.5 * (c + (b - a)));
}

} // namespace

PointsOnLine::PointsOnLine(const std::vector<Point3>& points) : m_points(points)
{
	for (std::size_t i = 0; i < points.size(); ++i)
		m_line.emplace_back(along(points[i]), static_cast<int>(i));
	std::sort(m_line.begin(), m_line.end());
}

double euclideanArea(const std::array<double, 3>& sides)
{
	return ofSides(
		sides, [](double s, double a, double b, double c) { return std::sqrt(s * a * b * c); });
}

double hyperbolicArea(const std::array<double, 3>& sides)
{
	return ofSides(sides, [](double s, double a, double b, double c) {
		return 4.0 * std::atan(std::sqrt(
						 std::tanh(0.5 * s) * std::tanh(0.5 * a) * std::tanh(0.5 * b) *
						 std::tanh(0.5 * c)));
	});
}

int orientation(const Point2& a, const Point2& b, const Point2& c)
{
	const double left = (b[0] - a[0]) * (c[1] - a[1]);
	const double right = (b[1] - a[1]) * (c[0] - a[0]);
	const double area = left - right;
	// More than the rounding error of the area, where nothing underflows.
	const double bound =
		4.0 * std::numeric_limits<double>::epsilon() * (std::abs(left) + std::abs(right));
	if (std::abs(area) > bound && bound > std::numeric_limits<double>::min())
		return area > 0.0 ? 1 : -1;
	Expansion exact;
	exact.addProduct(a[0], b[1]);
	exact.addProduct(-a[1], b[0]);
	exact.addProduct(b[0], c[1]);
	exact.addProduct(-b[1], c[0]);
	exact.addProduct(c[0], a[1]);
	exact.addProduct(-c[1], a[0]);
	return exact.sign();
}

} // namespace ricci
