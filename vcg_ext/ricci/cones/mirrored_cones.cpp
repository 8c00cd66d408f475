// SPDX-License-Identifier: GPL-3.0-or-later
#include "mirrored_cones.h"

#include "../base/tolerances.h"

#include <algorithm>
#include <map>
#include <utility>

namespace ricci {

namespace {

/// Vertices of the surface by the cones of a model that stand for them.
using ConesOfSurface = std::map<Vertex, Vertex>;

/// The cones of one half, and their images.
/// \param place the vertex of the model for one of the surface that is none of those given; none if there is none
template<class Place>
ConesOfSurface
ofHalf(const MirrorSymmetry& mirror, bool isAbove, const ConesOfSurface& cones, const Place& place)
{
	ConesOfSurface result;
	for (const auto& [cone, v] : cones)
		if (const Vertex image = mirror.image[v];
			image == v || (image.isValid() && mirror.isAbove[v] == isAbove))
			result[cone] = v;
	for (const auto& [cone, v] : ConesOfSurface(result)) {
		const Vertex image = mirror.image[v];
		if (const Vertex other = place(image, result); image != v && other.isValid())
			result[other] = image;
	}
	return result;
}

} // namespace

void setCones(std::vector<Vertex> cones, ConeModel& model)
{
	std::sort(cones.begin(), cones.end());
	for (int i = model.size() - 1; i >= 0; --i)
		if (!std::binary_search(cones.begin(), cones.end(), model.vertex(i)))
			model.remove(i);
	std::vector<Vertex> missing;
	for (const Vertex v : cones)
		if (!model.isCone(v))
			missing.push_back(v);
	model.append(missing);
	model.fit();
}

std::vector<Vertex> mirrorCones(
	const TargetRequest& request,
	const ConeSites& sites,
	const VertexArray<Vertex>& roots,
	const VertexArray<Point3>& positions,
	ConeModel& model)
{
	const auto place = [&](Vertex v, const ConesOfSurface& taken) {
		if (roots.empty())
			return v;
		Vertex nearest;
		double least = kInfinity;
		for (const Vertex i : roots.indices())
			if (const double d = distance(positions[roots[i]], positions[v]);
				d < least && sites.isAllowed(i) && taken.count(i) == 0) {
				least = d;
				nearest = i;
			}
		return nearest;
	};
	const auto cost = [&] {
		return MapCost{
			expectedEnergy(model.distortion()), SeamTree(sites, model.vertices()).length()}
			.total();
	};
	const auto take = [&](const ConesOfSurface& cones) {
		std::vector<Vertex> vertices;
		for (const auto& [cone, v] : cones)
			vertices.push_back(cone);
		setCones(std::move(vertices), model);
	};
	ConesOfSurface own;
	for (const Vertex v : model.vertices())
		own[v] = roots.empty() ? v : roots[v];
	ConesOfSurface best = own;
	if (request.goal.mirror) {
		double least = cost() + kMirrorPrice * expectedEnergy(0.0);
		for (const bool isAbove : {false, true}) {
			ConesOfSurface next = ofHalf(*request.goal.mirror, isAbove, own, place);
			if (next.empty() || static_cast<int>(next.size()) < model.minSize())
				continue;
			take(next);
			if (const double c = cost(); c < (1.0 - kTiny) * least) {
				least = c;
				best = std::move(next);
			}
		}
		take(best);
	}
	std::vector<Vertex> vertices;
	for (const Vertex v : model.vertices())
		vertices.push_back(best.at(v));
	return vertices;
}

void mirrorCurvatures(const TargetRequest& request, PlacedCones& placed)
{
	if (!request.goal.mirror)
		return;
	const VertexArray<Vertex>& image = request.goal.mirror->image;
	std::map<Vertex, double> curvature;
	for (std::size_t i = 0; i < placed.vertices.size(); ++i)
		curvature[placed.vertices[i]] = placed.curvatures[i];
	for (const Vertex v : placed.vertices)
		if (curvature.count(image[v]) == 0)
			return;
	for (std::size_t i = 0; i < placed.vertices.size(); ++i)
		placed.curvatures[i] = 0.5 * (placed.curvatures[i] + curvature[image[placed.vertices[i]]]);
}

} // namespace ricci
