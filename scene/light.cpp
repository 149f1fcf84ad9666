// SPDX-License-Identifier: Apache-2.0
#include "scene/light.h"

namespace iride {

void Light::answer(std::span<LightRequest> requests) const {
    for (LightRequest& r : requests) r.sample = sample(r.from, *r.wavelengths, r.u);
}
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

}  // namespace iride
