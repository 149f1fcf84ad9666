// SPDX-License-Identifier: Apache-2.0
// Every strategy of integrators/direct_light.h at the same number of samples, on a box with one lamp and on a room with
// several. Error: root mean square over pixels of the standard error over the mean, from the kept variance.
#include "experiment.h"

namespace iride::bench {

void light_strategies() {
    constexpr int spp = 64;
    fmt::print("{} samples per pixel, 96 x 96 pixels.\n\n", spp);
    fmt::print(
        "| scene | strategy | lights | relative error | seconds | seconds x error^2 |\n|---|---|---|---:|---:|---:|\n");
    for (char const* name : {"cornell", "room"}) {
        auto const scene = load_scene(find_scene(name));
        scene->film.width = scene->film.height = 96;
        for (auto const& [strategy, lights] : {std::pair("hemisphere", "-"),
                                               {"cosine", "-"},
                                               {"bsdf", "-"},
                                               {"area", "uniform"},
                                               {"area", "power"},
                                               {"area", "all"},
                                               {"solid-angle", "uniform"},
                                               {"solid-angle", "power"},
                                               {"solid-angle", "tree"},
                                               {"solid-angle", "all"},
                                               {"mis", "power"},
                                               {"mis", "tree"},
                                               {"mis", "all"}}) {
            std::string integrator = fmt::format("direct:strategy={}", strategy);
            if (lights[0] != '-') integrator += fmt::format(",lights={}", lights);
            auto const [film, report] = rendered(*scene, integrator, {.spp = spp, .seed = 1, .threads = 1});
            double const error = film.relative_error();
            fmt::print("| {} | {} | {} | {:.4f} | {:.2f} | {:.3g} |\n", name, strategy, lights, error, report.seconds,
                       report.seconds * error * error);
        }
    }
}

}  // namespace iride::bench
