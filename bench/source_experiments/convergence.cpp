// SPDX-License-Identifier: Apache-2.0
// The slope of log error against log samples, where the value is known: a place on a floor under a sphere lamp,
// L = rho Le (r/d)^2 cos, as 1024 pixels that see the same; and the same with a mirror ball's edge across the pixels'
// view of the lamp, where the integrand jumps.
#include <array>
#include <cmath>

#include "bench/measure/benchmark.h"
#include "experiment.h"

namespace iride::bench {

namespace {

std::string scene_text(std::string const& more) {
    return fmt::format(
        R"({{ "camera": {{ "type": "orthographic", "eye": [0.4, 0.3, 0], "target": [0.4, 0, 0], "up": [0, 0, 1], "window": 0.0001 }},
      "film": {{ "size": [32, 32] }}, "render": {{ "max_bounces": 1 }},
      "shapes": [ {{ "type": "quad", "corners": [[-3,0,-3],[-3,0,3],[3,0,3],[3,0,-3]], "material": {{ "type": "diffuse", "reflectance": 0.5 }} }},
        {{ "type": "sphere", "centre": [0, 2, 0], "radius": 1, "material": {{ "type": "black" }}, "emission": {{ "radiance": 1 }} }} {} ] }})",
        more);
}

double error_of(Film const& film, double exact) {
    double sum = 0;
    for (int y = 0; y < film.height(); ++y)
        for (int x = 0; x < film.width(); ++x) sum += square(film.mean(x, y).Y / exact - 1);
    return std::sqrt(sum / (film.width() * film.height()));
}

double mean_of(Film const& film) {
    double sum = 0;
    for (int y = 0; y < film.height(); ++y)
        for (int x = 0; x < film.width(); ++x) sum += film.mean(x, y).Y;
    return sum / (film.width() * film.height());
}

}  // namespace

void convergence() {
    constexpr std::array<int, 6> spp{1, 4, 16, 64, 256, 1024};
    fmt::print("| scene | sampler |");
    for (int n : spp) fmt::print(" {} |", n);
    fmt::print(" slope |\n|---|---|{}---:|\n", "---:|---:|---:|---:|---:|---:|");
    double independent = 0, sobol = -infinity;
    for (
        auto const& [name, more] :
        {std::pair("smooth", ""),
         {"with an edge",
          R"(, { "type": "disc", "centre": [0.3, 0.8, 0], "normal": [0, 1, 0], "radius": 0.2, "material": { "type": "black" } })"}}) {
        auto const scene = scene_from(scene_text(more));
        double const exact = more[0] ? mean_of(rendered(*scene, "direct", {.spp = 16384, .seed = 99}).film)
                                     : 0.5 / (2 * 2 + 0.4 * 0.4) * 2 / std::sqrt(2 * 2 + 0.4 * 0.4);
        for (auto const& [sampler, kind] : {std::pair("independent", SamplerKind::independent),
                                            {"stratified", SamplerKind::stratified},
                                            {"sobol", SamplerKind::sobol},
                                            {"zsobol", SamplerKind::zsobol}}) {
            std::vector<std::pair<double, double>> points;
            fmt::print("| {} | {} |", name, sampler);
            for (int n : spp) {
                double const e = error_of(
                    rendered(*scene, "direct:strategy=solid-angle", {.spp = n, .seed = 3, .sampler = kind}).film,
                    exact);
                points.emplace_back(n, e);
                fmt::print(" {:.2e} |", e);
            }
            double const slope = fit_power_law(points).slope;
            fmt::print(" {:.2f} |\n", slope);
            if (kind == SamplerKind::independent) independent = std::max(independent, std::abs(slope + 0.5));
            if (more[0] == 0 && (kind == SamplerKind::sobol || kind == SamplerKind::zsobol))
                sobol = std::max(sobol, slope);
        }
    }
    print_verdict("slope -.5 of independent points", fmt::format("within {:.2f} of it", independent),
                  independent < 0.05);
    print_verdict("slope -.7 or steeper of Sobol' points where the integrand is smooth",
                  fmt::format("{:.2f} at most", sobol), sobol <= -0.7);
}

}  // namespace iride::bench
