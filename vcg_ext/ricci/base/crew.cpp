// SPDX-License-Identifier: GPL-3.0-or-later
#include "crew.h"

#include <algorithm>
#include <new>
#include <system_error>

namespace ricci {

namespace {

thread_local Crew* ofThread = nullptr;

} // namespace

Crew::Crew() : m_outer(ofThread)
{
	if (!m_outer)
		ofThread = this;
}

Crew::~Crew()
{
	if (m_outer)
		return;
	ofThread = nullptr;
	{
		const std::lock_guard<std::mutex> lock(m_mutex);
		m_isEnding = true;
	}
	m_isOffered.notify_all();
	for (std::thread& thread : m_threads)
		thread.join();
}

/// As many as offers wait for, but at most as one caller asks for, and one more for each that waits: more would
/// outnumber the processors where loops are within others.
void Crew::startThreads()
{
	try {
		while (m_idle < m_wanted && static_cast<int>(m_threads.size()) < m_most + m_waiting) {
			m_threads.emplace_back([this] { work(); });
			++m_idle;
		}
	}
	catch (const std::system_error&) { // no more threads to be had
	}
	catch (const std::bad_alloc&) { // nor memory for one
	}
}

/// The oldest offer that waits for help: of loops within others the outer one.
Crew::Offer* Crew::firstOpen() const
{
	Offer* offer = m_first;
	while (offer && offer->m_wanted == 0)
		offer = offer->m_after;
	return offer;
}

void Crew::work()
{
	ofThread = this;
	std::unique_lock<std::mutex> lock(m_mutex);
	for (;;) {
		Offer* const offer = firstOpen();
		if (!offer) {
			if (m_isEnding)
				return;
			m_isOffered.wait(lock);
			continue;
		}
		--offer->m_wanted;
		--m_wanted;
		++offer->m_atWork;
		--m_idle;
		lock.unlock();
		offer->m_call(offer->m_help);
		lock.lock();
		++m_idle;
		if (--offer->m_atWork == 0)
			m_isDone.notify_all();
	}
}

void Crew::Offer::begin(int helpers)
{
	if (helpers <= 0 || !ofThread)
		return;
	m_crew = ofThread;
	{
		const std::lock_guard<std::mutex> lock(m_crew->m_mutex);
		m_wanted = helpers;
		m_crew->m_wanted += helpers;
		m_before = m_crew->m_last;
		(m_before ? m_before->m_after : m_crew->m_first) = this;
		m_crew->m_last = this;
		m_crew->m_most = std::max(m_crew->m_most, helpers);
		m_crew->startThreads();
	}
	for (int i = 0; i < helpers; ++i)
		m_crew->m_isOffered.notify_one();
}

bool Crew::Offer::end(std::chrono::milliseconds wait)
{
	if (!m_crew)
		return true;
	std::unique_lock<std::mutex> lock(m_crew->m_mutex);
	m_crew->m_wanted -= m_wanted;
	m_wanted = 0;
	if (m_atWork > 0) {
		++m_crew->m_waiting;
		m_crew->startThreads();
		m_crew->m_isDone.wait_for(lock, wait, [&] { return m_atWork == 0; });
		--m_crew->m_waiting;
	}
	return m_atWork == 0;
}

Crew::Offer::~Offer()
{
	if (!m_crew)
		return;
	while (!end(std::chrono::hours(1))) {
	}
	const std::lock_guard<std::mutex> lock(m_crew->m_mutex);
	(m_before ? m_before->m_after : m_crew->m_first) = m_after;
	(m_after ? m_after->m_before : m_crew->m_last) = m_before;
}

} // namespace ricci
