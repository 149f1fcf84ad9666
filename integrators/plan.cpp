// SPDX-License-Identifier: Apache-2.0
#include "integrators/plan.h"

#include <fmt/format.h>

#include <algorithm>

#include "integrators/choice.h"

namespace iride {

namespace {

std::string names_of(Scene const& scene, bool (*wanted)(NamedMaterial const&)) {
    std::string names;
    for (NamedMaterial const& m : scene.materials)
        if (wanted(m)) names += (names.empty() ? "" : ", ") + m.name;
    return names;
}

// The union of the lamps' spectra, cut to what observer and bands can see.
WavelengthRange seen_range(Scene const& scene) {
    WavelengthRange lit{scene.wavelengths.max_nm, scene.wavelengths.min_nm};
    for (LightDescription const& light : scene.light_descriptions) {
        lit.min_nm = std::min(lit.min_nm, light.nonzero.min_nm);
        lit.max_nm = std::max(lit.max_nm, light.nonzero.max_nm);
    }
    WavelengthRange seen = visible_range;
    if (scene.film.band_count > 0) {
        seen.min_nm = std::min(seen.min_nm, scene.film.band_range.min_nm);
        seen.max_nm = std::max(seen.max_nm, scene.film.band_range.max_nm);
    }
    WavelengthRange const both{std::max({lit.min_nm, seen.min_nm, scene.wavelengths.min_nm}),
                               std::min({lit.max_nm, seen.max_nm, scene.wavelengths.max_nm})};
    // No overlap: the picture is black, whatever is sampled.
    return both.min_nm < both.max_nm ? both : scene.wavelengths;
}

// What camera rays start in, at places all over the lens and the window; absent if they differ.
std::optional<Surroundings> surroundings_of_camera(Scene const& scene) {
    constexpr int places = 5;
    Camera const camera(scene.camera, scene.film.width, scene.film.height);
    std::optional<Surroundings> first;
    for (int i = 0; i < places * places; ++i) {
        float const x = static_cast<float>(i % places) / (places - 1),
                    y = static_cast<float>(i / places) / (places - 1);
        Ray const ray =
            camera.ray(x * static_cast<float>(scene.film.width), y * static_cast<float>(scene.film.height), {x, y});
        Surroundings const here = surroundings_at(scene, ray.origin);
        if (!first) first = here;
        if (!(here == *first)) return std::nullopt;
    }
    return first;
}

bool decided(RenderPlan& plan, std::string name, bool used, std::string reason) {
    plan.decisions.push_back({std::move(name), used, std::move(reason)});
    return used;
}

// What varies over surfaces; each is asked of those shapes alone whose material has it.
void decide_surfaces(Scene const& scene, RenderPlan& plan) {
    std::string const textured = names_of(scene, [](NamedMaterial const& m) { return m.material->traits.textured; });
    std::string const relief = names_of(scene, [](NamedMaterial const& m) { return m.relief != nullptr; });
    std::string const holes = names_of(scene, [](NamedMaterial const& m) { return m.alpha.has_value(); });
    std::string const tangents = names_of(scene, [](NamedMaterial const& m) { return m.material->traits.anisotropic; });
    bool const textures = decided(plan, "textures", !textured.empty(),
                                  textured.empty() ? "no material varies over its surface" : "in: " + textured);
    bool const turned =
        decided(plan, "bumps", !relief.empty(),
                relief.empty() ? "no bump or normal map turns a normal" : "normals are turned by: " + relief);
    bool const cut = decided(plan, "alpha", !holes.empty(),
                             holes.empty() ? "no surface has holes: hits are not filtered" : "holes in: " + holes);
    bool const uv = textures || turned || cut;
    decided(plan, "uv and tangents", uv || !tangents.empty(),
            uv                 ? "on the shapes of those materials"
            : tangents.empty() ? "nobody looks at them"
                               : "tangents for: " + tangents);
    plan.ray_cones = decided(plan, "ray cones", textures || turned,
                             textures || turned ? "textures are averaged over half a pixel's cone, wider after rough "
                                                  "scattering; reference_path looks at points"
                                                : "no texture to average");
}

}  // namespace

RenderPlan make_plan(Scene const& scene) {
    RenderPlan plan;
    auto const decide = [&](std::string name, bool used, std::string reason) {
        return decided(plan, std::move(name), used, std::move(reason));
    };

    std::string const dispersive =
        names_of(scene, [](NamedMaterial const& m) { return m.material->traits.dispersive; });
    plan.dispersion =
        decide("dispersion", !dispersive.empty(),
               dispersive.empty() ? "no index of a transparent body depends on wavelength: all lanes share "
                                    "every path, their reach is not carried"
                                  : "wavelengths part company in: " + dispersive);

    std::string const absorbing = names_of(scene, [](NamedMaterial const& m) {
        Body const* const body = m.material->body();
        return body && (body->inside.absorbs || body->outside.absorbs);
    });
    std::string const nested = names_of(
        scene, [](NamedMaterial const& m) { return m.material->body() && m.material->body()->priority.has_value(); });
    decide("absorption", !absorbing.empty(),
           absorbing.empty() ? "no transparent body absorbs" : "light is lost on the way through: " + absorbing);
    decide("nested bodies", !nested.empty(),
           nested.empty() ? "no priorities: each surface knows both its sides, what a path is in is not carried for it"
                          : "what a path is in decides at the surfaces of: " + nested);
    plan.media = !absorbing.empty() || !nested.empty();
    if (plan.media) plan.camera_in = surroundings_of_camera(scene);

    plan.environment =
        decide("environment", !scene.lights.environments().empty(),
               scene.lights.environments().empty() ? "no light from infinity: a ray that leaves the scene "
                                                     "ends its path"
                                                   : "rays that leave the scene bring light");

    std::string const finite = names_of(scene, [](NamedMaterial const& m) { return m.material->traits.has_density; });
    bool const lamps = scene.lights.has_power();
    plan.light_sampling = decide("light sampling", lamps && !finite.empty(),
                                 !lamps           ? "no light has any power"
                                 : finite.empty() ? "every surface is a mirror, glass or black: lamps are found by "
                                                    "scattering alone"
                                                  : fmt::format("{} lights, chosen by power", scene.lights.size()));

    bool const smooth = std::ranges::any_of(scene.shapes, [](Shape const& s) {
        auto const* m = std::get_if<MeshShape>(&s.geometry);
        return m && m->smooth && !m->mesh->normal.empty();
    });
    decide("smooth normals", smooth, smooth ? "a mesh has vertex normals" : "no mesh has vertex normals");
    decide_surfaces(scene, plan);
    decide("instances", !scene.instances.empty(), fmt::format("{} in the scene", scene.instances.size()));

    plan.wavelengths = seen_range(scene);
    decide("wavelengths", true,
           fmt::format("{:g}..{:g} nm of {:g}..{:g}: where the lamps shine and the {} sees", plan.wavelengths.min_nm,
                       plan.wavelengths.max_nm, scene.wavelengths.min_nm, scene.wavelengths.max_nm,
                       scene.film.band_count > 0 ? "observer or a band" : "observer"));

    plan.bands = decide("spectral bands", scene.film.band_count > 0,
                        scene.film.band_count > 0 ? fmt::format("{} of {:g} nm", scene.film.band_count,
                                                                scene.film.band_range.width() / scene.film.band_count)
                                                  : "none asked for: wavelengths are drawn for the observer alone");

    plan.max_bounces = scene.render.max_bounces;
    decide("bounce limit", plan.max_bounces.has_value(),
           plan.max_bounces ? fmt::format("{} (the file's wish: light beyond is left out)", *plan.max_bounces)
                            : "none: Russian roulette ends paths without bias");
    IntegratorChoice const choice = choose_integrator(scene, plan);
    decide("integrator auto", true, choice.name + ": " + choice.reason);
    return plan;
}

}  // namespace iride
