// SPDX-License-Identifier: GPL-3.0-or-later
#include "task.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ricci {

namespace {

thread_local Task* current = nullptr;
thread_local const HelpFlag* helpFlag = nullptr;

/// Bytes for each face of the mesh; for each face of the component at work; and the same for each
/// doubling of their number (the factor). Fitted from above to measured peaks of 5e4 to 1e6 faces
/// (1.2 to 1.4 kB for each, 1.8 with the common refinement). A flow on the double of a surface with
/// boundary cannot be foreseen, see requireMemoryForDouble().
/// Then of the arrays for the output of the common refinement, for each face at work; and for each crossing of the
/// overlay, measured on cylinders whose caps are fans.
constexpr double kEveryFace = 350.0, kFaceAtWork = 450.0, kFaceInFactor = 35.0,
				 kFaceRefined = 400.0, kCrossing = 390.0, kCrossingRefined = 760.0;

/// More faces than this have more halfedges than int has numbers, or could have after refinement; and a crossing
/// makes up to eight corners of pieces, which int has to number.
constexpr std::size_t kMaxFaces = 300000000, kMaxCrossings = 250000000;

void requireBytes(double needed, TooLarge::Problem problem, std::size_t count)
{
	if (!hasRoomFor(needed))
		throw TooLarge(problem, count, needed, Task::memoryLimit());
}

} // namespace

Task::Task(Progress& listener, double seconds) :
		m_outer(current), m_listener(&listener), m_seconds(seconds), m_what("Starting"),
		m_start(std::chrono::steady_clock::now())
{
	if (!(seconds >= 0.0))
		throw InvalidOption(InvalidOption::TimeLimit, seconds);
	current = this;
}

Task::Task(double from, double to, bool isSilent) :
		m_outer(current), m_from(from), m_to(to), m_isSilent(isSilent),
		m_what(current ? current->m_what : std::string())
{
	current = this;
}

Task::~Task()
{
	current = m_outer;
}

void Task::setMemoryLimit(double bytes)
{
	if (!(bytes >= 0.0))
		throw InvalidOption(InvalidOption::MemoryLimit, bytes);
	m_memory = bytes;
}

double Task::memoryLimit()
{
	for (const Task* task = current; task; task = task->m_outer)
		if (task->m_memory > 0.0)
			return task->m_memory;
	return helpFlag ? helpFlag->m_memory : 0.0;
}

double estimatedMemory(std::size_t faces, std::size_t allFaces, bool refines)
{
	const auto n = static_cast<double>(faces);
	double each = kFaceAtWork + kFaceInFactor * std::log2(std::max(n, 2.0));
	if (refines)
		each += kFaceRefined;
	return kEveryFace * static_cast<double>(allFaces) + each * n;
}

bool hasRoomFor(double bytes)
{
	const double limit = Task::memoryLimit();
	return limit <= 0.0 || bytes <= limit;
}

void requireMemory(std::size_t faces, std::size_t allFaces, bool refines)
{
	if (allFaces > kMaxFaces)
		throw TooLarge(TooLarge::Faces, allFaces, 0.0, static_cast<double>(kMaxFaces));
	requireBytes(estimatedMemory(faces, allFaces, refines), TooLarge::Memory, allFaces);
}

void requireMemoryForDouble(std::size_t faces)
{
	requireBytes(estimatedMemory(2 * faces, faces, false), TooLarge::DoubleMemory, 2 * faces);
}

void requireOverlayMemory(std::size_t crossings, bool refines)
{
	if (crossings > kMaxCrossings)
		throw TooLarge(TooLarge::Crossings, crossings, 0.0, static_cast<double>(kMaxCrossings));
	requireBytes(
		(refines ? kCrossingRefined : kCrossing) * static_cast<double>(crossings),
		TooLarge::OverlayMemory,
		crossings);
}

/// Passes the share on to the task that this one is a part of, and to the listener at last.
void Task::tell(double fraction)
{
	m_done = std::max(m_done, std::clamp(fraction, 0.0, 1.0));
	if (!m_listener) {
		if (m_outer) {
			m_outer->m_what = m_what;
			m_outer->tell(std::min(m_to, m_from + m_done * (m_to - m_from)));
		}
		return;
	}
	const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - m_start;
	if (m_seconds > 0.0 && elapsed.count() > m_seconds && m_done < 1.0)
		throw TimeOut(elapsed.count(), m_done, m_seconds);
	m_listener->step(m_done, m_what);
}

void checkpoint()
{
	if (helpFlag && helpFlag->isEnded())
		throw HelpEnded();
	if (current)
		current->tell(current->m_done);
}

void advance(double fraction, const std::string& what)
{
	if (!current)
		return;
	current->m_what = what;
	current->tell(fraction);
}

void logLine(const std::string& line)
{
	for (const Task* task = current; task; task = task->m_outer) {
		if (task->m_isSilent)
			return;
		if (task->m_lines) {
			task->m_lines->push_back(line);
			return;
		}
		if (task->m_listener) {
			task->m_listener->log(line);
			return;
		}
	}
}

void logLines(const std::vector<std::string>& lines)
{
	for (const std::string& line : lines)
		logLine(line);
}

HelpFlag::HelpFlag() : m_outer(helpFlag), m_memory(Task::memoryLimit())
{
}

bool HelpFlag::isEnded() const
{
	for (const HelpFlag* flag = this; flag; flag = flag->m_outer)
		if (flag->m_ended)
			return true;
	return false;
}

const HelpFlag* HelpFlag::exchange(const HelpFlag* flag)
{
	return std::exchange(helpFlag, flag);
}

} // namespace ricci
