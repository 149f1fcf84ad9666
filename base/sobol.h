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
#ifdef __AVX2__
#include <immintrin.h>
#endif

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

#ifdef __AVX2__
// Bytes in reverse order, and in each the bits of a half byte by table.
inline SobolWords reverse_bits(SobolWords x) {
    using Bytes = char __attribute__((vector_size(sizeof(SobolWords))));
    auto const looked_up = [](__m256i table, SobolWords half) {
        return reinterpret_cast<SobolWords>(_mm256_shuffle_epi8(table, reinterpret_cast<__m256i>(half)));
    };
    __m256i const reversed =
        _mm256_broadcastsi128_si256(_mm_setr_epi8(0, 8, 4, 12, 2, 10, 6, 14, 1, 9, 5, 13, 3, 11, 7, 15));
    __m256i const to_high = _mm256_slli_epi16(reversed, 4);
    SobolWords const bytes = looked_up(to_high, x & 0x0f0f0f0fu) | looked_up(reversed, (x >> 4) & 0x0f0f0f0fu);
    constexpr Bytes backwards{3, 2, 1, 0, 7, 6, 5, 4, 11, 10, 9, 8, 15, 14, 13, 12,
                              3, 2, 1, 0, 7, 6, 5, 4, 11, 10, 9, 8, 15, 14, 13, 12};
    return looked_up(reinterpret_cast<__m256i>(bytes), reinterpret_cast<SobolWords>(backwards));
}
#endif

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
[[gnu::always_inline]] inline SobolWords shuffled_sobol(std::uint32_t index, SobolWords shuffle) {
    SobolWords const i = reverse_bits(scramble_reversed(SobolWords{} + reverse_bits(index), shuffle));
    return (i & ~sobol_is_y) | (multiply_by_pascal(i) & sobol_is_y);
}

// The same as fixed point numbers of 2^-32. scramble: a seed for each coordinate.
[[gnu::always_inline]] inline SobolWords scrambled_sobol(std::uint32_t index, SobolWords shuffle, SobolWords scramble) {
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
[[gnu::always_inline]] inline SobolWords jittered(std::uint32_t index, SobolWords shuffle, SobolWords scramble) {
    SobolWords const i = scramble_reversed(SobolWords{} + reverse_bits(index), shuffle);  // reversed: first digit first
    SobolWords const square = (even_bits(i >> 1) & ~sobol_is_y) | (even_bits(i) & sobol_is_y);
    return reverse_bits(scramble_reversed(reverse_bits(square << 16), scramble));
}

}  // namespace iride
