// SPDX-License-Identifier: Apache-2.0
#include "integrators/integrator.h"

#include <fmt/format.h>

#include <array>

#include "integrators/ambient_occlusion.h"
#include "integrators/automatic.h"
#include "integrators/bidirectional.h"
#include "integrators/light_tracing.h"
#include "integrators/path.h"
#include "integrators/photon/photon_integrators.h"
#include "integrators/radiosity/directional.h"
#include "integrators/radiosity/radiosity.h"
#include "integrators/radiosity/two_pass.h"
#include "integrators/recursive.h"

namespace iride {

namespace {

constexpr std::array<IntegratorEntry, 16> table{{
    {"path", "path tracing: light sampling and scattering, unbiased; splits=", make_path, MediaKnown::scattering},
    {"reference_path", "path tracing by scattering alone: slow, the oracle of the others", make_reference_path,
     MediaKnown::scattering},
    {"auto",
     "the default: path or caustic-path, whichever suits the scene, split where it is noisy, later bidirectional-power "
     "where that is better (`iride plan` says why)",
     make_auto, MediaKnown::scattering},
    {"light-tracing", "paths from the lights, shown to the camera: caustics, but no mirror images", make_light_tracing,
     MediaKnown::between_bodies},
    {"bidirectional", "paths from camera and light, joined in every way: unbiased, caustics and mirror images",
     make_bidirectional, MediaKnown::between_bodies},
    {"bidirectional-power", "the same, weighed by the power heuristic", make_bidirectional_power,
     MediaKnown::between_bodies},
    {"caustic-path",
     "path tracing, and light paths aimed at mirrors and glass: unbiased, caustics; light_paths=, splits=",
     make_caustic_path, MediaKnown::between_bodies},
    {"direct",
     "lamps and what they light without a stop; strategy= hemisphere, cosine, bsdf, area, solid-angle, mis; "
     "lights= uniform, power, tree, all; samples=",
     make_direct},
    {"recursive", "Whitted's: chains of mirrors and glass, direct light at their ends; generations=, splits=, lights=",
     make_recursive},
    {"ambient-occlusion",
     "how much of a sky each place would see; sampling= uniform, cosine; distance=", make_ambient_occlusion},
    {"radiosity",
     "diffuse surfaces cut into patches, solved for every wavelength: no noise; patches=, wavelengths=, form_factors=; "
     "direct_light= patches, lamps; last_gather= rays",
     radiosity::make_radiosity},
    {"directional-radiosity",
     "the same where surfaces are rough, patch to patch to patch, for small scenes; patches=, wavelengths=",
     radiosity::make_directional_radiosity},
    {"two-pass",
     "path tracing with radiosity as control variate: unbiased; patches=, rays= among them, go_on= of the paths",
     radiosity::make_two_pass},
    {"photon-map", "one photon map, nearest photons: caustics at once, biased", make_photon_map},
    {"progressive-photon", "photon maps of shrinking radius, pass by pass: unbiased in the limit",
     make_progressive_photon},
    {"final-gather", "photons or radiosity, gathered one scattering away: smooth", make_final_gather},
}};

void refuse_media(IntegratorEntry const& entry, Scene const& scene, RenderPlan const& plan) {
    MediaKnown const needed = plan.scattering                  ? MediaKnown::scattering
                              : scene.open_medium.attenuates() ? MediaKnown::between_bodies
                                                               : MediaKnown::in_bodies;
    if (entry.media >= needed) return;
    std::string able;
    for (IntegratorEntry const& e : table)
        if (e.media >= needed) able += fmt::format("{}'{}'", able.empty() ? "" : ", ", e.name);
    throw InputError({}, "integrator",
                     fmt::format("'{}' knows no medium that {}, and this scene has one; allowed: {}", entry.name,
                                 plan.scattering ? "scatters" : "fills the space between bodies", able));
}

}  // namespace

std::span<IntegratorEntry const> integrator_entries() { return table; }

std::unique_ptr<Integrator> make_integrator(IntegratorChoice const& choice, Scene const& scene,
                                            RenderPlan const& plan) {
    std::vector<std::string> names;
    for (IntegratorEntry const& e : table) {
        names.emplace_back(e.name);
        if (choice.name != e.name) continue;
        refuse_media(e, scene, plan);
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
