// SPDX-License-Identifier: Apache-2.0
// The plot of error against time: a panel per scene, a line per integrator, both axes logarithmic.
#pragma once

#include "app/plot.h"
#include "bench/measure/benchmark.h"

namespace iride {

// `results` as `iride bench` writes them; InputError if there is nothing of 'error' among them.
void plot_errors(nlohmann::ordered_json const& results, std::filesystem::path const& path);

}  // namespace iride
