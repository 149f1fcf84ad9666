// SPDX-License-Identifier: Apache-2.0
// What single steps of a path cost: see bench/README.md.
#include <benchmark/benchmark.h>

#include "materials/closure.h"

namespace {

using namespace iride;

// From blue to red, roughly.
BareFresnel gold() {
    BareFresnel fresnel;
    for (int i = 0; i < lane_count; ++i) {
        float const x = static_cast<float>(i) / lane_count;
        fresnel.n.set(i, 1.4f - 1.2f * x);
        fresnel.k.set(i, 1.9f + 1.5f * x);
    }
    return fresnel;
}

// One vertex of a path with light sampling: evaluate for a light's direction, then sample. [ns]
void vertex(benchmark::State& state, Bsdf const& bsdf) {
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

void conductor(benchmark::State& state) {
    float const alpha = static_cast<float>(state.range(1)) / 100;
    auto const loss = shared_facet_loss(Facets::ggx(alpha, alpha));
    vertex(state, RoughConductor{gold(), alpha, state.range(0) != 0 ? loss.get() : nullptr, Lanes(.5f)});
}
BENCHMARK(conductor)->ArgNames({"multiple", "alpha_percent"})->ArgsProduct({{0, 1}, {5, 20, 50, 100}});

void facets(benchmark::State& state, Facets const& facets) {
    auto const loss = shared_facet_loss(facets);
    if (facets.is_plain())
        vertex(state, RoughConductor{gold(), facets.plain(), loss.get(), Lanes(.5f)});
    else
        vertex(state, RoughMetal<BareFresnel, FacetsOfMaterial>{gold(), {&facets}, loss.get(), Lanes(.5f)});
}
std::vector<FacetComponent> const one{{1, .2f, .2f}}, brushed{{1, .05f, .3f}}, two{{.5f, .1f, .1f}, {.5f, .4f, .4f}};
BENCHMARK_CAPTURE(facets, ggx_anisotropic, Facets{brushed});
BENCHMARK_CAPTURE(facets, ggx_mixture, Facets{two});
BENCHMARK_CAPTURE(facets, beckmann, Facets{one, FacetShape::beckmann});
BENCHMARK_CAPTURE(facets, beckmann_mixture, Facets{two, FacetShape::beckmann});
BENCHMARK_CAPTURE(facets, ggx_v_cavity, Facets{one, FacetShape::ggx, Masking::v_cavity});
BENCHMARK_CAPTURE(facets, beckmann_v_cavity, Facets{one, FacetShape::beckmann, Masking::v_cavity});

void rough_glass(benchmark::State& state) {
    BoundaryLoss const loss(Facets::ggx(.2f, .2f), 1.5, 1.5);
    vertex(state, RoughDielectric<Ggx>{Lanes(1.5f), Lanes(1), .2f, &loss});
}
BENCHMARK(rough_glass);

// What a material with facets of its own costs at load. [ms]
void tabulate_loss(benchmark::State& state) {
    float const alpha = static_cast<float>(state.range(0)) / 1000;
    for (auto _ : state) benchmark::DoNotOptimize(FacetLoss(Facets::ggx(alpha, alpha)));
}
BENCHMARK(tabulate_loss)->ArgName("alpha_permille")->Arg(1)->Arg(50)->Arg(1000)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
