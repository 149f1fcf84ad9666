// SPDX-License-Identifier: Apache-2.0
#include "integrators/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "integrators/automatic.h"
#include "integrators/choice.h"
#include "integrators/layers.h"

namespace iride {

std::string names_of(Scene const& scene, bool (*wanted)(NamedMaterial const&)) {
    std::string names;
    for (NamedMaterial const& m : scene.materials)
        if (wanted(m)) names += (names.empty() ? "" : ", ") + m.name;
    return names;
}

namespace {

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

bool decided(RenderPlan& plan, std::string name, bool used, std::string reason) {
    plan.decisions.push_back({std::move(name), used, std::move(reason)});
    return used;
}

// Of what surfaces do with light, what no kernel does unless a material asks for it.
void decide_surface_optics(Scene const& scene, RenderPlan& plan) {
    std::string const clear = names_of(scene, [](NamedMaterial const& m) { return m.material->traits.transmits; });
    decided(plan, "transmission", !clear.empty(),
            clear.empty() ? "no surface lets light through: nothing refracts, disperses, absorbs or nests"
                          : "light goes through: " + clear);
    std::string const filmed = names_of(scene, [](NamedMaterial const& m) { return m.material->traits.filmed; });
    decided(plan, "films", !filmed.empty(),
            filmed.empty() ? "no thin film: Fresnel's equations at bare surfaces, no phase is followed"
                           : "interference in the layers of: " + filmed);
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

std::string joined(std::array<std::string, 2> const& names) {
    return names[0] + (names[0].empty() || names[1].empty() ? "" : ", ") + names[1];
}

void decide_scattering(Scene const& scene, RenderPlan& plan) {
    std::string const bodies = names_of(
        scene, [](NamedMaterial const& m) { return m.material->body() && m.material->body()->inside.scatters; });
    std::string const where = joined({scene.open_medium.scatters ? "the medium all around" : "", bodies});
    plan.scattering = decided(plan, "scattering", !where.empty(),
                              where.empty() ? "no medium scatters: light goes straight on between surfaces"
                                            : "free flights, lamps sampled where they end, in: " + where);
}

void decide_beams(Scene const& scene, RenderPlan& plan) {
    int points = 0;
    for (int i = 0; i < static_cast<int>(scene.lights.size()); ++i)
        points += scene.lights.light(i).extent() == LightExtent::point && scene.lights.probability(i) > 0 ? 1 : 0;
    plan.beams = decided(plan, "beams", plan.scattering && points > 0,
                         !plan.scattering ? "no medium scatters: no beam is seen"
                         : points == 0    ? "no point lamp or spot: free flights find what the others light"
                                       : fmt::format("{} of {} lights have no extent: what they light in a medium is "
                                                     "looked for along rays and along beams, beside free flights",
                                                     points, scene.lights.size()));
}

// Whether light that is the same from everywhere is asked for samples. Where flights end by chance these do better:
// they are weighed by how much gets through.
void decide_uniform_light(Scene const& scene, RenderPlan& plan) {
    bool const uniform =
        std::ranges::any_of(scene.lights.environments(), [&](int e) { return scene.lights.light(e).is_uniform(); });
    if (uniform && !plan.scattering) plan.uniform_light = UniformLight::left_to_scattering;
    decided(plan, "uniform light", uniform && plan.scattering,
            !uniform          ? "no light is the same from everywhere"
            : plan.scattering ? "asked like a lamp: media let through what flights that end by chance miss"
                              : "found by the directions of scattering alone: every light sample goes to a lamp");
}

struct AskedLights {
    int count = 0, with_place = 0;
};
AskedLights asked_lights(Scene const& scene, UniformLight uniform) {
    AskedLights asked;
    for (int i = 0; i < static_cast<int>(scene.lights.size()); ++i) {
        if (!is_asked(scene.lights, i, uniform)) continue;
        ++asked.count;
        asked.with_place += scene.lights.light(i).bounds().has_value() ? 1 : 0;
    }
    return asked;
}

void decide_light_sampling(Scene const& scene, AskedLights const& asked, RenderPlan& plan) {
    std::string const finite = names_of(scene, [](NamedMaterial const& m) { return m.material->traits.has_density; });
    bool const lamps = scene.lights.has_power();
    plan.light_sampling = lamps && (!finite.empty() || plan.scattering);
    decided(plan, "light sampling", plan.light_sampling && asked.count > 0,
            !lamps                 ? "no light has any power"
            : !plan.light_sampling ? "every surface is a mirror, glass or black: lamps are found by scattering alone"
            : asked.count == 0     ? "no light but what is the same from everywhere"
                                   : fmt::format("{} of {} lights", asked.count, scene.lights.size()));
}

// Which light a surface asks. A tree looks at where the surface is; with few lights that costs more than it saves.
void decide_light_selection(Scene const& scene, AskedLights const& asked, RenderPlan& plan) {
    constexpr int worth_a_tree = 2;
    bool const tree = asked.with_place >= worth_a_tree;
    bool const choice = plan.light_sampling && asked.count > 1;
    plan.light_selection = scene.render.light_selection.value_or(tree ? LightSelection::tree : LightSelection::power);
    char const* const name = light_selection_names[static_cast<std::size_t>(plan.light_selection)];
    decided(plan, "light selection", choice,
            !choice                        ? "there is no choice"
            : scene.render.light_selection ? fmt::format("{}: the file's wish", name)
            : tree
                ? fmt::format("tree: {} lamps, of which each place asks those that may bring it most", asked.with_place)
                : "power: no two lamps that have a place, of which a tree could choose");
}

}  // namespace

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

RenderPlan make_plan(Scene const& scene) {
    RenderPlan plan;
    auto const decide = [&](std::string name, bool used, std::string reason) {
        return decided(plan, std::move(name), used, std::move(reason));
    };

    decide_surface_optics(scene, plan);

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
    bool const open_absorbs = scene.open_medium.absorbs;
    decide("absorption", !absorbing.empty() || open_absorbs,
           absorbing.empty() && !open_absorbs ? "no transparent body absorbs"
                                              : "light is lost on the way through: " +
                                                    joined({open_absorbs ? "the medium all around" : "", absorbing}));
    decide("nested bodies", !nested.empty(),
           nested.empty() ? "no priorities: each surface knows both its sides, what a path is in is not carried for it"
                          : "what a path is in decides at the surfaces of: " + nested);
    decide_scattering(scene, plan);
    plan.media = plan.scattering || scene.open_medium.absorbs || !absorbing.empty() || !nested.empty();
    if (plan.media) plan.camera_in = surroundings_of_camera(scene);

    plan.environment =
        decide("environment", !scene.lights.environments().empty(),
               scene.lights.environments().empty() ? "no light from infinity: a ray that leaves the scene "
                                                     "ends its path"
                                                   : "rays that leave the scene bring light");

    decide_beams(scene, plan);
    decide_uniform_light(scene, plan);
    AskedLights const asked = asked_lights(scene, plan.uniform_light);
    decide_light_sampling(scene, asked, plan);
    decide_light_selection(scene, asked, plan);

    bool const smooth = std::ranges::any_of(scene.shapes, [](Shape const& s) {
        auto const* m = std::get_if<MeshShape>(&s.geometry);
        return m && m->smooth && !m->mesh->normal.empty();
    });
    decide("smooth normals", smooth, smooth ? "a mesh has vertex normals" : "no mesh has vertex normals");
    decide_surfaces(scene, plan);
    decide("origin", !scene.origin.isZero(),
           scene.origin.isZero() ? "places count from the file's origin"
                                 : fmt::format("places count from the scene's middle, ({:g}, {:g}, {:g}) m: floats are "
                                               "finest there",
                                               scene.origin.x(), scene.origin.y(), scene.origin.z()));
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

    std::string layers;
    for (LayerRequest const& r : scene.film.aovs) layers += (layers.empty() ? "" : ", ") + r.name;
    decide("aovs", !layers.empty(),
           layers.empty() ? "film.aovs names none: nothing is computed beside the picture"
                          : layers + ": found after the picture, from its own paths");
    auto const of_paths =
        std::ranges::find_if(scene.film.aovs, [](LayerRequest const& r) { return is_made_of_paths(r.name); });
    plan.whole_paths = of_paths != scene.film.aovs.end();
    if (plan.whole_paths) plan.no_light_paths = fmt::format("the layer '{}' is made of camera paths", of_paths->name);

    plan.max_bounces = scene.render.max_bounces;
    decide("bounce limit", plan.max_bounces.has_value(),
           plan.max_bounces ? fmt::format("{} (the file's wish: light beyond is left out)", *plan.max_bounces)
                            : "none: Russian roulette ends paths without bias");
    AutomaticChoice const choice = choose_integrator(scene, plan);
    decide("integrator auto", true,
           fmt::format("{}: {}; paths are {}{}", choice.name, choice.reason,
                       plan.whole_paths ? "not split"
                                        : "split where a pilot finds noise, or share what their neighbours find, if a "
                                          "trial finds it better",
                       choice.trial ? fmt::format("; after {} samples bidirectional-power, if a trial finds it better",
                                                  samples_before_joining)
                                    : ""));
    return plan;
}

}  // namespace iride
