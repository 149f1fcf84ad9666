// SPDX-License-Identifier: Apache-2.0
#include "scene/light.h"

namespace iride {

Radiance Light::emitted(SurfacePoint const&, Direction const&, Wavelengths const&) const { return {}; }
PerSteradian Light::density(Vector const&, SurfacePoint const&, std::uint32_t) const { return {}; }
Radiance Light::arriving(Direction const&, Wavelengths const&) const { return {}; }
PerSteradian Light::arriving_density(Direction const&) const { return {}; }

LightSet::LightSet(std::vector<std::unique_ptr<Light>> lights, double scene_radius) : lights_(std::move(lights)) {
    std::vector<double> power;
    double total = 0;
    for (std::size_t i = 0; i < lights_.size(); ++i) {
        power.push_back(lights_[i]->power(scene_radius));
        total += power.back();
        if (lights_[i]->is_environment()) environments_.push_back(static_cast<int>(i));
    }
    if (total > 0) by_power_ = DiscreteDistribution(power);
}

std::optional<LightSet::Choice> LightSet::choose_by_power(float u) const {
    if (by_power_.size() == 0) return std::nullopt;
    auto const choice = by_power_.sample(u);
    if (choice.probability <= 0) return std::nullopt;
    return Choice{choice.index, choice.probability, choice.rest};
}

}  // namespace iride
