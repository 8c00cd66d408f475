// SPDX-License-Identifier: GPL-3.0-or-later
#include "bridge/error_sentences.h"
#include "bridge/parameters.h"

#include <ricci/base/numbers.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <iterator>
#include <sstream>
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
	EXPECT_EQ(plane.flow.chartMargin, 0.0); // it depends on the texture
	EXPECT_EQ(plane.padding, 2);
	EXPECT_EQ(plane.flow.sharpAngle, options.sharpAngle);
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
	EXPECT_EQ(seams.choices, findParameter(filterParameters(Euclidean), "seams")->choices);
}

TEST(Parameters, TakeTexts)
{
	const auto read = [](const char* name, const std::string& text) {
		Parameter p = *findParameter(filterParameters(Euclidean), name);
		return std::pair(setFromText(p, text), p.value);
	};
	const struct
	{
		const char *name, *text;
		Parameter::Value value;
	} cases[] = {
		{"finish", "LEAST distortion", 2},
		{"finish", "2", 2},
		{"finish", "-3", -3}, // the range is looked at later
		{"colorize", "True", true},
		{"colorize", "0", false},
		{"cone_count", "12", 12},
		{"cone_distortion", "1.25e-1", 0.125},
		{"report", " a ", std::string(" a ")}};
	for (const auto& c : cases)
		EXPECT_EQ(read(c.name, c.text), std::pair(std::string(), c.value)) << c.text;
	EXPECT_TRUE(std::isnan(std::get<double>(read("epsilon", "NaN").second)));
	EXPECT_EQ(std::get<double>(read("epsilon", "-inf").second), -ricci::kInfinity);
	for (const auto& [name, text] :
		 {std::pair("finish", "best"),
		  std::pair("colorize", "2"),
		  std::pair("cone_count", "1.0"),
		  std::pair("cone_count", ""),
		  std::pair("cone_distortion", "0,1"),
		  std::pair("cone_distortion", "1 2")}) {
		const std::string sentence = read(name, text).first;
		EXPECT_EQ(sentence.rfind("{" + std::string(name) + "} must be ", 0), 0u) << sentence;
		EXPECT_NE(sentence.find(", not '" + std::string(text) + "'."), std::string::npos);
	}
}

/// What a call refuses, as a sentence.
template<class Call>
std::string refusal(const Call& call)
{
	try {
		call();
	}
	catch (const Refusal& e) {
		return e.what();
	}
	return "";
}

/// Dialogs have at most 16 parameters. Each of the table is one of them or named by the last one, and can be set so.
TEST(Parameters, AreFewInDialogs)
{
	for (const int filter : {Euclidean, Hyperbolic}) {
		const Parameters dialog = dialogParameters(filter);
		EXPECT_LE(dialog.size(), 16u);
		EXPECT_EQ(dialog.back().name, "options");
		for (const Parameter& p : filterParameters(filter)) {
			const bool isOption = p.place == Place::Options;
			EXPECT_EQ(findParameter(dialog, p.name) == nullptr, isOption);
			EXPECT_EQ(dialog.back().tooltip.find(" " + p.name) != std::string::npos, isOption);
			for (const std::string& text : {p.tooltip, dialog.back().tooltip}) {
				std::istringstream words(text);
				const std::istream_iterator<std::string> begin(words), end;
				EXPECT_LE(std::distance(begin, end), 25) << text;
			}
		}
	}
}

TEST(Parameters, AreReadFromOptions)
{
	Parameters parameters = filterParameters(Euclidean);
	setOptions(
		Euclidean,
		parameters,
		" cone_count = 3;; report=a b=1.html ;cone_rounding=multiples of PI/2; ");
	setOptions(Euclidean, parameters, "");
	EXPECT_EQ(valueOf<int>(parameters, "cone_count"), 3);
	EXPECT_EQ(valueOf<int>(parameters, "cone_rounding"), 1);
	EXPECT_EQ(valueOf<std::string>(parameters, "report"), "a b=1.html");
	for (const auto& [text, sentence] :
		 {std::pair("cone_count=many", "{cone_count} must be a whole number, not 'many'."),
		  std::pair("report=a.html;b", "The filter has no parameter 'b': it is one of"),
		  std::pair("Cone_count=3", "The filter has no parameter 'Cone_count': it is one of"),
		  std::pair("flat_layer=true", "'flat_layer': it is layers='Flat mesh' now."),
		  std::pair("time_limit", "{time_limit} has no value: "),
		  std::pair("padding=4", "{padding} is a parameter of its own")}) {
		const std::string found = refusal([&text = text] {
			Parameters other = filterParameters(Euclidean);
			setOptions(Euclidean, other, text);
		});
		EXPECT_NE(found.find(sentence), std::string::npos) << found;
	}
	// The hyperbolic filter has always had flat_layer, and never the others.
	for (const auto& [old, now] : renamedParameters(Euclidean))
		EXPECT_EQ(
			noSuchParameter(Hyperbolic, old),
			"The filter has no parameter '" + old + "'" +
				noSuchParameter(Hyperbolic, "other")
					.substr(std::strlen("The filter has no parameter 'other'")));
}

/// A quarter of the texture at most.
TEST(Parameters, PaddingFitsIntoTheTexture)
{
	const auto read = [](int padding, int size) {
		Parameters parameters = filterParameters(Euclidean);
		findParameter(parameters, "padding")->value = padding;
		findParameter(parameters, "texture_size")->value = size;
		return refusal([&] { readSettings(parameters); });
	};
	EXPECT_EQ(read(512, 2048) + read(4, 16) + read(0, 0) + read(512, 0), "");
	for (const auto& [padding, size] :
		 {std::pair(513, 2048), std::pair(-1, 2048), std::pair(5, 16), std::pair(513, 0)})
		EXPECT_EQ(
			read(padding, size),
			"The value " + std::to_string(padding) + " of {padding} cannot be used. Use 0 to " +
				std::to_string((size > 0 ? size : 2048) / 4) +
				" pixels, a quarter of {texture_size}.");
}

} // namespace
} // namespace filter_ricci
