// SPDX-License-Identifier: Apache-2.0
// The first two dimensions of Sobol's sequence, a (0,2)-sequence in base 2, with hashed Owen scrambling.
//   dimension 0:  reverse(i)              (van der Corput)
//   dimension 1:  reverse(P i)            P = Pascal's triangle mod 2: C(k, j) is odd iff j is a submask of k, so P i
//   is
//                                         a sum over supersets, five shifts and masks
// Owen scrambling flips each bit by a hash of the bits above it; on reversed words that is a hash in which a bit only
// depends on lower ones. [Sobol 1967] [Owen 1995] [Laine 2011] [Burley 2020]
#pragma once

#include <cstdint>

namespace iride {

constexpr std::uint32_t reverse_bits(std::uint32_t x) {
    x = __builtin_bswap32(x);
    x = ((x >> 4) & 0x0f0f0f0fu) | ((x & 0x0f0f0f0fu) << 4);
    x = ((x >> 2) & 0x33333333u) | ((x & 0x33333333u) << 2);
    return ((x >> 1) & 0x55555555u) | ((x & 0x55555555u) << 1);
}

// Pascal's matrix mod 2 applied to a vector of bits: y_j = sum of x_k over all k that contain j.
constexpr std::uint32_t multiply_by_pascal(std::uint32_t x) {
    x ^= (x >> 1) & 0x55555555u;
    x ^= (x >> 2) & 0x33333333u;
    x ^= (x >> 4) & 0x0f0f0f0fu;
    x ^= (x >> 8) & 0x00ff00ffu;
    return x ^ (x >> 16);
}

// A permutation of 32-bit words in which each bit depends only on itself, lower bits and the seed: Owen scrambling of
// the reversed word. [Laine 2011] [Vegdahl 2021]
constexpr std::uint32_t scramble_reversed(std::uint32_t x, std::uint32_t seed) {
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1u;
    x ^= x * 0x05526c56u;
    return x ^ (x * 0x53a22864u);
}

// Owen-scrambled order of the indices: each aligned block of 2^k consecutive ones stays a block.
constexpr std::uint32_t shuffled_index(std::uint32_t index, std::uint32_t seed) {
    return reverse_bits(scramble_reversed(reverse_bits(index), seed));
}

struct SobolPoint {
    std::uint32_t x, y;  // fixed point, 2^-32
};

// Point `index` of the scrambled and shuffled sequence; the seed's two halves choose shuffle and scrambles.
constexpr SobolPoint scrambled_sobol(std::uint32_t index, std::uint64_t seed) {
    auto const low = static_cast<std::uint32_t>(seed), high = static_cast<std::uint32_t>(seed >> 32);
    std::uint32_t const i = shuffled_index(index, low);
    return {reverse_bits(scramble_reversed(i, high)),
            reverse_bits(scramble_reversed(multiply_by_pascal(i), low * 0x9e3779b9u ^ high))};
}

}  // namespace iride
