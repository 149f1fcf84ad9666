// SPDX-License-Identifier: Apache-2.0
// `--error de=2`, each pixel alike against more samples where there is more noise: time until 99 % of the pixels are
// expected to be within the target, and the mean difference by the reference.
#include <fmt/format.h>

#include "bench/measure/benchmark.h"
#include "bench/measure/clock.h"
#include "bench/measure/reference.h"
#include "film/checkpoint.h"
#include "integrators/adaptive.h"

namespace iride::bench {

namespace {

constexpr double target = 2;  // CIEDE2000

struct Outcome {
    RenderReport report;
    XyzPicture picture;
};

Outcome run(Scene const& scene, bool adaptive, int threads, std::uint64_t seed) {
    RenderPlan const plan = make_plan(scene);
    auto const integrator = make_integrator("path", scene, plan);
    ErrorTarget wanted = ErrorTarget::parse(fmt::format("de={}", target));
    wanted.set_display(scene.film.white, scene.film.exposure);
    RenderSettings settings{.spp = 1 << 20, .seed = seed, .threads = threads};
    if (!adaptive) {
        settings.stop_at = wanted;
        Film film = make_film(scene);
        RenderReport const report = render(scene, plan, *integrator, settings, film);
        return {report, picture_of(film)};
    }
    AdaptiveState state = make_adaptive_state(scene);
    RenderReport const report = render_adaptively(scene, plan, *integrator, settings, wanted, state.films, state.round);
    return {report, picture_of(iride::picture_of(state.films))};
}

}  // namespace

Rows measure_adaptive(Settings const& settings) {
    Rows rows = Rows::array();
    for (std::string const& name : scenes_of(settings, {"metals", "metals-furnace", "cornell", "cube-ceiling"})) {
        auto const scene = load_for_picture(name);
        Reference const reference = reference_of(*scene, settings);
        std::array<std::vector<double>, 2> seconds;  // uniform, adaptive
        std::array<Outcome, 2> last;
        constexpr std::array<char const*, 2> names{"uniform", "adaptive"};
        for (int round = 0; round < settings.rounds; ++round)
            for (std::size_t k : {0u, 1u}) {
                settings.say(fmt::format("adaptive: {} {}, round {}", name, names[k], round + 1));
                last[k] = run(*scene, k == 1, settings.threads, static_cast<std::uint64_t>(round));
                seconds[k].push_back(last[k].report.seconds);
            }
        for (std::size_t k : {0u, 1u}) {
            Spread const s = spread_of(seconds[k]);
            rows.push_back({{"scene", name},
                            {"samples", names[k]},
                            {"seconds", s.median},
                            {"least", s.least},
                            {"most", s.most},
                            {"mean_spp", last[k].report.spp},
                            {"relmse", reference.relmse_of(last[k].picture)},
                            {"mean_delta_e", compare(last[k].picture, reference.picture).delta_e_2000_mean},
                            {"reference_delta_e", reference.delta_e_2000}});
        }
    }
    return rows;
}

}  // namespace iride::bench
