// SPDX-License-Identifier: Apache-2.0
// The benchmarks of `iride bench`: each returns rows of named numbers, which are printed as a table, written as JSON
// and plotted without knowing what they mean.
#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

namespace iride::bench {

struct Settings {
    std::vector<std::string> scenes;       // those named; empty: what each benchmark is about
    std::vector<std::string> integrators;  // of `error`; empty: every one that can do the scene
    std::filesystem::path references;      // folder of the converged pictures
    double reference_seconds = 20;         // for each of the two halves of a reference
    double error_seconds = 4;              // for each scene and integrator
    int threads = 0;                       // 0: all
    int rounds = 3;                        // of what is quoted as median, least and most
    std::function<void(std::string const&)> say = [](std::string const&) {};  // progress, for a person
};

using Rows = nlohmann::ordered_json;  // an array of objects with the same keys in the same order

struct Benchmark {
    char const* name;
    char const* summary;
    Rows (*run)(Settings const&);
    bool by_default;
};
std::span<Benchmark const> benchmarks();

// The scenes named, or else `usual`.
std::vector<std::string> scenes_of(Settings const& settings, std::vector<std::string> const& usual);
std::vector<std::string> all_scenes();

// For each benchmark its function; the file of that name says what it measures.
Rows measure_rays(Settings const&);
Rows make_references(Settings const&);
Rows measure_error(Settings const&);
Rows measure_peers(Settings const&);
Rows measure_start(Settings const&);
Rows measure_threads(Settings const&);
Rows measure_triangles(Settings const&);
Rows measure_lamps(Settings const&);
Rows measure_spp(Settings const&);
Rows measure_resolution(Settings const&);
Rows measure_plan(Settings const&);
Rows measure_lanes(Settings const&);
Rows measure_adaptive(Settings const&);
Rows run_stress(Settings const&);

// The least-squares line through log(y) over log(x), of two points or more of different x.
struct PowerLaw {
    double slope, scale;  // y = scale x^slope
    double x_at(double y) const;
};
PowerLaw fit_power_law(std::span<std::pair<double, double> const> points);

}  // namespace iride::bench
