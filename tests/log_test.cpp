// SPDX-License-Identifier: GPL-3.0-or-later
// What a run says of itself, line by line: the log, the notes and the choice of Automatic, with the numbers that
// the report has.
#include "support/calls.h"
#include "support/flat_map.h"
#include "support/listener.h"
#include "support/random_surface.h"
#include "support/shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <regex>

namespace ricci::testing {
namespace {

std::string text(const char* format, double x)
{
	char buffer[64];
	std::snprintf(buffer, sizeof buffer, format, x);
	return buffer;
}
std::string three(double x)
{
	return text("%.3g", x);
}

/// Whether \p line is \p pattern, in which # stands for any number, * for any text.
bool matches(const std::string& line, const std::string& pattern)
{
	std::string regex;
	for (const char c : pattern)
		if (c == '#')
			regex += "[-+.e0-9]+";
		else if (c == '*')
			regex += ".*";
		else if (std::isalnum(static_cast<unsigned char>(c)) || c == ' ')
			regex += c;
		else
			regex += std::string("\\") + c;
	return std::regex_match(line, std::regex(regex));
}

/// What the words in braces of a line stand for, of what the call gives; numbers with three digits.
class Lines
{
public:
	Lines(const SurfaceMesh& mesh, const Parametrization& map) : m_mesh(mesh), m_map(map) {}

	/// The lines that \p line stands for: "{newton}" and "{newton} again" for all states of the flow.
	std::vector<std::string> of(std::string line) const
	{
		const std::string steps = "{newton}";
		if (line.rfind(steps, 0) == 0)
			return newton(line.substr(std::min(line.size(), steps.size() + 1)));
		const Report& r = m_map.report;
		const std::pair<const char*, std::string> words[] = {
			{"{component}",
			 "Component of " + std::to_string(m_mesh.positions.size()) + " vertices, " +
				 std::to_string(m_mesh.triangles.size()) + " faces:"},
			{"{cones}", cones()},
			{"{boundary}",
			 "Free boundary: in the map its edges are " + three(r.boundaryRatioMin.value_or(-1)) +
				 " to " + three(r.boundaryRatioMax.value_or(-1)) +
				 " times as long as on the mesh."},
			// Of the map that was taken.
			{"{cost}",
			 "energy " + three(r.stretch.value_or(-1)) + ", seams " + three(r.seamLengthRelative) +
				 " (objective " + three(r.objective.value_or(-1)) + ")"},
			{"{expected}", kExpected},
			{"{spread}", three(r.expectedSpread.value_or(-1))},
			{"{lengthened}", three(r.lengthened)},
			{"{error}", three(r.maxCurvatureError)},
			{"{floor}", three(r.residualFloor)},
			{"{unequal}", std::to_string(r.unequalSeams)}};
		for (const auto& [word, text] : words)
			if (const std::size_t place = line.find(word); place != std::string::npos)
				line.replace(place, std::string(word).size(), text);
		return {line};
	}

private:
	static constexpr const char* kExpected =
		"expected energy #, seams # (in units of the square root of the area), area distortion";

	/// The cones that were placed, by their numbers in the mesh.
	std::string cones() const
	{
		std::vector<int> cones = m_map.placedCones;
		std::sort(cones.begin(), cones.end());
		std::string list;
		for (const int v : cones)
			list += (list.empty() ? " " : ", ") + std::to_string(v) + " (" +
					text("%.9g", m_map.targetCurvature[at(v)] / kPi) + ")";
		return std::to_string(cones.size()) + " cones placed: " + kExpected + " " +
			   three(m_map.report.expectedSpread.value_or(-1)) +
			   " (spread); vertex (curvature / pi):" + list + ".";
	}

	/// Every state of the flow, and \p again before a step that another solve begins with; without it, what
	/// is known of the step already is not said again.
	std::vector<std::string> newton(const std::string& again) const
	{
		std::vector<std::string> lines;
		const std::vector<FlowState>& states = m_map.report.flowStates;
		for (std::size_t i = 0; i < states.size(); ++i) {
			if (i > 0 && states[i].step == states[i - 1].step) {
				if (again.empty())
					continue;
				lines.push_back(again);
			}
			lines.push_back(
				"Newton step " + std::to_string(states[i].step) +
				": max |target - K| = " + text("%.3e", states[i].residual));
		}
		return lines;
	}

	const SurfaceMesh& m_mesh;
	const Parametrization& m_map;
};

/// A call, its log and its choice.
struct Log : Call
{
	std::vector<std::string>
		expected; ///< patterns with words for Lines; of "?count:" only if there are some
	std::string choice;
};

std::vector<Log> logs()
{
	const auto target = [&](TargetCurvature t) { return with([=](Options& o) { o.target = t; }); };
	Random random(90);
	const SurfaceMesh donut = bumpyTorus(14, 9, random);
	const SurfaceMesh handles = shaken(perforatedSlab(2, 2), 0.06, random);
	const SurfaceMesh tube = shaken(sphereWithTube(0.2, 4, 0.4, 16, 16), 0.004, random);
	const SurfaceMesh plate = stretched(perforatedSlab(0, 4), {1, 1, 0.1});
	SurfaceMesh sheet = randomPlanarDisk(6, random);
	for (Point3& p : sheet.positions)
		p[2] = 0.3 * std::sin(4 * p[0]) * std::cos(3 * p[1]);
	VertexInput bent;
	bent.targetCurvature = {-3, 0, 0, 0, 0, 0, 0, 0};
	const std::string disk = "{component} a disk.";
	const std::string sphere = "{component} a closed surface of genus 0 (a sphere).";
	const std::string torus = "{component} a closed surface of genus 1 (a torus).";
	const std::string genus2 = "{component} a closed surface of genus 2.";
	const std::string free = "Free boundary: the flow keeps the boundary's metric.";
	const std::string noCones = "No cones: {expected} {spread} (spread).";
	const std::string withoutThem = "Cones: without them {expected} # (spread).";
	const std::string noBoundary =
		"The target prescribes the boundary: the option of a free boundary has no effect.";
	const std::string isSphere =
		"a closed surface of genus 0 (a sphere) has no flat metric without them";
	const std::string onDouble =
		"{newton} Another solve, on the double of the surface: on the surface alone, the boundary "
		"bends.";
	const std::string both = // before a chart is cut for packing
		"cones, because " + isSphere +
		"; as a whole: energy 4, seams # (objective #); cut along creases and unfolded: energy 4, "
		"seams # (objective #)";
	const std::string spreadAlone =
		"no cones, because without them areas are expected to spread by # alone";
	const Options separate = with([](Options& o) { o.charts = Charts::WithoutOverlap; });
	return {
		{{"Torus", donut, separate},
		 {torus,
		  withoutThem,
		  "{cones}",
		  "{newton}",
		  "Automatic: cones, which are expected to lower the objective from # to #; as a whole: "
		  "{cost}; cut along creases and unfolded: energy #, seams # (objective #)."},
		 "cones, which are expected to lower the objective from # to #; as a whole: energy #, "
		 "seams # (objective #); cut along creases and unfolded: energy #, seams # (objective #)"},
		{{"FixedTriangles", donut, with([](Options& o) { o.method = Method::FixedTriangles; })},
		 {torus, "{newton}"},
		 "no cones, because only the method 'Intrinsic flips' places them to keep areas"},
		{{"FlatSheet", rectangle(4, 4, 1, 1), Options()},
		 {disk, free, noCones, "{newton}"},
		 spreadAlone},
		{{"AreasMaySpread", tube, with([](Options& o) { o.cones.distortion = 1e9; })},
		 {disk,
		  free,
		  noCones,
		  "{newton}",
		  "?ended The finish stopped at its step limit: the map could still be slightly better.",
		  "{boundary}",
		  "?unequal {unequal} seam edges are longer on one side than on the other: flipped faces "
		  "next to them were repaired."},
		 spreadAlone},
		{{"AreasAreKept", tube, with([](Options& o) { o.cones.distortion = 0.2; })},
		 {disk, withoutThem, "{cones}", free, "{newton}", "{boundary}"},
		 "cones, because without them areas would spread by #, more than allowed"},
		{{"Unfolded", plate, separate},
		 {sphere,
		  "Cones: " + isSphere + ".",
		  "# cones placed: {expected} # (spread); vertex (curvature / pi): *.",
		  "Automatic: cut along creases and unfolded: {cost}; as a whole: energy #, seams # "
		  "(objective #)."},
		 "cut along creases and unfolded: energy 4, seams # (objective #); as a whole: energy #, "
		 "seams # (objective #)"},
		{{"Box", perforatedSlab(0, 2), Options()},
		 {sphere, "Cones: " + isSphere + ".", "{cones}", "{newton}", "Automatic: " + both + "."},
		 both},
		{{"RoundDisk", sheet, target(TargetCurvature::Disk)},
		 {disk,
		  noBoundary,
		  "{newton} Solve # for the circle: its angles are updated to the present lengths of the "
		  "boundary."},
		 ""},
		{{"Rectangle", sheet, with([](Options& o) {
			  o.target = TargetCurvature::Rectangle;
			  o.finish = Finish::LeastStretch;
		  })},
		 {disk,
		  "No vertices are selected: the corners are the boundary vertices nearest to the corners "
		  "of the smallest rectangle around the boundary.",
		  noBoundary,
		  "{newton}",
		  "The boundary or the turns across seams are prescribed: the finish is least distortion "
		  "instead of least stretch."},
		 ""},
		{{"ConesOnTheBoundary",
		  sheet,
		  target(TargetCurvature::SelectedCones),
		  selecting(sheet, {0, 3, 48})},
		 {disk,
		  "3 cones of curvature 2.0943951 each.", // 2 pi / 3
		  "Cones lie on the boundary, which is therefore prescribed: the option of a free boundary "
		  "has no effect.",
		  onDouble},
		 ""},
		{{"PrescribedBoundary",
		  withoutStars(testing::torus(3, 1, 16, 12), {0, 50, 100}),
		  with([](Options& o) { o.freeBoundary = false; })},
		 {"{component} a surface of genus 1 with 3 boundary loops.",
		  "The boundary is prescribed: its curvature is proportional to its length.",
		  onDouble},
		 "no cones, because of the topology and the requested boundary"},
		{{"QuarterTurns", handles, with([](Options& o) {
			  o.target = TargetCurvature::PlacedCones;
			  o.cones.rounding = ConeRounding::QuarterTurns;
		  })},
		 {genus2,
		  "{cones}",
		  "{newton}",
		  "The rotations across seams are up to # from a multiple of a quarter turn, and # once "
		  "the metric has changed."},
		 ""},
		{{"EdgeSwaps",
		  fanWithGap(100),
		  with([](Options& o) {
			  o.target = TargetCurvature::Prescribed;
			  o.method = Method::EdgeSwaps;
		  }),
		  bent},
		 {disk, free, "{newton} 1 boundary edges split; the flow starts again.", "{boundary}"},
		 ""},
		{{"Needles", withFlatTail(rectangle(6, 6, 0.5, 1), 47, 48, 100.0), with([](Options& o) {
			  o.target = TargetCurvature::PlacedCones;
			  o.cones.count = 1;
			  o.epsilon = 1e-17;
		  })},
		 {disk,
		  "{cones}",
		  free,
		  "{newton}",
		  "Some faces have no area, or one side a million times shorter than another: the solver "
		  "lengthened the edges at 1 of the vertices, by up to {lengthened} of their new length.",
		  "The requested accuracy is beyond rounding: the curvature is within {error} of its "
		  "target (rounding floor {floor})."},
		 ""},
		{{"HyperbolicCones",
		  handles,
		  inDisk([](HyperbolicOptions& o) {
			  o.target = HyperbolicTarget::SelectedCones;
			  o.coneAngle = 1.0;
		  }),
		  selecting(handles, {3, 30})},
		 {genus2, "2 cones of angle 57.2957795 degrees each.", "{newton}"},
		 ""},
		{{"HyperbolicFreeBoundary", sheet, inDisk([](HyperbolicOptions& o) {
			  o.freeBoundary = true;
		  })},
		 {disk,
		  "Free boundary: the boundary's circles keep their radii, at the scale at which the mesh "
		  "has the area 6.28318531.", // 2 pi
		  "{newton}"},
		 ""},
		{{"WideDisk", perforatedSlab(16, 2), inDisk([](HyperbolicOptions& o) {
			  o.canonicalGenerators = true;
		  })},
		 {"{component} a closed surface of genus 16.",
		  "{newton}",
		  "The short seams reach # out in the disk, too far for floats. Longer seams around the "
		  "centre reach # out.",
		  "There are no canonical generators: they would move points farther than floating-point "
		  "numbers can resolve."},
		 ""}};
}

class Logs : public ::testing::TestWithParam<Log>
{
};

TEST_P(Logs, SayWhatWasDone)
{
	const Log& log = GetParam();
	Listener listener;
	const Parametrization map = withListener(listener, [&] { return outcomeOf(log).map; });
	std::vector<std::string> expected;
	for (std::string line : log.expected) {
		for (const auto& [word, count] :
			 {std::pair("?ended ", map.report.endedEarly),
			  std::pair("?unequal ", map.report.unequalSeams)})
			if (line.rfind(word, 0) == 0)
				line = count > 0 ? line.substr(std::string(word).size()) : "";
		if (line.empty())
			continue;
		const std::vector<std::string> lines = Lines(log.mesh, map).of(line);
		expected.insert(expected.end(), lines.begin(), lines.end());
	}
	std::vector<std::string> lines = listener.lines;
	const auto isStep = [](const std::string& line) { return line.rfind("Newton step", 0) == 0; };
	if (std::none_of(expected.begin(), expected.end(), isStep)) // of a map that was not taken
		lines.erase(std::remove_if(lines.begin(), lines.end(), isStep), lines.end());
	for (std::size_t i = 0; i < std::max(expected.size(), lines.size()); ++i) {
		const std::string line = i < lines.size() ? lines[i] : "nothing";
		const std::string pattern = i < expected.size() ? expected[i] : "nothing";
		EXPECT_TRUE(matches(line, pattern)) << line << "\nis not\n" << pattern;
	}
	EXPECT_TRUE(matches(map.report.choice, log.choice)) << map.report.choice;
	EXPECT_EQ(listener.count("boundary edges split"), map.report.boundarySplits);
	if (listener.count("no canonical generators") > 0) {
		EXPECT_FALSE(map.charts[0].group.isCanonical());
	}
	// Notes are the lines on what was chosen.
	std::size_t next = 0;
	for (const std::string& line : listener.lines)
		next += next < map.notes.size() && line == map.notes[next];
	EXPECT_EQ(next, map.notes.size());
}

INSTANTIATE_TEST_SUITE_P(Calls, Logs, ::testing::ValuesIn(logs()), CallName());

/// All that can be wrong with a mesh, in numbers of one and of more.
TEST(Logs, SayWhatWasDoneToTheMesh)
{
	SurfaceMesh mesh = book(3, 3);
	mesh.triangles.push_back(mesh.triangles[0]);
	mesh.triangles.push_back({5, 5, 5});
	mesh.positions.push_back({9, 9, 9});
	mesh = sideBySide(mesh, moebiusBand(9), 10);
	mesh = sideBySide(mesh, withReversedFaces(rectangle(3, 3, 1, 1), 9), 20);
	mesh.seam.assign(mesh.triangles.size(), {0, 0, 0});
	mesh.seam[mesh.triangles.size() - 10] = {1, 0, 0};
	const auto notesOf = [](const SurfaceMesh& surface) {
		Listener listener;
		const Parametrization map =
			withListener(listener, [&] { return parametrizeEuclidean(surface, {}, {}); });
		EXPECT_TRUE(std::equal(map.notes.begin(), map.notes.begin() + 9, listener.lines.begin()));
		const Report& r = map.report;
		const auto expectCount = [&](std::size_t i, int count) {
			EXPECT_EQ(std::stoi(map.notes[i]), count) << map.notes[i];
		};
		expectCount(2, r.duplicateFaces);
		expectCount(3, r.cutNonmanifoldEdges);
		expectCount(4, r.chosenSeamEdges);
		expectCount(5, r.seamEdges);
		expectCount(6, r.oneSidedComponents);
		expectCount(7, r.splitVertices);
		expectCount(8, r.degenerateFaces);
		return std::vector<std::string>(map.notes.begin(), map.notes.begin() + 9);
	};
	const std::vector<std::string> once{
		"1 vertex belongs to no face and is left out.",
		"2 faces were turned over for the map: inverted winding (inconsistent normals).",
		"1 face duplicates another and is a separate sheet.",
		"6 edges with more than two faces were cut: the sheets continue where they are smoothest.",
		"1 edge is a chosen seam.",
		"1 seam of a single edge was extended by another edge, because a single edge does not "
		"open.",
		"1 one-sided component was cut along short one-sided loops.",
		"8 vertices have more than one triangle fan, each with its own place in the map.",
		"1 face has no area and is drawn as a line or a point."};
	const std::vector<std::string> twice{
		"2 vertices belong to no face and are left out.",
		"4 faces were turned over for the map: inverted winding (inconsistent normals).",
		"2 faces duplicate others and are separate sheets.",
		"12 edges with more than two faces were cut: the sheets continue where they are smoothest.",
		"2 edges are chosen seams.",
		"2 seams of a single edge were extended by another edge, because a single edge does not "
		"open.",
		"2 one-sided components were cut along short one-sided loops.",
		"16 vertices have more than one triangle fan, each with its own place in the map.",
		"2 faces have no area and are drawn as lines or points."};
	EXPECT_EQ(notesOf(mesh), once);
	SurfaceMesh both = sideBySide(mesh, mesh, 50);
	both.seam = mesh.seam;
	both.seam.insert(both.seam.end(), mesh.seam.begin(), mesh.seam.end());
	EXPECT_EQ(notesOf(both), twice);
}

/// Of many components the largest are described, in their order, and each with its own states of the flow.
TEST(Logs, AreOfTheLargestComponents)
{
	const SurfaceMesh large = torus(2, 1, 9, 6);
	SurfaceMesh mesh = rectangle(1, 1, 1, 1);
	for (int i = 1; i < 24; ++i)
		mesh = sideBySide(mesh, rectangle(1, 1, 1.0 + 0.01 * i, 1), 3.0 * i); // no copies
	const auto notesOf = [](const SurfaceMesh& surface) {
		return parametrizeEuclidean(surface, {}, Options()).notes;
	};
	const std::size_t small = notesOf(rectangle(1, 1, 1, 1)).size();
	ASSERT_GT(small, 0u);
	Listener listener;
	const Parametrization map = withListener(
		listener, [&] { return parametrizeEuclidean(sideBySide(mesh, large, 100), {}, {}); });
	const std::vector<std::string> alone = notesOf(large);
	ASSERT_EQ(map.notes.size(), 19 * small + alone.size());
	EXPECT_EQ(map.notes[19 * small], alone.front());
	EXPECT_EQ(listener.count("Component of 4 vertices, 2 faces: a disk."), 19);
	EXPECT_EQ(listener.count("Component of 54 vertices, 108 faces"), 1);
	EXPECT_EQ(listener.lines.back(), "The log leaves out the smaller ones of 25 components.");
	int component = 0;
	for (const FlowState& state : map.report.flowStates) {
		EXPECT_TRUE(state.component == component || state.component == component + 1);
		component = state.component;
	}
	EXPECT_EQ(component, 24);
}

} // namespace
} // namespace ricci::testing
