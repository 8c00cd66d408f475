// SPDX-License-Identifier: GPL-3.0-or-later
// The library through its C interface alone: what it gives is what the façade gives, and whatever is asked for, the
// answer is a code and a sentence.
#include "support/decimal_commas.h"
#include "support/failing_malloc.h"
#include "support/random_surface.h"
#include "support/shapes.h"
#include "support/vcg_mesh.h"

#include <ricci_c.h>

#include <vcg/complex/algorithms/parametrization/ricci_flow.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <memory>
#include <regex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace ricci::testing {
namespace {

template<class T>
constexpr int32_t typeOf()
{
	if constexpr (std::is_same_v<T, double>)
		return RICCI_FLOAT64;
	else if constexpr (std::is_same_v<T, float>)
		return RICCI_FLOAT32;
	else if constexpr (std::is_same_v<T, int64_t>)
		return RICCI_INT64;
	else if constexpr (std::is_same_v<T, int32_t>)
		return RICCI_INT32;
	else if constexpr (std::is_same_v<T, uint16_t>)
		return RICCI_UINT16;
	else
		return RICCI_UINT8;
}

template<class T>
ricci_array arrayOf(const std::vector<T>& entries, const std::vector<std::size_t>& shape)
{
	ricci_array array{typeOf<T>(), static_cast<int32_t>(shape.size()), {0, 0, 0}, entries.data()};
	std::transform(shape.begin(), shape.end(), array.shape, [](std::size_t n) {
		return static_cast<int64_t>(n);
	});
	return array;
}

/// A run, whose calls are to succeed.
class CRun
{
public:
	explicit CRun(int32_t filter = RICCI_EUCLIDEAN) : m_run(ricci_create(filter), ricci_free) {}
	explicit CRun(const SurfaceMesh& mesh, int32_t filter = RICCI_EUCLIDEAN) : CRun(filter)
	{
		std::vector<double> positions;
		for (const Point3& p : mesh.positions)
			positions.insert(positions.end(), p.begin(), p.end());
		std::vector<int32_t> corners;
		for (const Triangle& t : mesh.triangles)
			corners.insert(corners.end(), t.begin(), t.end());
		set("vertices", positions, {mesh.positions.size(), 3});
		set("faces", corners, {mesh.triangles.size(), 3});
	}

	ricci_run* get() const { return m_run.get(); }
	operator ricci_run*() const { return m_run.get(); }

	std::string message() const { return ricci_message(get()); }

	template<class T>
	CRun&
	set(const char* name, const std::vector<T>& entries, const std::vector<std::size_t>& shape)
	{
		const ricci_array array = arrayOf(entries, shape);
		EXPECT_EQ(ricci_set_array(get(), name, &array), RICCI_OK) << message();
		return *this;
	}

	CRun& with(const char* name, const char* value)
	{
		EXPECT_EQ(ricci_set_parameter(get(), name, value), RICCI_OK) << message();
		return *this;
	}

	CRun& execute()
	{
		EXPECT_EQ(ricci_execute(get()), RICCI_OK) << message();
		EXPECT_EQ(message(), "");
		return *this;
	}

	bool has(const std::string& name) const
	{
		ricci_array array;
		return ricci_output(get(), name.c_str(), &array) == RICCI_OK;
	}

	ricci_array shapeOf(const std::string& name) const
	{
		ricci_array array{-1, 1, {0, 0, 0}, nullptr};
		EXPECT_EQ(ricci_output(get(), name.c_str(), &array), RICCI_OK) << name;
		return array;
	}

	template<class T>
	std::vector<T> output(const std::string& name) const
	{
		const ricci_array array = shapeOf(name);
		std::size_t count = 1;
		for (int32_t k = 0; k < array.dimensions; ++k)
			count *= static_cast<std::size_t>(array.shape[k]);
		EXPECT_EQ(array.type == RICCI_BOOL ? RICCI_UINT8 : array.type, typeOf<T>()) << name;
		const T* const data = static_cast<const T*>(array.data);
		return std::vector<T>(data, data + count);
	}

	template<class T>
	T result(const std::string& key) const
	{
		EXPECT_EQ(shapeOf("results." + key).dimensions, 0);
		return output<T>("results." + key).at(0);
	}

	/// All bytes of all outputs, with their names.
	std::string everything() const
	{
		std::string all;
		for (int64_t i = 0; i < ricci_output_count(get()); ++i) {
			const std::string name = ricci_output_name(get(), i);
			const ricci_array array = shapeOf(name);
			std::size_t bytes = std::array<std::size_t, 7>{1, 1, 2, 4, 8, 4, 8}.at(
				static_cast<std::size_t>(array.type));
			for (int32_t k = 0; k < array.dimensions; ++k)
				bytes *= static_cast<std::size_t>(array.shape[k]);
			all += name + std::string(static_cast<const char*>(array.data), bytes);
		}
		return all;
	}

private:
	std::unique_ptr<ricci_run, void (*)(ricci_run*)> m_run;
};

SurfaceMesh slab()
{
	return perforatedSlab(2, 2);
}

TEST(Library, SaysWhatItIs)
{
	EXPECT_EQ(ricci_c_version(), RICCI_C_VERSION);
	EXPECT_TRUE(std::regex_match(ricci_library_version(), std::regex("\\d+\\.\\d+\\.\\d+")));
	EXPECT_TRUE(std::regex_match(ricci_solver(), std::regex("CHOLMOD.*|Eigen.*")))
		<< ricci_solver();
	const std::string all = ricci_description();
	for (const char* words :
		 {"\"python_name\":\"compute_texcoord_parametrization_ricci_flow_euclidean_per_wedge\"",
		  "\"name\":\"epsilon\"",
		  "\"type\":\"float\",\"default\":1e-08",
		  "\"type\":\"enum\",\"default\":\"Hyperbolic metric\",\"choices\":[\"Hyperbolic metric\",",
		  "\"type\":\"file\",\"default\":\"\",\"files\":\"PNG image (*.png)\"",
		  "Poincaré"})
		EXPECT_NE(all.find(words), std::string::npos) << words;
	// As JSON has it: brackets in pairs outside of texts, and nothing behind the last one.
	int depth = 0;
	bool isText = false;
	for (std::size_t i = 0; i < all.size(); ++i) {
		if (isText && all[i] == '\\')
			++i;
		else if (all[i] == '"')
			isText = !isText;
		else if (!isText)
			depth += all[i] == '[' || all[i] == '{' ? 1 : all[i] == ']' || all[i] == '}' ? -1 : 0;
		EXPECT_EQ(depth == 0, i + 1 == all.size());
	}
	EXPECT_FALSE(isText);
}

TEST(Library, GivesWhatTheFacadeGives)
{
	using Flow = vcg::tri::RicciFlow<DoubleMesh>;
	const SurfaceMesh mesh = torus(2.0, 0.7, 24, 12);
	DoubleMesh m;
	toVcg(mesh, m);
	Flow::Params params;
	params.chartMargin = 2.0 / 2048.0;
	const Flow::Result map = Flow::Compute(m, params);
	Flow::WriteVertexQuality(m, map);
	Flow::WriteWedgeTexCoord(m, map);
	CRun run(mesh);
	run.execute();
	const auto uv = run.output<double>("uv");
	ASSERT_EQ(uv.size(), 6 * m.face.size());
	for (std::size_t i = 0; i < uv.size(); ++i) {
		const auto& at = m.face[i / 6].cWT(static_cast<int>(i / 2 % 3));
		EXPECT_EQ(uv[i], static_cast<double>(i % 2 == 0 ? at.u() : at.v())) << i;
	}
	const auto quality = run.output<double>("quality"), u = run.output<double>("log_radius"),
			   curvature = run.output<double>("target_curvature");
	for (std::size_t v = 0; v < m.vert.size(); ++v) {
		EXPECT_EQ(quality.at(v), map.vertexQC[v]);
		EXPECT_EQ(u.at(v), map.u[v]);
		EXPECT_EQ(curvature.at(v), map.targetCurvature[v]);
	}
	const auto chart = run.output<int32_t>("chart");
	for (int f = 0; f < map.mesh.size(); ++f)
		EXPECT_EQ(chart.at(static_cast<std::size_t>(map.mesh.face[f])), map.mesh.chart[f]);
	EXPECT_EQ(run.result<int32_t>("charts"), map.report.charts);
	EXPECT_EQ(run.result<double>("objective"), map.report.objective.value());
	EXPECT_EQ(run.output<uint8_t>("results.converged"), std::vector<uint8_t>{1});
	const auto vertices = run.output<double>("vertices");
	for (std::size_t i = 0; i < vertices.size(); ++i)
		EXPECT_EQ(vertices[i], mesh.positions[i / 3][i % 3]);
}

TEST(Library, TakesNumbersOfAnyType)
{
	const SurfaceMesh mesh = rectangle(3, 2, 1.5, 1);
	std::vector<float> positions;
	for (const Point3& p : mesh.positions)
		for (const double x : p)
			positions.push_back(static_cast<float>(x));
	std::vector<int64_t> corners;
	for (const Triangle& t : mesh.triangles)
		corners.insert(corners.end(), t.begin(), t.end());
	CRun run;
	run.set("vertices", positions, {mesh.positions.size(), 3});
	run.set("faces", corners, {mesh.triangles.size(), 3});
	EXPECT_EQ(run.execute().everything(), CRun(mesh).execute().everything());
}

/// Two triangles whose sides lie on each other, joined where they are of one part.
TEST(Library, TellsPartsByAnyNumbers)
{
	const std::vector<double> positions{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
	const std::vector<int32_t> corners{0, 1, 2, 3, 4, 5};
	for (const int64_t first : {int64_t(-7), int64_t(3000000000)})
		for (const int64_t second : {first, int64_t(5000000000)}) {
			CRun run;
			run.set("vertices", positions, {6, 3}).set("faces", corners, {2, 3});
			run.set("part", std::vector<int64_t>{first, first, first, second, second, second}, {6});
			run.with("join_vertices", "Always").execute();
			EXPECT_EQ(
				run.output<int32_t>("results.joined_edges"),
				std::vector<int32_t>(1, first == second ? 1 : 0));
		}
}

TEST(Library, RunsAgainWithOtherParameters)
{
	const SurfaceMesh mesh = rectangle(4, 4, 1, 1);
	CRun run(mesh);
	const std::string first = run.execute().everything();
	run.with("target_curvature", "disk").execute(); // in any case
	const std::string disk = run.everything();
	EXPECT_NE(first, disk);
	EXPECT_EQ(disk, CRun(mesh).with("target_curvature", "2").execute().everything());
	EXPECT_EQ(first, run.with("target_curvature", "Automatic").execute().everything());
	EXPECT_EQ(ricci_output_name(run, ricci_output_count(run)), nullptr);
	EXPECT_EQ(ricci_output_name(run, -1), nullptr);
}

/// Pixels of a texture, from the border and between charts; less where so many charts do not fit.
TEST(Library, PadsChartsInPixels)
{
	const auto boxOf = [](const CRun& run) {
		double least = 1.0;
		for (const double x : run.output<double>("uv"))
			least = std::min(least, x);
		return least;
	};
	const SurfaceMesh square = rectangle(4, 4, 1, 1);
	for (const auto& [padding, size] : {std::pair("4", 2048), std::pair("256", 1024)}) {
		CRun run(square);
		run.with("padding", padding).with("texture_size", std::to_string(size).c_str()).execute();
		EXPECT_NEAR(boxOf(run), std::stod(padding) / size, 1e-6);
		EXPECT_NEAR(run.output<double>("results.padding_pixels").front(), std::stod(padding), 1e-9);
	}
	SurfaceMesh many; // 30 charts in six columns: seven margins of an eighth leave almost no room
	for (int i = 0; i < 30; ++i)
		many = sideBySide(many, square, 3.0 * i);
	CRun run(many);
	run.with("padding", "512").execute();
	EXPECT_EQ(run.output<double>("results.padding_pixels").front(), 128.0);
}

TEST(Library, ReadsNumbersInNoLocale)
{
	const DecimalCommas commas;
	const auto sharpEdges = [&](const char* degrees) {
		CRun run(slab());
		run.with("seams", "Sharp edges").with("sharp_angle", degrees).execute();
		return run.output<int32_t>("results.chosen_seam_edges").front();
	};
	EXPECT_GT(sharpEdges("8.95e1"), 0);
	EXPECT_EQ(sharpEdges("9.05e1"), 0);
	EXPECT_EQ(ricci_set_parameter(CRun(slab()), "sharp_angle", "90,5"), RICCI_MISUSE);
}

/// What is wrong, the code, and words of the sentence.
struct Wrong
{
	std::function<int32_t(CRun&)> call;
	int32_t code;
	std::string words;
};

/// A text that is no value of a parameter.
Wrong setting(const char* parameter, const char* value, const char* words)
{
	return {[=](CRun& r) { return ricci_set_parameter(r, parameter, value); }, RICCI_MISUSE, words};
}

/// A value with which there is no run.
Wrong running(
	const char* parameter, const char* value, const char* words, int32_t code = RICCI_REFUSED)
{
	return {[=](CRun& r) { return ricci_execute(r.with(parameter, value)); }, code, words};
}

/// A shape that an array cannot have.
Wrong shaped(
	const char* name,
	const std::vector<int64_t>& shape,
	const char* words,
	int32_t type = RICCI_FLOAT64)
{
	const auto set = [=](CRun& r) {
		static const std::vector<double> many(1000, 0.0);
		ricci_array array{type, static_cast<int32_t>(shape.size()), {0, 0, 0}, many.data()};
		std::copy_n(shape.begin(), std::min<std::size_t>(shape.size(), 3), array.shape);
		return ricci_set_array(r, name, &array);
	};
	return {set, RICCI_MISUSE, words};
}

/// Entries with which there is no run.
template<class T>
Wrong given(
	const char* name,
	const std::vector<T>& entries,
	const std::vector<std::size_t>& shape,
	int32_t code,
	const char* words)
{
	return {[=](CRun& r) { return ricci_execute(r.set(name, entries, shape)); }, code, words};
}

/// A picture that is none.
Wrong drawnWith(const ricci_array& picture, int32_t code, const char* words)
{
	return {[=](CRun& r) { return ricci_add_picture(r, "old.png", &picture); }, code, words};
}

TEST(Library, RefusesWithACodeAndASentence)
{
	constexpr int64_t kMany = std::numeric_limits<int32_t>::max();
	const std::vector<uint8_t> texels(20);
	const Wrong all[] = {
		setting("epsilonn", "1", "no parameter 'epsilonn'"),
		setting("finish", "Best", "finish must be one of 'None', 'Repair', .*, not 'Best'"),
		running(
			"finish", "17", "The value 17 of finish is not one of its choices. Use 0 \\(None\\)"),
		setting("colorize", "maybe", "colorize must be true or false, not 'maybe'"),
		setting("cone_count", "1.5", "cone_count must be a whole number"),
		setting("cone_count", "99999999999", "cone_count must be a whole number"),
		setting("epsilon", "1e-8x", "epsilon must be a number, not '1e-8x'"),
		running("epsilon", "nan", "The value nan of epsilon cannot be used"),
		running("time_limit", "-Infinity", "The value -inf of time_limit cannot be used"),
		running("time_limit", "1e-9", "stopped after", RICCI_TIMED_OUT),
		running("padding", "513", "The value 513 of padding cannot be used. Use 0 to 512 pixels"),
		setting(
			"chart_margin",
			"0.004",
			"'chart_margin': it is 'padding' now, in pixels of texture_size: 0.004 is 4"),
		running("target_curvature", "Disk", "'Disk' needs a topological disk"),
		running("seams", "Selected edges", "no edge of a face is selected"),
		running("seams", "Existing texture seams", "the mesh has no texture coordinates"),
		running("target_curvature", "From vertex quality", "the mesh has no vertex quality"),
		running("carry_texture", "new.png", "the mesh has neither a texture nor colours"),
		running("carry_texture", "new.jpg", "end in .png"),
		running(
			"report", "nowhere/at/all.html", "cannot be written \\(.+\\): choose another place"),
		shaped("edges", {2, 3}, "no array 'edges'"),
		shaped("vertices", {3, 2}, "vertices must have the shape V x 3, not 3 x 2"),
		shaped("vertices", {9}, "not 9"),
		shaped("matrix", {3, 4}, "the shape 4 x 4, not 3 x 4"),
		shaped("vertices", {1, 1, 1, 1}, "has an invalid shape"),
		shaped("vertices", {-1, 3}, "has an invalid shape"),
		shaped("vertices", {1ll << 40, 3}, "has an invalid shape"),
		shaped("vertices", {3, 3}, "no array type 77", 77),
		shaped("faces", {3, 3}, "faces must have whole numbers"),
		{[](CRun& r) {
			 const ricci_array array{RICCI_FLOAT64, 2, {3, 3, 0}, nullptr};
			 return ricci_set_array(r, "vertices", &array);
		 },
		 RICCI_MISUSE,
		 "is null, but 3 x 3 entries are expected"},
		{[](CRun& r) { return ricci_set_array(r, nullptr, nullptr); }, RICCI_MISUSE, "is null"},
		{[](CRun& r) { return ricci_set_parameter(r, "finish", nullptr); },
		 RICCI_MISUSE,
		 "is null"},
		{[](CRun& r) { return ricci_set_text(r, "author", "x"); },
		 RICCI_MISUSE,
		 "no text 'author'"},
		given<double>(
			"quality",
			{1, 2, 3},
			{3},
			RICCI_MISUSE,
			"The array quality has 3 entries, but there are 24 vertices"),
		given<uint8_t>(
			"faux",
			{1, 0, 1},
			{1, 3},
			RICCI_MISUSE,
			"The array faux has 1 entries, but there are 48 faces"),
		{[](CRun& r) {
			 return ricci_set_array(r, "faces", nullptr) == RICCI_OK ? ricci_execute(r) : -1;
		 },
		 RICCI_MISUSE,
		 "no array faces"},
		{[](CRun& r) {
			 r.set<double>("vertices", {}, {0, 3});
			 return ricci_execute(r.set<int32_t>("faces", {}, {0, 3}));
		 },
		 RICCI_REFUSED,
		 "The mesh is empty"},
		given<int32_t>("faces", {}, {0, 3}, RICCI_REFUSED, "point cloud"),
		given<int32_t>(
			"faces",
			{0, 1, -1},
			{1, 3},
			RICCI_REFUSED,
			"1 face uses vertices that are deleted or not in the mesh"),
		given<int32_t>(
			"faces",
			{0, 1, 24, 1, 2, 24, 0, 1, 2},
			{3, 3},
			RICCI_REFUSED,
			"2 faces use vertices that are deleted or not in the mesh"),
		given<int64_t>("faces", {0, 1, 1ll << 62}, {1, 3}, RICCI_REFUSED, "1 face uses vertices"),
		{[](CRun& r) {
			 std::vector<double> positions = r.execute().output<double>("vertices");
			 positions[5] = std::numeric_limits<double>::quiet_NaN();
			 return ricci_execute(r.set("vertices", positions, {24, 3}));
		 },
		 RICCI_REFUSED,
		 "1 vertex"},
		drawnWith(
			{RICCI_UINT8, 3, {2, 2, 5}, texels.data()},
			RICCI_MISUSE,
			"The picture old.png must have rows, columns and 1 to 4 channels"),
		drawnWith(
			{RICCI_FLOAT32, 3, {2, 2, 1}, texels.data()}, RICCI_MISUSE, "bytes or 16-bit words"),
		drawnWith(
			{RICCI_UINT8, 3, {kMany, kMany, 1}, texels.data()},
			RICCI_NO_MEMORY,
			"not enough memory")};
	const SurfaceMesh mesh = torus(2, 0.8, 6, 4);
	ASSERT_EQ(mesh.triangles.size(), 48u); // and 24 vertices
	for (const Wrong& wrong : all) {
		SCOPED_TRACE(wrong.words);
		CRun run(mesh);
		EXPECT_EQ(wrong.call(run), wrong.code) << run.message();
		const std::string message = run.message();
		EXPECT_TRUE(std::regex_search(message, std::regex(wrong.words))) << message;
		EXPECT_TRUE(std::regex_search(message, std::regex("\\.$"))) << message;
		EXPECT_EQ(message.find('{'), std::string::npos) << message;
		if (wrong.code != RICCI_MISUSE && wrong.code != RICCI_NO_MEMORY) {
			EXPECT_EQ(ricci_output_count(run), 0);
		}
	}
}

TEST(Library, DoesWithoutARun)
{
	EXPECT_EQ(ricci_create(2), nullptr);
	EXPECT_EQ(ricci_create(-1), nullptr);
	ricci_free(nullptr);
	ricci_array array;
	EXPECT_EQ(ricci_set_parameter(nullptr, "finish", "0"), RICCI_MISUSE);
	EXPECT_EQ(ricci_set_array(nullptr, "faces", nullptr), RICCI_MISUSE);
	EXPECT_EQ(ricci_set_text(nullptr, "name", ""), RICCI_MISUSE);
	EXPECT_EQ(ricci_add_picture(nullptr, "", nullptr), RICCI_MISUSE);
	EXPECT_EQ(ricci_set_listener(nullptr, nullptr, nullptr), RICCI_MISUSE);
	EXPECT_EQ(ricci_execute(nullptr), RICCI_MISUSE);
	EXPECT_EQ(ricci_output_count(nullptr), 0);
	EXPECT_EQ(ricci_output_name(nullptr, 0), nullptr);
	EXPECT_EQ(ricci_output(nullptr, "uv", &array), RICCI_MISUSE);
	EXPECT_EQ(ricci_output(CRun(), "uv", &array), RICCI_MISUSE);
	EXPECT_EQ(ricci_output(CRun(), nullptr, nullptr), RICCI_MISUSE);
	EXPECT_STRNE(ricci_message(nullptr), "");
}

/// Keeps what it is told.
struct Told
{
	std::vector<double> fractions;
	std::vector<std::string> lines;
	std::size_t last = std::numeric_limits<std::size_t>::max();

	static int32_t receive(void* context, double fraction, const char* text)
	{
		Told& told = *static_cast<Told*>(context);
		if (fraction < 0.0) {
			told.lines.push_back(text);
			return 0; // which is not read
		}
		told.fractions.push_back(fraction);
		return told.fractions.size() < told.last ? 1 : 0;
	}
};

TEST(Library, TellsAndIsCancelled)
{
	CRun run(slab());
	Told told;
	ASSERT_EQ(ricci_set_listener(run, Told::receive, &told), RICCI_OK);
	run.execute();
	EXPECT_TRUE(std::is_sorted(told.fractions.begin(), told.fractions.end()));
	EXPECT_GT(told.fractions.size(), 100u);
	EXPECT_LE(told.fractions.back(), 1.0);
	EXPECT_TRUE(std::any_of(told.lines.begin(), told.lines.end(), [](const std::string& line) {
		return line.rfind("Result: converged=true", 0) == 0;
	}));
	const std::string whole = run.everything();
	for (std::size_t n = 1; n < told.fractions.size(); n += 1 + n / 3) {
		Told cancels;
		cancels.last = n;
		ASSERT_EQ(ricci_set_listener(run, Told::receive, &cancels), RICCI_OK);
		EXPECT_EQ(ricci_execute(run), RICCI_CANCELLED);
		EXPECT_EQ(run.message(), "Cancelled: the mesh is unchanged.");
		EXPECT_EQ(cancels.fractions.size(), n);
		EXPECT_EQ(ricci_output_count(run), 0);
	}
	ASSERT_EQ(ricci_set_listener(run, nullptr, nullptr), RICCI_OK);
	EXPECT_EQ(run.execute().everything(), whole);
}

TEST(Library, ThreadsGetTheSameBits)
{
	const std::string alone[] = {
		CRun(slab()).execute().everything(),
		CRun(slab(), RICCI_HYPERBOLIC).with("universal_cover", "1").execute().everything()};
	std::array<std::string, 4> together;
	std::vector<std::thread> threads;
	for (std::size_t i = 0; i < together.size(); ++i)
		threads.emplace_back([&together, i] {
			CRun run(slab(), i % 2 == 0 ? RICCI_EUCLIDEAN : RICCI_HYPERBOLIC);
			if (i % 2 == 1)
				run.with("universal_cover", "1");
			together[i] = run.execute().everything();
		});
	for (std::thread& thread : threads)
		thread.join();
	for (std::size_t i = 0; i < together.size(); ++i)
		EXPECT_EQ(together[i] == alone[i % 2], true) << i;
}

TEST(Library, LastsWhateverAllocationFails)
{
	RICCI_NEEDS_FAILING_MALLOC();
	const SurfaceMesh mesh = rectangle(2, 2, 1, 1);
	std::string whole;
	for (const Failing which : {Failing::One, Failing::AllThatFollow})
		for (long n = 0, failures = 1; failures > 0; n += 1 + n / 64) {
			FailingMalloc failing(n, which);
			ricci_run* const run = ricci_create(RICCI_EUCLIDEAN);
			int32_t code = RICCI_NO_MEMORY;
			if (run != nullptr) {
				static double positions[27];
				static int32_t corners[24];
				for (std::size_t i = 0; i < 27; ++i)
					positions[i] = mesh.positions[i / 3][i % 3];
				for (std::size_t i = 0; i < 24; ++i)
					corners[i] = mesh.triangles[i / 3][i % 3];
				const ricci_array v{RICCI_FLOAT64, 2, {9, 3, 0}, positions};
				const ricci_array f{RICCI_INT32, 2, {8, 3, 0}, corners};
				code = ricci_set_array(run, "vertices", &v);
				code = code == RICCI_OK ? ricci_set_array(run, "faces", &f) : code;
				code = code == RICCI_OK ? ricci_execute(run) : code;
			}
			failing.end();
			failures = failing.failures();
			EXPECT_EQ(failing.freedTwice(), 0) << n;
			if (code != RICCI_OK) {
				EXPECT_EQ(code, RICCI_NO_MEMORY) << ricci_message(run);
				EXPECT_STRNE(ricci_message(run), "");
				EXPECT_EQ(ricci_output_count(run), 0);
			}
			ricci_free(run);
			if (HasFailure())
				return;
		}
}

TEST(Library, RefinesAndSaysOfWhichFaces)
{
	const SurfaceMesh mesh = torus(2.0, 0.5, 30, 6);
	CRun run(mesh);
	std::vector<uint8_t> faux; // the diagonals of the quads
	for (std::size_t f = 0; f < mesh.triangles.size(); ++f)
		for (std::size_t k = 0; k < 3; ++k)
			faux.push_back(f % 2 == 0 ? k == 2 : k == 0);
	run.set("faux", faux, {mesh.triangles.size(), 3});
	run.with("output_triangulation", "Common refinement").execute();
	const auto vertices = run.output<double>("vertices");
	const auto faces = run.output<int32_t>("faces"), origin = run.output<int32_t>("face_of_origin"),
			   chart = run.output<int32_t>("chart");
	const std::size_t points = static_cast<std::size_t>(run.result<int32_t>("refinement_points"));
	ASSERT_GT(points, 0u);
	EXPECT_EQ(vertices.size(), 3 * (mesh.positions.size() + points));
	EXPECT_EQ(faces.size(), 3 * origin.size());
	EXPECT_EQ(faces.size(), 3 * chart.size());
	EXPECT_EQ(run.output<double>("quality").size(), mesh.positions.size() + points);
	const auto place = [&](int32_t v) {
		return Point3{vertices[3 * at(v)], vertices[3 * at(v) + 1], vertices[3 * at(v) + 2]};
	};
	const auto lengthOf = [&](const auto& marks, const auto& ends) {
		double sum = 0.0;
		for (std::size_t i = 0; i < marks.size(); ++i) {
			const Point3 p = place(ends(i)), q = place(ends(i % 3 == 2 ? i - 2 : i + 1));
			sum += marks[i] * std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
		}
		return sum;
	};
	EXPECT_NEAR( // the pieces of the diagonals are the diagonals
		lengthOf(run.output<uint8_t>("faux"), [&](std::size_t i) { return faces[i]; }),
		lengthOf(faux, [&](std::size_t i) { return mesh.triangles[i / 3][i % 3]; }),
		1e-9);
	std::vector<double> area(mesh.triangles.size(), 0.0);
	for (std::size_t f = 0; f < origin.size(); ++f) {
		if (f < mesh.triangles.size()) {
			EXPECT_EQ(origin[f], static_cast<int32_t>(f));
		}
		EXPECT_GE(chart[f], 0);
		EXPECT_LT(chart[f], run.result<int32_t>("charts"));
		SurfaceMesh piece;
		for (std::size_t k = 0; k < 3; ++k)
			piece.positions.push_back(place(faces[3 * f + k]));
		piece.triangles = {{0, 1, 2}};
		area.at(at(origin[f])) += areaOf(piece);
	}
	for (std::size_t f = 0; f < area.size(); ++f)
		EXPECT_NEAR(area[f], areaOf(mesh, f), 1e-9);
}

TEST(Library, OpensAtTheSeamsThatAreChosen)
{
	Random random(5);
	const SurfaceMesh mesh =
		shaken(torus(2.0, 0.7, 12, 6), 0.02, random); // its halves are no copies
	const std::size_t faces = mesh.triangles.size();
	std::vector<uint8_t> selected(faces, 0);
	std::fill(selected.begin(), selected.begin() + static_cast<std::ptrdiff_t>(faces / 2), 1);
	CRun run(mesh);
	run.set("selected_faces", selected, {faces})
		.with("seams", "Border of selected faces")
		.execute();
	const int32_t round = run.result<int32_t>("chosen_seam_edges");
	EXPECT_EQ(run.result<int32_t>("components"), 2);

	std::vector<uint8_t> sides(3 * faces, 0); // the same edges, seen from the selected faces
	std::vector<double> uv(6 * faces);
	for (std::size_t f = 0; f < faces; ++f)
		for (std::size_t k = 0; k < 3; ++k) {
			uv[6 * f + 2 * k] = selected[f] ? 0.25 : 0.75; // jumps there alone
			uv[6 * f + 2 * k + 1] = 0.01 * mesh.triangles[f][k];
			const int a = mesh.triangles[f][k], b = mesh.triangles[f][(k + 1) % 3];
			for (std::size_t g = 0; g < faces; ++g)
				for (std::size_t j = 0; j < 3; ++j)
					if (selected[f] && !selected[g] && mesh.triangles[g][j] == b &&
						mesh.triangles[g][(j + 1) % 3] == a)
						sides[3 * f + k] = 1;
		}
	EXPECT_EQ(std::count(sides.begin(), sides.end(), 1), round);
	CRun byEdges(mesh), byTexture(mesh);
	byEdges.set("selected_edges", sides, {faces, 3}).with("seams", "2").execute();
	byTexture.set("uv", uv, {faces, 3, 2}).with("seams", "1").execute();
	EXPECT_EQ(byEdges.output<double>("uv"), run.output<double>("uv"));
	EXPECT_EQ(byTexture.output<double>("uv"), run.output<double>("uv"));
}

TEST(Library, TakesConesAndCurvatures)
{
	const SurfaceMesh mesh = slab();
	const std::size_t count = mesh.positions.size();
	std::vector<uint8_t> selected(count, 0);
	selected[0] = selected[5] = 1;
	CRun run(mesh);
	run.set("selected_vertices", selected, {count});
	run.with("target_curvature", "Cones at selected vertices").execute();
	const auto curvature = run.output<double>("target_curvature");
	for (std::size_t v = 0; v < count; ++v)
		EXPECT_NEAR(curvature[v], selected[v] ? -2.0 * kPi : 0.0, 1e-12) << v;
	CRun same(mesh);
	same.set("quality", curvature, {count})
		.with("target_curvature", "From vertex quality")
		.execute();
	EXPECT_EQ(same.output<double>("target_curvature"), curvature);
}

TEST(Library, FlattensTheMeshAsItsMatrixMovesIt)
{
	const SurfaceMesh mesh = rectangle(4, 4, 1, 1);
	CRun run(mesh);
	run.set<double>("matrix", {3, 0, 0, 7, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}, {4, 4}).execute();
	EXPECT_EQ(run.output<double>("uv"), CRun(rectangle(4, 4, 3, 1)).execute().output<double>("uv"));
	EXPECT_EQ(run.output<double>("vertices"), CRun(mesh).execute().output<double>("vertices"));
}

TEST(Library, GivesTheLayers)
{
	CRun disk(slab(), RICCI_HYPERBOLIC);
	for (const char* layer : {"flat_layer", "generator_axes", "canonical_polygon", "colorize"})
		disk.with(layer, "true");
	disk.with("universal_cover", "1").execute();
	for (const char* layer : {"disk", "cover", "axes", "polygon"})
		for (const char* what : {".vertices", ".faces", ".edges", ".matrix"})
			EXPECT_TRUE(disk.has(std::string(layer) + what)) << layer << what;
	EXPECT_TRUE(disk.has("disk.uv"));
	EXPECT_TRUE(disk.has("disk.colors"));
	EXPECT_GT(disk.shapeOf("axes.edges").shape[0], 0);
	EXPECT_EQ(disk.shapeOf("disk.faces").shape[0], disk.shapeOf("faces").shape[0]);
	EXPECT_GT(disk.shapeOf("cover.faces").shape[0], 5 * disk.shapeOf("faces").shape[0]);
	EXPECT_EQ(disk.shapeOf("results.generators").shape[0], 4 * 4);
	for (const char* layer : {"disk", "cover", "axes", "polygon"})
		for (const double x : disk.output<double>(layer + std::string(".vertices"))) {
			EXPECT_GE(x, 0.0);
			EXPECT_LE(x, 1.0);
		}
	CRun sphere(tetrahedron());
	sphere.with("layers", "Sphere").execute();
	const auto places = sphere.output<double>("sphere.vertices");
	ASSERT_EQ(places.size(), 12u);
	for (std::size_t v = 0; v < 4; ++v)
		EXPECT_NEAR(std::hypot(places[3 * v], places[3 * v + 1], places[3 * v + 2]), 1.0, 1e-12);
}

TEST(Library, DrawsThePictures)
{
	const SurfaceMesh mesh = rectangle(4, 4, 1, 1);
	std::vector<double> uv;
	for (const Triangle& t : mesh.triangles)
		for (const int v : t)
			uv.insert(uv.end(), {mesh.positions[at(v)][0], mesh.positions[at(v)][1]});
	const auto drawn = [&](const ricci_array* picture) {
		CRun run(mesh);
		EXPECT_EQ(ricci_add_picture(run, "old.png", picture), RICCI_OK) << run.message();
		run.set("uv", uv, {mesh.triangles.size(), 3, 2});
		run.with("carry_texture", "new.png").with("texture_size", "64");
		return run;
	};
	// Every form of one colour gives that colour, where there is a chart and round it.
	const std::vector<uint8_t> grey(16 * 16, 100), alpha{100, 80, 60, 40};
	const std::vector<uint16_t> words(3 * 16 * 16, 1000);
	const ricci_array pictures[] = {
		arrayOf(grey, {16, 16, 1}), arrayOf(alpha, {1, 1, 4}), arrayOf(words, {16, 16, 3})};
	CRun plain = drawn(&pictures[0]);
	plain.execute();
	EXPECT_EQ(plain.shapeOf("picture").shape[2], 3);
	EXPECT_EQ(plain.output<uint8_t>("picture").at(3 * (32 * 64 + 32)), 100);
	CRun clear = drawn(&pictures[1]);
	clear.execute();
	ASSERT_EQ(clear.shapeOf("picture").shape[2], 4);
	const auto texels = clear.output<uint8_t>("picture");
	for (std::size_t k = 0; k < 4; ++k)
		EXPECT_EQ(texels.at(4 * (32 * 64 + 32) + k), alpha[k]);
	CRun deep = drawn(&pictures[2]);
	deep.execute();
	EXPECT_EQ(deep.output<uint16_t>("picture").at(3 * (32 * 64 + 32)), 1000);
	// Gutters take their most of so small a picture, a twentieth of its side, but more if that is asked for.
	EXPECT_NEAR(deep.result<double>("texture_scale"), 0.9 * 64.0 / 16.0, 1e-6);
	EXPECT_NEAR(deep.result<double>("padding_pixels"), 0.05 * 64.0, 1e-12);
	deep.with("padding", "4").execute();
	EXPECT_NEAR(deep.result<double>("texture_scale"), (64.0 - 8.0) / 16.0, 1e-5);
	EXPECT_FALSE(std::filesystem::exists("new.png"));

	CRun missing = drawn(nullptr);
	EXPECT_EQ(ricci_execute(missing), RICCI_REFUSED);
	EXPECT_TRUE(std::regex_search(
		missing.message(), std::regex("texture old.png of the mesh cannot be loaded")));
	CRun same = drawn(&pictures[0]);
	same.with("carry_texture", "OLD.png");
	EXPECT_EQ(ricci_execute(same), RICCI_REFUSED);
	EXPECT_TRUE(std::regex_search(same.message(), std::regex("has the name of a texture")));

	CRun coloured(mesh);
	std::vector<uint8_t> colours;
	for (std::size_t v = 0; v < mesh.positions.size(); ++v)
		colours.insert(colours.end(), {10, 20, 30, 255});
	coloured.set("vertex_colors", colours, {mesh.positions.size(), 4});
	coloured.with("carry_texture", "new.png").with("texture_size", "16").execute();
	EXPECT_EQ(coloured.output<uint8_t>("picture").at(3 * (8 * 16 + 8) + 2), 30);
	EXPECT_EQ(coloured.output<uint8_t>("vertex_colors"), colours);
}

TEST(Library, WritesReportsWhereTheFolderSays)
{
	const std::filesystem::path folder =
		std::filesystem::path(::testing::TempDir()) / "ricci_library_ü (1)";
	std::filesystem::remove_all(folder);
	std::filesystem::create_directories(folder);
	const auto files = [&] {
		return std::distance(std::filesystem::directory_iterator(folder), {});
	};
	CRun run(rectangle(4, 4, 1, 1));
	ASSERT_EQ(ricci_set_text(run, "folder", folder.u8string().c_str()), RICCI_OK);
	ASSERT_EQ(ricci_set_text(run, "name", "a <b> \"c\".ply"), RICCI_OK);
	run.with("report", "page.html").with("target_curvature", "Flat everywhere");
	EXPECT_EQ(ricci_execute(run), RICCI_REFUSED); // Euler characteristic 1
	EXPECT_EQ(files(), 0);
	run.with("target_curvature", "Disk").execute();
	EXPECT_EQ(files(), 2);
	std::ifstream page(folder / "page.html");
	const std::string text((std::istreambuf_iterator<char>(page)), {});
	EXPECT_NE(text.find("<p>a &lt;b&gt; &quot;c&quot;.ply</p>"), std::string::npos);
	EXPECT_TRUE(std::filesystem::exists(folder / "page.csv"));
	std::filesystem::remove_all(folder);
}

} // namespace
} // namespace ricci::testing
