// SPDX-License-Identifier: GPL-3.0-or-later
#include "cholmod_tick.h"

#include "../base/task.h"

namespace ricci {

namespace {

/// Products of two numbers between two calls of checkpoint(): some milliseconds.
constexpr double kBetweenTicks = 2e7;

thread_local CholmodTick* current = nullptr;

} // namespace

CholmodTick::CholmodTick() : m_outer(current)
{
	current = this;
}

CholmodTick::~CholmodTick()
{
	current = m_outer;
}

bool CholmodTick::goesOn(double products)
{
	CholmodTick* own = current;
	if (!own)
		return true;
	own->m_products += products;
	if (own->m_products > kBetweenTicks && !own->m_thrown) {
		own->m_products = 0.0;
		try {
			checkpoint();
		}
		catch (...) {
			own->m_thrown = std::current_exception();
		}
	}
	return !own->m_thrown;
}

void CholmodTick::rethrow() const
{
	if (m_thrown)
		std::rethrow_exception(m_thrown);
}

} // namespace ricci
