// SPDX-License-Identifier: Apache-2.0
// The random numbers of one camera path: dimension after dimension, each a function of (seed, pixel, sample,
// dimension). They come in blocks of four pairs, made together in one register: a block for the camera, one for each
// vertex of the path. Each pair is an independently scrambled and shuffled (0,2)-sequence over the samples of its pixel
// ("padding"), with SamplerKind::zsobol one that neighbouring pixels share (base/pixel_sobol.h); with stratified,
// progressive jittered points; with independent, plain hashes.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string_view>

#include "base/pixel_sobol.h"
#include "base/random.h"

namespace iride {

struct Sample2 {
    float x, y;
};

enum class SamplerKind { sobol, independent, stratified, zsobol };
inline constexpr std::array<char const*, 4> sampler_names{"sobol", "independent", "stratified", "zsobol"};
constexpr std::optional<SamplerKind> sampler_of(std::string_view name) {
    for (std::size_t i = 0; i < sampler_names.size(); ++i)
        if (name == sampler_names[i]) return static_cast<SamplerKind>(i);
    return std::nullopt;
}

class Sampler {
  public:
    // `pixel`: any number of its own; with zsobol its Morton number, that neighbours know of one another.
    Sampler(SamplerKind kind, std::uint64_t seed, std::uint32_t pixel, std::uint32_t sample)
        : key_(kind == SamplerKind::zsobol ? hash_words(seed) : hash_words(seed, pixel)),
          sample_(sample),
          reversed_pixel_(reverse_bits(pixel)),
          kind_(kind) {
        begin_block(0);
    }

    // The next pair, or the first number of it.
    Sample2 next2() {
        if (used_ == sobol_points) begin_block(block_ + 1);
        int const i = used_++;
        return {number_[i], number_[i + sobol_points]};
    }
    float next() { return next2().x; }

    // Go to the block of path vertex `vertex`, whatever has been used of those before: the same decision of two paths
    // then reads the same dimension. What does not fit into a block goes to one that no vertex begins with.
    void begin_vertex(std::uint32_t vertex) { begin_block(block_of(vertex)); }
    // The same, and use up the block: its pairs become the members of `decisions`, four Sample2, in one store.
    template <class Decisions>
    [[gnu::always_inline]] void begin_vertex(std::uint32_t vertex, Decisions& decisions) {
        static_assert(sizeof(Decisions) == sobol_points * sizeof(Sample2));
        block_ = block_of(vertex);
        used_ = sobol_points;
        constexpr SobolWords pair_by_pair{0, 4, 1, 5, 2, 6, 3, 7};
        Numbers const pairs = __builtin_shuffle(numbers_of_block(block_), pair_by_pair);
        std::memcpy(&decisions, &pairs, sizeof pairs);
    }

    // For part `part` of `count` that this path is split into: of all parts of all samples, the numbers are as even as
    // those of that many samples.
    void split(std::uint32_t part, std::uint32_t count) { sample_ = sample_ * count + part; }

  private:
    using Numbers = float __attribute__((vector_size(sizeof(SobolWords))));

    // Words [first, first + 8) of a hash sequence: one round of multiply and shift, on top of a fully mixed base.
    static SobolWords spread(std::uint32_t base, std::uint32_t first) {
        SobolWords x = (SobolWords{0, 1, 2, 3, 4, 5, 6, 7} + first) * 0x9e3779b9u + base;
        x ^= x >> 16;
        x *= 0x21f0aaadu;
        return x ^ (x >> 15);
    }

    static std::uint32_t block_of(std::uint32_t vertex) { return 2 * vertex + 2; }
    void begin_block(std::uint32_t block) {
        block_ = block;
        used_ = 0;
        number_ = numbers_of_block(block);
    }
    // x of the block's four pairs, then y.
    [[gnu::always_inline, gnu::flatten]] Numbers numbers_of_block(std::uint32_t block) const {
        bool const by_index = kind_ != SamplerKind::independent;
        std::uint64_t const base =
            by_index ? mix_bits(key_ + 0x9e3779b97f4a7c15ull * (block + 1ull)) : hash_words(key_, sample_, block);
        auto const low = static_cast<std::uint32_t>(base), high = static_cast<std::uint32_t>(base >> 32);
        SobolWords const seeds = spread(low, 0);
        SobolWords words;
        if (by_index) {
            SobolWords const once = spread(high, 8);
            constexpr SobolWords twice{0, 1, 2, 3, 0, 1, 2, 3}, twice_more{4, 5, 6, 7, 4, 5, 6, 7};
            SobolWords const shuffle = __builtin_shuffle(once, twice);
            if (kind_ == SamplerKind::zsobol)
                words = pixel_sobol(sample_, reversed_pixel_, shuffle, __builtin_shuffle(once, twice_more), seeds);
            else
                words = kind_ == SamplerKind::sobol ? scrambled_sobol(sample_, shuffle, seeds)
                                                    : jittered(sample_, shuffle, seeds);
        } else {
            words = seeds ^ spread(high, 8);
            words *= 0x735a2d97u;
            words ^= words >> 15;
        }
        // The upper 24 bits: every value is exact and 1 is never reached.
        using Signed = std::int32_t __attribute__((vector_size(sizeof(SobolWords))));
        return __builtin_convertvector(reinterpret_cast<Signed>(words >> 8), Numbers) * 0x1p-24f;
    }

    Numbers number_;
    std::uint64_t key_;
    std::uint32_t sample_, reversed_pixel_, block_ = 0;
    int used_ = 0;
    SamplerKind kind_;
};

}  // namespace iride
