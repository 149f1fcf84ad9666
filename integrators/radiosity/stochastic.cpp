// SPDX-License-Identifier: Apache-2.0
#include "integrators/radiosity/stochastic.h"

#include <tbb/parallel_for.h>

#include <array>
#include <cmath>
#include <vector>

namespace iride::radiosity {

namespace {

// Power emitted and reflected over power emitted, if light were even: lines per walk.
double lines_per_walk(System const& s) {
    double const emitted = (s.emission.colwise() * s.area).sum();
    if (!(emitted > 0)) return 1;
    Row const mean = (s.reflectance.colwise() * s.area).colwise().sum() / s.area.sum(),
              power = (s.emission.colwise() * s.area).colwise().sum();
    return (power / (1 - mean.min(0.99))).sum() / emitted;
}

// Rounds of lines: what a round brings is what the next sends on.
struct Rounds {
    System const& s;
    Spectra unshot, sent, variance;
    std::uint64_t lines = 0;
    int count = 0;

    explicit Rounds(System const& system)
        : s(system),
          unshot(system.emission.colwise() * system.area),
          sent(Spectra::Zero(unshot.rows(), unshot.cols())),
          variance(sent) {}
    StochasticSolution finish() const {
        return {s.emission + sent.colwise() / s.area, variance.sqrt().colwise() / s.area, lines, count};
    }
    bool goes_on(double emitted) const {
        constexpr double negligible = 1e-5;  // of the emitted power
        constexpr int most = 1000;
        return count < most && unshot.sum() > negligible * emitted;
    }
    void arrive(Spectra& next, int at, Row const& power) {
        Row const reflected = s.reflectance.row(at) * power;
        next.row(at) += reflected;
        variance.row(at) += reflected.square();
    }
    void end(Spectra next) {
        sent += next;
        unshot = std::move(next);
        ++count;
    }
};

// Lines in proportion to the unshot power: patch i gets those of lines 0, 1, 2 .. that fall into its part of it.
StochasticSolution jacobi(System const& system, LineSource const& source, std::uint64_t lines, std::uint64_t seed) {
    Rounds rounds(system);
    double const emitted = rounds.unshot.sum(),
                 per_line = emitted * lines_per_walk(system) / static_cast<double>(std::max<std::uint64_t>(1, lines));
    while (rounds.goes_on(emitted)) {
        double const total = rounds.unshot.sum();
        auto const count = static_cast<std::uint64_t>(std::ceil(total / per_line));
        auto const round = static_cast<std::uint32_t>(rounds.count);
        // The end of each line, found in parallel; what it carries is added in order.
        std::vector<int> from(count), to(count);
        double until = 0,
               start = static_cast<double>(to_unit_float(static_cast<std::uint32_t>(hash_words(seed, round))));
        std::uint64_t k = 0;
        for (Eigen::Index i = 0; i < rounds.unshot.rows(); ++i) {
            until += rounds.unshot.row(i).sum() / total * static_cast<double>(count);
            for (; k < count && static_cast<double>(k) + start < until; ++k) from[k] = static_cast<int>(i);
        }
        std::uint64_t const found = k;
        tbb::parallel_for(tbb::blocked_range<std::uint64_t>(0, found, 1024), [&](auto const& range) {
            for (std::uint64_t line = range.begin(); line < range.end(); ++line) {
                Sampler sampler(SamplerKind::independent, seed + 1, static_cast<std::uint32_t>(line), round);
                to[line] = source.local(from[line], sampler);
            }
        });
        Spectra next = Spectra::Zero(rounds.unshot.rows(), rounds.unshot.cols());
        for (std::uint64_t line = 0; line < found; ++line)
            if (to[line] >= 0) {
                Row const power = rounds.unshot.row(from[line]);
                rounds.arrive(next, to[line], power * (total / (power.sum() * static_cast<double>(count))));
            }
        rounds.lines += found;
        rounds.end(std::move(next));
    }
    return rounds.finish();
}

// Every line serves all pairs along it, both ways: patch i is left by `meetings` A_i lines of each direction's sum.
StochasticSolution global_jacobi(System const& system, LineSource const& source, std::uint64_t lines,
                                 std::uint64_t seed) {
    Rounds rounds(system);
    double const emitted = rounds.unshot.sum();
    constexpr int rounds_expected = 16;
    auto const count = static_cast<std::uint32_t>(std::max<std::uint64_t>(1, lines / rounds_expected));
    auto const series = static_cast<std::uint32_t>(hash_words(seed));
    while (rounds.goes_on(emitted)) {
        Spectra next = Spectra::Zero(rounds.unshot.rows(), rounds.unshot.cols());
        auto const give = [&](int i, int j) {
            double const leaving = source.meetings * system.area[i] * count;
            rounds.arrive(next, j, rounds.unshot.row(i) / leaving);
        };
        for (std::uint32_t k = 0; k < count; ++k)
            source.global(series + static_cast<std::uint32_t>(rounds.count), k, [&](int i, int j) {
                give(i, j);
                give(j, i);
            });
        rounds.lines += count;
        rounds.end(std::move(next));
    }
    return rounds.finish();
}

template <Walk kind>
StochasticSolution solve_by_walks(System const& system, LineSource const& source, std::uint64_t lines,
                                  std::uint64_t seed) {
    auto const walks = static_cast<std::uint64_t>(static_cast<double>(lines) / lines_per_walk(system));
    return random_walks(system, source, kind, std::max<std::uint64_t>(2, walks), seed);
}

constexpr std::array<StochasticEntry, 5> table{{
    {"stochastic-jacobi", "increments by lines of equal power from the patches that have some", jacobi},
    {"collision-walk", "random walks that count wherever they arrive", solve_by_walks<Walk::collision>},
    {"survival-walk", "random walks that count where they go on", solve_by_walks<Walk::survival>},
    {"absorption-walk", "random walks that count where they end", solve_by_walks<Walk::absorption>},
    {"global-lines-jacobi", "increments by lines through the whole scene, both ways", global_jacobi},
}};

}  // namespace

std::span<StochasticEntry const> stochastic_solvers() { return table; }

}  // namespace iride::radiosity
