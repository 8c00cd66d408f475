// SPDX-License-Identifier: GPL-3.0-or-later
// CPU time of each stage for one mesh, and the time of the flow as a multiple of one analysis,
// factorisation and solution of the same matrix: a number that does not depend on the machine's
// speed. One process measures one mesh, so that the peak of its memory means something; it is that of
// the whole way from mesh to plane, which runs first.
#include "support/random_surface.h"
#include "support/shapes.h"
#ifdef RICCI_HAVE_VCGLIB
#include "support/mesh_file.h"
#endif

#include <ricci/flow/hessian.h>
#include <ricci/flow/ricci_flow.h>
#include <ricci/flow/sparse_cholesky.h>
#include <ricci/flow/target_curvature.h>
#include <ricci/layout/cut_graph.h>
#include <ricci/layout/distortion.h>
#include <ricci/layout/planar_layout.h>
#include <ricci/metric/delaunay_start.h>
#include <ricci/metric/euclidean.h>
#include <ricci/parallel.h>
#include <ricci/parametrize.h>
#include <ricci/surface/component.h>

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
#include <iostream>
#include <string>
#include <vector>

namespace {

using namespace ricci;

constexpr double kPi = 3.14159265358979323846;

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
	"\tpeak_mb\tread_cpu_s\tpacking_cpu_s\tcut_cpu_s\tlayout_cpu_s\tdistortion_cpu_s"
	"\twhole_cpu_s\twhole_wall_s\tevaluation_wall_s\tthreads\tthread_"
	"speedup\tfactorizations\tsolutions\tgflop\ttarget\tsurgery\tsolver"
	"\tremark";

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

struct Row
{
	std::string name, geometry, target, surgery, remark = "-";
	std::size_t faces = 0;
	double read = 0, packing = 0, flow = 0, oneFactor = 0, cut = 0, layout = 0, distortion = 0;
	double whole = 0, wholeWall = 0, peak = 0, evaluation = 0, speedup = 0;
	double residual = 0;
	int iterations = 0;
	std::size_t flips = 0;
	CholeskyWork work;

	void print() const
	{
		std::printf("%s\t%zu\t%s", name.c_str(), faces, geometry.c_str());
		if (remark == "-")
			std::printf(
				"\t%.4f\t%.4f\t%.2f\t%d\t%zu\t%.1e\t%.0f\t%.4f\t%.4f\t%.4f\t%.4f\t%.4f\t%.4f\t%.4f"
				"\t%.4f\t%d\t%.2f\t%d\t%d\t%.3f",
				flow,
				oneFactor,
				flow / oneFactor,
				iterations,
				flips,
				residual,
				peak,
				read,
				packing,
				cut,
				layout,
				distortion,
				whole,
				wholeWall,
				evaluation,
				defaultThreads(),
				speedup,
				work.factorizations,
				work.solutions,
				1e-9 * work.flops);
		else
			for (int column = 0; column < 20; ++column)
				std::printf("\t-");
		std::printf(
			"\t%s\t%s\t%s\t%s\n",
			target.c_str(),
			surgery.c_str(),
			SparseCholesky::name(),
			remark.c_str());
	}
};

/// The automatic target, and uniform curvature where a closed surface has none.
TargetRequest chooseRequest(const Topology& topology, std::size_t vertexCount, std::string& name)
{
	TargetRequest request;
	request.selected.assign(vertexCount, 0);
	request.prescribed.assign(vertexCount, 0.0);
	name = "automatic";
	if (!topology.isClosed() || topology.isTorus())
		return request;
	name = "uniform";
	request.mode = TargetCurvature::Prescribed;
	request.prescribedPrecision = 1e-12;
	std::fill(
		request.prescribed.begin(),
		request.prescribed.end(),
		2 * kPi * topology.eulerCharacteristic / static_cast<double>(vertexCount));
	return request;
}

#ifdef RICCI_USE_CHOLMOD
/// What the column one_factor_cpu_s says, through CHOLMOD's own interface.
void solveOnce(const Hessian::Matrix& matrix)
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
void solveOnce(const Hessian::Matrix& matrix)
{
	Eigen::SimplicialLDLT<Hessian::Matrix, Eigen::Lower> solver(matrix);
	const Eigen::VectorXd x = solver.solve(Eigen::VectorXd::Ones(matrix.rows()));
	if (solver.info() != Eigen::Success)
		throw std::runtime_error("The matrix is not positive definite.");
}
#endif

double oneFactorisation(const CurvatureMap& map, const Target& target, int repeat)
{
	std::vector<int> unknown(target.fixed.size(), -1);
	const bool anyFixed =
		std::find(target.fixed.begin(), target.fixed.end(), 1) != target.fixed.end();
	int count = 0;
	for (std::size_t v = anyFixed || !map.scaleInvariant() ? 0 : 1; v < unknown.size(); ++v)
		if (!target.fixed[v])
			unknown[v] = count++;
	Hessian hessian;
	hessian.layOut(map, unknown, count);
	hessian.fill(map, 0.0);
	double least = INFINITY;
	for (int i = 0; i < repeat; ++i)
		least = std::min(least, timeOf([&] { solveOnce(hessian.matrix()); }));
	return least;
}

/// The first component of the mesh; the others would only add up.
void measure(
	const SurfaceMesh& mesh, Background background, bool flowOnly, const Options& options, Row& row)
{
	Component component;
	Triangulation t;
	std::vector<double> lengths;
	const auto setUp = [&] {
		std::vector<std::string> notes;
		component = std::move(splitIntoComponents(mesh, notes).front());
		t = Triangulation(static_cast<int>(component.positions.size()), component.triangles);
		lengths = edgeLengths(t, component.positions);
	};
	row.read += timeOf(setUp);
	row.faces = component.triangles.size();
	const Topology topology = topologyOf(t);
	Target target;
	if (background == Background::EuclideanPlane)
		target = chooseTarget(
			t,
			topology,
			lengths,
			component.positions,
			chooseRequest(topology, component.positions.size(), row.target));
	else {
		row.target = "zero";
		target.curvature.setZero(t.vertexCount());
		target.fixed.assign(component.positions.size(), 0);
	}
	// A uniform curvature makes every vertex a cone, which no one wants to see cut open.
	if (row.target == "automatic" && !flowOnly) {
		component = Component(); // or the peak would be that of this program
		t = Triangulation();
		lengths = std::vector<double>();
		Progress silent;
		const double start = wallSeconds();
		row.whole = timeOf([&] { parametrizeEuclidean(mesh, {}, options, silent); });
		row.wholeWall = wallSeconds() - start;
		row.peak = peakMegabytes();
		setUp();
	}

	// By itself once more; the flow includes it.
	row.packing = timeOf([&] {
		if (options.surgery == Surgery::IntrinsicFlips) {
			const DelaunayStart start = delaunayStart({t, lengths}, {});
			inversiveDistancePacking(start.mesh.triangulation, start.mesh.lengths, start.radii);
		}
		else
			inversiveDistancePacking(t, lengths, initialRadii(t, lengths));
	});
	FlowResult flow;
	const int repeat = repetitions(row.faces);
	row.flow = INFINITY;
	for (int i = 0; i < repeat; ++i) {
		flow = FlowResult();
		row.flow =
			std::min(row.flow, timeOf([&] {
						 flow = runRicciFlow(
							 background,
							 t,
							 lengths,
							 component.positions,
							 target,
							 topology.loops.empty() ? std::vector<int>() : topology.loops.front(),
							 options,
							 [](int, double) {});
					 }));
	}
	if (row.peak == 0.0)
		row.peak = peakMegabytes();
	row.work = flow.work;
	row.iterations = flow.iterations;
	row.residual = flow.residual;
	row.flips = flow.history.startFlips.size() + flow.history.flowFlips.size() +
				static_cast<std::size_t>(flow.edgeSwaps);
	// The matrix of the flow's last step; where the flow ran on the double of the surface, that of
	// the surface itself at the start.
	GeometricCurvatureMap<Euclidean> start(
		inversiveDistancePacking(t, lengths, initialRadii(t, lengths)));
	start.evaluate(Eigen::Map<const Eigen::VectorXd>(
		start.packing().u.data(), static_cast<Eigen::Index>(start.packing().u.size())));
	// K(u) and its derivative, what the flow does in several threads, in one and in all of them.
	const auto evaluation = [&](int threads) {
		start.useThreads(threads);
		double least = INFINITY;
		for (int i = 0; i < kEvaluations; ++i) {
			const double before = wallSeconds();
			start.evaluate(Eigen::Map<const Eigen::VectorXd>(
				start.packing().u.data(), static_cast<Eigen::Index>(start.packing().u.size())));
			least = std::min(least, wallSeconds() - before);
		}
		return least;
	};
	row.evaluation = evaluation(1);
	row.speedup = row.evaluation / evaluation(defaultThreads());
	row.oneFactor = oneFactorisation(flow.doubled ? start : *flow.metric, flow.target, repeat);

	// Cut, layout and distortion on the input's triangles with the input's metric: the work is that
	// on the flat one.
	CutGraph cut;
	PlanarLayout layout;
	const std::vector<char> marked(component.positions.size(), 0);
	row.cut = timeOf([&] { cut = cutToDisk(t, lengths, marked, {}); });
	row.layout = timeOf([&] { layout = layOutInPlane(t, lengths, start.angles(), cut.isCut); });
	std::vector<std::array<Point2, 3>> uv;
	for (int f = 0; f < t.faceCount(); ++f) {
		const auto h = t.halfedges(f);
		uv.push_back({layout.at(h[0]), layout.at(h[1]), layout.at(h[2])});
	}
	const SurfaceMesh surface{component.positions, component.triangles};
	Report report;
	const std::vector<char> reversed(uv.size(), 0);
	row.distortion = timeOf([&] { measureDistortion(surface, uv, reversed, report); });
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

SurfaceMesh read(const std::string& path)
{
	const std::string generated = "generated";
	if (path.rfind(generated, 0) == 0)
		return wavyTorus(
			path == generated ? 50000.0 : std::stod(path.substr(generated.size() + 1)));
#ifdef RICCI_HAVE_VCGLIB
	return testing::readMesh(path);
#else
	throw std::runtime_error("Without vcglib only the meshes generated:FACES can be measured.");
#endif
}

} // namespace

int main(int argc, char** argv)
{
	Options options;
	Background background = Background::EuclideanPlane;
	bool flowOnly = false; // not the whole way from mesh to plane, which needs more memory
	std::string path;
	const auto surgeryName = [&] {
		return options.surgery == Surgery::None       ? "none"
			   : options.surgery == Surgery::EdgeSwap ? "edge_swap"
													  : "intrinsic_flips";
	};
	for (int i = 1; i < argc; ++i) {
		const std::string word = argv[i];
		if (word == "--header") {
			std::puts(kHeader);
			return 0;
		}
		if (word == "--surgery=none")
			options.surgery = Surgery::None;
		else if (word == "--surgery=edge_swap")
			options.surgery = Surgery::EdgeSwap;
		else if (word == "--surgery=intrinsic_flips")
			options.surgery = Surgery::IntrinsicFlips;
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
		std::cerr << "usage: ricci_bench --header | [--surgery=none|edge_swap|intrinsic_flips] "
					 "[--geometry=euclidean|hyperbolic] [--flow-only] MESH|generated[:FACES]\n";
		return 2;
	}
	Row row;
	row.name = std::filesystem::path(path).stem().string();
	row.surgery = surgeryName();
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
