// SPDX-License-Identifier: Apache-2.0
#include "integrators/integrator.h"

#include <fmt/format.h>

#include <array>

#include "integrators/bidirectional.h"
#include "integrators/choice.h"
#include "integrators/light_tracing.h"
#include "integrators/path.h"
#include "integrators/radiosity/radiosity.h"

namespace iride {

namespace {

constexpr std::array<IntegratorEntry, 7> table{{
    {"path", "path tracing: light sampling and scattering, unbiased", make_path},
    {"reference_path", "path tracing by scattering alone: slow, the oracle of the others", make_reference_path},
    {"auto", "path or bidirectional, whichever suits the scene (`iride plan` says why)", make_auto},
    {"light-tracing", "paths from the lights, shown to the camera: caustics, but no mirror images", make_light_tracing},
    {"bidirectional", "paths from camera and light, joined in every way: unbiased, caustics and mirror images",
     make_bidirectional},
    {"bidirectional-power", "the same, weighed by the power heuristic", make_bidirectional_power},
    {"radiosity", "diffuse surfaces cut into patches, solved for every wavelength: no noise",
     radiosity::make_radiosity},
}};

}  // namespace

std::span<IntegratorEntry const> integrator_entries() { return table; }

std::unique_ptr<Integrator> make_integrator(std::string const& name, Scene const& scene, RenderPlan const& plan) {
    std::vector<std::string> names;
    for (IntegratorEntry const& e : table) {
        if (name == e.name) return e.make(scene, plan);
        names.emplace_back(e.name);
    }
    throw InputError({}, "integrator", fmt::format("unknown integrator '{}'{}", name, suggestion(name, names)));
}

}  // namespace iride
