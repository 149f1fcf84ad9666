// SPDX-License-Identifier: Apache-2.0
// What single steps of a path cost: see bench/README.md.
#include <benchmark/benchmark.h>

#include "materials/conductor_material.h"

namespace {

using namespace iride;

Bsdf rough_gold(float alpha, bool multiple_scattering) {
    static std::vector<std::unique_ptr<GgxAlbedo const>> albedos;
    Lanes n, k;
    for (int i = 0; i < lane_count; ++i) {  // from blue to red, roughly
        float const x = static_cast<float>(i) / lane_count;
        n.set(i, 1.4f - 1.2f * x);
        k.set(i, 1.9f + 1.5f * x);
    }
    if (!multiple_scattering) return RoughConductor{n, k, {alpha}};
    albedos.push_back(std::make_unique<GgxAlbedo const>(Ggx{alpha}));
    return InterreflectingConductor{n, k, Lanes(.5f), {alpha}, albedos.back().get()};
}

// One vertex of a path with light sampling: evaluate for a light's direction, then sample. [ns]
void conductor(benchmark::State& state) {
    Bsdf const bsdf = rough_gold(static_cast<float>(state.range(1)) / 100, state.range(0) != 0);
    std::uint32_t i = 0;
    std::vector<std::pair<Direction, Direction>> directions;
    std::vector<Sample3> numbers;
    for (; i < 1024; ++i) {
        Sampler s(SamplerKind::independent, 1, 1, i);
        directions.emplace_back(to_cosine_hemisphere(s.next2()), to_cosine_hemisphere(s.next2()));
        numbers.push_back({s.next(), s.next2()});
    }
    for (auto _ : state) {
        auto const& [wo, wi] = directions[i % 1024];
        benchmark::DoNotOptimize(bsdf.evaluate(wo, wi));
        benchmark::DoNotOptimize(bsdf.sample(wo, numbers[i % 1024]));
        ++i;
    }
}
BENCHMARK(conductor)->ArgNames({"multiple", "alpha_percent"})->ArgsProduct({{0, 1}, {5, 20, 50, 100}});

}  // namespace

BENCHMARK_MAIN();
