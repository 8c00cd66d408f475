// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RICCI_NUMBERS_H
#define RICCI_NUMBERS_H

namespace ricci {

constexpr double kPi = 3.14159265358979323846;

/// pi less the double next to it.
constexpr double kPiLow = 1.2246467991473531772e-16;
constexpr double kQuarterTurn = 0.5 * kPi;

} // namespace ricci

#endif
