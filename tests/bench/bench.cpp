// SPDX-License-Identifier: GPL-3.0-or-later
// CPU time of each stage for one mesh, and the time of the flow as a multiple of one analysis,
// factorisation and solution of the same matrix: a number that does not depend on the machine's
// speed. One process measures one mesh, so that the peak of its memory means something; it is that of
// the complete run from mesh to plane, which is first.
#include "support/flipped_flow.h"
#include "support/intrinsic.h"
#include "support/random_surface.h"
#include "support/shapes.h"
#ifdef RICCI_HAVE_VCGLIB
#include "support/mesh_file.h"
#endif

#include <ricci/base/numbers.h>
#include <ricci/base/parallel.h>
#include <ricci/cones/target_curvature.h>
#include <ricci/flow/curvature_map.h>
#include <ricci/flow/ricci_flow.h>
#include <ricci/mesh/component.h>
#include <ricci/metric/circle_packing.h>
#include <ricci/metric/geometry.h>
#include <ricci/numerics/sparse_cholesky.h>
#include <ricci/parametrize.h>

#ifdef RICCI_USE_CHOLMOD
#include <cholmod.h>
#else
#include <Eigen/SparseCholesky>
#endif

#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <exception>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace ricci;

/// The cheapest of these runs is taken, of the flow as of the factorisation: the first one also pays
/// for cold caches, and other work on the machine makes the processor's time longer.
int repetitions(std::size_t faces)
{
	return faces < 500000 ? 3 : 1;
}

constexpr int kEvaluations = 10;

/// Columns of the table; bench.sh prints them once for all meshes.
const char* const kHeader =
	"mesh\tfaces\tgeometry\tsolve_cpu_s\tone_factor_cpu_s\tratio\titerations\tflips\tresidual"
	"\tpeak_mb\tread_cpu_s\tpacking_cpu_s\twhole_cpu_s\twhole_wall_s\twhole_ratio"
	"\tcones_cpu_s\tflows_cpu_s\tcut_cpu_s\toverlay_cpu_s\tfinish_cpu_s\tcharts_cpu_s"
	"\tpack_cpu_s\twrite_cpu_s\trest_cpu_s\tlongest_silence_s\tsilent_stage"
	"\tevaluation_wall_s\tthreads\tthread_speedup\tfactorizations\tsolutions\tgflop\ttarget"
	"\tmethod\tsolver\tremark";

double cpuSeconds()
{
	timespec now{};
	clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
	return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double peakMegabytes()
{
	rusage usage{};
	getrusage(RUSAGE_SELF, &usage);
	return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

template<class Work>
double timeOf(Work work)
{
	const double start = cpuSeconds();
	work();
	return cpuSeconds() - start;
}

double wallSeconds()
{
	timespec now{};
	clock_gettime(CLOCK_MONOTONIC, &now);
	return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Columns of the complete run, in its order.
const std::vector<std::string> kStages = {
	"cones", "flows", "cut", "overlay", "finish", "charts", "pack", "write", "rest"};

/// Times the stages of a run by what it tells its listener.
class StageClock : public Progress
{
public:
	bool update(double, const std::string& what) override
	{
		enter(stageOf(what));
		return true;
	}

	/// Starts \p stage.
	void enter(const std::string& stage)
	{
		const double cpu = cpuSeconds(), wall = wallSeconds();
		if (!m_stage.empty()) {
			m_cpu[m_stage] += cpu - m_sinceCpu;
			if (wall - m_sinceWall > m_silence) {
				m_silence = wall - m_sinceWall;
				m_silentStage = m_stage;
			}
		}
		m_stage = stage;
		m_sinceCpu = cpu;
		m_sinceWall = wall;
	}

	double cpuOf(const std::string& stage) const
	{
		const auto found = m_cpu.find(stage);
		return found == m_cpu.end() ? 0.0 : found->second;
	}

	/// The longest time on the clock between two calls, and the stage.
	double longestSilence() const { return m_silence; }
	const std::string& silentStage() const { return m_silentStage; }

private:
	static std::string stageOf(const std::string& what)
	{
		const std::vector<std::pair<std::string, std::string>> words = {
			{"Choosing the target", "cones"},
			{"Placing cones", "cones"},
			{"Solving for the metric", "flows"},
			{"Newton step", "flows"},
			{"Laying out", "cut"},
			{"Shortening the seams", "cut"},
			{"Placing the pieces of the overlay", "overlay"},
			{"Repairing the map", "finish"},
			{"Looking for overlaps", "charts"},
			{"Packing the charts", "pack"},
			{"Finishing the coordinates", "write"}};
		for (const auto& [word, stage] : words)
			if (what.rfind(word, 0) == 0)
				return stage;
		return "rest";
	}

	std::map<std::string, double> m_cpu;
	std::string m_stage, m_silentStage = "-";
	double m_sinceCpu = 0.0, m_sinceWall = 0.0, m_silence = 0.0;
};

struct Row
{
	std::string name, geometry, target, method, remark = "-";
	std::size_t faces = 0;
	double read = 0, packing = 0, flow = 0, oneFactor = 0;
	double whole = 0, wholeWall = 0, peak = 0, evaluation = 0, speedup = 0;
	StageClock stages;
	double residual = 0;
	int iterations = 0;
	std::size_t flips = 0;
	CholeskyWork work;

	void print() const
	{
		std::cout << name << '\t' << faces << '\t' << geometry;
		const auto add = [&](const auto& value, int digits = 4) {
			std::cout << '\t';
			if (remark == "-")
				std::cout << std::fixed << std::setprecision(digits) << value;
			else
				std::cout << '-';
		};
		add(flow), add(oneFactor), add(flow / oneFactor, 2), add(iterations), add(flips);
		std::ostringstream error;
		error << std::scientific << std::setprecision(1) << residual;
		add(error.str()), add(peak, 0);
		add(read), add(packing), add(whole), add(wholeWall), add(whole / oneFactor, 2);
		for (const std::string& stage : kStages)
			add(stages.cpuOf(stage));
		add(stages.longestSilence(), 3), add(stages.silentStage());
		add(evaluation), add(defaultThreads()), add(speedup, 2);
		add(work.factorizations), add(work.solutions), add(1e-9 * work.flops, 3);
		for (const std::string& text :
			 {target, method, std::string(SparseCholesky::name()), remark})
			std::cout << '\t' << text;
		std::cout << std::endl;
	}
};

/// The automatic target, and uniform curvature where a closed surface has none.
TargetRequest
chooseRequest(const EmbeddedSurface& surface, const Options& options, std::string& name)
{
	const SurfaceType& type = surface.topology.type;
	const int vertexCount = surface.triangulation.vertexCount();
	TargetRequest request;
	request.target = options.target;
	request.goal = coneGoal(options.cones);
	request.rounding = options.cones.rounding;
	request.freeBoundary = options.freeBoundary;
	request.selected.assign(positionOf(vertexCount), 0);
	request.targetCurvature.assign(positionOf(vertexCount), 0.0);
	name = "automatic";
	if (!type.isClosed() || type.isTorus())
		return request;
	name = "uniform";
	request.target = TargetCurvature::Prescribed;
	request.precision = 1e-12;
	request.targetCurvature.assign(
		positionOf(vertexCount),
		2 * kPi * type.eulerCharacteristic() / static_cast<double>(vertexCount));
	return request;
}

#ifdef RICCI_USE_CHOLMOD
/// What the column one_factor_cpu_s says, through CHOLMOD's own interface.
[[gnu::noinline]] void solveOnce(const FactoredHessian::Matrix& matrix)
{
	cholmod_common common;
	cholmod_start(&common);
	common.nmethods = 1;
	common.method[0].ordering = CHOLMOD_AMD;
	common.postorder = 1;
	common.supernodal = CHOLMOD_SUPERNODAL;
	common.print = 0;
	cholmod_sparse view{};
	view.nrow = view.ncol = static_cast<std::size_t>(matrix.rows());
	view.nzmax = static_cast<std::size_t>(matrix.nonZeros());
	view.p = const_cast<int*>(matrix.outerIndexPtr());
	view.i = const_cast<int*>(matrix.innerIndexPtr());
	view.x = const_cast<double*>(matrix.valuePtr());
	view.stype = -1;
	view.itype = CHOLMOD_INT;
	view.xtype = CHOLMOD_REAL;
	view.dtype = CHOLMOD_DOUBLE;
	view.sorted = view.packed = 1;
	cholmod_factor* factor = cholmod_analyze(&view, &common);
	cholmod_factorize(&view, factor, &common);
	const bool solved = factor && common.status == CHOLMOD_OK;
	cholmod_dense* rhs = cholmod_ones(view.nrow, 1, CHOLMOD_REAL, &common);
	cholmod_dense* x = solved ? cholmod_solve(CHOLMOD_A, factor, rhs, &common) : nullptr;
	cholmod_free_dense(&x, &common);
	cholmod_free_dense(&rhs, &common);
	cholmod_free_factor(&factor, &common);
	cholmod_finish(&common);
	if (!solved)
		throw std::runtime_error("The matrix is not positive definite.");
}
#else
[[gnu::noinline]] void solveOnce(const FactoredHessian::Matrix& matrix)
{
	Eigen::SimplicialLDLT<FactoredHessian::Matrix, Eigen::Lower> solver(matrix);
	const Eigen::VectorXd x = solver.solve(Eigen::VectorXd::Ones(matrix.rows()));
	if (solver.info() != Eigen::Success)
		throw std::runtime_error("The matrix is not positive definite.");
}
#endif

double oneFactorisation(const CurvatureMap& map, const Target& target, int repeat)
{
	FactoredHessian hessian(target.fixed, map.scaleInvariant());
	hessian.fill(map);
	double fastest = INFINITY;
	for (int i = 0; i < repeat; ++i)
		fastest = std::min(fastest, timeOf([&] { solveOnce(hessian.matrix()); }));
	return fastest;
}

/// The flow with its start: what core.work_guard counts.
[[gnu::noinline]] FlowResult
startAndFlow(const EmbeddedSurface& surface, const Target& target, const FlowOptions& options)
{
	return testing::runRicciFlow(surface, initialPacking(surface, options), target, options);
}

/// From the mesh to the coordinates that a host stores, with default parameters; core.work_guard
/// counts it.
[[gnu::noinline]] void
measureWholeWay(const SurfaceMesh& mesh, Background background, const Options& options, Row& row)
{
	const double begin = wallSeconds();
	StageClock& clock = row.stages;
	row.whole = timeOf([&] {
		const Task task(clock);
		if (background == Background::EuclideanPlane)
			parametrizeEuclidean(mesh, {}, options);
		else
			parametrizeHyperbolic(mesh, {}, HyperbolicOptions());
		clock.enter("rest");
	});
	row.wholeWall = wallSeconds() - begin;
	row.peak = peakMegabytes();
}

/// The stages on the first component of the mesh; the others would only add up.
void measure(
	const SurfaceMesh& mesh, Background background, bool flowOnly, const Options& options, Row& row)
{
	FlowDomain domain;
	const auto setUp = [&] {
		const std::vector<Component> components = splitIntoComponents(openMesh(mesh));
		domain = flowDomain(components.front(), Holes::Boundaries);
	};
	row.read += timeOf(setUp);
	const EmbeddedSurface& surface = domain.surface;
	row.faces = static_cast<std::size_t>(surface.triangulation.faceCount());
	InitialPacking start;
	Target target;
	if (background == Background::EuclideanPlane)
		target = chooseTarget(surface, start, chooseRequest(surface, options, row.target));
	else {
		row.target = "zero";
		target.background = background;
		target.curvature = VertexVector(Eigen::VectorXd::Zero(surface.triangulation.vertexCount()));
		target.fixed.assign(surface.triangulation.vertexCount(), 0);
	}
	if (!flowOnly) {
		domain = FlowDomain(); // or the peak would be that of this program
		measureWholeWay(mesh, background, options, row);
		setUp();
	}

	// By itself once more; the flow includes it.
	row.packing = timeOf([&] { initialPacking(surface, options); });
	FlowResult flow;
	const int repeat = repetitions(row.faces);
	row.flow = INFINITY;
	for (int i = 0; i < repeat; ++i) {
		flow = FlowResult();
		row.flow =
			std::min(row.flow, timeOf([&] { flow = startAndFlow(surface, target, options); }));
	}
	if (row.peak == 0.0)
		row.peak = peakMegabytes();
	row.work = flow.work;
	row.iterations = flow.iterations;
	row.residual = flow.residual;
	row.flips = static_cast<std::size_t>(flow.flipCount());
	// The matrix of the flow's last step; where the flow ran on the double of the surface, that of
	// the surface itself at the start.
	const testing::Packed packed(surface.triangulation, surface.lengths);
	const VertexVector u = packed.u();
	GeometricCurvatureMap<Euclidean> map = packed.map();
	map.evaluate(u);
	// K(u) and its derivative, what the flow does in several threads, in one and in all of them.
	const auto evaluation = [&](int threads) {
		map.useThreads(threads);
		double fastest = INFINITY;
		for (int i = 0; i < kEvaluations; ++i) {
			const double before = wallSeconds();
			map.evaluate(u);
			fastest = std::min(fastest, wallSeconds() - before);
		}
		return fastest;
	};
	row.evaluation = evaluation(1);
	row.speedup = row.evaluation / evaluation(defaultThreads());
	row.oneFactor = oneFactorisation(flow.doubled ? map : *flow.metric, flow.target, repeat);
}

/// A smooth torus with about so many triangles, its vertices jittered on the surface and the
/// diagonals of its cells random.
SurfaceMesh wavyTorus(double faces)
{
	testing::Random random(1);
	const int nv = std::max(3, static_cast<int>(std::sqrt(faces / 4.0))), nu = 2 * nv;
	SurfaceMesh mesh = testing::grid(
		nu, nv, testing::Ends::Joined, testing::Ends::Joined, [&](int i, int j) -> Point3 {
			const double u = 2 * kPi * (i + random.real(-0.25, 0.25)) / nu;
			const double v = 2 * kPi * (j + random.real(-0.25, 0.25)) / nv;
			const double r = 1.0 + 0.2 * std::sin(5 * u) * std::cos(3 * v),
						 d = 3.0 + r * std::cos(v);
			return {d * std::cos(u), d * std::sin(u), r * std::sin(v)};
		});
	testing::swapDiagonalsAtRandom(mesh, random);
	return mesh;
}

/// A closed surface of genus 2 with about so many triangles, which takes cones and long seams: a slab
/// of cubes with its vertices jittered.
SurfaceMesh slab(double faces)
{
	constexpr int kGenus = 2;
	const double squares = static_cast<double>(testing::perforatedSlab(kGenus, 1).triangles.size());
	const int subdivision = std::max(1, static_cast<int>(std::sqrt(faces / squares)));
	testing::Random random(2);
	return testing::shaken(testing::perforatedSlab(kGenus, subdivision), 0.2 / subdivision, random);
}

SurfaceMesh read(const std::string& path)
{
	const std::size_t colon = path.find(':');
	const std::string name = path.substr(0, colon);
	if (name == "generated" || name == "slab") {
		const double faces =
			colon == std::string::npos ? 50000.0 : std::stod(path.substr(colon + 1));
		return name == "slab" ? slab(faces) : wavyTorus(faces);
	}
#ifdef RICCI_HAVE_VCGLIB
	return testing::readMesh(path);
#else
	throw std::runtime_error(
		"Without vcglib only the meshes generated:FACES and slab:FACES can be measured.");
#endif
}

const std::map<std::string, Method> kMethods = {
	{"intrinsic_flips", Method::IntrinsicFlips},
	{"fixed_triangles", Method::FixedTriangles},
	{"edge_swaps", Method::EdgeSwaps},
	{"thurston", Method::Thurston}};

} // namespace

int main(int argc, char** argv)
{
	Options options;
	Background background = Background::EuclideanPlane;
	bool flowOnly = false; // not the complete run from mesh to plane, which needs more memory
	std::string path;
	std::string method = "intrinsic_flips";
	for (int i = 1; i < argc; ++i) {
		const std::string word = argv[i];
		if (word == "--header") {
			std::puts(kHeader);
			return 0;
		}
		if (word.rfind("--method=", 0) == 0 && kMethods.count(word.substr(9)) > 0) {
			method = word.substr(9);
			options.method = kMethods.at(method);
		}
		else if (word.rfind("--cone-distortion=", 0) == 0)
			options.cones.distortion = std::stod(word.substr(18));
		else if (word == "--flow-only")
			flowOnly = true;
		else if (word == "--geometry=euclidean")
			background = Background::EuclideanPlane;
		else if (word == "--geometry=hyperbolic")
			background = Background::HyperbolicPlane;
		else if (path.empty() && word.rfind("--", 0) != 0)
			path = word;
		else
			path.clear(), i = argc;
	}
	if (path.empty()) {
		std::cerr << "usage: ricci_bench --header | "
					 "[--method=intrinsic_flips|fixed_triangles|edge_swaps|thurston] "
					 "[--geometry=euclidean|hyperbolic] [--flow-only] [--cone-distortion=X] "
					 "MESH|generated[:FACES]|slab[:FACES]\n";
		return 2;
	}
	Row row;
	row.name = std::filesystem::path(path).stem().string();
	row.method = method;
	row.geometry = background == Background::EuclideanPlane ? "euclidean" : "hyperbolic";
	int status = 0;
	try {
		SurfaceMesh mesh;
		row.read = timeOf([&] { mesh = read(path); });
		measure(mesh, background, flowOnly, options, row);
	}
	catch (const std::exception& error) {
		row.remark = error.what();
		status = 1;
	}
	row.print();
	return status;
}
