// SPDX-License-Identifier: Apache-2.0
// source_experiments [NAME ...]: the experiments by name, or all; tables in Markdown.
#include <array>
#include <string_view>

#include "experiment.h"

namespace {

using namespace iride::bench;

constexpr std::array<Experiment, 6> table{{
    {"light-strategies", "Direct light: directions of the hemisphere against points of the lamp, at equal samples",
     light_strategies},
    {"russian-roulette", "Variance of Russian roulette against its closed form", russian_roulette},
    {"convergence", "Error against samples: independent, stratified, Sobol'", convergence},
    {"lamp-shapes", "What a sphere lamp costs against a quad lamp", lamp_shapes},
    {"photon-density", "Estimates of density: the source's grid of photons and neighbours, on one surface",
     photon_density},
    {"photon-rates", "Photon methods: error and bias against photons", photon_rates},
}};

bool is_wanted(Experiment const& e, int count, char** names) {
    if (count == 0) return true;
    for (int i = 0; i < count; ++i)
        if (std::string_view(names[i]) == e.name) return true;
    return false;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        for (Experiment const& e : table) {
            if (!is_wanted(e, argc - 1, argv + 1)) continue;
            fmt::print("## {}\n\n", e.question);
            e.run();
            fmt::print("\n");
            std::fflush(stdout);
        }
    } catch (iride::InputError const& e) {
        fmt::print(stderr, "{}\n", e.what());
        return 2;
    }
}
