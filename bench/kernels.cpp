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

// The random numbers of one path vertex, four pairs. [ns]
void sampler(benchmark::State& state) {
    auto const kind = static_cast<SamplerKind>(state.range(0));
    for (std::uint32_t i = 0; auto _ : state) {
        Sampler s(kind, 1, 7, i++);
        s.begin_vertex(1);
        benchmark::DoNotOptimize(s.next2());
    }
    state.SetLabel(sampler_names[static_cast<std::size_t>(kind)]);
}
BENCHMARK(sampler)->DenseRange(0, static_cast<int>(sampler_names.size()) - 1);

// Reflectance of a metal under so many films, for all lanes. [ns]
void coating(benchmark::State& state) {
    auto const constant = [](double n, double k) {
        return ComplexIndex{SpectralFunction::constant(n), SpectralFunction::constant(k)};
    };
    WavelengthGrid const grid = WavelengthGrid::covering(visible_range);
    std::vector<CoatingLayer> layers;
    for (int i = 0; i < state.range(0); ++i) layers.push_back({constant(i % 2 ? 1.46 : 2.35, 0), i % 2 ? 94.0 : 58.0});
    CoatingTable const table(layers, constant(.2, 3), grid);
    WavelengthSampler const sampler(visible_range, SpectralFunction::constant(1), grid);
    constexpr std::uint32_t packets = 64;
    std::vector<LaneRegister> rows;
    for (std::uint32_t i = 0; i < packets; ++i)
        rows.push_back(table.row_of(sampler.sample((static_cast<float>(i) + .5f) / packets)));
    for (std::uint32_t i = 0; auto _ : state) {
        float const cosine = static_cast<float>(i * 37 % 1000) / 1000;
        benchmark::DoNotOptimize(table.reflectance(rows[i++ % packets], cosine));
    }
}
BENCHMARK(coating)->ArgName("films")->Arg(0)->Arg(1)->Arg(2)->Arg(20);

}  // namespace

BENCHMARK_MAIN();
