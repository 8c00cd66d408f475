// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_TESTS_FACADE_CHECK_H
#define RICCI_TESTS_FACADE_CHECK_H

#include <cstddef>
#include <cstdint>
#include <string>

namespace ricci::testing {

enum class Verdict { Mapped, Refused, Cancelled };

struct Execution
{
	Verdict verdict = Verdict::Refused;
	std::string sentence; ///< of a refusal
	std::string defect;   ///< empty if everything that must hold does
};

/// Runs the façade on the hostile mesh that the bytes describe. Whatever it is, either an error
/// with a sentence comes back, not for how faces are connected, and the mesh is bit for bit as before,
/// or a finite map of every face with a converged residual, in the unit square if asked, whose reported
/// number of flipped faces is that of an exact count of what was written.
Execution runFacade(const std::uint8_t* data, std::size_t size);

} // namespace ricci::testing

#endif
