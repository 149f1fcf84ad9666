// SPDX-License-Identifier: Apache-2.0
// Sobol's points of all pixels of a picture as one point set, in which neighbours share out the square, however many
// samples they have: for every k, L and aligned square of 2^L x 2^L pixels the first 2^k points of these (and each
// aligned block after them) are one (0, k + 2L, 2)-net. Errors of neighbours then cancel: blue noise. Over GF(2),
// sample digits s_k and pixel digits a_m, b_m (two for each level of the Morton number, 0 the finest) make a function
// of t,
//   f(t) = sum s_k t^k + sum (a_m + b_m t) / q(t)^(m+1),    q = t^2 + t + 1
// and x, y are its expansions at t = 0 and t = 1. If k sample digits and L levels make the first i digits of x and j of
// y 0, i + j = k + 2L, then f q^L is a polynomial of degree < k + 2L with as many zeros, hence 0: any two points differ
// there. Without pixels this is Sobol's sequence; q stays q when t is t + 1. The order of the pixels is scrambled as
// points are, anew for each pair of dimensions. [Niederreiter 1996] [Ahmed 2020]
#pragma once

#include "base/sobol.h"

namespace iride {

// Bits of x and y in turns, x first: neighbours in the picture are so in number. x, y < 2^16.
constexpr std::uint32_t morton_number(std::uint32_t x, std::uint32_t y) {
    auto const spread = [](std::uint32_t v) {
        v = (v | (v << 8)) & 0x00ff00ffu;
        v = (v | (v << 4)) & 0x0f0f0f0fu;
        v = (v | (v << 2)) & 0x33333333u;
        return (v | (v << 1)) & 0x55555555u;
    };
    return spread(x) | spread(y) << 1;
}

// The pixels' part of reversed points, from reversed Morton numbers: digits to base q, the finest level first, are
// multiplied out (halves A and B of 2n bits each: A q^n + B, q^n = t^2n + t^n + 1) and divided by q^16.
template <class Word>
constexpr Word expanded_at_zero(Word x) {
    auto const join = [&x](std::uint32_t upper_half, int n) {
        Word const A = x & upper_half;
        x ^= (A >> n) ^ (A >> (2 * n));
    };
    join(0xccccccccu, 1);
    join(0xf0f0f0f0u, 2);
    join(0xff00ff00u, 4);
    join(0xffff0000u, 8);
    return x ^ (x << 16);
}

// Point `index` of the pixel with reversed Morton number `pixel`, of four sequences. Seeds as for scrambled_sobol(),
// the same for all pixels; order: of each sequence's order of pixels, twice the same four words.
[[gnu::always_inline]] inline SobolWords pixel_sobol(std::uint32_t index, std::uint32_t pixel, SobolWords shuffle,
                                                     SobolWords order, SobolWords scramble) {
    SobolWords digits = scramble_reversed(SobolWords{} + pixel, order);
    digits ^= (digits >> 1) & 0x55555555u & sobol_is_y;  // a + b t = (a + b) + b (t + 1)
    SobolWords const reversed = shuffled_sobol(index, shuffle) ^ expanded_at_zero(digits);
    return reverse_bits(scramble_reversed(reversed, scramble));
}

}  // namespace iride
