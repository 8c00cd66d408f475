// SPDX-License-Identifier: GPL-3.0-or-later
#include "patches.h"

#include "../math/disjoint_sets.h"

#include <algorithm>
#include <map>
#include <utility>

namespace ricci {

PatchFinder::PatchFinder(const DrawnTriangles& drawn, const PointGroups& groups) :
		m_drawn(drawn), m_groups(groups), m_trianglesOf(
											  groups.fixed.size(),
											  [&](const auto& add) {
												  for (const int f : drawn.corners.indices())
													  for (const int p : drawn.corners[f])
														  add(groups.group[p], f);
											  }),
		m_taken(drawn.corners.size(), 0), m_local(drawn.points.size(), -1),
		m_count(groups.fixed.size(), 0)
{
}

std::vector<Patch> PatchFinder::patches(const std::vector<int>& seeds, int rings)
{
	std::vector<int> taken;
	const auto take = [&](int f) {
		if (!m_taken[f])
			taken.push_back(f);
		m_taken[f] = 1;
	};
	for (const int f : seeds)
		for (const int p : m_drawn.corners[f])
			if (!m_groups.fixed[m_groups.group[p]])
				take(f);
	for (std::size_t first = 0; rings > 0; --rings) {
		const std::size_t end = taken.size();
		for (; first < end; ++first)
			for (const int p : m_drawn.corners[taken[first]])
				for (const int f : m_trianglesOf[m_groups.group[p]])
					take(f);
	}
	std::sort(taken.begin(), taken.end());

	std::vector<int> groups; // of the triangles that were taken
	for (const int f : taken)
		for (const int p : m_drawn.corners[f])
			groups.push_back(m_groups.group[p]);
	std::sort(groups.begin(), groups.end());
	groups.erase(std::unique(groups.begin(), groups.end()), groups.end());
	const auto place = [&](int p) {
		return static_cast<int>(
			std::lower_bound(groups.begin(), groups.end(), m_groups.group[p]) - groups.begin());
	};
	DisjointSets sets(static_cast<int>(groups.size()));
	for (const int f : taken)
		for (const int p : m_drawn.corners[f])
			sets.merge(place(m_drawn.corners[f][0]), place(p));
	std::map<int, std::size_t> number; // [set] of its patch
	std::vector<std::vector<int>> parts;
	for (const int f : taken) {
		const int set = sets.find(place(m_drawn.corners[f][0]));
		const auto [entry, isNew] = number.emplace(set, parts.size());
		if (isNew)
			parts.emplace_back();
		parts[entry->second].push_back(f);
		m_taken[f] = 0;
	}
	std::vector<Patch> result;
	for (std::vector<int>& part : parts) {
		Patch patch = makePatch(std::move(part));
		if (patch.variables > 0)
			result.push_back(std::move(patch));
	}
	return result;
}

Patch PatchFinder::makePatch(std::vector<int> triangles)
{
	Patch patch;
	patch.triangles = std::move(triangles);
	for (const int f : patch.triangles) {
		Triangle local{};
		for (std::size_t k = 0; k < 3; ++k) {
			const int p = m_drawn.corners[f][k];
			if (m_local[p] < 0) {
				m_local[p] = static_cast<int>(patch.points.size());
				patch.points.push_back(p);
			}
			local[k] = m_local[p];
			++m_count[m_groups.group[p]];
		}
		patch.corners.push_back(local);
	}
	// A group is inside if the patch has all its triangles.
	std::map<int, int> number; // [group] of its variable
	for (const int p : patch.points) {
		const int group = m_groups.group[p];
		const bool inside = !m_groups.fixed[group] && m_count[group] == m_trianglesOf[group].size();
		patch.variable.push_back(
			inside ? number.emplace(group, patch.variables).first->second : -1);
		patch.variables = static_cast<int>(number.size());
	}
	for (const int p : patch.points) {
		m_local[p] = -1;
		m_count[m_groups.group[p]] = 0;
	}
	return patch;
}

} // namespace ricci
