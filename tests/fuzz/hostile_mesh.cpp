// SPDX-License-Identifier: GPL-3.0-or-later
#include "hostile_mesh.h"

#include "support/shapes.h"

#include <ricci/base/graphs.h>
#include <ricci/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <utility>

namespace ricci::testing {

namespace {

using Limits = std::numeric_limits<double>;

/// Faces of any vertices.
SurfaceMesh soup(ByteSource& bytes)
{
	SurfaceMesh mesh;
	const int vertices = bytes.below(12), faces = bytes.below(20);
	for (int v = 0; v < vertices; ++v)
		mesh.positions.push_back(randomPoint(bytes));
	for (int f = 0; f < faces && vertices > 0; ++f)
		mesh.triangles.push_back(
			{bytes.below(vertices), bytes.below(vertices), bytes.below(vertices)});
	return mesh;
}

/// Sheet, tube or torus.
SurfaceMesh patch(ByteSource& bytes)
{
	const int nu = 1 + bytes.below(7), nv = 1 + bytes.below(7);
	const Ends u = bytes.below(2) ? Ends::Joined : Ends::Open;
	const Ends v = bytes.below(2) ? Ends::Joined : Ends::Open;
	const double bump = bytes.below(3) * 0.2;
	const bool round = bytes.below(4) != 0;
	return grid(nu, nv, u, v, [&](int i, int j) {
		Point3 p{double(i), double(j), 0.0};
		if (round && (u == Ends::Joined || v == Ends::Joined)) {
			const double a = 2 * kPi * i / nu, b = 2 * kPi * j / nv;
			const double r = v == Ends::Joined ? 3.0 + std::cos(b) : 1.0 + j;
			p = {r * std::cos(a), r * std::sin(a), v == Ends::Joined ? std::sin(b) : 0.0};
			if (u == Ends::Open)
				p = {std::cos(b), std::sin(b), double(i)};
		}
		for (double& x : p)
			x += bump > 0.0 ? bytes.real(-bump, bump) : 0.0;
		return p;
	});
}

/// A star round one vertex, open, closed, or with a second centre.
SurfaceMesh star(ByteSource& bytes)
{
	// A fan makes as many crossings as its valence squared.
	const bool large = bytes.oneIn(256) && bytes.oneIn(4);
	const int n = !large            ? 2 + bytes.below(40)
				  : bytes.oneIn(64) ? 2000 + bytes.below(2000)
									: 200 + bytes.below(200);
	const int kind = bytes.below(3);
	SurfaceMesh mesh;
	mesh.positions.push_back({0, 0, 1});
	for (int i = 0; i < n; ++i)
		mesh.positions.push_back({std::cos(2 * kPi * i / n), std::sin(2 * kPi * i / n), 0});
	for (int i = 0; i + (kind == 0 ? 1 : 0) < n; ++i)
		mesh.triangles.push_back({0, 1 + i, 1 + (i + 1) % n});
	if (kind == 2) {
		mesh.positions.push_back({0, 0, bytes.real(-2, 2)});
		for (int i = 0; i < n; ++i)
			mesh.triangles.push_back({n + 1, 1 + (i + 1) % n, 1 + i});
	}
	return mesh;
}

/// A sphere made by putting vertices into faces of a tetrahedron.
SurfaceMesh stackedSphere(ByteSource& bytes)
{
	SurfaceMesh mesh = tetrahedron();
	const int added = bytes.below(24);
	for (int i = 0; i < added; ++i) {
		const auto f = at(bytes.below(faceCount(mesh)));
		const Triangle t = mesh.triangles[f];
		const int v = vertexCount(mesh);
		Point3 p{0, 0, 0};
		for (std::size_t k = 0; k < 3; ++k)
			for (int corner : t)
				p[k] += mesh.positions[at(corner)][k] / 3;
		const double out = bytes.real(0.5, 2.0);
		for (double& x : p)
			x *= out;
		mesh.positions.push_back(p);
		mesh.triangles[f] = {t[0], t[1], v};
		mesh.triangles.push_back({t[1], t[2], v});
		mesh.triangles.push_back({t[2], t[0], v});
	}
	return mesh;
}

/// Triangles whose sides are glued in random pairs, subdivided until every face has three vertices:
/// any topology, orientable or not.
SurfaceMesh gluedAtRandom(ByteSource& bytes)
{
	const int n = 1 + bytes.below(5);
	DisjointSets corners(3 * n);
	const auto corner = [&](int side, int end) { return 3 * (side / 3) + (side % 3 + end) % 3; };
	std::vector<int> free(at(3 * n)), mate(at(3 * n), -1);
	std::iota(free.begin(), free.end(), 0);
	std::vector<char> twisted(at(3 * n), 0);
	const int pairs = bytes.below(3 * n / 2 + 1);
	const bool mayTwist = bytes.oneIn(4);
	for (int i = 0; i < pairs; ++i) {
		int side[2];
		for (int& s : side) {
			const auto k = bytes.below(static_cast<int>(free.size()));
			s = free[at(k)];
			free.erase(free.begin() + k);
		}
		const bool twist = mayTwist && bytes.oneIn(2);
		for (int end : {0, 1})
			corners.merge(corner(side[0], end), corner(side[1], twist ? end : 1 - end));
		mate[at(side[0])] = side[1];
		mate[at(side[1])] = side[0];
		twisted[at(side[0])] = twisted[at(side[1])] = twist;
	}
	// Each triangle in 9 pieces of side 1/3; sides that are glued share their inner vertices.
	SurfaceMesh mesh;
	std::vector<int> vertexOf(at(3 * n), -1);
	std::vector<std::array<int, 2>> onSide(at(3 * n), {-1, -1});
	const auto add = [&] {
		mesh.positions.push_back(randomPoint(bytes));
		return vertexCount(mesh) - 1;
	};
	for (int s = 0; s < 3 * n; ++s) {
		if (int& v = vertexOf[at(corners.find(s))]; v < 0)
			v = add();
		if (onSide[at(s)][0] >= 0)
			continue;
		onSide[at(s)] = {add(), add()};
		const int m = mate[at(s)];
		if (m >= 0)
			onSide[at(m)] = twisted[at(s)] ? onSide[at(s)]
										   : std::array<int, 2>{onSide[at(s)][1], onSide[at(s)][0]};
	}
	for (int f = 0; f < n; ++f) {
		const int middle = add();
		std::array<int, 9> rim;
		for (int k = 0; k < 3; ++k) {
			rim[at(3 * k)] = vertexOf[at(corners.find(3 * f + k))];
			rim[at(3 * k + 1)] = onSide[at(3 * f + k)][0];
			rim[at(3 * k + 2)] = onSide[at(3 * f + k)][1];
		}
		for (std::size_t k = 0; k < 9; ++k) {
			// In turns 2, 2, 2 ... would leave long sides between rim vertices; a second ring keeps
			// the result free of double edges.
			const int a = rim[k], b = rim[(k + 1) % 9];
			const int inner = add();
			mesh.triangles.push_back({a, b, inner});
			mesh.triangles.push_back({b, middle, inner});
			mesh.triangles.push_back({middle, a, inner});
		}
	}
	return mesh;
}

SurfaceMesh oneShape(ByteSource& bytes)
{
	switch (bytes.below(9)) {
	case 0:
		return soup(bytes);
	case 1:
	case 2:
		return patch(bytes);
	case 3:
		return star(bytes);
	case 4:
		return stackedSphere(bytes);
	case 5:
		return gluedAtRandom(bytes);
	case 6:
		return perforatedSlab(bytes.below(3), 1);
	case 7:
		return moebiusBand(3 + bytes.below(5));
	default: {
		SurfaceMesh mesh; // 0 to 3 faces
		const int faces = bytes.below(4);
		for (int v = 0; v < 5; ++v)
			mesh.positions.push_back(randomPoint(bytes));
		for (int f = 0; f < faces; ++f)
			mesh.triangles.push_back({f, f + 1, f + 2});
		return mesh;
	}
	}
}

SurfaceMesh shape(ByteSource& bytes)
{
	SurfaceMesh mesh = oneShape(bytes);
	if (bytes.oneIn(4)) {
		const int more = 1 + bytes.below(4);
		for (int i = 0; i < more; ++i)
			mesh = sideBySide(mesh, oneShape(bytes), 10.0 * i);
	}
	if (bytes.oneIn(32)) { // crumbs
		const int crumbs = bytes.oneIn(256) && bytes.oneIn(32) ? 10000 : bytes.below(60);
		for (int i = 0; i < crumbs; ++i) {
			const int v = vertexCount(mesh);
			for (int k = 0; k < 3; ++k)
				mesh.positions.push_back(randomPoint(bytes));
			mesh.triangles.push_back({v, v + 1, v + 2});
		}
	}
	return mesh;
}

/// A coordinate that breaks careless arithmetic.
double awkward(ByteSource& bytes)
{
	static const double values[] = {
		0.0,
		-0.0,
		1e-45,
		1e-40,
		1e-38,
		1e38,
		3.4028234663852886e38,
		-3.4028234663852886e38,
		Limits::denorm_min(),
		Limits::min(),
		1e-300,
		1e-160,
		1e-150,
		1e150,
		1e160,
		1e300,
		Limits::max(),
		-Limits::max(),
		Limits::infinity(),
		-Limits::infinity(),
		Limits::quiet_NaN(),
		Limits::epsilon(),
		1.0 + Limits::epsilon(),
		1e7,
		1e-7};
	return values[bytes.below(static_cast<int>(std::size(values)))];
}

void changeCoordinates(SurfaceMesh& mesh, ByteSource& bytes)
{
	const int n = vertexCount(mesh);
	const auto v = at(bytes.below(n)), w = at(bytes.below(n));
	const auto k = at(bytes.below(3));
	switch (bytes.below(7)) {
	case 0:
		mesh.positions[v][k] = bytes.oneIn(4) ? awkward(bytes) : bytes.real(-4, 4);
		break;
	case 1:
		mesh.positions[v] = mesh.positions[w];
		break;
	case 2: // middle of an edge
		mesh.positions[v] = 0.5 * (mesh.positions[v] + mesh.positions[w]);
		break;
	case 3: { // flat, or nearly
		const double factor = bytes.oneIn(2) ? 0.0 : std::pow(10.0, -bytes.below(40));
		for (Point3& p : mesh.positions)
			p[k] *= factor;
		break;
	}
	case 4: { // huge or tiny
		const double factor =
			std::pow(10.0, bytes.oneIn(4) ? bytes.below(640) - 320 : bytes.below(80) - 40);
		for (Point3& p : mesh.positions)
			for (double& x : p)
				x *= factor;
		break;
	}
	case 5: { // far from the origin
		const double shift = std::pow(10.0, bytes.below(20));
		for (Point3& p : mesh.positions)
			p[k] += shift;
		break;
	}
	default: { // slivers
		const double factor = std::pow(10.0, -bytes.below(16));
		for (std::size_t i = v; i < mesh.positions.size(); i += 1 + w)
			for (double& x : mesh.positions[i])
				x *= factor;
		break;
	}
	}
}

void changeFaces(SurfaceMesh& mesh, ByteSource& bytes)
{
	const auto f = at(bytes.below(faceCount(mesh)));
	Triangle& t = mesh.triangles[f];
	switch (bytes.below(7)) {
	case 0:
		std::swap(t[0], t[1]);
		break;
	case 1:
		mesh.triangles.push_back(Triangle(t));
		break;
	case 2:
		t[at(bytes.below(3))] = t[at(bytes.below(3))];
		break;
	case 3:
		t[at(bytes.below(3))] = bytes.below(vertexCount(mesh));
		break;
	case 4:
		mesh.triangles.erase(mesh.triangles.begin() + static_cast<std::ptrdiff_t>(f));
		break;
	case 5: { // two vertices become one
		const int from = bytes.below(vertexCount(mesh)), to = bytes.below(vertexCount(mesh));
		for (Triangle& face : mesh.triangles)
			for (int& v : face)
				v = v == from ? to : v;
		break;
	}
	default:
		mesh.triangles.push_back({t[1], t[0], bytes.below(vertexCount(mesh))});
		break;
	}
}

Options anyOptions(ByteSource& bytes)
{
	static const double epsilons[] = {
		1e-8,
		1e-8,
		1e-8,
		1e-10,
		1e-16,
		1e-3,
		1.0,
		1e300,
		Limits::denorm_min(),
		0.0,
		-1.0,
		Limits::infinity(),
		Limits::quiet_NaN()};
	Options options;
	options.target = static_cast<TargetCurvature>(bytes.below(6));
	options.freeBoundary = bytes.below(2) != 0;
	const bool thurston = bytes.oneIn(5);
	const int other = bytes.below(5);
	options.method = thurston     ? Method::Thurston
					 : other == 0 ? Method::FixedTriangles
					 : other == 1 ? Method::EdgeSwaps
								  : Method::IntrinsicFlips;
	const bool mayRefine = options.method == Method::IntrinsicFlips || bytes.oneIn(32);
	options.output = mayRefine && bytes.below(2) ? OutputTriangulation::CommonRefinement
												 : OutputTriangulation::KeepMesh;
	options.epsilon = epsilons[bytes.oneIn(6) ? bytes.below(13) : 0];
	options.holes = mayRefine && bytes.oneIn(4) ? Holes::Capped : Holes::Boundaries;
	options.charts = bytes.oneIn(4) ? Charts::WithoutOverlap : Charts::OfTheFlow;
	return options;
}

/// Euler characteristic, and the vertices that are in use.
int euler(const SurfaceMesh& mesh, std::vector<int>& used)
{
	std::set<std::pair<int, int>> edges;
	std::set<int> vertices;
	for (const Triangle& t : mesh.triangles)
		for (std::size_t k = 0; k < 3; ++k) {
			vertices.insert(t[k]);
			edges.insert(std::minmax({t[k], t[(k + 1) % 3]}));
		}
	used.assign(vertices.begin(), vertices.end());
	return static_cast<int>(used.size()) - static_cast<int>(edges.size()) + faceCount(mesh);
}

/// Often the curvature of some metric, sometimes anything.
std::vector<double> anyQuality(const SurfaceMesh& mesh, ByteSource& bytes)
{
	std::vector<double> quality(mesh.positions.size(), 0.0);
	std::vector<int> used;
	const double total = 2 * kPi * euler(mesh, used);
	if (used.empty())
		return quality;
	const auto any = [&] { return used[at(bytes.below(static_cast<int>(used.size())))]; };
	const int cones = bytes.oneIn(4) ? static_cast<int>(used.size()) : 1 + bytes.below(6);
	double sum = 0.0;
	for (int i = 0; i < cones; ++i) {
		const int v = any();
		const double K = bytes.oneIn(4) ? bytes.real(-30, 7) : bytes.real(-3, 3);
		quality[at(v)] += K;
		sum += K;
	}
	const int sharers = bytes.oneIn(2) ? 1 + bytes.below(6) : static_cast<int>(used.size());
	for (int i = 0; i < sharers; ++i)
		quality[at(sharers > 6 ? used[at(i)] : any())] += (total - sum) / sharers;
	if (bytes.oneIn(16))
		quality[at(any())] = awkward(bytes);
	return quality;
}

} // namespace

HostileMesh::HostileMesh(ByteSource& bytes)
{
	options = anyOptions(bytes);
	hyperbolic = bytes.oneIn(4);
	if (hyperbolic) {
		static_cast<FlowOptions&>(hyperbolicOptions) = options;
		hyperbolicOptions.target = static_cast<HyperbolicTarget>(bytes.below(3));
		hyperbolicOptions.coneAngle = bytes.oneIn(8) ? awkward(bytes) : bytes.real(-1, 13);
		hyperbolicOptions.freeBoundary = bytes.below(2) != 0;
		hyperbolicOptions.output = options.output;
	}
	normalizeUV = bytes.below(4) != 0;
	doublePrecision = bytes.below(2) != 0;
	mesh = shape(bytes);
	const int changes = bytes.oneIn(2) ? 0 : bytes.below(6);
	for (int i = 0; i < changes; ++i) {
		if (!mesh.positions.empty() && bytes.below(3) != 0)
			changeCoordinates(mesh, bytes);
		else if (!mesh.triangles.empty() && !mesh.positions.empty())
			changeFaces(mesh, bytes);
	}
	if (bytes.oneIn(4)) // vertices that no face uses
		for (int i = bytes.below(4); i > 0; --i)
			mesh.positions.push_back({awkward(bytes), awkward(bytes), awkward(bytes)});
	deletedVertex.assign(mesh.positions.size(), 0);
	deletedFace.assign(mesh.triangles.size(), 0);
	if (bytes.oneIn(4)) {
		for (int i = bytes.below(6); i > 0 && !mesh.triangles.empty(); --i)
			deletedFace[at(bytes.below(faceCount(mesh)))] = 1;
		std::vector<char> used(mesh.positions.size(), 0);
		for (std::size_t f = 0; f < mesh.triangles.size(); ++f)
			for (int v : mesh.triangles[f])
				used[at(v)] |= deletedFace[f] == 0;
		const bool evenInUse = bytes.oneIn(16);
		for (std::size_t v = 0; v < used.size(); ++v)
			deletedVertex[v] = !used[v] || (evenInUse && bytes.oneIn(8));
	}
	selected.assign(mesh.positions.size(), 0);
	const bool selects = hyperbolic ? hyperbolicOptions.target == HyperbolicTarget::SelectedCones
									: options.target == TargetCurvature::SelectedCones ||
										  options.target == TargetCurvature::Rectangle;
	if (selects)
		for (int i = bytes.below(8); i > 0 && !mesh.positions.empty(); --i)
			selected[at(bytes.below(vertexCount(mesh)))] = 1;
	quality.assign(mesh.positions.size(), 0.0);
	if (hyperbolic ? hyperbolicOptions.target == HyperbolicTarget::Prescribed
				   : options.target == TargetCurvature::Prescribed)
		quality = anyQuality(mesh, bytes);
	if (bytes.oneIn(8))
		cancelAt = bytes.below(20);
	drawRarerOptions(bytes);
	if (bytes.below(5) == 0) {
		mend();
		if (bytes.oneIn(2))
			options.target = TargetCurvature::Automatic; // fits every surface
		hyperbolic = hyperbolic && bytes.oneIn(2);
	}
	if (bytes.oneIn(4))
		options.finish = hyperbolicOptions.finish = static_cast<Finish>(bytes.below(3));
	if (bytes.oneIn(2))
		drawAnyTriangles(bytes);
	if (bytes.oneIn(8))
		options.sharpAngle = hyperbolicOptions.sharpAngle =
			bytes.oneIn(16) ? awkward(bytes) : bytes.real(0.0, kPi);
	if (bytes.oneIn(8)) {
		Box2 box;
		for (const Point3& p : mesh.positions)
			box.add(Point2{p[0], p[1]});
		options.tileSide = bytes.oneIn(16) ? awkward(bytes) : bytes.real(0.1, 2.0) * box.extent();
	}
}

/// Another mesh, or a change of this one, behind everything else like the rarer options. Most of them
/// with options that every surface takes.
void HostileMesh::drawAnyTriangles(ByteSource& bytes)
{
	SurfaceMesh base;
	if (bytes.oneIn(4)) {
		for (std::size_t f = 0; f < mesh.triangles.size(); ++f)
			if (!deletedFace[f])
				base.triangles.push_back(mesh.triangles[f]);
		base.positions = mesh.positions;
	}
	else
		base = oneShape(bytes);
	mesh = anyTriangles(base, bytes);
	deletedFace.assign(mesh.triangles.size(), 0);
	deletedVertex.assign(mesh.positions.size(), 0);
	quality.assign(mesh.positions.size(), 0.0);
	selected.resize(mesh.positions.size(), 0);
	if (bytes.oneIn(4) && !mesh.triangles.empty())
		deletedFace[at(bytes.below(faceCount(mesh)))] = 1;
	if (bytes.below(3) != 0) {
		const Finish finish = options.finish;
		options = Options();
		options.finish = finish;
		if (bytes.oneIn(2))
			options.output = OutputTriangulation::CommonRefinement;
		hyperbolic = hyperbolic && bytes.oneIn(4);
	}
	if (!hyperbolic && options.target == TargetCurvature::Prescribed)
		quality = anyQuality(mesh, bytes);
}

/// Drawn behind everything else: an input keeps its mesh whatever is added here.
void HostileMesh::drawRarerOptions(ByteSource& bytes)
{
	const auto number = [&](double low, double high) {
		return bytes.oneIn(16) ? awkward(bytes) : bytes.real(low, high);
	};
	if (bytes.oneIn(8)) {
		options.target = TargetCurvature::PlacedCones;
		options.cones.count = bytes.oneIn(2) ? bytes.below(9) - (bytes.oneIn(16) ? 9 : 0) : 0;
	}
	if (bytes.oneIn(4)) {
		options.cones.distortion = number(0.05, 3.0);
		options.cones.rounding = bytes.oneIn(2) ? ConeRounding::QuarterTurns : ConeRounding::Free;
	}
	if (bytes.oneIn(8))
		options.seamHiding = number(0.0, 1.0);
	if (bytes.oneIn(8))
		chartMargin = number(0.0, 0.25);
	if (bytes.oneIn(64))
		memoryLimit = awkward(bytes);
	sphere = bytes.oneIn(16);
	rings = bytes.below(3);
	if (bytes.oneIn(8))
		options.charts = Charts::CutForPacking;
	if (bytes.oneIn(8)) {
		seamEvery = 1 + bytes.below(50);
		seamSeed = bytes.byte();
	}
}

/// Takes the cheapest reasons for a refusal away, so that more inputs come as far as the flow.
void HostileMesh::mend()
{
	if (hyperbolicOptions.method == Method::EdgeSwaps)
		hyperbolicOptions.method = Method::IntrinsicFlips;
	if (hyperbolicOptions.method == Method::Thurston)
		hyperbolicOptions.method = Method::FixedTriangles;
	for (FlowOptions* flow :
		 {static_cast<FlowOptions*>(&options), static_cast<FlowOptions*>(&hyperbolicOptions)}) {
		if (!(flow->epsilon > 0.0))
			flow->epsilon = 1e-8;
	}
	for (Point3& p : mesh.positions)
		for (double& x : p)
			if (!std::isfinite(x))
				x = 0.0;
	// Each directed side once, no face twice: an oriented surface except for its vertices, which take a
	// copy for every fan.
	std::map<std::pair<int, int>, int> cornerAt;
	for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
		const Triangle& t = mesh.triangles[f];
		bool kept = !deletedFace[f] && t[0] != t[1] && t[1] != t[2] && t[2] != t[0];
		for (std::size_t k = 0; k < 3; ++k)
			kept = kept && cornerAt.count({t[k], t[(k + 1) % 3]}) == 0;
		const auto opposite = cornerAt.find({t[1], t[0]});
		if (kept && opposite != cornerAt.end())
			kept = mesh.triangles[at(opposite->second / 3)][at((opposite->second + 2) % 3)] != t[2];
		deletedFace[f] = !kept;
		for (std::size_t k = 0; k < 3 && kept; ++k)
			cornerAt[{t[k], t[(k + 1) % 3]}] = static_cast<int>(3 * f + k);
	}
	const SurfaceMesh old = mesh;
	std::vector<char> done(3 * old.triangles.size(), 0), taken(old.positions.size(), 0);
	for (std::size_t first = 0; first < done.size(); ++first) {
		if (deletedFace[first / 3] || done[first])
			continue;
		const int v = old.triangles[first / 3][first % 3];
		int own = v;
		if (taken[at(v)]) {
			own = vertexCount(mesh);
			mesh.positions.push_back(old.positions[at(v)]);
			selected.push_back(selected[at(v)]);
			quality.push_back(0.0);
			deletedVertex.push_back(0);
		}
		taken[at(v)] = 1;
		deletedVertex[at(own)] = 0;
		// Round the vertex both ways, over the side that leaves it and the one that arrives.
		for (bool leaving : {true, false})
			for (std::size_t corner = first;;) {
				done[corner] = 1;
				mesh.triangles[corner / 3][corner % 3] = own;
				const Triangle& t = old.triangles[corner / 3];
				const std::size_t k = corner % 3;
				const auto next = cornerAt.find(
					leaving ? std::make_pair(t[(k + 1) % 3], t[k])
							: std::make_pair(t[k], t[(k + 2) % 3]));
				if (next == cornerAt.end())
					break;
				const auto c = static_cast<std::size_t>(next->second);
				corner = leaving ? c - c % 3 + (c + 1) % 3 : c;
				if (done[corner])
					break;
			}
	}
}

} // namespace ricci::testing
