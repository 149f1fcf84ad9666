// SPDX-License-Identifier: Apache-2.0
// A path in a closed furnace of emission 1 and albedo rho that survives each bounce with probability q, with weight
// rho / q: mean 1 / (1 - rho) = m, variance (1 + 2 rho m) / (1 - rho^2 / q) - m^2, finite where q > rho^2. And one
// number: f(x) = x on [0, 1], kept with probability P: variance 1 / (3 P) - 1/4. [Arvo 1990]
#include <cmath>

#include "base/random.h"
#include "experiment.h"

namespace iride::bench {

namespace {

struct Moments {
    double sum = 0, squares = 0;
    long count = 0;
    void add(double x) { sum += x, squares += x * x, ++count; }
    double mean() const { return sum / static_cast<double>(count); }
    double variance() const { return squares / static_cast<double>(count) - square(mean()); }
};

double uniform(std::uint64_t a, std::uint64_t b) { return static_cast<double>(hash_words(5, a, b) >> 11) * 0x1p-53; }

double furnace_path(double rho, double q, std::uint64_t path) {
    double sum = 1, weight = 1;
    for (std::uint64_t bounce = 0; uniform(path, bounce) < q && bounce < 100000; ++bounce) {
        weight *= rho / q;
        if (weight < 1e-12) break;  // what is left out is below the last digit
        sum += weight;
    }
    return sum;
}

}  // namespace

void russian_roulette() {
    constexpr std::uint64_t paths = 1000000;
    fmt::print(
        "{} paths.\n\n| albedo | survival | mean | exact | variance | closed form |\n|---:|---:|---:|---:|---:|---:|\n",
        paths);
    for (auto const& [rho, q, rule] : {std::tuple(0.5, 0.45, ".9 albedo, the source's"),
                                       {0.5, 0.5, "albedo, ours"},
                                       {0.8, 0.72, ".9 albedo, the source's"},
                                       {0.8, 0.8, "albedo, ours"},
                                       {0.89, 0.801, ".9 albedo, the source's"},
                                       {0.89, 0.89, "albedo, ours"},
                                       {0.95, 0.855, ".9 albedo, the source's"},
                                       {0.95, 0.95, "albedo, ours"}}) {
        Moments m;
        for (std::uint64_t i = 0; i < paths; ++i) m.add(furnace_path(rho, q, i));
        double const mean = 1 / (1 - rho);
        double const exact = (1 + 2 * rho * mean) / (1 - rho * rho / q) - mean * mean;
        fmt::print("| {} | {:.3f} ({}) | {:.4g} | {:.4g} | {:.4g} | {} |\n", rho, q, rule, m.mean(), mean, m.variance(),
                   q > rho * rho ? fmt::format("{:.4g}", exact) : "infinite");
    }
    fmt::print("\n| f(x) = x kept with P | mean | exact | variance | closed form |\n|---:|---:|---:|---:|---:|\n");
    double worst = 0;
    for (double P : {1.0, 0.8, 0.5, 0.2}) {
        Moments m;
        for (std::uint64_t i = 0; i < paths; ++i) m.add(uniform(i, 7) < P ? uniform(i, 8) / P : 0);
        worst = std::max(worst, std::abs(m.variance() / (1 / (3 * P) - 0.25) - 1));
        fmt::print("| {} | {:.4f} | 0.5 | {:.4f} | {:.4f} |\n", P, m.mean(), m.variance(), 1 / (3 * P) - 0.25);
    }
    print_verdict("variances of one number as the closed form", fmt::format("within {:.1f} %", 100 * worst),
                  worst < 0.01);
}

}  // namespace iride::bench
