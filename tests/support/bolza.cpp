// SPDX-License-Identifier: GPL-3.0-or-later
#include "bolza.h"

#include "intrinsic.h"
#include "shapes.h"

#include <array>
#include <cmath>

namespace ricci::testing {

namespace {

constexpr long double kPi = 3.14159265358979323846264338327950288L;

using Complex = BolzaSurface::Complex;

Complex midpoint(Complex z, Complex w)
{
	// From z the other end is straight ahead.
	const Complex ahead = (w - z) / (1.0L - std::conj(z) * w);
	const long double r = std::abs(ahead);
	const Complex half = ahead / r * std::tanh(std::atanh(r) / 2);
	return (half + z) / (1.0L + std::conj(z) * half);
}

/// Triangles with their places, glued side by side: side 3 f + k runs from corner k of f.
struct Pieces
{
	int vertexCount = 0;
	std::vector<Triangle> triangles;
	std::vector<int> glued;
	std::vector<std::array<Complex, 3>> place;
	std::vector<char> onOctagon; // [side]
};

Pieces octagon()
{
	// Half the angles at the centre and at the corners are pi / 8: cosh R = cot^2(pi / 8).
	const long double cotangent = 1 / std::tan(kPi / 8);
	const long double radius = std::tanh(std::acosh(cotangent * cotangent) / 2);
	Pieces p;
	p.vertexCount = 2; // the centre, and the corners, which are one point
	for (int i = 0; i < 8; ++i) {
		const long double turn = kPi / 4;
		p.triangles.push_back({0, 1, 1});
		p.place.push_back(
			{Complex(0), std::polar(radius, turn * i), std::polar(radius, turn * (i + 1))});
		p.glued.insert(
			p.glued.end(), {3 * ((i + 7) % 8) + 2, 3 * ((i + 4) % 8) + 1, 3 * ((i + 1) % 8)});
		p.onOctagon.insert(p.onOctagon.end(), {0, 1, 0});
	}
	return p;
}

/// Child k of a triangle keeps its corner k: (corner k, midpoint of side k, midpoint of side k - 1).
/// Child 3 has the midpoints.
Pieces divided(const Pieces& p)
{
	const std::size_t n = p.triangles.size();
	Pieces d;
	d.vertexCount = p.vertexCount;
	std::vector<int> middle(3 * n, -1);
	for (std::size_t side = 0; side < 3 * n; ++side)
		if (middle[side] < 0)
			middle[side] = middle[at(p.glued[side])] = d.vertexCount++;
	d.glued.assign(12 * n, -1);
	d.onOctagon.assign(12 * n, 0);
	const auto half = [](std::size_t side, bool second) { // of a side, in its direction
		const std::size_t f = side / 3, k = side % 3;
		return second ? 3 * (4 * f + (k + 1) % 3) + 2 : 3 * (4 * f + k);
	};
	for (std::size_t f = 0; f < n; ++f) {
		std::array<Complex, 3> m;
		for (std::size_t k = 0; k < 3; ++k)
			m[k] = midpoint(p.place[f][k], p.place[f][(k + 1) % 3]);
		for (std::size_t k = 0; k < 3; ++k) {
			const std::size_t side = 3 * f + k, last = (k + 2) % 3;
			d.triangles.push_back({p.triangles[f][k], middle[side], middle[3 * f + last]});
			d.place.push_back({p.place[f][k], m[k], m[last]});
			const std::size_t inner = 3 * (4 * f + 3) + last, outer = 3 * (4 * f + k) + 1;
			d.glued[inner] = static_cast<int>(outer);
			d.glued[outer] = static_cast<int>(inner);
			for (bool second : {false, true}) {
				d.glued[half(side, second)] = static_cast<int>(half(at(p.glued[side]), !second));
				d.onOctagon[half(side, second)] = p.onOctagon[side];
			}
		}
		d.triangles.push_back({middle[3 * f], middle[3 * f + 1], middle[3 * f + 2]});
		d.place.push_back(m);
	}
	return d;
}

} // namespace

long double distanceInDisk(Complex z, Complex w)
{
	return 2 * std::atanh(std::abs((z - w) / (1.0L - std::conj(w) * z)));
}

long double angleInDisk(Complex p, Complex q, Complex r)
{
	const auto seen = [&](Complex z) { return (z - p) / (1.0L - std::conj(p) * z); };
	return std::abs(std::arg(seen(r) / seen(q)));
}

double BolzaSurface::halfTrace()
{
	return 1.0 + std::sqrt(2.0);
}

double BolzaSurface::inradius()
{
	return std::acosh(halfTrace());
}

BolzaSurface::BolzaSurface(int levels)
{
	Pieces p = octagon();
	for (int i = 0; i < levels; ++i)
		p = divided(p);
	triangulation = glued(p.vertexCount, p.triangles, p.glued);
	const Triangulation& t = triangulation;
	lengths.resize(t.edgeCount());
	angles.resize(t.halfedgeCount());
	place.resize(t.halfedgeCount());
	cut.isCut.assign(t.edgeCount(), 0);
	std::vector<char> sideHasGenerator(4, 0);
	for (const Face f : t.faces()) {
		const auto h = t.halfedges(f);
		for (std::size_t k = 0; k < 3; ++k) {
			const auto& q = p.place[at(f)];
			const Edge e = h[k].edge();
			place[h[k]] = q[k];
			lengths[e] = static_cast<double>(distanceInDisk(q[k], q[(k + 1) % 3]));
			angles[h[k]] = static_cast<double>(angleInDisk(q[k], q[(k + 1) % 3], q[(k + 2) % 3]));
			if (!p.onOctagon[3 * at(f) + k] || cut.isCut[e])
				continue;
			cut.isCut[e] = 1;
			++cut.edgeCount;
			cut.length += lengths[e];
			// The middle of side i of the octagon is at (i + 1/2) pi / 4.
			const Complex middle = midpoint(q[k], q[(k + 1) % 3]);
			const double turn = static_cast<double>(std::arg(middle) / (kPi / 4));
			const auto side = at((static_cast<int>(std::floor(turn)) + 8) % 4);
			if (!sideHasGenerator[side]) {
				sideHasGenerator[side] = 1;
				cut.generators.push_back(e);
			}
		}
	}
}

IntrinsicMesh BolzaSurface::distorted(const std::function<double(Complex)>& f) const
{
	IntrinsicMesh mesh{triangulation, lengths};
	for (const Edge e : triangulation.edges()) {
		const Halfedge h = e.halfedge();
		mesh.lengths[e] *= std::exp(0.5 * (f(place[h]) + f(place[triangulation.next(h)])));
	}
	return mesh;
}

} // namespace ricci::testing
