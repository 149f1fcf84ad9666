// SPDX-License-Identifier: Apache-2.0
// What choosing among many lamps costs and gains: uniform, by power, by tree. Small spheres hang over a floor, one per
// square metre at 0.5 to 2.5 m, of powers over four decades. At places on the floor the variance of one sample is
// exact:
//   sum over lamps of c^2 / p - (sum of c)^2,   c = L pi (r/d)^2 cos
#include <fmt/format.h>

#include <ctime>

#include "scene/light_selection.h"

namespace {

using namespace iride;

constexpr float lamp_radius = 0.02f;  // m

struct Lamp {
    Vector at;
    float radiance;
};

std::vector<Lamp> lamps_over_floor(int count) {
    std::vector<Lamp> lamps;
    float const side = std::sqrt(static_cast<float>(count));
    for (int i = 0; i < count; ++i) {
        Sampler s(SamplerKind::independent, 1, 0, static_cast<std::uint32_t>(i));
        Sample2 const place = s.next2(), rest = s.next2();
        lamps.push_back({{side * place.x, 0.5f + 2 * rest.x, side * place.y}, std::pow(10.0f, 4 * rest.y - 2)});
    }
    return lamps;
}

LightSet light_set(std::vector<Lamp> const& lamps) {
    std::vector<std::unique_ptr<Light>> lights;
    SpectralFunction const white = SpectralFunction::constant(1);
    WavelengthGrid const grid{};
    for (Lamp const& lamp : lamps) {
        Shape shape;
        shape.geometry = Sphere{lamp.at, lamp_radius};
        SpectralFunction const L = SpectralFunction::constant(static_cast<double>(lamp.radiance));
        lights.push_back(make_area_light(shape, {{Emission(L, grid)}, static_cast<double>(lamp.radiance)}));
    }
    return LightSet(std::move(lights), 1);
}

// Mean over the places of the relative variance of one sample.
double relative_variance(std::vector<Lamp> const& lamps, LightSelector const& selector,
                         std::vector<LightReceiver> const& places) {
    double total = 0;
    for (LightReceiver const& place : places) {
        double sum = 0, squares = 0;
        for (std::size_t k = 0; k < lamps.size(); ++k) {
            VectorDouble const d = (lamps[k].at - place.position).cast<double>();
            double const c = pi_double * static_cast<double>(lamps[k].radiance) *
                             square(static_cast<double>(lamp_radius)) * d.y() / (d.squaredNorm() * d.norm());
            auto const p = static_cast<double>(selector.probability(place, static_cast<int>(k)));
            sum += c;
            squares += c * c / p;
        }
        total += squares / square(sum) - 1;
    }
    return total / static_cast<double>(places.size());
}

// Nanoseconds of the processor for choosing a lamp and a point of it; the least of some rounds.
double nanoseconds(LightSet const& lights, LightSelector const& selector, std::vector<LightReceiver> const& places,
                   Wavelengths const& wavelengths) {
    constexpr int rounds = 7, draws = 20000;
    double best = infinity;
    float kept = 0;
    for (int round = 0; round < rounds; ++round) {
        std::clock_t const start = std::clock();
        for (int i = 0; i < draws; ++i) {
            Sampler s(SamplerKind::sobol, 3, 0, static_cast<std::uint32_t>(i));
            LightReceiver const& place = places[static_cast<std::size_t>(i) % places.size()];
            auto const choice = selector.choose(place, s.next());
            auto const sample = lights.light(choice.light).sample(place.position, wavelengths, s.next2());
            if (sample) kept += sample->wi.y() / choice.probability;
        }
        best = std::min(best, 1e9 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC / draws);
    }
    return kept > 0 ? best : 0;
}

}  // namespace

int main() {
    fmt::print("| lamps | selection | ns a sample | relative variance | time x variance | of uniform |\n");
    fmt::print("|---:|---|---:|---:|---:|---:|\n");
    Wavelengths const wavelengths =
        WavelengthSampler(visible_range, SpectralFunction::constant(1), WavelengthGrid{}).sample(0.5f);
    for (int count : {2, 4, 8, 16, 32, 64, 256, 1000, 10000, 100000}) {
        std::vector<Lamp> const lamps = lamps_over_floor(count);
        LightSet const lights = light_set(lamps);
        std::vector<LightReceiver> places;
        for (std::uint32_t i = 0; i < 64; ++i) {
            Sample2 const u = Sampler(SamplerKind::sobol, 2, 0, i).next2();
            float const side = std::sqrt(static_cast<float>(count));
            places.push_back({{side * u.x, 0, side * u.y}, {0, 1, 0}});
        }
        double uniform = 0;
        for (LightSelection how : {LightSelection::uniform, LightSelection::power, LightSelection::tree}) {
            LightSelector const selector(lights, how);
            double const time = nanoseconds(lights, selector, places, wavelengths);
            double const variance = relative_variance(lamps, selector, places);
            if (how == LightSelection::uniform) uniform = time * variance;
            fmt::print("| {} | {} | {:.0f} | {:.4g} | {:.4g} | {:.3g} |\n", count,
                       light_selection_names[static_cast<std::size_t>(how)], time, std::max(0.0, variance),
                       std::max(0.0, time * variance), uniform > 0 ? time * variance / uniform : 1);
        }
    }
}
