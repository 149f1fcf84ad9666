// SPDX-License-Identifier: Apache-2.0
// The random numbers of one camera path: dimension after dimension, each a function of (seed, pixel, sample,
// dimension). Dimensions are handed out in pairs; each pair is an independently scrambled and shuffled (0,2)-sequence
// over the samples of its pixel ("padding"), or, with SamplerKind::independent, plain hashes.
#pragma once

#include <cstdint>

#include "base/random.h"
#include "base/sobol.h"

namespace iride {

struct Sample2 {
    float x, y;
};

enum class SamplerKind { sobol, independent };

class Sampler {
  public:
    Sampler(SamplerKind kind, std::uint64_t seed, std::uint32_t pixel, std::uint32_t sample)
        : key_(hash_words(seed, pixel)), sample_(sample), kind_(kind) {}

    float next() { return next2().x; }

    Sample2 next2() {
        if (kind_ == SamplerKind::independent) {
            std::uint64_t const bits = hash_words(key_, sample_, dimension_++);
            return {to_unit_float(static_cast<std::uint32_t>(bits >> 32)),
                    to_unit_float(static_cast<std::uint32_t>(bits))};
        }
        SobolPoint const p = scrambled_sobol(sample_, mix_bits(key_ + 0x9e3779b97f4a7c15ull * ++dimension_));
        return {to_unit_float(p.x), to_unit_float(p.y)};
    }

    // Go to the first dimension of path vertex `vertex`, whatever the vertices before it have used: the same decision
    // of two paths then reads the same dimension.
    void begin_vertex(std::uint32_t vertex) { dimension_ = camera_dimensions + vertex * vertex_dimensions; }

  private:
    static constexpr std::uint32_t camera_dimensions = 4, vertex_dimensions = 6;  // pairs

    std::uint64_t key_;
    std::uint32_t sample_;
    std::uint32_t dimension_ = 0;
    SamplerKind kind_;
};

}  // namespace iride
