// SPDX-License-Identifier: GPL-3.0-or-later
#include "facade_runs.h"

#include "random_surface.h"

#include <vcg/complex/algorithms/parametrization/ricci_flow_layers.h>

namespace ricci::testing {

namespace {

using Flow = vcg::tri::RicciFlow<FloatMesh>;
using Layers = vcg::tri::RicciFlowLayers<FloatMesh>;

Options
params(TargetCurvature target, OutputTriangulation output, Method method = Method::IntrinsicFlips)
{
	Options p;
	p.target = target;
	p.output = output;
	p.method = method;
	p.charts = Charts::WithoutOverlap;
	return p;
}

} // namespace

std::vector<FacadeCase> facadeCases()
{
	constexpr auto kKept = OutputTriangulation::KeepMesh;
	constexpr auto kRefined = OutputTriangulation::CommonRefinement;
	Random random(500);
	const SurfaceMesh torus = shaken(bumpyTorus(5, 4, random), 0.4, random);
	const SurfaceMesh sheet = shaken(rectangle(3, 3, 3, 3), 0.35, random);
	return {
		{"RefinedTorus", torus, params(TargetCurvature::Automatic, kRefined)},
		{"FixedTorus",
		 bumpyTorus(5, 4, random),
		 params(TargetCurvature::Automatic, kKept, Method::FixedTriangles)},
		{"RoundDisk", sheet, params(TargetCurvature::Disk, kRefined)},
		{"SwappedDisk", sheet, params(TargetCurvature::Automatic, kKept, Method::EdgeSwaps)},
		{"TwoDisks",
		 sideBySide(sheet, rectangle(1, 2, 1, 1), 9),
		 params(TargetCurvature::Automatic, kKept)}};
}

std::vector<FacadeRun> facadeRuns()
{
	std::vector<FacadeRun> all;
	for (const FacadeCase& c : facadeCases())
		all.push_back({c.name, c.mesh, [p = c.params](const FloatMesh& m) {
						   return Flow::Compute(m, p).report.iterations;
					   }});
	const auto hyperbolic = [](const FloatMesh& m) {
		HyperbolicOptions p;
		p.output = OutputTriangulation::CommonRefinement;
		p.canonicalGenerators = true;
		const Flow::Result result = Flow::ComputeHyperbolic(m, p);
		FloatMesh flat, cover, axes, polygon;
		Layers::BuildFlatMesh(result, flat);
		Layers::BuildUniversalCover(result, 1, 100000, cover);
		Layers::BuildAxes(result, 10, axes);
		Layers::BuildCanonicalPolygons(result, 10, polygon);
		return result.report.iterations;
	};
	const auto euclidean = [](const Options& p) {
		return [p](const FloatMesh& m) {
			FloatMesh flat;
			const Flow::Result result = Flow::Compute(m, p);
			Layers::BuildFlatMesh(result, flat);
			return result.report.iterations;
		};
	};
	Options cones, capped;
	cones.cones.count = 5;
	capped.holes = Holes::Capped;
	capped.charts = Charts::WithoutOverlap;
	all.push_back({"Hyperbolic", perforatedSlab(2, 1), hyperbolic});
	all.push_back({"PlacedCones", perforatedSlab(0, 1), euclidean(cones)});
	all.push_back({"CappedRing", ring(1, 2, 5, 2), euclidean(capped)});
	all.push_back({"Sphere", perforatedSlab(0, 1), [](const FloatMesh& m) {
					   FloatMesh sphere;
					   Layers::BuildSphereMesh(m, Flow::ComputeSphere(m, {}), sphere);
					   return 0;
				   }});
	return all;
}

void write(FloatMesh& m, const Options& params, const Flow::Result& result)
{
	if (params.output == OutputTriangulation::CommonRefinement) {
		Flow::WriteRefinement(m, result);
		return;
	}
	Flow::WriteVertexQuality(m, result);
	Flow::WriteWedgeTexCoord(m, result);
}

} // namespace ricci::testing
