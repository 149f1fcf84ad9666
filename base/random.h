// SPDX-License-Identifier: Apache-2.0
// Counter-based random numbers: every number is a hash of (seed, pixel, sample, dimension) and of nothing else, so the
// picture does not depend on threads, tile order, resume or the number of processes.
#pragma once

#include <cstdint>

#include "base/constants.h"

namespace iride {

// A bijection of 64-bit words with full avalanche. [Steele 2014, variant 13 of Stafford]
constexpr std::uint64_t mix_bits(std::uint64_t x) {
    x ^= x >> 30;
    x *= 0xbf58476d1ce4e5b9ull;
    x ^= x >> 27;
    x *= 0x94d049bb133111ebull;
    return x ^ (x >> 31);
}

// Hash of a sequence of words; order matters.
constexpr std::uint64_t hash_words(std::uint64_t first) { return mix_bits(first + 0x9e3779b97f4a7c15ull); }
template <class... Rest>
constexpr std::uint64_t hash_words(std::uint64_t first, Rest... rest) {
    return mix_bits(hash_words(static_cast<std::uint64_t>(rest)...) ^ (first + 0x9e3779b97f4a7c15ull));
}

// The upper 24 bits as a float in [0, 1): every value is exact and 1 is never reached.
constexpr float to_unit_float(std::uint32_t bits) { return static_cast<float>(bits >> 8) * 0x1p-24f; }

}  // namespace iride
