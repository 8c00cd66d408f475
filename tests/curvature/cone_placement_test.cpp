// SPDX-License-Identifier: GPL-3.0-or-later
#include "dense_flow.h"

#include "support/expect.h"
#include "support/packed.h"
#include "support/random_surface.h"
#include "support/run_flow.h"
#include "support/shapes.h"
#include "support/transform.h"

#include <ricci/base/numbers.h>
#include <ricci/curvature/area_change.h>
#include <ricci/curvature/cone_model.h>
#include <ricci/curvature/cone_placement.h>
#include <ricci/curvature/target_curvature.h>
#include <ricci/error.h>
#include <ricci/parametrize.h>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace ricci::testing {
namespace {

constexpr double kQuarter = 0.5 * kPi;

/// As the pipeline places them: with the start of the flow.
PlacedCones place(const Packed& p, const ConeRequest& request)
{
	const EmbeddedSurface surface = surfaceOf(p);
	InitialPacking start = initialPacking(surface, FlowOptions());
	return placeCones(surface, start, request);
}

PlacedCones place(const Packed& p, int count, ConeRounding rounding = ConeRounding::Free)
{
	ConeRequest request;
	request.count = count;
	request.rounding = rounding;
	return place(p, request);
}

double sum(const std::vector<double>& x)
{
	double s = 0.0;
	for (double a : x)
		s += a;
	return s;
}

void expectAdmissible(const Packed& p, const PlacedCones& cones)
{
	const auto boundary = p.triangulation.boundaryVertices();
	ASSERT_EQ(cones.vertices.size(), cones.curvatures.size());
	for (std::size_t i = 0; i < cones.vertices.size(); ++i) {
		EXPECT_LE(cones.curvatures[i], 1.5 * kPi);
		EXPECT_NE(cones.curvatures[i], 0.0);
		EXPECT_FALSE(boundary[cones.vertices[i]]);
		if (i > 0) {
			EXPECT_LT(cones.vertices[i - 1], cones.vertices[i]);
		}
	}
}

TEST(ConePlacement, IsAdmissibleOnClosedSurfacesOfEveryGenus)
{
	Random random(700);
	for (int genus = 0; genus <= 3; ++genus) {
		const Packed p(shaken(perforatedSlab(genus, 3), 0.04, random));
		const int chi = 2 - 2 * genus;
		for (ConeRounding rounding : {ConeRounding::Free, ConeRounding::QuarterTurns})
			for (int count : {0, 4, 9}) {
				SCOPED_TRACE("genus " + std::to_string(genus) + ", " + std::to_string(count));
				const PlacedCones cones = place(p, count, rounding);
				expectAdmissible(p, cones);
				EXPECT_NEAR(sum(cones.curvatures), 2 * kPi * chi, 1e-11);
				if (count > 0) {
					EXPECT_LE(static_cast<int>(cones.vertices.size()), count);
				}
				if (rounding == ConeRounding::Free)
					continue;
				for (double k : cones.curvatures)
					EXPECT_NEAR(k / kQuarter, std::round(k / kQuarter), 1e-12);
			}
	}
}

TEST(ConePlacement, FindsTheCornersOfABox)
{
	// A box is flat but for its eight corners of pi/2: no area has to change.
	for (int subdivision : {2, 3, 4, 6}) {
		const Packed p(perforatedSlab(0, subdivision));
		GeometricCurvatureMap<Euclidean> map = p.map();
		map.evaluate(p.u());
		for (ConeRounding rounding : {ConeRounding::Free, ConeRounding::QuarterTurns}) {
			const PlacedCones cones = place(p, 8, rounding);
			ASSERT_EQ(cones.vertices.size(), 8u);
			for (std::size_t i = 0; i < 8; ++i) {
				EXPECT_NEAR(cones.curvatures[i], kQuarter, 1e-9);
				EXPECT_NEAR(map.curvature()[cones.vertices[i]], kQuarter, 1e-9);
			}
			EXPECT_LT(cones.distortion, 1e-9);
		}
	}
}

TEST(ConePlacement, PredictsTheDistortionOfTheLinearFlow)
{
	Random random(701);
	for (int genus : {0, 2}) {
		const Packed p(shaken(perforatedSlab(genus, 2), 0.05, random));
		const DenseFlow flow(p);
		const PlacedCones cones = place(p, 6);
		const double own = flow.distortion(cones.vertices, cones.curvatures);
		EXPECT_NEAR(cones.distortion, own, 1e-6 * (1.0 + own));
		// The curvatures are the best for these vertices: moving some from one to another costs.
		for (std::size_t i = 0; i < cones.vertices.size(); ++i)
			for (std::size_t j = 0; j < cones.vertices.size(); ++j) {
				std::vector<double> other = cones.curvatures;
				other[i] += 0.05;
				other[j] -= 0.05;
				const bool allowed = other[i] <= 1.5 * kPi;
				if (i != j && allowed) {
					EXPECT_GT(flow.distortion(cones.vertices, other), own);
				}
			}
	}
}

TEST(ConePlacement, DistortionFallsAsConesAreAdded)
{
	Random random(702);
	for (int genus = 0; genus <= 2; ++genus) {
		const Packed p(shaken(perforatedSlab(genus, 4), 0.05, random));
		double before = 1e300;
		for (int count : {3, 6, 12, 24}) {
			const PlacedCones cones = place(p, count);
			EXPECT_LT(cones.distortion, before) << "genus " << genus << ", " << count << " cones";
			before = cones.distortion;
		}
	}
}

TEST(ConePlacement, CountsAsManyAsTheDistortionAsksFor)
{
	Random random(703);
	const Packed p(shaken(perforatedSlab(1, 4), 0.05, random));
	std::size_t before = 0;
	for (double distortion : {0.8, 0.4, 0.2}) {
		ConeRequest request;
		request.distortion = distortion;
		const PlacedCones cones = place(p, request);
		EXPECT_LE(cones.distortion, distortion);
		EXPECT_GE(cones.vertices.size(), before);
		before = cones.vertices.size();
	}
}

/// Cones that were found on aggregates have the curvatures of the least energy on the surface itself, or,
/// as quarter turns, some of the right sum.
TEST(ConePlacement, FitsWhatWasFoundOnAggregates)
{
	Random random(706);
	const Packed p(shaken(perforatedSlab(1, 31), 0.002, random));
	ASSERT_GT(p.triangulation.vertexCount(), 20000);
	const EmbeddedSurface surface = surfaceOf(p);
	InitialPacking start = initialPacking(surface, FlowOptions());
	LinearFlow flow(surface, start, ConeBoundary::Fixed);
	const PlacedCones cones = placeCones(surface, flow, ConeRequest());
	expectAdmissible(p, cones);
	EXPECT_NEAR(sum(cones.curvatures), 0.0, 1e-9);
	ConeModel model(flow, 0.0);
	model.append(cones.vertices);
	model.fit();
	EXPECT_GT(cones.distortion, (1.0 - 1e-9) * model.exactDistortion());
	EXPECT_LT(cones.distortion, (1.0 + 1e-5) * model.exactDistortion());
	ConeRequest request;
	request.rounding = ConeRounding::QuarterTurns;
	const PlacedCones rounded = placeCones(surface, flow, request);
	EXPECT_NEAR(sum(rounded.curvatures), 0.0, 1e-9);
	for (const double k : rounded.curvatures)
		EXPECT_NEAR(k / kQuarter, std::round(k / kQuarter), 1e-12);
}

TEST(ConePlacement, KeepsItsPromisesOnLargeSurfaces)
{
	Random random(705);
	for (int genus = 0; genus <= 1; ++genus) {
		const SurfaceMesh mesh = shaken(perforatedSlab(genus, genus == 0 ? 28 : 20), 0.002, random);
		ASSERT_GT(mesh.positions.size(), 10000u);
		const Packed p(mesh);
		ConeRequest request;
		request.distortion = 0.4;
		const PlacedCones cones = place(p, request);
		expectAdmissible(p, cones);
		EXPECT_NEAR(sum(cones.curvatures), 4 * kPi * (1 - genus), 1e-9);
		EXPECT_LE(cones.distortion, 0.4);
		// One cone less does not reach it.
		const PlacedCones fewer = place(p, static_cast<int>(cones.vertices.size()) - 1);
		EXPECT_GT(fewer.distortion, 0.4) << "genus " << genus;
		const PlacedCones rounded = place(p, 10, ConeRounding::QuarterTurns);
		EXPECT_NEAR(sum(rounded.curvatures), 4 * kPi * (1 - genus), 1e-9);
		for (const double k : rounded.curvatures)
			EXPECT_NEAR(k / kQuarter, std::round(k / kQuarter), 1e-12);
	}
}

TEST(ConePlacement, TheFlowReachesThePredictedDistortion)
{
	// The linear problem is that of smooth surfaces; the flow's own distortion agrees with it where
	// the mesh resolves the factor.
	Random random(704);
	const SurfaceMesh mesh = shaken(perforatedSlab(0, 8), 0.01, random);
	const PlacedCones cones = place(Packed(mesh), 6);
	Options options;
	options.target = TargetCurvature::PlacedCones;
	options.cones.count = 6;
	options.output = OutputTriangulation::CommonRefinement;
	const Parametrization map = parametrizeEuclidean(mesh, {}, options);
	EXPECT_EQ(map.report.cones, static_cast<int>(cones.vertices.size()));
	EXPECT_NEAR(map.report.areaDistortionSpread, cones.distortion, 0.1 * cones.distortion);
}

TEST(ConePlacement, LowersTheDistortionInsideABoundary)
{
	Random random(705);
	for (const SurfaceMesh& mesh :
		 {withoutStars(shaken(perforatedSlab(0, 4), 0.05, random), {0}),
		  withoutStars(shaken(perforatedSlab(1, 4), 0.05, random), {0, 40})}) {
		const Packed p(mesh);
		for (ConeBoundary boundary : {ConeBoundary::Fixed, ConeBoundary::Prescribed}) {
			ConeRequest request;
			request.boundary = boundary;
			double before = 1e300;
			for (int count : {1, 4, 10}) {
				request.count = count;
				const PlacedCones cones = place(p, request);
				expectAdmissible(p, cones);
				EXPECT_LT(cones.distortion, before);
				before = cones.distortion;
			}
		}
		// With a prescribed boundary all curvatures together obey Gauss-Bonnet.
		TargetRequest request;
		request.options.target = TargetCurvature::PlacedCones;
		request.options.freeBoundary = false;
		request.options.cones.count = 3;
		const EmbeddedSurface surface = surfaceOf(p);
		InitialPacking start = initialPacking(surface, FlowOptions());
		const Target target = chooseTarget(surface, start, request);
		EXPECT_NEAR(
			target.curvature.sum(), 2 * kPi * surface.topology.type.eulerCharacteristic(), 1e-10);
	}
}

/// Energy and price of seams that are expected.
double cost(const PlacedCones& cones)
{
	return expectedEnergy(cones.distortion) + kSeamPrice * cones.seams;
}

TEST(ConePlacement, TakesAsManyAsLowerEnergyAndPriceOfSeams)
{
	Random random(711);
	for (int genus = 0; genus <= 2; ++genus) {
		const Packed p(shaken(perforatedSlab(genus, 4), 0.05, random));
		const PlacedCones best = place(p, ConeRequest());
		const int count = static_cast<int>(best.vertices.size());
		// Half as many have too much energy, twice as many too long seams.
		for (const int other : {std::max(3, count / 2), 2 * count})
			EXPECT_LT(cost(best), cost(place(p, other))) << genus << ": " << count << ", " << other;
	}
}

TEST(ConePlacement, EndsWhereAnotherMapIsOutOfReach)
{
	Random random(712);
	const Packed p(shaken(perforatedSlab(9, 4), 0.02, random));
	ConeRequest request;
	const PlacedCones alone = place(p, request);
	EXPECT_GT(alone.vertices.size(), 64u);
	request.alternative = cost(alone) + 0.3;
	EXPECT_EQ(place(p, request).vertices, alone.vertices);
	request.alternative = 4.0; // no map costs less
	const PlacedCones ended = place(p, request);
	EXPECT_LT(ended.vertices.size(), 64u);
	EXPECT_GT(cost(ended), request.alternative);
	expectAdmissible(p, ended);
}

TEST(ConePlacement, ScaleChangesNothing)
{
	Random random(706);
	const SurfaceMesh mesh = shaken(perforatedSlab(2, 3), 0.05, random);
	const PlacedCones a = place(Packed(mesh), 7), b = place(Packed(scaled(mesh, 1024.0)), 7);
	EXPECT_EQ(a.vertices, b.vertices);
	for (std::size_t i = 0; i < a.vertices.size(); ++i)
		EXPECT_NEAR(a.curvatures[i], b.curvatures[i], 1e-9);
}

TEST(ConePlacement, IsDeterministic)
{
	Random random(707);
	const Packed p(shaken(perforatedSlab(2, 3), 0.05, random));
	for (ConeRounding rounding : {ConeRounding::Free, ConeRounding::QuarterTurns}) {
		const PlacedCones first = place(p, 0, rounding);
		for (int i = 0; i < 3; ++i) {
			const PlacedCones again = place(p, 0, rounding);
			EXPECT_EQ(again.vertices, first.vertices);
			EXPECT_EQ(again.curvatures, first.curvatures);
		}
	}
}

TEST(ConePlacement, TakesTheStartOfTheFlowForItsOwn)
{
	// Without a Delaunay start of the flow it makes one, the same.
	Random random(709);
	const Packed p(shaken(perforatedSlab(1, 3), 0.05, random));
	const EmbeddedSurface surface = surfaceOf(p);
	FlowOptions onInput;
	onInput.method = Method::FixedTriangles;
	ConeRequest request;
	request.count = 6;
	InitialPacking shared = initialPacking(surface, FlowOptions()),
				   other = initialPacking(surface, onInput);
	const PlacedCones a = placeCones(surface, shared, request);
	const PlacedCones b = placeCones(surface, other, request);
	EXPECT_EQ(a.vertices, b.vertices);
	EXPECT_EQ(a.curvatures, b.curvatures);
	EXPECT_EQ(a.distortion, b.distortion);
}

/// A flow to a few cones on a surface whose areas it changes much.
struct FlowToFewCones
{
	EmbeddedSurface surface;
	ConeBoundary boundary;
	FlowResult flow;

	FlowToFewCones(const SurfaceMesh& mesh, ConeBoundary b, int cones) :
			surface(embeddedSurface(VertexArray<Point3>(mesh.positions), mesh.triangles)),
			boundary(b)
	{
		TargetRequest request;
		request.options.target = TargetCurvature::PlacedCones;
		request.options.freeBoundary = boundary == ConeBoundary::Fixed;
		request.options.cones.count = cones;
		InitialPacking start = initialPacking(surface, FlowOptions());
		const Target target = chooseTarget(surface, start, request);
		flow = to(target);
	}

	FlowResult to(const Target& target) const
	{
		return runRicciFlow(surface, initialPacking(surface, FlowOptions()), target, FlowOptions());
	}

	FlowResult to(const PlacedCones& cones) const
	{
		Target target = flow.target;
		for (const Vertex v : target.curvature.indices())
			if (!surface.topology.boundary[v])
				target.curvature[v] = 0.0;
		for (std::size_t i = 0; i < cones.vertices.size(); ++i)
			target.curvature[cones.vertices[i]] = cones.curvatures[i];
		return to(target);
	}

	PlacedCones more(double distortion, ConeRounding rounding = ConeRounding::Free) const
	{
		ConeRequest request;
		request.boundary = boundary;
		request.distortion = distortion;
		request.rounding = rounding;
		return moreCones(surface, flow, request);
	}

	int cones() const
	{
		int count = 0;
		for (const Vertex v : surface.triangulation.vertices())
			count += !surface.topology.boundary[v] && flow.target.curvature[v] != 0.0;
		return count;
	}

	double excess(const FlowResult& result, double spread) const
	{
		return areaExcess(areaChange(surface, flowFactor(result)), spread);
	}
};

std::vector<FlowToFewCones> flowsToFewCones()
{
	std::vector<FlowToFewCones> flows;
	flows.emplace_back(sphereWithTube(0.25, 3.0, 0.0, 16, 16), ConeBoundary::Fixed, 3);
	flows.emplace_back(sphereWithTube(0.25, 2.0, 0.5, 16, 16), ConeBoundary::Fixed, 1);
	Random random(710);
	flows.emplace_back(
		withoutStars(shaken(perforatedSlab(1, 4), 0.05, random), {0, 40}), ConeBoundary::Fixed, 2);
	return flows;
}

TEST(MoreCones, FitsTheCurvaturesOfTheConesAnew)
{
	int compared = 0;
	// So large a distortion that no cone is added: the curvatures alone are new, and any others at
	// the same vertices would change areas more by the linear problem where the flow has led.
	for (const FlowToFewCones& few : flowsToFewCones()) {
		const PlacedCones cones = few.more(1e6);
		EXPECT_EQ(static_cast<int>(cones.vertices.size()), few.cones());
		LinearFlow linear(
			few.surface, few.flow, few.boundary, tailWeights(few.surface, flowFactor(few.flow)));
		VertexVector best = VertexVector::Zero(linear.vertexCount());
		for (std::size_t i = 0; i < cones.vertices.size(); ++i) {
			EXPECT_NE(few.flow.target.curvature[cones.vertices[i]], 0.0);
			best[cones.vertices[i]] = cones.curvatures[i];
		}
		const VertexVector factor = linear.factor(best);
		EXPECT_NEAR(cones.distortion, areaChange(few.surface, factor).spread, 1e-6);
		const double least = linear.meanSquare(factor);
		for (std::size_t i = 0; i < cones.vertices.size(); ++i)
			for (const double step : {-0.01, 0.01}) {
				if (cones.curvatures[i] + step > kMaxConeCurvature)
					continue;
				VertexVector other = best;
				other[cones.vertices[i]] += step;
				if (linear.hasFixedSum()) {
					const std::size_t j = (i + 1) % cones.vertices.size();
					other[cones.vertices[j]] -= step;
					if (other[cones.vertices[j]] > kMaxConeCurvature)
						continue;
				}
				EXPECT_GT(linear.meanSquare(linear.factor(other)), least);
				++compared;
			}
	}
	EXPECT_GT(compared, 5);
}

TEST(MoreCones, KeepsAreasBetterThanTheFlowItStartsFrom)
{
	for (const FlowToFewCones& few : flowsToFewCones()) {
		const double before = few.excess(few.flow, 0.5);
		ASSERT_GT(before, 1.0);
		const PlacedCones cones = few.more(0.5);
		EXPECT_GT(static_cast<int>(cones.vertices.size()), few.cones());
		EXPECT_LE(static_cast<int>(cones.vertices.size()), few.cones() + kMaxMoreCones);
		EXPECT_LT(few.excess(few.to(cones), 0.5), before);
	}
}

TEST(MoreCones, AreABoundedNumberAtATime)
{
	for (const FlowToFewCones& few : flowsToFewCones()) {
		const int more = static_cast<int>(few.more(1e-9).vertices.size()) - few.cones();
		EXPECT_LE(more, kMaxMoreCones);
		EXPECT_GT(more, kMaxMoreCones / 2);
	}
}

TEST(MoreCones, IsAdmissible)
{
	for (const FlowToFewCones& few : flowsToFewCones())
		for (const ConeRounding rounding : {ConeRounding::Free, ConeRounding::QuarterTurns}) {
			const PlacedCones cones = few.more(0.5, rounding);
			for (std::size_t i = 0; i < cones.vertices.size(); ++i) {
				EXPECT_LE(cones.curvatures[i], kMaxConeCurvature + 1e-12);
				EXPECT_NE(cones.curvatures[i], 0.0);
				EXPECT_FALSE(few.surface.topology.boundary[cones.vertices[i]]);
				if (rounding == ConeRounding::QuarterTurns) {
					const double turns = cones.curvatures[i] / kQuarter;
					EXPECT_NEAR(turns, std::round(turns), 1e-12);
				}
			}
			EXPECT_TRUE(std::is_sorted(cones.vertices.begin(), cones.vertices.end()));
			if (few.surface.topology.type.isClosed()) {
				EXPECT_NEAR(sum(cones.curvatures), 4 * kPi, 1e-11);
			}
		}
}

TEST(MoreCones, AreMoreForLessDistortion)
{
	const FlowToFewCones few(sphereWithTube(0.25, 2.0, 0.5, 16, 16), ConeBoundary::Fixed, 1);
	std::size_t before = 0;
	for (const double distortion : {1.0, 0.5, 0.25}) {
		const PlacedCones cones = few.more(distortion);
		EXPECT_GE(cones.vertices.size(), before);
		EXPECT_LE(cones.distortion, 1.001 * distortion); // weak cones were taken out again
		before = cones.vertices.size();
	}
	EXPECT_GT(before, 1u);
}

/// The refusal of \p count cones.
InvalidOption refusal(const SurfaceMesh& mesh, int count)
{
	const auto error = errorOf<InvalidOption>([&] { place(Packed(mesh), count); });
	EXPECT_TRUE(error) << "accepted";
	return error.value_or(InvalidOption(InvalidOption::Epsilon));
}

TEST(ConePlacement, RefusesWhatNoMetricHas)
{
	// Two cones below 2 pi cannot carry the 4 pi of a sphere.
	const InvalidOption tooFew = refusal(perforatedSlab(0, 2), 2);
	EXPECT_EQ(tooFew.problem, InvalidOption::TooFewCones);
	EXPECT_EQ(tooFew.value, 2.0);
	EXPECT_EQ(tooFew.bound, 3.0);
	EXPECT_NO_THROW(place(Packed(perforatedSlab(0, 2)), 3));
	EXPECT_NO_THROW(place(Packed(tetrahedron()), 4));
	const InvalidOption tooMany = refusal(tetrahedron(), 5);
	EXPECT_EQ(tooMany.problem, InvalidOption::TooFewVertices);
	EXPECT_EQ(tooMany.value, 5.0);
	EXPECT_EQ(tooMany.count, 4u);
}

} // namespace
} // namespace ricci::testing
