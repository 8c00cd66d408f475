// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_PART_OF_PROGRESS_H
#define RICCI_PART_OF_PROGRESS_H

#include "../progress.h"

#include <string>

namespace ricci {

/// A part of a run: passes its share on as one of the whole.
class PartOfProgress : public Progress
{
public:
	/// \param from, to shares of the whole that are done before and after the part
	PartOfProgress(Progress& whole, double from, double to) : m_whole(whole), m_from(from), m_to(to)
	{
	}

	void log(const std::string& line) override { m_whole.log(line); }

	bool update(double fraction, const std::string& what) override
	{
		return m_whole.update(m_from + fraction * (m_to - m_from), what);
	}

private:
	Progress& m_whole;
	double m_from, m_to;
};

} // namespace ricci

#endif
