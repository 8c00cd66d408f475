// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_TESTS_LISTENER_H
#define RICCI_TESTS_LISTENER_H

#include <ricci/base/task.h>

#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace ricci::testing {

/// Keeps what it is told, and cancels at the n-th update if it is asked to.
class Listener : public Progress
{
public:
	explicit Listener(int last = std::numeric_limits<int>::max()) : m_last(last) {}

	bool update(double fraction, const std::string&) override
	{
		fractions.push_back(fraction);
		return calls() < m_last;
	}

	void log(const std::string& line) override { lines.push_back(line); }

	int calls() const { return static_cast<int>(fractions.size()); }

	std::vector<double> fractions;
	std::vector<std::string> lines;

private:
	int m_last;
};

/// What \p run gives while \p listener hears of it.
template<class Run>
auto heard(Progress& listener, const Run& run)
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
