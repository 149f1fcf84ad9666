// SPDX-License-Identifier: Apache-2.0
// An experiment of the source, repeated with the columns that it lacks: each prints one table in Markdown on stdout.
#pragma once

#include <fmt/format.h>

#include <string>

#include "bench/measure/scene_text.h"
#include "integrators/render.h"

namespace iride::bench {

struct Experiment {
    char const* name;
    char const* question;
    void (*run)();
};

// One per file; main.cpp has the table.
void light_strategies();
void russian_roulette();
void convergence();
void lamp_shapes();
void photon_density();
void photon_rates();

// The line below a table: what it was to show, and whether it does.
inline void print_verdict(std::string const& asked, std::string const& found, bool holds) {
    fmt::print("\nAsked: {}. Found: {}: {}.\n", asked, found, holds ? "holds" : "**does not hold**");
}

struct Rendered {
    Film film;
    RenderReport report;
};
inline Rendered rendered(Scene const& scene, std::string const& integrator, RenderSettings const& settings) {
    RenderPlan const plan = make_plan(scene);
    Film film = make_film(scene);
    RenderReport const report = render(scene, plan, *make_integrator(integrator, scene, plan), settings, film);
    return {std::move(film), report};
}

}  // namespace iride::bench
