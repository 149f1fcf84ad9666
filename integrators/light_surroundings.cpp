// SPDX-License-Identifier: Apache-2.0
#include "integrators/light_surroundings.h"

namespace iride {

namespace {

// None: rays disagree.
std::optional<Surroundings> common_surroundings(Scene const& scene, Light const& light,
                                                Wavelengths const& wavelengths) {
    constexpr std::uint32_t rays = 64;
    Ball const ball{scene.centre(), scene.radius()};
    std::optional<Surroundings> first;
    for (std::uint32_t i = 0; i < rays; ++i) {
        Sampler numbers(SamplerKind::sobol, 0, 0, i);
        Sample2 const place = numbers.next2();
        auto const e = light.emit(ball, wavelengths, place, numbers.next2());
        if (!e) continue;
        Surroundings const here = surroundings_at(scene, leaving_ray(light, *e).origin);
        if (!first) first = here;
        if (!(here == *first)) return std::nullopt;
    }
    return first;
}

}  // namespace

LightSurroundings::LightSurroundings(Scene const& scene, RenderPlan const& plan) : media_(plan.media) {
    if (!media_) return;
    Wavelengths const some =
        WavelengthSampler(plan.wavelengths, SpectralFunction::constant(1), scene.grid).sample(0.5f);
    for (int i = 0; i < static_cast<int>(scene.lights.size()); ++i)
        of_light_.push_back(common_surroundings(scene, scene.lights.light(i), some));
}

Throughput LightSurroundings::left(Light const& light, Surroundings const& in, Wavelengths const& wavelengths) {
    bool const from_infinity = light.extent() == LightExtent::distant || light.extent() == LightExtent::environment;
    return from_infinity ? in.medium().transmittance(infinity, wavelengths) : Throughput(1);
}

}  // namespace iride
