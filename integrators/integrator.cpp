// SPDX-License-Identifier: Apache-2.0
#include "integrators/integrator.h"

#include <fmt/format.h>

#include <array>

#include "integrators/path.h"
#include "integrators/photon/photon_integrators.h"
#include "integrators/radiosity/radiosity.h"

namespace iride {

namespace {

constexpr std::array<IntegratorEntry, 6> table{{
    {"path", "path tracing: light sampling and scattering, unbiased", make_path},
    {"reference_path", "path tracing by scattering alone: slow, the oracle of the others", make_reference_path},
    {"radiosity", "diffuse surfaces cut into patches, solved for every wavelength: no noise",
     radiosity::make_radiosity},
    {"photon-map", "one photon map, nearest photons: caustics at once, biased", make_photon_map},
    {"progressive-photon", "photon maps of shrinking radius, pass by pass: unbiased in the limit",
     make_progressive_photon},
    {"final-gather", "photons or radiosity, gathered one scattering away: smooth", make_final_gather},
}};

}  // namespace

std::span<IntegratorEntry const> integrator_entries() { return table; }

std::unique_ptr<Integrator> make_integrator(IntegratorChoice const& choice, Scene const& scene,
                                            RenderPlan const& plan) {
    std::vector<std::string> names;
    for (IntegratorEntry const& e : table) {
        names.emplace_back(e.name);
        if (choice.name != e.name) continue;
        IntegratorOptions options(choice);
        auto integrator = e.make(scene, plan, options);
        options.finish();
        return integrator;
    }
    throw InputError({choice.file.string(), choice.line, choice.column}, choice.key_path,
                     fmt::format("unknown integrator '{}'{}", choice.name, suggestion(choice.name, names)));
}

std::unique_ptr<Integrator> make_integrator(std::string const& text, Scene const& scene, RenderPlan const& plan) {
    return make_integrator(parse_integrator(text), scene, plan);
}

}  // namespace iride
