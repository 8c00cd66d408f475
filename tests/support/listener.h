// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_TESTS_LISTENER_H
#define RICCI_TESTS_LISTENER_H

#include <ricci/base/task.h>

#include <algorithm>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace ricci::testing {

/// Keeps what it is told, and cancels at the n-th update, of those that name a stage, if it is asked to.
class Listener : public Progress
{
public:
	explicit Listener(int last = std::numeric_limits<int>::max(), std::string stage = {}) :
			m_last(last), m_stage(std::move(stage))
	{
	}

	bool update(double fraction, const std::string& what) override
	{
		fractions.push_back(fraction);
		m_calls += what.find(m_stage) != std::string::npos;
		return m_calls < m_last;
	}

	void log(const std::string& line) override { lines.push_back(line); }

	/// Updates, of the stage alone if there is one.
	int calls() const { return m_calls; }

	/// Lines of the log with these words.
	int count(const std::string& words) const
	{
		return static_cast<int>(
			std::count_if(lines.begin(), lines.end(), [&](const std::string& line) {
				return line.find(words) != std::string::npos;
			}));
	}

	std::vector<double> fractions;
	std::vector<std::string> lines;

private:
	int m_last, m_calls = 0;
	std::string m_stage;
};

/// The result of \p run, which reports to \p listener.
template<class Run>
auto withListener(Progress& listener, const Run& run)
{
	const Task task(listener);
	return run();
}

/// How often \p run calls checkpoint() in its own thread.
template<class Run>
int checkpointsOf(const Run& run)
{
	Listener listener;
	const Task task(listener);
	run();
	return listener.calls();
}

} // namespace ricci::testing

#endif
