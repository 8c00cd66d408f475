// SPDX-License-Identifier: GPL-3.0-or-later
#include "bridge/error_sentences.h"
#include "bridge/parameters.h"

#include <ricci/base/numbers.h>

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>

namespace filter_ricci {
namespace {

/// The table names the defaults of the algorithm's options.
TEST(Parameters, HaveTheDefaultsOfTheAlgorithm)
{
	const Settings plane = readSettings(filterParameters(Euclidean));
	const ricci::Options options;
	EXPECT_EQ(plane.flow.target, options.target);
	EXPECT_EQ(plane.flow.cones.count, options.cones.count);
	EXPECT_EQ(plane.flow.cones.distortion, options.cones.distortion);
	EXPECT_EQ(plane.flow.cones.rounding, options.cones.rounding);
	EXPECT_EQ(plane.flow.freeBoundary, options.freeBoundary);
	EXPECT_EQ(plane.flow.epsilon, options.epsilon);
	EXPECT_EQ(plane.flow.method, options.method);
	EXPECT_EQ(plane.flow.output, options.output);
	EXPECT_EQ(plane.flow.finish, options.finish);
	EXPECT_EQ(plane.flow.normalizeUV, options.normalizeUV);
	EXPECT_EQ(plane.flow.chartMargin, options.chartMargin);
	EXPECT_EQ(plane.flow.seamHiding, options.seamHiding);
	EXPECT_EQ(plane.flow.holes, options.holes);
	EXPECT_EQ(plane.flow.charts, options.charts);
	EXPECT_EQ(plane.texture.size, TextureSettings().size);
	const HyperbolicSettings disk = readHyperbolicSettings(filterParameters(Hyperbolic));
	const ricci::HyperbolicOptions hyperbolic;
	EXPECT_EQ(disk.flow.target, hyperbolic.target);
	EXPECT_NEAR(disk.flow.coneAngle, hyperbolic.coneAngle, 1e-15);
	EXPECT_EQ(disk.flow.freeBoundary, hyperbolic.freeBoundary);
	EXPECT_EQ(disk.flow.epsilon, hyperbolic.epsilon);
	EXPECT_EQ(disk.flow.method, hyperbolic.method);
	EXPECT_EQ(disk.flow.finish, ricci::Finish::Repair);
	for (const RunSettings& run :
		 {static_cast<const RunSettings&>(plane), static_cast<const RunSettings&>(disk)}) {
		EXPECT_EQ(run.seams, Seams::Shortest);
		EXPECT_FALSE(run.colorize || run.flatLayer);
		EXPECT_EQ(run.timeLimit, 0.0);
		EXPECT_EQ(run.report + run.texture.file, "");
	}
	EXPECT_FALSE(plane.sphereLayer || disk.axes || disk.canonicalPolygon);
	EXPECT_EQ(disk.coverRings, 0);
}

/// A parameter of both filters is one, except for what few runs of one of them need.
TEST(Parameters, AreReadFromTheirTable)
{
	for (const int filter : {Euclidean, Hyperbolic})
		for (const Parameter& p : filterParameters(filter)) {
			SCOPED_TRACE(p.name);
			EXPECT_FALSE(p.label.empty() || p.tooltip.empty());
			EXPECT_EQ(p.tooltip.find('\n'), std::string::npos);
			EXPECT_EQ(p.tooltip.find("  "), std::string::npos);
			EXPECT_EQ(p.files.empty(), !std::holds_alternative<std::string>(p.value));
			EXPECT_EQ(p.label.front() == ' ' || p.label.back() == ' ', false);
			if (!p.choices.empty()) {
				EXPECT_LT(std::get<int>(p.value), static_cast<int>(p.choices.size()));
			}
		}
	EXPECT_EQ(findParameter(filterParameters(Euclidean), "cone_angle"), nullptr);
	const Parameter& seams = *findParameter(filterParameters(Hyperbolic), "seams");
	EXPECT_TRUE(seams.isAdvanced);
	EXPECT_EQ(seams.choices, findParameter(filterParameters(Euclidean), "seams")->choices);
}

TEST(Parameters, TakeTexts)
{
	const auto read = [](const char* name, const std::string& text) {
		Parameter p = *findParameter(filterParameters(Euclidean), name);
		return std::pair(setFromText(p, text), p.value);
	};
	using Value = Parameter::Value;
	const std::pair<std::string, Value> expected[] = {
		{"", 2},
		{"", 2},
		{"", -3},
		{"", true},
		{"", false},
		{"", 12},
		{"", 0.125},
		{"", std::string(" a ")}};
	EXPECT_EQ(read("finish", "LEAST distortion"), expected[0]);
	EXPECT_EQ(read("finish", "2"), expected[1]);
	EXPECT_EQ(read("finish", "-3"), expected[2]); // the range is looked at later
	EXPECT_EQ(read("colorize", "True"), expected[3]);
	EXPECT_EQ(read("colorize", "0"), expected[4]);
	EXPECT_EQ(read("cone_count", "12"), expected[5]);
	EXPECT_EQ(read("chart_margin", "1.25e-1"), expected[6]);
	EXPECT_EQ(read("report", " a "), expected[7]);
	EXPECT_TRUE(std::isnan(std::get<double>(read("epsilon", "NaN").second)));
	EXPECT_EQ(std::get<double>(read("epsilon", "-inf").second), -ricci::kInfinity);
	for (const auto& [name, text] :
		 {std::pair("finish", "best"),
		  std::pair("colorize", "2"),
		  std::pair("cone_count", "1.0"),
		  std::pair("cone_count", ""),
		  std::pair("chart_margin", "0,1"),
		  std::pair("chart_margin", "1 2")}) {
		const std::string sentence = read(name, text).first;
		EXPECT_EQ(sentence.rfind("{" + std::string(name) + "} must be ", 0), 0u) << sentence;
		EXPECT_NE(sentence.find(", not '" + std::string(text) + "'."), std::string::npos);
	}
}

} // namespace
} // namespace filter_ricci
