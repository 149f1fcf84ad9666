// SPDX-License-Identifier: Apache-2.0
// Photon methods against `path`, on a box of diffuse walls: for `photon-map` the number of its photons, for
// `progressive-photon` that of its passes. The square error of n photons spread over k each is 1 / k and the square of
// a bias that falls with k / n; with k fixed it stays, by n passes it falls as n^(-2/3) [Knaus 2011].
//   error: root mean square over pixels of (Y - Y of path) over the picture's mean; bias: of that mean. Pixels that the
//   lamp is seen in are left out: it is 40 times as bright as the mean, its edges' noise is that of camera paths.
//   `path` at as many samples tells how much of the rest is theirs
#include "bench/measure/benchmark.h"
#include "experiment.h"

namespace iride::bench {

namespace {

struct Deviation {
    double error, bias;
};
Deviation deviation(Film const& film, Film const& exact) {
    constexpr double lamp = 0.5;  // Y: what it lights is below .26, the lamp 12.5
    double squares = 0, sum = 0, sum_exact = 0;
    int n = 0;
    for (int y = 0; y < film.height(); ++y)
        for (int x = 0; x < film.width(); ++x) {
            double const a = film.mean(x, y).Y, b = exact.mean(x, y).Y;
            if (b < lamp) squares += square(a - b), sum += a, sum_exact += b, ++n;
        }
    return {std::sqrt(squares / n) / (sum_exact / n), sum / sum_exact - 1};
}

}  // namespace

void photon_rates() {
    auto const scene = load_scene(find_scene("cornell"));
    scene->film.width = scene->film.height = 32;
    Film const exact = rendered(*scene, "path", {.spp = 16384, .seed = 99}).film;
    fmt::print("| method | photons | error % | bias % | seconds |\n|---|---:|---:|---:|---:|\n");
    auto const row = [&](std::string const& name, std::string const& integrator, long photons, int spp) {
        auto const [film, report] = rendered(*scene, integrator, {.spp = spp, .seed = 1, .threads = 1});
        Deviation const d = deviation(film, exact);
        fmt::print("| {} | {} | {:.2f} | {:+.2f} | {:.2f} |\n", name, photons, 100 * d.error, 100 * d.bias,
                   report.seconds);
        return d.error;
    };
    row("path", "path", 0, 256);
    for (int k : {80, 240, 480})
        for (long photons : {3200, 12800, 51200, 204800})
            row(fmt::format("photon-map, {} neighbours", k),
                fmt::format("photon-map:photons={},neighbours={}", photons, k), photons, 256);
    std::vector<std::pair<double, double>> points;
    constexpr int each = 10000;
    for (int passes : {4, 16, 64, 256})
        points.emplace_back(passes, row("progressive-photon", fmt::format("progressive-photon:photons={}", each),
                                        static_cast<long>(each) * passes, 4 * passes));
    double const slope = fit_power_law(points).slope;
    constexpr double predicted = -1.0 / 3, margin = 0.08;
    print_verdict(fmt::format("error of progressive photons falls as their number to the power {:.2f}", predicted),
                  fmt::format("{:.2f}", slope), slope < predicted + margin);
}

}  // namespace iride::bench
