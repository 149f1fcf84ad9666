// SPDX-License-Identifier: Apache-2.0
#include "bench/measure/benchmark.h"

#include <array>
#include <cmath>

#include "scene/scene.h"

namespace iride::bench {

namespace {

constexpr std::array<Benchmark, 14> table{{
    {"rays", "rays per second, one thread, against bare Embree on the same rays", measure_rays, true},
    {"peers", "256 x 256, 64 spp, 2 threads: time, relMSE and paths per second, as published for other renderers",
     measure_peers, true},
    {"error", "error against time by scene and integrator; the time to given errors", measure_error, true},
    {"references", "make the converged pictures that errors are told by, where they are missing", make_references,
     false},
    {"start", "from the file to the first sample", measure_start, true},
    {"threads", "paths per second over threads", measure_threads, true},
    {"triangles", "1e3 .. 1e7 triangles: time per path, build, memory", measure_triangles, true},
    {"lamps", "1 .. 1e5 lamps: time per path, noise", measure_lamps, true},
    {"spp", "paths per second over samples per pixel", measure_spp, true},
    {"resolution", "paths per second over the size of the picture", measure_resolution, true},
    {"plan", "what each decision of the plan saves", measure_plan, true},
    {"adaptive", "--error de=2: uniform samples against adaptive ones", measure_adaptive, true},
    {"lanes", "time and noise at this build's number of wavelengths per path", measure_lanes, true},
    {"stress", "numerical stability, the long form: scales, distances, slivers, lamps, precision", run_stress, false},
}};

}  // namespace

std::span<Benchmark const> benchmarks() { return table; }

std::vector<std::string> scenes_of(Settings const& settings, std::vector<std::string> const& usual) {
    return settings.scenes.empty() ? usual : settings.scenes;
}

std::vector<std::string> all_scenes() {
    std::vector<std::string> names;
    for (ShippedScene const& s : shipped_scenes()) names.push_back(s.name);
    return names;
}

double PowerLaw::x_at(double y) const { return std::pow(y / scale, 1 / slope); }

PowerLaw fit_power_law(std::span<std::pair<double, double> const> points) {
    double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
    for (auto const& [x, y] : points) {
        double const u = std::log(x), v = std::log(y);
        n += 1, sx += u, sy += v, sxx += u * u, sxy += u * v;
    }
    double const slope = (n * sxy - sx * sy) / (n * sxx - sx * sx);
    return {slope, std::exp((sy - slope * sx) / n)};
}

}  // namespace iride::bench
