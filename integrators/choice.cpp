// SPDX-License-Identifier: Apache-2.0
#include "integrators/choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "integrators/light_emission_choice.h"
#include "integrators/light_tracing.h"

namespace iride {

namespace {

bool is_one_of(std::string const& type, std::span<char const* const> types) {
    return std::ranges::any_of(types, [&](char const* t) { return type == t; });
}

bool receives_caustics(NamedMaterial const& m) {
    constexpr std::array types{"diffuse", "oren-nayar", "plastic", "mixture", "two-sided"};
    return is_one_of(m.type, types);
}

}  // namespace

AutomaticChoice choose_integrator(Scene const& scene, RenderPlan const& plan) {
    if (!plan.no_light_paths.empty()) return {"path", plan.no_light_paths, false};
    std::string const hindrance = why_no_light_paths(scene, plan);
    if (!hindrance.empty()) return {"path", hindrance, false};
    bool const trial = !plan.environment && !plan.ray_cones;
    std::string const from = names_of(scene, throws_caustics), onto = names_of(scene, receives_caustics);
    if (from.empty() || onto.empty()) return {"path", "no mirror or glass throws light at a diffuse surface", trial};
    if (plan.environment) return {"path", "light from infinity: most of it comes without a caustic", false};
    if (!AimedEmission(scene).has_targets()) return {"path", "no lamp of a place shines at a mirror or a glass", trial};
    return {"caustic-path", fmt::format("caustics of {} on {}", from, onto), trial};
}

}  // namespace iride
