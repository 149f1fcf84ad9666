// SPDX-License-Identifier: Apache-2.0
// Mathematical constants in the precision of the sampling loop.
#pragma once

#include <numbers>

namespace iride {

inline constexpr float pi = std::numbers::pi_v<float>;
inline constexpr float inverse_pi = std::numbers::inv_pi_v<float>;
inline constexpr double pi_double = std::numbers::pi;
inline constexpr float infinity = __builtin_inff();

// Largest float below 1: random numbers live in [0, one_minus_epsilon].
inline constexpr float one_minus_epsilon = 0x1.fffffep-1f;

constexpr double radians(double degrees) { return degrees * (std::numbers::pi / 180); }

}  // namespace iride
