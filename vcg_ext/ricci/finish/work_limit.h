// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_WORK_LIMIT_H
#define RICCI_WORK_LIMIT_H

#include <algorithm>
#include <cstdint>

namespace ricci {

/// What the repairs of one map may still spend, in triangles set up for a step of Newton: a third of a
/// microsecond to one each. It bounds their time without a clock, so that the result is the same on every run.
class WorkLimit
{
public:
	/// \param triangles of the map
	explicit WorkLimit(std::int64_t triangles) :
			m_stage(kOfStage + kOfStagePerTriangle * triangles), m_left(kStages * m_stage)
	{
	}

	/// What one stage may spend of it.
	std::int64_t ofStage() const { return std::min(m_stage, m_left); }

	/// \param work no more than is left
	void spend(std::int64_t work) { m_left -= work; }
	std::int64_t left() const { return m_left; }

private:
	/// CAD meshes of 20000 triangles with a thousand needles take all of it; the
	/// repair of a refinement of millions takes 1 to 2 for each triangle.
	static constexpr std::int64_t kOfStage = 1000000, kOfStagePerTriangle = 2, kStages = 6;

	std::int64_t m_stage, m_left;
};

} // namespace ricci

#endif
