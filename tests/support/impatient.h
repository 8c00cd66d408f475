// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_TESTS_IMPATIENT_H
#define RICCI_TESTS_IMPATIENT_H

#include <ricci/progress.h>

#include <string>
#include <vector>

namespace ricci::testing {

/// Cancels at the n-th call and keeps what it is told.
class Impatient : public Progress
{
public:
	explicit Impatient(int last) : m_last(last) {}

	bool update(double fraction, const std::string&) override
	{
		fractions.push_back(fraction);
		return static_cast<int>(fractions.size()) < m_last;
	}

	void log(const std::string& line) override { lines.push_back(line); }

	std::vector<double> fractions;
	std::vector<std::string> lines;

private:
	int m_last;
};

} // namespace ricci::testing

#endif
