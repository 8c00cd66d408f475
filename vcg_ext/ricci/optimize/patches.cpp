// SPDX-License-Identifier: GPL-3.0-or-later
#include "patches.h"

#include "../base/disjoint_sets.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace ricci {

Patch wholePatch(const FlatMesh& flat)
{
	Patch patch;
	patch.triangles.resize(positionOf(flat.size()));
	patch.points.resize(positionOf(flat.place.size()));
	std::iota(patch.triangles.begin(), patch.triangles.end(), 0);
	std::iota(patch.points.begin(), patch.points.end(), 0);
	patch.corners = flat.points;
	patch.variable = Array<int>(patch.points);
	patch.variables = flat.place.size();
	return patch;
}

PatchFinder::PatchFinder(const FlatMesh& flat, const PointGroups& groups) :
		m_flat(flat), m_groups(groups), m_trianglesOf(
											groups.fixed.size(),
											[&](const auto& add) {
												for (const int f : flat.points.indices())
													for (const int p : flat.points[f])
														add(groups.group[p], f);
											}),
		m_taken(flat.points.size(), 0), m_local(flat.place.size(), -1),
		m_number(groups.fixed.size(), -1), m_count(groups.fixed.size(), 0)
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
		for (const int p : m_flat.points[f])
			if (!m_groups.fixed[m_groups.group[p]])
				take(f);
	int groups = 0;
	std::vector<int> reached; // [number of a group]
	const auto isNew = [&](int group) {
		if (m_number[group] >= 0)
			return false;
		m_number[group] = groups++;
		reached.push_back(group);
		return true;
	};
	for (std::size_t first = 0; rings > 0; --rings) {
		const std::size_t end = taken.size();
		for (; first < end; ++first)
			for (const int p : m_flat.points[taken[first]])
				if (const int group = m_groups.group[p]; isNew(group))
					for (const int f : m_trianglesOf[group])
						take(f);
	}
	std::sort(taken.begin(), taken.end());

	for (const int f : taken)
		for (const int p : m_flat.points[f])
			isNew(m_groups.group[p]);
	const auto numberOf = [&](int p) { return m_number[m_groups.group[p]]; };
	DisjointSets sets(groups);
	for (const int f : taken)
		for (const int p : m_flat.points[f])
			sets.merge(numberOf(m_flat.points[f][0]), numberOf(p));
	Array<int> partOf(reached.size(), -1); // [set]
	std::vector<std::vector<int>> parts;
	for (const int f : taken) {
		int& part = partOf[sets.find(numberOf(m_flat.points[f][0]))];
		if (part < 0) {
			part = static_cast<int>(parts.size());
			parts.emplace_back();
		}
		parts[positionOf(part)].push_back(f);
		m_taken[f] = 0;
	}
	for (const int group : reached)
		m_number[group] = -1;
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
			const int p = m_flat.points[f][k];
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
	for (const int p : patch.points) {
		const int group = m_groups.group[p];
		if (!m_groups.fixed[group] && m_number[group] < 0 &&
			m_count[group] == m_trianglesOf[group].size())
			m_number[group] = patch.variables++;
		patch.variable.push_back(m_number[group]);
	}
	for (const int p : patch.points) {
		m_local[p] = -1;
		m_count[m_groups.group[p]] = 0;
		m_number[m_groups.group[p]] = -1;
	}
	return patch;
}

} // namespace ricci
