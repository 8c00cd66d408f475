// SPDX-License-Identifier: GPL-3.0-or-later
// Prints a digest of every array and number that runs on meshes give back, a line for each: what a
// change that should change nothing is compared by, bit for bit.
#include "calls.h"
#include "mesh_file.h"
#include "vcg_mesh.h"

#include <vcg/complex/algorithms/parametrization/ricci_flow.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <functional>

namespace {

using namespace ricci;
using Flow = vcg::tri::RicciFlow<testing::DoubleMesh>;

/// FNV-1a of the bytes.
class Digest
{
public:
	template<class Number>
	void add(const Number& x)
	{
		unsigned char bytes[sizeof x];
		std::memcpy(bytes, &x, sizeof x);
		for (const unsigned char byte : bytes)
			m_value = (m_value ^ byte) * 1099511628211ull;
	}
	template<class Range>
	void addAll(const Range& range)
	{
		for (const auto& x : range)
			add(x);
	}
	std::uint64_t value() const { return m_value; }

private:
	std::uint64_t m_value = 14695981039346656037ull;
};

void print(const std::string& run, const char* what, const Digest& digest)
{
	std::printf("%s\t%s\t%016llx\n", run.c_str(), what, (unsigned long long) (digest.value()));
}

void print(const std::string& run, const char* what, double value)
{
	std::printf("%s\t%s\t%.17g\n", run.c_str(), what, value);
}

void printReport(const std::string& run, const Report& r)
{
	for (const testing::Figure& figure : testing::figuresOf(r))
		print(run, figure.name, figure.value);
	Digest periods;
	periods.addAll(r.periodMatrix);
	print(run, "periods", periods);
}

void printResult(const std::string& run, const Flow::Result& result)
{
	const bool isRefined = run.find("refined") != std::string::npos;
	printReport(run, result.report);
	Digest uv, qc, u, target, refined, group;
	const FlatMesh& mesh = result.mesh;
	u.addAll(result.u);
	target.addAll(result.targetCurvature);
	if (isRefined) {
		refined.addAll(mesh.vertices);
		refined.addAll(mesh.face);
		refined.addAll(mesh.corners());
		refined.addAll(result.vertexQC);
		for (const SurfacePoint& p : mesh.source) {
			refined.addAll(p.vertex);
			refined.addAll(p.weight);
		}
	}
	else {
		std::vector<Triangle2> byFace(positionOf(mesh.size()));
		for (const int f : mesh.face.indices())
			byFace[positionOf(mesh.face[f])] = mesh.at(f);
		uv.addAll(byFace);
		qc.addAll(result.vertexQC);
	}
	for (const Chart& chart : result.charts) {
		const FuchsianGroup& g = chart.group;
		if (!result.report.relationError)
			continue; // in the plane there is none
		for (const auto* isometries : {&g.handles, &g.peripheral, &g.sides})
			for (const DiskIsometry& isometry : *isometries) {
				group.add(isometry.a);
				group.add(isometry.b);
			}
		group.add(g.relationError);
	}
	print(run, "uv", uv);
	print(run, "qc", qc);
	print(run, "u", u);
	print(run, "target", target);
	print(run, "refined", refined);
	print(run, "group", group);
}

struct Case
{
	const char* name;
	std::function<void(Flow::Params&)> change;
};

const std::vector<Case> kCases = {
	{"default", [](Flow::Params&) {}},
	{"refined", [](Flow::Params& p) { p.output = OutputTriangulation::CommonRefinement; }},
	{"placed", [](Flow::Params& p) { p.target = TargetCurvature::PlacedCones; }},
	{"counted", [](Flow::Params& p) { p.cones.count = 9; }},
	{"spread", [](Flow::Params& p) { p.cones.distortion = 0.2; }},
	{"quarter",
	 [](Flow::Params& p) {
		 p.target = TargetCurvature::PlacedCones;
		 p.cones.rounding = ConeRounding::QuarterTurns;
	 }},
	{"flat", [](Flow::Params& p) { p.target = TargetCurvature::Flat; }},
	{"disk", [](Flow::Params& p) { p.target = TargetCurvature::Disk; }},
	{"rectangle", [](Flow::Params& p) { p.target = TargetCurvature::Rectangle; }},
	{"prescribed_boundary", [](Flow::Params& p) { p.freeBoundary = false; }},
	{"capped", [](Flow::Params& p) { p.holes = Holes::Capped; }},
	{"strips_unscaled",
	 [](Flow::Params& p) {
		 p.charts = Charts::CutForPacking;
		 p.chartMargin = 0.01;
	 }},
	{"no_surgery", [](Flow::Params& p) { p.method = Method::FixedTriangles; }},
	{"edge_swap", [](Flow::Params& p) { p.method = Method::EdgeSwaps; }},
	{"thurston", [](Flow::Params& p) { p.method = Method::Thurston; }}};

const std::vector<std::pair<const char*, std::function<void(HyperbolicOptions&)>>>
	kHyperbolicCases = {
		{"hyperbolic", [](HyperbolicOptions& o) { o.canonicalGenerators = true; }},
		{"hyperbolic_refined",
		 [](HyperbolicOptions& o) { o.output = OutputTriangulation::CommonRefinement; }},
		{"hyperbolic_no_surgery", [](HyperbolicOptions& o) { o.method = Method::FixedTriangles; }}};

template<class Run>
void tryRun(const std::string& run, const Run& body)
{
	try {
		body();
	}
	catch (const std::exception& e) {
		std::printf("%s\trefused\t%s\n", run.c_str(), e.what());
	}
	std::fflush(stdout);
}

} // namespace

/// result_digest [--case NAME]... MESH...
int main(int argc, char** argv)
{
	std::vector<std::string> wanted, meshes;
	for (int i = 1; i < argc; ++i)
		if (std::string(argv[i]) == "--case" && i + 1 < argc)
			wanted.push_back(argv[++i]);
		else
			meshes.push_back(argv[i]);
	const auto isWanted = [&](const std::string& name) {
		return wanted.empty() || std::find(wanted.begin(), wanted.end(), name) != wanted.end();
	};
	for (const std::string& path : meshes) {
		testing::DoubleMesh m;
		try {
			testing::toVcg(testing::readMesh(path), m);
		}
		catch (const std::exception& e) {
			std::fprintf(stderr, "%s: %s\n", path.c_str(), e.what());
			return 2;
		}
		const std::string mesh = std::filesystem::path(path).stem().string() + "\t";
		for (const Case& c : kCases)
			if (isWanted(c.name))
				tryRun(mesh + c.name, [&] {
					Flow::Params params;
					c.change(params);
					printResult(mesh + c.name, Flow::Compute(m, params));
				});
		for (const auto& [name, change] : kHyperbolicCases)
			if (isWanted(name))
				tryRun(mesh + name, [&, change = change, name = name] {
					HyperbolicOptions options;
					change(options);
					printResult(mesh + name, Flow::ComputeHyperbolic(m, options));
				});
		if (isWanted("sphere"))
			tryRun(mesh + "sphere", [&] {
				const SphereMap sphere = Flow::ComputeSphere(m, Flow::Params());
				Digest digest;
				digest.addAll(sphere.positions);
				digest.addAll(sphere.triangles);
				print(mesh + "sphere", "sphere", digest);
			});
	}
}
