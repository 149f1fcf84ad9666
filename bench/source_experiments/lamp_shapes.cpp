// SPDX-License-Identifier: Apache-2.0
// The same floor and ball under a quad and under a sphere lamp of the same power, in turn, one thread: the median of
// the ratios of their times.
#include <algorithm>

#include "bench/measure/clock.h"
#include "experiment.h"

namespace iride::bench {

namespace {

std::unique_ptr<Scene> lit_by(std::string const& lamp) {
    return scene_from(fmt::format(R"({{ "camera": {{ "eye": [0, 1.5, -5], "target": [0, 0.7, 0], "field_deg": 40 }},
      "film": {{ "size": [128, 128] }},
      "shapes": [ {{ "type": "quad", "corners": [[-4,0,-4],[-4,0,4],[4,0,4],[4,0,-4]], "material": {{ "type": "diffuse", "reflectance": 0.5 }} }},
        {{ "type": "sphere", "centre": [0, 0.6, 0], "radius": 0.6, "material": {{ "type": "diffuse", "reflectance": 0.7 }} }},
        {{ {}, "material": {{ "type": "black" }}, "emission": {{ "radiance": 5 }} }} ] }})",
                                  lamp));
}

}  // namespace

void lamp_shapes() {
    constexpr int rounds = 9, spp = 32;
    auto const quad = lit_by(R"("type": "quad", "corners": [[-0.5,3,-0.5],[0.5,3,-0.5],[0.5,3,0.5],[-0.5,3,0.5]])");
    auto const sphere = lit_by(R"("type": "sphere", "centre": [0,3,0], "radius": 0.2821)");
    fmt::print(
        "| integrator | quad, s | sphere, s | sphere / quad | error quad | error sphere "
        "|\n|---|---:|---:|---:|---:|---:|\n");
    double most = 0;
    for (char const* integrator : {"direct:strategy=solid-angle", "direct:strategy=area", "path"}) {
        std::vector<double> ratio, a, b;
        double error_a = 0, error_b = 0;
        for (int round = 0; round < rounds; ++round) {
            auto const q = rendered(*quad, integrator, {.spp = spp, .seed = 1, .threads = 1});
            auto const s = rendered(*sphere, integrator, {.spp = spp, .seed = 1, .threads = 1});
            a.push_back(q.report.seconds);
            b.push_back(s.report.seconds);
            ratio.push_back(b.back() / a.back());
            error_a = q.film.relative_error(), error_b = s.film.relative_error();
        }
        fmt::print("| {} | {:.2f} | {:.2f} | {:.2f} | {:.4f} | {:.4f} |\n", integrator, spread_of(a).median,
                   spread_of(b).median, spread_of(ratio).median, error_a, error_b);
        most = std::max(most, spread_of(ratio).median);
    }
    constexpr double allowed = 1.3;
    print_verdict(fmt::format("a sphere lamp costs no more than {} quad lamps (the source: 3)", allowed),
                  fmt::format("{:.2f} at most", most), most <= allowed);
}

}  // namespace iride::bench
