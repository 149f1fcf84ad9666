// SPDX-License-Identifier: Apache-2.0
// The first two dimensions of Sobol's sequence, a (0,2)-sequence in base 2, with hashed Owen scrambling.
//   dimension 0:  reverse(i)              (van der Corput)
//   dimension 1:  reverse(P i)            P = Pascal's triangle mod 2: C(k, j) is odd iff j is a submask of k, so P i
//   is
//                                         a sum over supersets, five shifts and masks
// Owen scrambling flips each bit by a hash of the bits above it; on reversed words that is a hash in which a bit only
// depends on lower ones. [Sobol 1967] [Owen 1995] [Laine 2011] [Burley 2020]
// Word is a 32-bit unsigned integer or a SIMD register of them.
#pragma once

#include <cstdint>

namespace iride {

// Four points at a time: the x in words 0..3, the y in words 4..7 of a register.
inline constexpr int sobol_points = 4;
using SobolWords = std::uint32_t __attribute__((vector_size(2 * sobol_points * sizeof(std::uint32_t))));

template <class Word>
constexpr Word reverse_bits(Word x) {
    x = (x >> 16) | (x << 16);
    x = ((x >> 8) & 0x00ff00ffu) | ((x & 0x00ff00ffu) << 8);
    x = ((x >> 4) & 0x0f0f0f0fu) | ((x & 0x0f0f0f0fu) << 4);
    x = ((x >> 2) & 0x33333333u) | ((x & 0x33333333u) << 2);
    return ((x >> 1) & 0x55555555u) | ((x & 0x55555555u) << 1);
}

// Pascal's matrix mod 2 applied to a vector of bits: y_j = sum of x_k over all k that contain j.
template <class Word>
constexpr Word multiply_by_pascal(Word x) {
    x ^= (x >> 1) & 0x55555555u;
    x ^= (x >> 2) & 0x33333333u;
    x ^= (x >> 4) & 0x0f0f0f0fu;
    x ^= (x >> 8) & 0x00ff00ffu;
    return x ^ (x >> 16);
}

// A permutation of 32-bit words in which each bit depends only on itself, lower bits and the seed: Owen scrambling of
// the reversed word. [Laine 2011] [Vegdahl 2021]
template <class Word>
constexpr Word scramble_reversed(Word x, Word seed) {
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1u;
    x ^= x * 0x05526c56u;
    return x ^ (x * 0x53a22864u);
}

inline constexpr SobolWords sobol_is_y{0, 0, 0, 0, ~0u, ~0u, ~0u, ~0u};

// Point `index` of four shuffled sequences, reversed and not yet scrambled. shuffle: seed of each sequence's order
// (twice the same four words), in which every aligned block of 2^k indices stays a block.
inline SobolWords shuffled_sobol(std::uint32_t index, SobolWords shuffle) {
    SobolWords const i = reverse_bits(scramble_reversed(SobolWords{} + reverse_bits(index), shuffle));
    return (i & ~sobol_is_y) | (multiply_by_pascal(i) & sobol_is_y);
}

// The same as fixed point numbers of 2^-32. scramble: a seed for each coordinate.
inline SobolWords scrambled_sobol(std::uint32_t index, SobolWords shuffle, SobolWords scramble) {
    return reverse_bits(scramble_reversed(shuffled_sobol(index, shuffle), scramble));
}

// The even bits of each word, moved together.
template <class Word>
constexpr Word even_bits(Word x) {
    x &= 0x55555555u;
    x = (x | (x >> 1)) & 0x33333333u;
    x = (x | (x >> 2)) & 0x0f0f0f0fu;
    x = (x | (x >> 4)) & 0x00ff00ffu;
    return (x | (x >> 8)) & 0x0000ffffu;
}

// Progressive jittered points, seeds as above: of every aligned block of 4^k indices one lies in each of the 4^k equal
// squares, and anywhere in it. The shuffled index, reversed, is the Morton number of the square. [Christensen 2018]
inline SobolWords jittered(std::uint32_t index, SobolWords shuffle, SobolWords scramble) {
    SobolWords const i = scramble_reversed(SobolWords{} + reverse_bits(index), shuffle);  // reversed: first digit first
    SobolWords const square = (even_bits(i >> 1) & ~sobol_is_y) | (even_bits(i) & sobol_is_y);
    return reverse_bits(scramble_reversed(reverse_bits(square << 16), scramble));
}

}  // namespace iride
