// SPDX-License-Identifier: Apache-2.0
#include "integrators/plan_disable.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

namespace iride {

namespace {

bool carry(bool& needed) { return !std::exchange(needed, true); }

bool carry_media(Scene& scene, RenderPlan& plan) {
    if (!carry(plan.media)) return false;
    plan.camera_in = surroundings_of_camera(scene);
    return true;
}

// Without power in any light there is none to choose.
bool sample_lights(Scene& scene, RenderPlan& plan) { return scene.lights.has_power() && carry(plan.light_sampling); }

bool ask_uniform_light(Scene&, RenderPlan& plan) {
    return std::exchange(plan.uniform_light, UniformLight::asked) != UniformLight::asked;
}

bool parametrise(std::vector<Shape>& shapes) {
    bool changed = false;
    for (Shape& s : shapes) changed = !std::exchange(s.parametrised, true) || changed;
    return changed;
}
bool parametrise_all(Scene& scene, RenderPlan&) {
    bool changed = parametrise(scene.shapes);
    for (ObjectGeometry& object : scene.objects) changed = parametrise(object.shapes) || changed;
    return changed;
}

bool sample_whole_range(Scene& scene, RenderPlan& plan) {
    WavelengthRange const cut = std::exchange(plan.wavelengths, scene.wavelengths);
    return cut.min_nm > scene.wavelengths.min_nm || cut.max_nm < scene.wavelengths.max_nm;
}

bool leave_beams_to_flights(Scene&, RenderPlan& plan) { return std::exchange(plan.beams, false); }

bool draw_for_observer(Scene&, RenderPlan& plan) { return !std::exchange(plan.observer_alone, true); }

constexpr std::array<PlanSwitch, 10> table{{
    {"dispersion", "the reach of each lane is carried", true,
     [](Scene&, RenderPlan& plan) { return carry(plan.dispersion); }},
    {"media", "what a path is in is carried (absorption, nested bodies)", true, carry_media},
    {"environment", "rays that leave the scene ask for light from infinity", true,
     [](Scene&, RenderPlan& plan) { return carry(plan.environment); }},
    {"light sampling", "lights are sampled though no surface can use them", true, sample_lights},
    {"uniform light", "light that is the same from everywhere is sampled like a lamp", false, ask_uniform_light},
    {"beams", "what point lamps light in a medium is found by free flights alone", false, leave_beams_to_flights},
    {"uv and tangents", "every hit gets uv, derivatives and tangent", true, parametrise_all},
    {"ray cones", "the diameter of a path's bundle is carried", true,
     [](Scene&, RenderPlan& plan) { return carry(plan.ray_cones); }},
    {"wavelengths", "the whole range of the scene is sampled", false, sample_whole_range},
    {"wavelength density", "wavelengths are drawn for the observer, not for the lamps", false, draw_for_observer},
}};

PlanSwitch const& switch_of(std::string const& name) {
    std::vector<std::string> names;
    for (PlanSwitch const& s : table) {
        if (name == s.name) return s;
        names.emplace_back(s.name);
    }
    throw InputError({}, "--plan-disable", fmt::format("unknown decision '{}'{}", name, suggestion(name, names)));
}

}  // namespace

std::span<PlanSwitch const> plan_switches() { return table; }

RenderPlan make_plan_without(std::vector<std::string> const& disabled, Scene& scene) {
    RenderPlan plan = make_plan(scene);
    for (std::string const& name : disabled) {
        PlanSwitch const& off = switch_of(name);
        bool const changes = off.disable(scene, plan);
        plan.decisions.push_back({"without", changes,
                                  changes
                                      ? fmt::format("{}: {}", name, off.instead)
                                      : fmt::format("{}: nothing to switch off, it leaves out nothing here", name)});
    }
    return plan;
}

}  // namespace iride
