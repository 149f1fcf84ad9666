// SPDX-License-Identifier: Apache-2.0
// How near a render comes to bare ray tracing: see bench/README.md.
#include <fmt/format.h>

#include <cstdlib>

#include "bench/measure/clock.h"
#include "bench/measure/rays.h"

namespace {

using namespace iride;

int run(std::string const& name, int spp, int rounds) {
    auto const scene = load_scene(find_scene(name));
    bench::RayRace const race(*scene, "path", spp);
    std::vector<double> ratios;
    for (int round = 0; round < rounds; ++round) {
        bench::RayRates const r = race.round();
        ratios.push_back(r.ratio());
        fmt::print("render {:.3g} rays/s, {:.3g} paths/s; bare Embree {:.3g} rays/s ({} rays); ratio {:.3f}\n",
                   r.rendered, r.paths_per_second, r.bare, race.ray_count(), r.ratio());
    }
    fmt::print("median ratio {:.3f}\n", bench::spread_of(ratios).median);
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 2) {
        fmt::print(stderr, "usage: ray_throughput SCENE [SPP] [ROUNDS]\n");
        return 2;
    }
    try {
        return run(argv[1], argc > 2 ? std::max(1, std::atoi(argv[2])) : 16,
                   argc > 3 ? std::max(1, std::atoi(argv[3])) : 5);
    } catch (InputError const& e) {
        fmt::print(stderr, "{}\n", e.what());
        return 2;
    }
}
