// SPDX-License-Identifier: Apache-2.0
#include "materials/mixture_material.h"

#include "base/check.h"

namespace iride {

namespace {

MaterialTraits either(MaterialTraits const& a, MaterialTraits const& b) {
    check(a.two_sided && b.two_sided, "what is made of others turns with the viewer");
    return {.dispersive = a.dispersive || b.dispersive,
            .has_density = a.has_density || b.has_density,
            .transmits = a.transmits || b.transmits,
            .filmed = a.filmed || b.filmed,
            .textured = a.textured || b.textured,
            .anisotropic = a.anisotropic || b.anisotropic,
            .grain = a.anisotropic ? a.grain : b.grain};
}

MaterialTraits traits_of(std::vector<MixtureMaterial::Part> const& parts) {
    MaterialTraits all = parts.front().material->traits;
    for (auto const& part : parts) all = either(all, part.material->traits);
    return all;
}

}  // namespace

MixtureMaterial::MixtureMaterial(std::vector<Part> const& parts) : Material(traits_of(parts)) {
    std::vector<double> weights;
    for (Part const& part : parts) {
        parts_.push_back(part.material);
        weights.push_back(part.weight);
    }
    choice_ = DiscreteDistribution(weights);
}

Bsdf MixtureMaterial::at(SurfacePoint const& point, Wavelengths const& w) const {
    auto const choice = choice_.sample(point.choice);
    SurfacePoint within = point;
    within.choice = choice.rest;
    return parts_[static_cast<std::size_t>(choice.index)]->at(within, w);
}

TwoSidedMaterial::TwoSidedMaterial(Material const& front, Material const& back)
    : Material(either(front.traits, back.traits)), front_(front), back_(back) {}

}  // namespace iride
