// SPDX-License-Identifier: Apache-2.0
// What each decision of the plan saves: renders with it and without, in turns, in one thread; and how far the pictures
// are apart, which is nothing where the random numbers mean the same.
#include <fmt/format.h>

#include "bench/measure/benchmark.h"
#include "bench/measure/clock.h"
#include "bench/measure/reference.h"
#include "integrators/plan_disable.h"

namespace iride::bench {

namespace {

constexpr int spp = 8;

struct Run {
    double seconds, relative_error;
    XyzPicture picture;
};

Run run(Scene const& scene, RenderPlan const& plan, int round) {
    auto const integrator = make_integrator("path", scene, plan);
    Film film = make_film(scene);
    RenderSettings const r{.spp = spp, .seed = static_cast<std::uint64_t>(round), .threads = 1};
    double const seconds = render(scene, plan, *integrator, r, film).seconds;
    return {seconds, film.relative_error(), picture_of(film)};
}

}  // namespace

Rows measure_plan(Settings const& settings) {
    Rows rows = Rows::array();
    for (std::string const& name : scenes_of(settings, {"cornell", "metals", "glass-spheres", "textures", "haze"}))
        for (PlanSwitch const& off : plan_switches()) {
            auto const planned = load_for_picture(name), carrying = load_for_picture(name);
            RenderPlan const plan = make_plan(*planned), without = make_plan_without({off.name}, *carrying);
            if (!without.decisions.back().used) continue;  // nothing to switch off
            settings.say(fmt::format("plan: {} without {}", name, off.name));
            std::vector<double> ratio;
            double noise = 0, apart = 0;
            for (int round = 0; round < settings.rounds; ++round) {
                Run const a = run(*planned, plan, round), b = run(*carrying, without, round);
                ratio.push_back(b.seconds / a.seconds);
                noise = b.relative_error / a.relative_error;
                apart = compare(b.picture, a.picture).relmse;
            }
            Spread const s = spread_of(ratio);
            rows.push_back({{"scene", name},
                            {"without", off.name},
                            {"instead", off.instead},
                            {"time_ratio", s.median},
                            {"least", s.least},
                            {"most", s.most},
                            {"noise_ratio", noise},
                            {"relmse_apart", apart}});
        }
    return rows;
}

}  // namespace iride::bench
