// SPDX-License-Identifier: GPL-3.0-or-later
// Runs at the façade on meshes so small that each can be repeated for every call and allocation in it.
#ifndef RICCI_TESTS_FACADE_RUNS_H
#define RICCI_TESTS_FACADE_RUNS_H

#include "shapes.h"
#include "vcg_mesh.h"

#include <vcg/complex/algorithms/parametrization/ricci_flow.h>

#include <functional>
#include <string>
#include <vector>

namespace ricci::testing {

/// A call of RicciFlow::Compute().
struct FacadeCase
{
	std::string name;
	SurfaceMesh mesh;
	Options params;
};

/// Between them they reach flips, the double, splits, seams and packing. Cuts for packing, for which charts are
/// packed again and again, are left to one of the facadeRuns().
std::vector<FacadeCase> facadeCases();

/// A way through the façade that reads \p m and writes nothing; it returns the Newton steps it tells of.
struct FacadeRun
{
	std::string name; ///< letters and digits
	SurfaceMesh mesh;
	std::function<int(const FloatMesh& m)> run;
};
std::vector<FacadeRun> facadeRuns();

inline std::ostream& operator<<(std::ostream& out, const FacadeRun& run)
{
	return out << run.name;
}

/// \p shape with something in quality and texture coordinates.
template<class Mesh>
void build(const SurfaceMesh& shape, Mesh& m)
{
	toVcg(shape, m);
	float value = 0.0f;
	for (auto& v : m.vert)
		v.Q() = value += 0.25f;
	for (auto& f : m.face)
		for (int k = 0; k < 3; ++k) {
			f.WT(k).U() = value += 0.125f;
			f.WT(k).N() = 3;
		}
}

/// Writes all that a filter would.
void write(
	FloatMesh& m, const Options& params, const vcg::tri::RicciFlow<FloatMesh>::Result& result);

} // namespace ricci::testing

#endif
