// SPDX-License-Identifier: Apache-2.0
#include "integrators/radiosity/lamp_light.h"

#include "integrators/radiosity/patch_spectra.h"

namespace iride::radiosity {

LampLight::LampLight(Scene const& scene, RenderPlan const& plan, PatchTracer const& tracer,
                     std::vector<double> const& wavelengths_nm)
    : scene_(scene), tracer_(tracer), selector_(scene.lights, plan.light_selection) {
    for (std::size_t first = 0; first < wavelengths_nm.size(); first += lane_count)
        packets_.push_back(packet_of(wavelengths_nm, first, scene.grid));
}

bool LampLight::ask(VectorDouble const& place, VectorDouble const& normal, float which, Sample2 where,
                    Spectrum& irradiance) const {
    auto const from = place.cast<float>();
    Direction const n = normal.cast<float>();
    auto const [lamp, probability] = selector_.choose({from, n}, which);
    if (lamp < 0) return false;
    Light const& light = scene_.lights.light(lamp);
    auto sample = light.sample(from, packets_.front(), where);
    float const cosine = sample ? sample->wi.dot(n) : 0;
    if (!(cosine > 0)) return false;
    constexpr double nearly = 1 - 1e-3;  // the lamp itself is met at this distance, or a little farther as facets
    auto const hit = tracer_.closest(place, normal, sample->wi.cast<double>());
    if (hit && (hit->position - place).norm() < nearly * static_cast<double>(sample->distance)) return false;
    float const weight = cosine / (probability * (sample->density ? sample->density->value : 1));
    for (std::size_t k = 0; k < packets_.size(); ++k) {
        if (k > 0) sample = light.sample(from, packets_[k], where);
        if (!sample) return false;
        auto const first = static_cast<Eigen::Index>(k) * lane_count;
        for (Eigen::Index lane = 0; lane < std::min<Eigen::Index>(lane_count, irradiance.size() - first); ++lane)
            irradiance[first + lane] = weight * sample->radiance[static_cast<int>(lane)];
    }
    return true;
}

}  // namespace iride::radiosity
