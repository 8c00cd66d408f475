// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_CREW_H
#define RICCI_CREW_H

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <vector>

namespace ricci {

/// The threads that help the one that makes it, until it is destroyed. They are started when help is asked for and
/// wait between tasks: a loop of a millisecond costs no start of a thread. Within the life of one, further ones in its
/// thread, or in the threads that help it, are the same.
class Crew
{
public:
	Crew();
	~Crew();
	Crew(const Crew&) = delete;
	Crew& operator=(const Crew&) = delete;

	/// What the crew of the calling thread may help with, until it is destroyed. Nobody waits for a thread that comes too
	/// late to help: so where processors have other work, the caller does all by itself and is as quick as alone.
	class Offer
	{
	public:
		/// \param helpers how many threads may call \p help() at a time, each of them once; fewer where there are no
		/// more threads to be had
		/// \param help must not throw, and outlives the offer
		template<class Help>
		Offer(int helpers, const Help& help) :
				m_help(&help), m_call([](const void* h) { (*static_cast<const Help*>(h))(); })
		{
			begin(helpers);
		}
		/// Waits for those that help.
		~Offer();
		Offer(const Offer&) = delete;
		Offer& operator=(const Offer&) = delete;

		/// From now on no other thread begins to help. Waits at most so long for those that have begun.
		/// \return whether all have ended
		bool end(std::chrono::milliseconds wait);

	private:
		friend class Crew;
		void begin(int helpers);

		const void* m_help;
		void (*m_call)(const void*);
		Crew* m_crew = nullptr; // none: nothing is offered
		int m_wanted = 0, m_atWork = 0;
		Offer *m_before = nullptr, *m_after = nullptr;
	};

private:
	void startThreads();
	void work();
	Offer* firstOpen() const;

	Crew* m_outer;
	std::mutex m_mutex; // for all that follows, and offers
	std::condition_variable m_isOffered, m_isDone;
	std::vector<std::thread> m_threads;
	Offer *m_first = nullptr, *m_last = nullptr;
	int m_idle = 0;    // threads
	int m_wanted = 0;  // by all offers
	int m_most = 0;    // that one offer wanted
	int m_waiting = 0; // callers, for others that help them
	bool m_isEnding = false;
};

} // namespace ricci

#endif
