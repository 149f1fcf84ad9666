// SPDX-License-Identifier: Apache-2.0
#include "integrators/integrator.h"

#include <fmt/format.h>

#include <array>

#include "integrators/path.h"
#include "integrators/radiosity/radiosity.h"

namespace iride {

namespace {

constexpr std::array<IntegratorEntry, 3> table{{
    {"path", "path tracing: light sampling and scattering, unbiased", make_path, true},
    {"reference_path", "path tracing by scattering alone: slow, the oracle of the others", make_reference_path, true},
    {"radiosity", "diffuse surfaces cut into patches, solved for every wavelength: no noise",
     radiosity::make_radiosity},
}};

void refuse_media(IntegratorEntry const& entry, Scene const& scene, RenderPlan const& plan) {
    if (entry.through_media || !(plan.scattering || scene.open_medium.attenuates())) return;
    std::string able;
    for (IntegratorEntry const& e : table)
        if (e.through_media) able += fmt::format("{}'{}'", able.empty() ? "" : ", ", e.name);
    throw InputError({}, "integrator",
                     fmt::format("'{}' knows no medium that scatters or that fills the space between bodies, and this "
                                 "scene has one; allowed: {}",
                                 entry.name, able));
}

}  // namespace

std::span<IntegratorEntry const> integrator_entries() { return table; }

std::unique_ptr<Integrator> make_integrator(std::string const& name, Scene const& scene, RenderPlan const& plan) {
    std::vector<std::string> names;
    for (IntegratorEntry const& e : table) {
        if (name == e.name) {
            refuse_media(e, scene, plan);
            return e.make(scene, plan);
        }
        names.emplace_back(e.name);
    }
    throw InputError({}, "integrator", fmt::format("unknown integrator '{}'{}", name, suggestion(name, names)));
}

}  // namespace iride
