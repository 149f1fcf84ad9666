// SPDX-License-Identifier: Apache-2.0
// The source's grid of photons and neighbours [Picardello 2022, table 14.2.1], with the error that it lacks, and
// against the other estimators of density that it describes. A point lamp at height h over the middle of the unit
// square makes
//   E(x) = c h / (r^2 + h^2)^(3/2),  c such that the square receives 1,
// closed form. Photons are drawn from it. Cells and functions are as many as make k photons each.
//   error: root mean square over 32 x 32 places and the repetitions of (estimate - E) / E; time: per place, look-up
//   alone
#include <ctime>

#include "base/random.h"
#include "experiment.h"
#include "integrators/photon/surface_density.h"

namespace iride::bench {

namespace {

constexpr double lamp_height = 0.35;
constexpr int places = 32;

double unnormalised(Eigen::Vector2d const& p) {
    double const r2 = (p - Eigen::Vector2d(0.5, 0.5)).squaredNorm();
    return lamp_height / std::pow(r2 + square(lamp_height), 1.5);
}

// Solid angle of the square from the lamp: 4 asin(a^2 / (a^2 + h^2)), a = 1/2.
double irradiance(Vector2 const& p) {
    double const a2 = 0.25, solid_angle = 4 * std::asin(a2 / (a2 + square(lamp_height)));
    return unnormalised(p.cast<double>()) / solid_angle;
}

class Numbers {
  public:
    explicit Numbers(std::uint64_t seed) : seed_(seed) {}
    float next() { return to_unit_float(static_cast<std::uint32_t>(hash_words(seed_, count_++))); }

  private:
    std::uint64_t seed_, count_ = 0;
};

// By rejection: independent points.
std::vector<Vector2> photons_of_lamp(int count, std::uint64_t seed) {
    Numbers numbers(seed);
    double const most = unnormalised({0.5, 0.5});
    std::vector<Vector2> points;
    while (static_cast<int>(points.size()) < count) {
        Vector2 const p(numbers.next(), numbers.next());
        if (static_cast<double>(numbers.next()) * most < unnormalised(p.cast<double>())) points.push_back(p);
    }
    return points;
}

struct Measured {
    double error = 0, bias = 0, nanoseconds = 0;
};

template <class Make>
Measured measure(int photons, int repetitions, Make&& make) {
    double squares = 0, sum = 0, seconds = 0;
    for (int k = 0; k < repetitions; ++k) {
        auto const density = make(photons_of_lamp(photons, hash_words(static_cast<std::uint64_t>(k), 7)));
        std::vector<double> found;
        std::clock_t const start = std::clock();
        for (int i = 0; i < places * places; ++i) {
            Vector2 const p((static_cast<float>(i % places) + 0.5f) / places,
                            (static_cast<float>(i / places) + 0.5f) / places);
            found.push_back(density.at(p));
        }
        seconds += static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
        for (int i = 0; i < places * places; ++i) {
            Vector2 const p((static_cast<float>(i % places) + 0.5f) / places,
                            (static_cast<float>(i / places) + 0.5f) / places);
            double const relative = found[static_cast<std::size_t>(i)] / irradiance(p) - 1;
            squares += relative * relative;
            sum += relative;
        }
    }
    double const n = static_cast<double>(places) * places * repetitions;
    return {std::sqrt(squares / n), sum / n, seconds / n * 1e9};
}

void print_row(int photons, int k) {
    int const repetitions = std::max(4, 12800 / photons);
    if (photons < k) {
        fmt::print("| {} | {} | fewer photons than neighbours |\n", photons, k);
        return;
    }
    int const side = std::max(1, static_cast<int>(std::lround(std::sqrt(static_cast<double>(photons) / k))));
    fmt::print("| {} | {} |", photons, k);
    auto const cell = [](Measured const& m) {
        fmt::print(" {:.1f} ({:+.1f}) {:.0f} |", 100 * m.error, 100 * m.bias, m.nanoseconds);
    };
    using Points = std::vector<Vector2>;
    cell(measure(photons, repetitions, [&](Points const& p) { return NeighbourDensity(p, k, false); }));
    cell(measure(photons, repetitions, [&](Points const& p) { return NeighbourDensity(p, k, true); }));
    cell(measure(photons, repetitions, [&](Points const& p) { return HistogramDensity(p, side); }));
    cell(measure(photons, repetitions, [&](Points const& p) { return SeriesDensity(p, side, SeriesBasis::legendre); }));
    cell(measure(photons, repetitions, [&](Points const& p) { return SeriesDensity(p, side, SeriesBasis::cosine); }));
    fmt::print("\n");
}

}  // namespace

void photon_density() {
    fmt::print("Error % (mean %) ns per look-up.\n\n");
    fmt::print("| photons | k | nearest, whole disc | nearest, disc in the square | histogram | Legendre | cosine |\n");
    fmt::print("|---|---|---|---|---|---|---|\n");
    for (int k : {80, 240, 480})
        for (int photons = 200; photons <= 12800; photons *= 2) print_row(photons, k);
}

}  // namespace iride::bench
