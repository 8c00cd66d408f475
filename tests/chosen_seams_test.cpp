// SPDX-License-Identifier: GPL-3.0-or-later
// Seams that the caller chooses, at the façade. Where the surface is developable between its seams, its map is
// known: an isometry.
#include "support/expect.h"
#include "support/written.h"

#include <vcg/complex/algorithms/parametrization/ricci_seams.h>

#include <functional>
#include <map>
#include <set>
#include <type_traits>
#include <utility>

namespace ricci::testing {
namespace {

using Flow = vcg::tri::RicciFlow<DoubleMesh>;
using Seams = vcg::tri::RicciSeams<DoubleMesh>;
using Marks = Flow::SideMarks;
using VertexPairs = std::set<std::pair<int, int>>; // of vertices, the lower first

/// In the mesh's own size, without cones for the sake of areas.
Options withoutCones(OutputTriangulation output = OutputTriangulation::KeepMesh)
{
	Options params = unscaled(output);
	params.cones.distortion = 100.0;
	return params;
}

std::pair<int, int> edge(const Triangle& t, std::size_t k)
{
	return std::minmax({t[k], t[(k + 1) % 3]});
}

using ChosenEdge = std::function<bool(const Point3&, const Point3&)>;

/// The sides of edges between such points.
Marks marksOf(const SurfaceMesh& mesh, const ChosenEdge& isChosen)
{
	Marks marks;
	for (const Triangle& t : mesh.triangles) {
		marks.push_back({0, 0, 0});
		for (std::size_t k = 0; k < 3; ++k)
			marks.back()[k] =
				isChosen(mesh.positions[at(t[k])], mesh.positions[at(t[(k + 1) % 3])]);
	}
	return marks;
}

/// The edges that are marked and have two faces.
VertexPairs insideEdges(const SurfaceMesh& mesh, const Marks& marks)
{
	std::map<std::pair<int, int>, int> faces;
	VertexPairs marked, inside;
	for (std::size_t f = 0; f < mesh.triangles.size(); ++f)
		for (std::size_t k = 0; k < 3; ++k) {
			++faces[edge(mesh.triangles[f], k)];
			if (marks[f][k])
				marked.insert(edge(mesh.triangles[f], k));
		}
	for (const auto& e : marked)
		if (faces[e] > 1)
			inside.insert(e);
	return inside;
}

/// The edges across which the map jumps.
VertexPairs jumps(const SurfaceMesh& mesh, const Flow::Result& r)
{
	DoubleMesh m;
	toVcg(mesh, m);
	Flow::WriteWedgeTexCoord(m, r);
	const Marks marks = Seams::OfTexture(m);
	return marks.empty() ? VertexPairs() : insideEdges(mesh, marks);
}

void expectCounts(const SurfaceMesh& mesh, const VertexPairs& chosen, const Report& report)
{
	double length = 0.0;
	for (const auto& [a, b] : chosen)
		length += distance(mesh.positions[at(a)], mesh.positions[at(b)]);
	EXPECT_EQ(report.chosenSeamEdges, static_cast<int>(chosen.size()));
	EXPECT_NEAR(report.chosenSeamLength, length, 1e-12 * (1.0 + length));
	EXPECT_EQ(report.cutNonmanifoldEdges, 0);
	EXPECT_EQ(report.splitVertices, 0);
	EXPECT_EQ(report.oneSidedComponents, 0);
	EXPECT_EQ(report.degenerateFaces, 0);
}

/// On the half plane in which the sphere's first meridian lies.
bool onMeridian(const Point3& p)
{
	return std::abs(p[1]) < 1e-9 && p[0] > -1e-9;
}

bool onEquator(const Point3& p)
{
	return std::abs(p[2]) < 1e-9;
}

TEST(ChosenSeams, OpenASphereAlongASlit)
{
	const SurfaceMesh mesh = sphere(12, 16);
	const Marks marks = marksOf(mesh, [](const Point3& p, const Point3& q) {
		return onMeridian(p) && onMeridian(q) && std::abs(p[2]) < 0.99 && std::abs(q[2]) < 0.99;
	});
	const VertexPairs chosen = insideEdges(mesh, marks);
	ASSERT_EQ(chosen.size(), 10u);
	for (const OutputTriangulation output : kOutputs) {
		const auto r = compute(mesh, withoutCones(output), marks);
		EXPECT_EQ(r.report.charts, 1);
		EXPECT_EQ(r.report.components, 1);
		EXPECT_EQ(r.report.boundaryLoops, 1);
		EXPECT_EQ(r.report.cones, 0);
		EXPECT_EQ(r.report.seamEdges, 0);
		EXPECT_EQ(r.report.seamLength, 0.0);
		expectCounts(mesh, chosen, r.report);
		expectWritten(mesh, output, r);
		if (output == OutputTriangulation::KeepMesh) {
			EXPECT_EQ(jumps(mesh, r), chosen);
		}
	}
}

/// A box of 1 x 3 x 1, open along all edges of its top but one and along its upright edges.
TEST(ChosenSeams, UnfoldABoxToItsNet)
{
	const SurfaceMesh mesh = perforatedSlab(0, 3);
	Point3 low = mesh.positions.front(), high = low;
	for (const Point3& p : mesh.positions)
		for (std::size_t k = 0; k < 3; ++k) {
			low[k] = std::min(low[k], p[k]);
			high[k] = std::max(high[k], p[k]);
		}
	const auto both = [](const Point3& p, const Point3& q, std::size_t k, double x) {
		return std::abs(p[k] - x) + std::abs(q[k] - x) < 1e-9;
	};
	const Marks marks = marksOf(mesh, [&](const Point3& p, const Point3& q) {
		const bool x0 = both(p, q, 0, low[0]), x1 = both(p, q, 0, high[0]);
		const bool y0 = both(p, q, 1, low[1]), y1 = both(p, q, 1, high[1]);
		const bool top = both(p, q, 2, high[2]);
		return ((x0 || x1) && (y0 || y1)) || (top && (x0 || x1 || y0));
	});
	const VertexPairs chosen = insideEdges(mesh, marks);
	for (const OutputTriangulation output : kOutputs) {
		const auto r = compute(mesh, withoutCones(output), marks);
		EXPECT_EQ(r.report.charts, 1);
		EXPECT_EQ(r.report.cones, 0);
		EXPECT_EQ(r.report.seamEdges, 0);
		expectCounts(mesh, chosen, r.report);
		expectIsometric(mesh, wedgesOf(r), r.report);
		expectWritten(mesh, output, r);
		if (output == OutputTriangulation::KeepMesh) {
			EXPECT_EQ(jumps(mesh, r), chosen);
		}
	}
}

/// The edges of a box have right angles, those of a prism of 12 sides 30 degrees. Faces that are turned over bend no
/// more, and sides inside polygons are none.
TEST(ChosenSeams, AreSharpEdges)
{
	const auto cutAbove = [](const SurfaceMesh& mesh, double degrees, auto options) {
		options.sharpAngle = degrees * kPi / 180.0;
		if constexpr (std::is_same_v<decltype(options), Options>)
			return parametrizeEuclidean(mesh, {}, options);
		else
			return parametrizeHyperbolic(mesh, {}, options);
	};
	const SurfaceMesh box = perforatedSlab(0, 2); // 1 x 3 x 1, edges of length 1/2
	for (const SurfaceMesh& mesh : {box, withReversedFaces(box, 3)})
		for (const double degrees : {1.0, 89.0, 91.0}) {
			const Report r = cutAbove(mesh, degrees, unscaled()).report;
			const bool isCut = degrees < 90.0;
			EXPECT_EQ(r.chosenSeamEdges, isCut ? 40 : 0);
			EXPECT_NEAR(r.chosenSeamLength, isCut ? 20.0 : 0.0, 1e-12);
			if (isCut) {
				EXPECT_EQ(r.charts, 6);
				EXPECT_NEAR(*r.stretch, 4.0, 1e-9);
			}
		}
	const SurfaceMesh prism = revolved({{1.0, 0.0}, {1.0, 1.0}, {1.0, 2.0}}, 12);
	EXPECT_EQ(cutAbove(prism, 29.0, unscaled()).report.charts, 12);
	EXPECT_EQ(cutAbove(prism, 29.0, unscaled()).report.chosenSeamEdges, 24);
	EXPECT_EQ(cutAbove(prism, 31.0, unscaled()).report.chosenSeamEdges, 0);
	EXPECT_EQ(cutAbove(prism, 180.0, unscaled()).report.chosenSeamEdges, 0);
	SurfaceMesh polygons = prism;
	for (const Triangle& t : prism.triangles) { // its long sides are inside polygons
		polygons.diagonal.push_back({0, 0, 0});
		for (std::size_t k = 0; k < 3; ++k) {
			const Point3 side = prism.positions[at(t[(k + 1) % 3])] - prism.positions[at(t[k])];
			polygons.diagonal.back()[k] = std::abs(side[2]) > 0.5 && length(side) < 1.01;
		}
	}
	EXPECT_EQ(cutAbove(polygons, 29.0, unscaled()).report.chosenSeamEdges, 0);
	const SurfaceMesh slab = perforatedSlab(2, 1); // its top and bottom have three boundaries each
	const Report plane = cutAbove(slab, 89.0, Options()).report;
	const Report disk = cutAbove(slab, 89.0, HyperbolicOptions()).report;
	EXPECT_GT(plane.chosenSeamEdges, 0);
	EXPECT_EQ(disk.chosenSeamEdges, plane.chosenSeamEdges);
	EXPECT_EQ(disk.components - disk.leftOutComponents, 2);
}

/// Two sheets at a right angle, one with the points \p left on their common edge, the other with \p right; between
/// them lie faces without area.
SurfaceMesh sheetsWithGap(const std::vector<double>& left, const std::vector<double>& right)
{
	SurfaceMesh mesh{{{0, 0, 0}, {0, 1, 0}, {0, 0.5, 1}, {1, 0.5, 0}}, {}};
	const auto chain = [&](const std::vector<double>& inside) {
		std::vector<int> points{0};
		for (const double y : inside) {
			points.push_back(static_cast<int>(mesh.positions.size()));
			mesh.positions.push_back({0, y, 0});
		}
		points.push_back(1);
		return points;
	};
	const std::vector<int> p = chain(left), q = chain(right);
	for (std::size_t i = 0; i + 1 < p.size(); ++i)
		mesh.triangles.push_back({2, p[i + 1], p[i]});
	for (std::size_t j = 0; j + 1 < q.size(); ++j)
		mesh.triangles.push_back({q[j], q[j + 1], 3});
	mesh.triangles.push_back({0, p[1], q[1]});
	for (std::size_t i = 1, j = 1; i + 1 < p.size() || j + 1 < q.size();) {
		const bool isLast = i + 2 == p.size() && j + 2 == q.size();
		const bool isLeft = j + 1 == q.size() || isLast ||
							(i + 2 < p.size() && left[i] < (j + 2 < q.size() ? right[j] : 1.0));
		if (isLeft)
			mesh.triangles.push_back({p[i], p[i + 1], q[j]});
		else
			mesh.triangles.push_back({p[i], q[j + 1], q[j]});
		if (mesh.triangles.back()[1] == mesh.triangles.back()[2])
			mesh.triangles.pop_back();
		i += isLeft;
		j += !isLeft || isLast;
	}
	return mesh;
}

/// The edge passes the faces without area along one of their sides.
TEST(ChosenSeams, AreSharpEdgesBesideFacesWithoutArea)
{
	Options options = unscaled();
	for (const auto& [left, right] :
		 std::vector<std::pair<std::vector<double>, std::vector<double>>>{
			 {{0.5}, {}},
			 {{0.2, 0.3, 0.6, 0.9}, {}},
			 {{0.5}, {0.5}},
			 {{0.25, 0.75}, {0.5}},
			 {{0.1, 0.5, 0.7}, {0.3, 0.5, 0.6, 0.9}}}) {
		const SurfaceMesh gap = sheetsWithGap(left, right);
		ASSERT_EQ(gap.triangles.size(), 2 * (left.size() + right.size() + 1));
		for (const SurfaceMesh& mesh : {gap, withReversedFaces(gap, 2), withReversedFaces(gap, 3)})
			for (const double degrees : {89.0, 91.0}) {
				options.sharpAngle = degrees * kPi / 180.0;
				const Report r = parametrizeEuclidean(mesh, {}, options).report;
				EXPECT_EQ(r.charts, degrees < 90.0 ? 2 : 1);
				EXPECT_NEAR(r.chosenSeamLength, degrees < 90.0 ? 1.0 : 0.0, 1e-15);
			}
	}
}

TEST(ChosenSeams, OpenATorusAlongAHandleAndATunnelLoop)
{
	constexpr int kAround = 12, kAcross = 8;
	const SurfaceMesh mesh = torus(3.0, 1.0, kAround, kAcross);
	const Marks marks = marksOf(mesh, [](const Point3& p, const Point3& q) {
		return (onMeridian(p) && onMeridian(q)) ||
			   (std::hypot(p[0], p[1]) > 3.99 && std::hypot(q[0], q[1]) > 3.99);
	});
	const VertexPairs chosen = insideEdges(mesh, marks);
	ASSERT_EQ(chosen.size(), std::size_t(kAround + kAcross));
	const auto r = compute(mesh, withoutCones(), marks);
	EXPECT_EQ(r.report.charts, 1);
	EXPECT_EQ(r.report.genus, 0);
	EXPECT_EQ(r.report.boundaryLoops, 1);
	EXPECT_EQ(r.report.seamEdges, 0);
	expectCounts(mesh, chosen, r.report);
	EXPECT_EQ(jumps(mesh, r), chosen);
}

/// The flow keeps the lengths along the seam, so that both halves come out at one scale.
TEST(ChosenSeams, DivideASphereAlongItsEquator)
{
	const SurfaceMesh mesh = sphere(12, 16);
	const Marks marks = marksOf(
		mesh, [](const Point3& p, const Point3& q) { return onEquator(p) && onEquator(q); });
	const VertexPairs chosen = insideEdges(mesh, marks);
	Options params = withoutCones();
	params.finish = Finish::None;
	const auto r = compute(mesh, params, marks);
	EXPECT_EQ(r.report.components, 2);
	EXPECT_EQ(r.report.charts, 2);
	expectCounts(mesh, chosen, r.report);
	EXPECT_EQ(jumps(mesh, r), chosen);
	for (std::size_t f = 0; f < mesh.triangles.size(); ++f)
		for (std::size_t k = 0; k < 3; ++k)
			if (const auto e = edge(mesh.triangles[f], k); chosen.count(e) > 0) {
				EXPECT_NEAR(
					sideLength(wedgesOf(r)[f], k),
					distance(mesh.positions[at(e.first)], mesh.positions[at(e.second)]),
					1e-6);
			}
	params.target = TargetCurvature::Disk; // each piece is one
	EXPECT_EQ(compute(mesh, params, marks).report.charts, 2);
}

/// Corners on a seam have two places each: the four of a cylinder that is slit from end to end.
TEST(ChosenSeams, MakeARectangleOfACylinder)
{
	constexpr int kAround = 12, kUp = 7;
	const SurfaceMesh mesh =
		grid(kAround, kUp, Ends::Joined, Ends::Open, [](int i, int j) -> Point3 {
			const double a = 2 * kPi * i / kAround;
			return {std::cos(a), std::sin(a), 0.6 * j};
		});
	const Marks marks = marksOf(
		mesh, [](const Point3& p, const Point3& q) { return onMeridian(p) && onMeridian(q); });
	DoubleMesh m;
	toVcg(mesh, m);
	for (auto& v : m.vert)
		if (onMeridian({v.P()[0], v.P()[1], v.P()[2]}) &&
			(v.P()[2] < 0.1 || v.P()[2] > 0.6 * kUp - 0.1))
			v.SetS();
	Options params = withoutCones();
	params.target = TargetCurvature::Rectangle;
	const auto r = Flow::Compute(m, params, marks);
	const double perimeter = 2 * kAround * std::sin(kPi / kAround);
	ASSERT_TRUE(r.report.rectangleAspect.has_value());
	EXPECT_NEAR(*r.report.rectangleAspect, perimeter / (0.6 * kUp), 1e-9);
	expectCounts(mesh, insideEdges(mesh, marks), r.report);
	// Uncut it is not a disk.
	EXPECT_EQ(
		refusalOf<InvalidOption>([&] { Flow::Compute(m, params); }).problem,
		InvalidOption::NotADisk);
}

/// Both sides of a single edge have its two vertices: its seam is extended along the next edge.
TEST(ChosenSeams, OfOneEdgeGoOnAlongAnother)
{
	const SurfaceMesh mesh = sphere(12, 16);
	const Marks marks = marksOf(mesh, [](const Point3& p, const Point3& q) {
		return onMeridian(p) && onMeridian(q) && std::abs(p[2]) < 0.3 && std::abs(q[2]) < 0.3 &&
			   p[2] + q[2] > 0.1;
	});
	const VertexPairs chosen = insideEdges(mesh, marks);
	ASSERT_EQ(chosen.size(), 1u);
	const auto r = compute(mesh, withoutCones(), marks);
	EXPECT_EQ(r.report.charts, 1);
	EXPECT_EQ(r.report.boundaryLoops, 1);
	expectCounts(mesh, chosen, r.report);
	EXPECT_EQ(r.report.seamEdges, 1);
	EXPECT_NEAR(r.report.seamLength, 2 * std::sin(kPi / 24), 1e-9);
	const VertexPairs cut = jumps(mesh, r);
	EXPECT_TRUE(std::includes(cut.begin(), cut.end(), chosen.begin(), chosen.end()));
	for (const auto& [a, b] : cut) // straight on
		EXPECT_TRUE(onMeridian(mesh.positions[at(a)]) && onMeridian(mesh.positions[at(b)]));
	EXPECT_EQ(cut.size(), 2u);
}

/// Slits are never capped, nor is a hole that one of them touches.
TEST(ChosenSeams, AreNoHoles)
{
	const auto vertex = [](int i, int j) { return i * 13 + j; };
	const SurfaceMesh mesh =
		withoutStars(rectangle(16, 12, 16.0, 12.0), {vertex(3, 3), vertex(10, 8)});
	Options params = withoutCones();
	params.holes = Holes::Capped;
	const auto count = [&](double low, double high) {
		const Marks marks = marksOf(mesh, [=](const Point3& p, const Point3& q) {
			return p[1] == 8.0 && q[1] == 8.0 && std::min(p[0], q[0]) >= low &&
				   std::max(p[0], q[0]) <= high;
		});
		const auto r = compute(mesh, params, marks);
		expectIsometric(mesh, wedgesOf(r), r.report);
		return r.report.cappedHoles;
	};
	EXPECT_EQ(count(20.0, 20.0), 2); // none
	EXPECT_EQ(count(3.0, 7.0), 2);
	EXPECT_EQ(count(3.0, 9.0), 1); // from one of the holes
	EXPECT_EQ(count(0.0, 9.0), 1); // from there to the border
	// A slit twice as long as the border leaves this open, and no hole is left out in a piece cut off.
	const Marks piece = marksOf(mesh, [](const Point3& p, const Point3& q) {
		const auto on = [](const Point3& r) {
			return std::max(std::abs(r[0] - 3.0), std::abs(r[1] - 3.0)) == 2.0;
		};
		return on(p) && on(q) && (p[0] == q[0] || p[1] == q[1]);
	});
	const auto r = compute(mesh, params, piece);
	EXPECT_EQ(r.report.components, 2);
	EXPECT_EQ(r.report.cappedHoles, 2);
	expectIsometric(mesh, wedgesOf(r), r.report);
}

TEST(ChosenSeams, DividePiecesOfHyperbolicSurfaces)
{
	const SurfaceMesh mesh = perforatedSlab(2, 2);
	double middle = 0.0;
	for (const Point3& p : mesh.positions)
		middle = std::max(middle, 0.5 * p[0]);
	const Marks marks = marksOf(mesh, [&](const Point3& p, const Point3& q) {
		return std::abs(p[0] - middle) + std::abs(q[0] - middle) < 1e-9;
	});
	const VertexPairs chosen = insideEdges(mesh, marks);
	for (const OutputTriangulation output : kOutputs) {
		Flow::HyperbolicParams params;
		params.output = output;
		DoubleMesh m;
		toVcg(mesh, m);
		const auto r = Flow::ComputeHyperbolic(m, params, marks);
		EXPECT_EQ(r.report.components, 2);
		EXPECT_EQ(r.report.genus, 2);
		EXPECT_EQ(r.report.boundaryLoops, 2);
		EXPECT_EQ(r.charts.size(), 2u);
		expectCounts(mesh, chosen, r.report);
		// Two tori with a geodesic for a border.
		EXPECT_NEAR(r.report.hyperbolicArea.value_or(0.0), 4 * kPi, 1e-6);
		if (output == OutputTriangulation::KeepMesh) {
			const VertexPairs cut = jumps(mesh, r);
			EXPECT_TRUE(std::includes(cut.begin(), cut.end(), chosen.begin(), chosen.end()));
		}
		expectWritten(mesh, output, r);
	}
}

/// A seam through an edge of more than two faces divides all its sheets, and is not counted as what had to be
/// cut.
TEST(ChosenSeams, DivideEverySheet)
{
	const SurfaceMesh mesh = book(4, 3);
	const Marks none(mesh.triangles.size(), {0, 0, 0});
	const Marks spine = marksOf(mesh, [](const Point3& p, const Point3& q) {
		return std::hypot(p[0], p[1]) + std::hypot(q[0], q[1]) < 1e-9;
	});
	const auto whole = compute(mesh, withoutCones(), none),
			   divided = compute(mesh, withoutCones(), spine);
	EXPECT_EQ(whole.report.charts, 2);
	EXPECT_EQ(whole.report.chosenSeamEdges, 0);
	EXPECT_EQ(divided.report.charts, 4);
	EXPECT_EQ(divided.report.chosenSeamEdges, 3);
	EXPECT_NEAR(
		divided.report.chosenSeamLength, 2.0 * 3.0, 1e-12); // two pairs of sheets are parted
	EXPECT_EQ(divided.report.cutNonmanifoldEdges, whole.report.cutNonmanifoldEdges);
	EXPECT_EQ(divided.report.splitVertices, whole.report.splitVertices);
	expectIsometric(mesh, wedgesOf(divided), divided.report);
}

/// A Moebius band that is cut across needs no other cut.
TEST(ChosenSeams, MakeAMoebiusBandTwoSided)
{
	const SurfaceMesh mesh = moebiusBand(20);
	const auto across = marksOf(mesh, [&](const Point3& p, const Point3& q) {
		return std::abs(p[1]) < 1e-9 && std::abs(q[1]) < 1e-9 && p[0] > 0.0 && q[0] > 0.0;
	});
	const auto r = compute(mesh, withoutCones(), across);
	EXPECT_EQ(r.report.chosenSeamEdges, 1);
	EXPECT_EQ(r.report.oneSidedComponents, 0);
	EXPECT_EQ(r.report.splitVertices, 0);
	EXPECT_EQ(r.report.charts, 1);
}

TEST(ChosenSeams, AreFoundInTheTexture)
{
	const SurfaceMesh mesh = rectangle(2, 1, 2.0, 1.0);
	DoubleMesh m;
	toVcg(mesh, m);
	EXPECT_TRUE(Seams::OfTexture(m).empty());
	const auto edges = [&] { return insideEdges(mesh, Seams::OfTexture(m)); };
	for (auto& f : m.face)
		for (int k = 0; k < 3; ++k) {
			f.WT(k).U() = float(f.P(k)[0]);
			f.WT(k).V() = float(f.P(k)[1]);
		}
	EXPECT_TRUE(Seams::OfTexture(m).empty());
	for (auto& f : m.face) // at two ends of an edge, at one, and for an index
		f.WT(0).N() = f.WT(1).N() = f.WT(2).N() = short(vcg::tri::Index(m, f) >= 2);
	EXPECT_EQ(edges().size(), 1u);
	const VertexPairs byIndex = edges();
	for (auto& f : m.face)
		for (int k = 0; k < 3; ++k)
			f.WT(k).N() = 0;
	for (int k = 0; k < 3; ++k)
		m.face[0].WT(k).V() += 1e-6f; // of coordinates from 0 to 2: what rounding does to them
	EXPECT_TRUE(Seams::OfTexture(m).empty());
	for (int k = 0; k < 3; ++k)
		m.face[0].WT(k).V() += 1.0f;
	EXPECT_FALSE(edges().empty());
	for (const auto& e : byIndex)
		EXPECT_EQ(
			edges().count(e),
			std::count_if(mesh.triangles[0].begin(), mesh.triangles[0].end(), [&](int v) {
				return v == e.first || v == e.second;
			}) == 2);
}

TEST(ChosenSeams, AreThoseSelected)
{
	const SurfaceMesh mesh = sphere(6, 8);
	DoubleMesh m;
	toVcg(mesh, m);
	EXPECT_TRUE(Seams::OfSelectedEdges(m).empty());
	EXPECT_TRUE(Seams::OfSelectedFaces(m).empty());
	m.face[5].SetFaceEdgeS(2);
	EXPECT_EQ(
		insideEdges(mesh, Seams::OfSelectedEdges(m)), VertexPairs{edge(mesh.triangles[5], 2)});
	m.face[5].SetS();
	VertexPairs border;
	for (std::size_t k = 0; k < 3; ++k)
		border.insert(edge(mesh.triangles[5], k));
	EXPECT_EQ(insideEdges(mesh, Seams::OfSelectedFaces(m)), border);
	for (auto& f : m.face)
		f.SetS();
	EXPECT_TRUE(Seams::OfSelectedFaces(m).empty());
	// Deleted faces and damaged ones have no seams.
	m.face[5].ClearS();
	vcg::tri::Allocator<DoubleMesh>::DeleteFace(m, m.face[5]);
	m.face[6].V(0) = nullptr;
	EXPECT_TRUE(Seams::OfSelectedFaces(m).empty());
	EXPECT_TRUE(Seams::OfSelectedEdges(m).empty());
}

/// What was cut once is cut again where the mesh is mapped again along its texture seams.
TEST(ChosenSeams, KeepTheSeamsOfAMap)
{
	for (const SurfaceMesh& mesh : {sphere(12, 16), torus(3.0, 1.0, 14, 9), perforatedSlab(2, 2)}) {
		DoubleMesh m;
		toVcg(mesh, m);
		Flow::WriteWedgeTexCoord(m, Flow::Compute(m, {}));
		const Marks marks = Seams::OfTexture(m);
		const VertexPairs before = insideEdges(mesh, marks);
		ASSERT_FALSE(before.empty());
		const auto r = Flow::Compute(m, {}, marks);
		expectCounts(mesh, before, r.report);
		const VertexPairs after = jumps(mesh, r);
		EXPECT_TRUE(std::includes(after.begin(), after.end(), before.begin(), before.end()));
		const auto kept = Flow::Compute(m, {}, Marks(), Flow::ReadMap(m));
		expectCounts(mesh, before, kept.report);
		EXPECT_EQ(jumps(mesh, kept), before);
		EXPECT_EQ(kept.report.seamEdges + kept.report.overlapCuts, 0);
		Options asGiven;
		asGiven.charts = Charts::AsGiven;
		const auto packed = Flow::Compute(m, asGiven, Marks(), Flow::ReadMap(m));
		EXPECT_EQ(jumps(mesh, packed), before);
		EXPECT_EQ(packed.report.charts, kept.report.charts);
	}
}

} // namespace
} // namespace ricci::testing
