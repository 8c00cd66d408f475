// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_NUMBERS_H
#define RICCI_NUMBERS_H

#include <cstddef>

namespace ricci {

constexpr double kPi = 3.14159265358979323846;

/// pi less the double next to it.
constexpr double kPiRest = 1.2246467991473531772e-16;

/// Elements are numbered by int or Eigen::Index (-1: none), containers by std::size_t.
template<class Integer>
constexpr std::size_t at(Integer index)
{
	return static_cast<std::size_t>(index);
}

} // namespace ricci

#endif
