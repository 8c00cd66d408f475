// SPDX-License-Identifier: GPL-3.0-or-later
// How a run speaks to its listener and how the listener ends it, at any depth of calls and with nothing
// passed down for it: what a thread works for is known by the thread.
#ifndef RICCI_TASK_H
#define RICCI_TASK_H

#include "../progress.h"

#include <atomic>
#include <chrono>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace ricci {

/// What the thread that makes it works for until it is destroyed: a whole run, or a part of the task that
/// the thread has in hand. A thread without one is silent and cannot be ended.
class Task
{
public:
	/// A whole run.
	/// \param seconds of wall-clock time that it may take from now on; 0: no limit
	/// \throw InvalidOption TimeLimit if it is negative or NaN
	explicit Task(Progress& listener, double seconds = 0.0);

	/// A part of the thread's task, from one share of it to another.
	/// \param isSilent whether its lines are not logged
	Task(double from, double to, bool isSilent = false);

	~Task();
	Task(const Task&) = delete;
	Task& operator=(const Task&) = delete;

	/// Its lines are kept in \p lines, not logged.
	void keepLines(std::vector<std::string>& lines) { m_lines = &lines; }

	/// Bytes that this task may use, and its parts; 0, the default: no limit.
	/// \throw InvalidOption MemoryLimit if it is negative or NaN
	void setMemoryLimit(double bytes);
	/// That of the thread's task.
	static double memoryLimit();

private:
	friend void checkpoint();
	friend void advance(double, const std::string&);
	friend void logLine(const std::string&);

	void tell(double fraction);

	Task* m_outer;
	Progress* m_listener = nullptr;
	double m_from = 0.0, m_to = 1.0, m_done = 0.0;
	bool m_isSilent = false;
	std::vector<std::string>* m_lines = nullptr;
	double m_memory = 0.0, m_seconds = 0.0;
	std::string m_what;
	std::chrono::steady_clock::time_point m_start;
};

/// Bytes that a run needs at its peak for a surface of \p faces triangles in its largest component
/// and \p allFaces in all, with the common refinement as output if it \p refines, estimated on the
/// safe side from measured runs: arrays in proportion to the faces, and the factor of the Hessian,
/// which grows like n log n on surfaces.
double estimatedMemory(std::size_t faces, std::size_t allFaces, bool refines);

/// Whether \p bytes are below Task::memoryLimit(), if there is one.
bool hasRoomFor(double bytes);

/// \throw TooLarge if the estimate is above Task::memoryLimit(), or if int cannot number the elements
void requireMemory(std::size_t faces, std::size_t allFaces, bool refines);

/// For the flow on the double of a surface with boundary, which \p faces are one half of.
/// \throw TooLarge if that needs more than Task::memoryLimit()
void requireMemoryForDouble(std::size_t faces);

/// For the overlay of two triangulations, whose size the faces do not tell: a fan of n triangles at
/// one vertex can make n^2 crossings.
/// \throw TooLarge if \p crossings need more than Task::memoryLimit(), or are too many for int
void requireOverlayMemory(std::size_t crossings, bool refines);

/// Shares of progress: of a component, spent before its flow and after it; of the part after it, that of the overlay, and
/// in this, until the pieces are linked; of the layout of a refinement, until its triangles lie; of all components, until
/// they are mapped; and of a run, until it has its charts.
constexpr double kBeforeFlow = 0.05, kAfterFlow = 0.1, kOverlay = 0.35, kDivided = 0.5,
				 kLaidOut = 0.85, kComponentsDone = 0.9, kMapped = 0.95;

/// Ends the run if its listener has cancelled it or its time is over. To be called in every loop that can
/// be long, many times a second; in a thread that helps another one it ends the help once that has failed.
/// \throw Cancelled, TimeOut
void checkpoint();

/// checkpoint() at every 65536th of a loop's short steps.
inline void checkpointNowAndThen(std::size_t step)
{
	if (step % 65536 == 0)
		checkpoint();
}

/// Tells the listener what is being done now, and how much of the task has been done. The bar never goes
/// back: a stage that starts again leaves it where it is.
/// \param fraction of the thread's task, in [0, 1]
/// \throw Cancelled, TimeOut
void advance(double fraction, const std::string& what);

/// One line for the user's log, without a line end.
void logLine(const std::string& line);

/// logLine() of each.
void logLines(const std::vector<std::string>& lines);

/// Thrown by checkpoint() in threads whose result nobody waits for any more.
struct HelpEnded
{
};

/// Whether the help of some threads is of no use any more; for parallel.h. Help within help, which the thread that
/// makes it may give, is of no use then, too. The task's memory limit holds for all who help.
class HelpFlag
{
public:
	HelpFlag();
	HelpFlag(const HelpFlag&) = delete;
	HelpFlag& operator=(const HelpFlag&) = delete;

	/// \return whether it was ended before
	bool end() { return m_ended.exchange(true); }
	bool isEnded() const;

	/// Makes \p flag that of the calling thread. \return that which it had, null for none
	static const HelpFlag* exchange(const HelpFlag* flag);

private:
	friend class Task;

	std::atomic<bool> m_ended{false};
	const HelpFlag* m_outer;
	double m_memory;
};

/// What \p action() returns. An error is not a result, but is logged; a stop of the run is a stop.
/// \param otherwise what is done without the result, for the log
/// \throw Stopped
template<class Action>
auto attempt(const std::string& otherwise, Action action) -> std::optional<decltype(action())>
{
	try {
		return action();
	}
	catch (const Stopped&) {
		throw;
	}
	catch (const Error& error) {
		logLine(error.what() + (": " + otherwise) + ".");
		return std::nullopt;
	}
}

} // namespace ricci

#endif
