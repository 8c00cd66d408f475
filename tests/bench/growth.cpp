// SPDX-License-Identifier: GPL-3.0-or-later
// How processor time grows with the size of the input: generated cases, each of three sizes n, 4n and 16n, and
// the exponent between the last two. Everyday inputs of which some stage could make more than n log n.
#include "support/implicit_surface.h"
#include "support/random_surface.h"
#include "support/shapes.h"
#include "texture/painted_square.h"

#include <ricci/base/numbers.h>
#include <ricci/base/task.h>
#include <ricci/mesh/sides.h>
#include <ricci/parametrize.h>
#include <ricci/progress.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <exception>
#include <functional>
#include <string>
#include <vector>

namespace {

using namespace ricci;
using testing::Ends;

double cpuSeconds()
{
	return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

/// Ends what takes too long.
class Patience : public Progress
{
public:
	bool update(double, const std::string&) override { return cpuSeconds() < m_end; }

private:
	double m_end = cpuSeconds() + 300.0;
};

/// A strip that goes round an axis by so many turns; with a \p ridge along it a screw thread.
SurfaceMesh helicoid(int turns, double ridge)
{
	const int across = 6, around = 40;
	return testing::grid(
		across, around * turns, Ends::Open, Ends::Open, [=](int i, int j) -> Point3 {
			const double s = static_cast<double>(i) / across, a = 2 * kPi * j / around;
			const double height = 0.3 * a + ridge * std::abs(s - 0.5);
			return {(1 + s) * std::cos(a), (1 + s) * std::sin(a), height};
		});
}

/// A slightly bent sheet with rows x rows square holes.
SurfaceMesh plate(int rows)
{
	const int n = 6 * rows;
	const SurfaceMesh whole =
		testing::grid(n, n, Ends::Open, Ends::Open, [=](int i, int j) -> Point3 {
			const double x = static_cast<double>(i) / n, y = static_cast<double>(j) / n;
			return {x, y, 0.3 * std::sin(2 * x) * std::cos(1.5 * y)};
		});
	return testing::partOf(whole, [&](std::size_t f) {
		const int cell = static_cast<int>(f / 2);
		return cell / n % 6 / 2 != 1 || cell % n % 6 / 2 != 1;
	});
}

/// That sheet with two sides: a closed surface of genus rows^2.
SurfaceMesh slab(int rows)
{
	SurfaceMesh mesh = plate(rows);
	const int below = static_cast<int>(mesh.positions.size());
	for (int v = 0; v < below; ++v)
		mesh.positions.push_back(mesh.positions[testing::at(v)] - Point3{0, 0, 0.3 / rows});
	const std::vector<Triangle> above = mesh.triangles;
	const Sides sides(above);
	for (const Triangle& t : above)
		mesh.triangles.push_back({t[0] + below, t[2] + below, t[1] + below});
	for (int f = 0; f < static_cast<int>(above.size()); ++f)
		for (const Corner side : cornersOf(f))
			if (!sides.across()[side].isValid()) {
				const int a = above[testing::at(f)][side.index()];
				const int b = above[testing::at(f)][side.next().index()];
				mesh.triangles.push_back({b, a, a + below});
				mesh.triangles.push_back({b, a + below, b + below});
			}
	return mesh;
}

/// What marching cubes find of waves in a ball of so many units of volume: folds and handles everywhere, as of a
/// cortex, and edges bent by roughness.
SurfaceMesh folds(int volume)
{
	testing::Random random(5);
	std::vector<std::array<double, 4>> waves(20);
	for (std::array<double, 4>& wave : waves) {
		for (double& x : wave)
			x = random.real(-1.0, 1.0);
		const double size = std::hypot(wave[0], wave[1], wave[2]);
		for (std::size_t k = 0; k < 3; ++k)
			wave[k] *= 9.0 / size;
		wave[3] *= kPi;
	}
	const double r = std::cbrt(volume);
	const auto level = [&](const Point3& p) {
		double sum = 0.0;
		for (const auto& [x, y, z, phase] : waves)
			sum += std::cos(x * p[0] + y * p[1] + z * p[2] + phase);
		return std::max(sum, std::hypot(p[0], p[1], p[2]) - r);
	};
	const double side = 1.1 * r;
	const int cells = static_cast<int>(32 * r);
	return testing::marchingCubes(
		level, {-side, -side, -side}, {side, side, side}, {cells, cells, cells});
}

/// A closed body of 6000 triangles without symmetry.
SurfaceMesh body()
{
	std::vector<std::array<double, 2>> profile;
	const int rings = 50;
	for (int i = 0; i <= rings; ++i) {
		const double a = kPi * i / rings;
		const double r = i % rings == 0 ? 0.0 : std::sin(a) * (1.0 + 0.4 * std::sin(5 * a));
		profile.push_back({r, -1.5 * std::cos(a)});
	}
	testing::Random random(3);
	return testing::shaken(testing::revolved(profile, 60), 0.01, random);
}

/// A round can whose walls and ends are needles.
SurfaceMesh can(int around)
{
	return testing::revolved({{0.0, 0.0}, {1.0, 0.0}, {1.0, 3.0}, {0.0, 3.0}}, around);
}

/// Draws 2048 x 2048 texels of 30000 faces with a picture of 1024 x 1024, repeated so often in each direction.
void drawTiles(int tiles)
{
	const testing::Square square(122);
	testing::Random random(4);
	testing::Picture<unsigned char> old(1024, 1024);
	for (unsigned char& sample : old.rgba)
		sample = static_cast<unsigned char>(random.index(256));
	const auto tiled = testing::mapped(square.place, [=](const Point2& p) {
		return Point2{tiles * p[0], tiles * p[1]};
	});
	testing::carried<unsigned char>(
		testing::carriedMesh(square, tiled, square.place), {&old}, 2048);
}

struct Case
{
	std::string name, unit;
	int first; ///< n
	std::function<void(int n)> run;
};

std::vector<Case> cases()
{
	const auto flatten = [](const SurfaceMesh& mesh, const Options& options = {}) {
		parametrizeEuclidean(mesh, {}, options);
	};
	const auto root = [](int n) { return static_cast<int>(std::lround(std::sqrt(n))); };
	Options boundaries, refined;
	boundaries.holes = Holes::Boundaries;
	refined.output = OutputTriangulation::CommonRefinement;
	return {
		{"helicoid", "turns", 20, [=](int n) { flatten(helicoid(n, 0.0)); }},
		{"thread", "turns", 20, [=](int n) { flatten(helicoid(n, 0.5)); }},
		{"plate", "holes", 64, [=](int n) { flatten(plate(root(n))); }},
		{"plate, holes open", "holes", 64, [=](int n) { flatten(plate(root(n)), boundaries); }},
		{"slab", "genus", 9, [=](int n) { flatten(slab(root(n))); }},
		{"folds", "volume", 1, [=](int n) { flatten(folds(n)); }},
		{"cones",
		 "cones",
		 50,
		 [=](int n) {
			 Options options;
			 options.target = TargetCurvature::PlacedCones;
			 options.cones.count = n;
			 flatten(body(), options);
		 }},
		{"needles", "around", 1000, [=](int n) { flatten(can(n)); }},
		{"refinement of needles", "around", 250, [=](int n) { flatten(can(n), refined); }},
		{"texture", "tiles", 1024, [=](int n) { drawTiles(root(n)); }}};
}

/// Processor seconds; none if it fails or takes too long, which is told.
double timeOf(const Case& growing, int n)
{
	try {
		Patience patience;
		const Task task(patience);
		const double start = cpuSeconds();
		growing.run(n);
		return cpuSeconds() - start;
	}
	catch (const std::exception& error) {
		std::fprintf(
			stderr, "%s, %d %s: %s\n", growing.name.c_str(), n, growing.unit.c_str(), error.what());
		return NAN;
	}
}

} // namespace

/// \param argv parts of the names of cases; none: all
int main(int argc, char** argv)
{
	std::puts("case\tunit\tn\tcpu_s\tcpu_s_4n\tcpu_s_16n\texponent");
	for (const Case& growing : cases()) {
		bool isWanted = argc < 2;
		for (int i = 1; i < argc; ++i)
			isWanted = isWanted || growing.name.find(argv[i]) != std::string::npos;
		if (!isWanted)
			continue;
		double seconds[3];
		for (int i = 0; i < 3; ++i)
			seconds[i] = timeOf(growing, growing.first << 2 * i);
		std::printf(
			"%s\t%s\t%d\t%.2f\t%.2f\t%.2f\t%.2f\n",
			growing.name.c_str(),
			growing.unit.c_str(),
			growing.first,
			seconds[0],
			seconds[1],
			seconds[2],
			std::log(seconds[2] / seconds[1]) / std::log(4.0));
		std::fflush(stdout);
	}
}
