// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_CHOLMOD_TICK_H
#define RICCI_CHOLMOD_TICK_H

#include "../base/task.h"

#include <exception>

namespace ricci {

/// Lets checkpoint() be called during a factorisation by CHOLMOD, for the BLAS in cholmod_blas.cpp. CHOLMOD
/// hands nothing on to BLAS, which finds this object by its thread as long as it lives.
class CholmodTick
{
public:
	CholmodTick();
	~CholmodTick();
	CholmodTick(const CholmodTick&) = delete;
	CholmodTick& operator=(const CholmodTick&) = delete;

	/// For BLAS, before it multiplies that many pairs of numbers: calls checkpoint() if the last call was
	/// some milliseconds of work ago. No exception may pass through CHOLMOD, so what it throws is kept.
	/// \return false from then on: what is factorised will not be used
	static bool goesOn(double products);

	/// Rethrows what checkpoint() has thrown.
	void rethrow() const;

private:
	CholmodTick* m_outer;    // of the same thread
	double m_products = 0.0; // since the last call
	std::exception_ptr m_thrown;
};

} // namespace ricci

#endif
