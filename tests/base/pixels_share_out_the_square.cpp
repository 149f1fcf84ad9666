// SPDX-License-Identifier: Apache-2.0
// Sobol's points of neighbouring pixels, as one set. Fails for pixels that are scrambled apart, for two samples and
// more where the number of samples must be known beforehand, and for y with the digits of x.
#include <catch2/catch.hpp>
#include <set>

#include "base/sampler.h"

using namespace iride;

// One point in each elementary interval of area 2^-(k + 2L), whatever its shape.
TEST_CASE("2^k samples of each of 2^L x 2^L pixels are one net, for every k and L", "[law]") {
    for (std::uint32_t seed : {1u, 77u, 3456789123u})
        for (std::uint32_t level : {0u, 1u, 2u, 3u})
            for (std::uint32_t k : {0u, 1u, 2u, 3u, 4u}) {
                std::uint32_t const digits = k + 2 * level, pixels = 1u << (2 * level), samples = 1u << k;
                SobolWords const order = SobolWords{21, 22, 23, 24, 21, 22, 23, 24} * seed;
                SobolWords const shuffle = SobolWords{1, 2, 3, 4, 1, 2, 3, 4} * seed;
                SobolWords const scramble = SobolWords{5, 6, 7, 8, 9, 10, 11, 12} * (seed + 0x9e3779b9u);
                for (std::uint32_t split = 0; split <= digits; ++split) {
                    std::set<std::uint64_t> cells[sobol_points];
                    for (std::uint32_t pixel = 0; pixel < pixels; ++pixel)
                        for (std::uint32_t i = 0; i < samples; ++i) {
                            SobolWords const p = pixel_sobol(i + 5 * samples, reverse_bits(pixel + 13 * pixels),
                                                             shuffle, order, scramble);
                            for (int s = 0; s < sobol_points; ++s) {
                                std::uint64_t const x = split ? p[s] >> (32 - split) : 0,
                                                    y = digits - split ? p[s + sobol_points] >> (32 - (digits - split))
                                                                       : 0;
                                cells[s].insert(x << 32 | y);
                            }
                        }
                    for (auto const& of_sequence : cells) CHECK(of_sequence.size() == pixels * samples);
                }
            }
}

// A pixel by itself has a Sobol sequence all the same.
TEST_CASE("the samples of one pixel are a (0,2)-sequence", "[law]") {
    for (std::uint32_t pixel : {0u, 1u, 1023u, 0x3fffffu})
        for (std::uint32_t k = 1; k <= 8; ++k)
            for (std::uint32_t split = 0; split <= k; ++split) {
                std::set<std::pair<int, int>> cells;
                for (std::uint32_t i = 0; i < 1u << k; ++i) {
                    Sampler s(SamplerKind::zsobol, 4, pixel, i);
                    s.begin_vertex(2);
                    Sample2 const u = s.next2();
                    cells.emplace(static_cast<int>(u.x * static_cast<float>(1u << split)),
                                  static_cast<int>(u.y * static_cast<float>(1u << (k - split))));
                }
                CHECK(cells.size() == 1u << k);
            }
}

TEST_CASE("Morton numbers take the bits of x and y in turns", "[unit]") {
    CHECK(morton_number(0, 0) == 0);
    CHECK(morton_number(3, 0) == 5);
    CHECK(morton_number(0, 3) == 10);
    CHECK(morton_number(0xffff, 0xffff) == 0xffffffffu);
}
