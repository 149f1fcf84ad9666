// SPDX-License-Identifier: Apache-2.0
// Radiosity by chance: unbiased, with the variances that can be worked out. With visits zeta_k = [(I - Q)^-1]_kk - 1,
// Q_ij = F_ij rho_j, and b' = b - e, a walk of power W has
//   survival W / A b' (1 + 2 zeta) - b'^2,   collision rho W / A b' (1 + 2 zeta) - b'^2,   absorption rho W / ((1 -
//   rho) A) b' - b'^2
#include <catch2/catch.hpp>

#include <fmt/format.h>

#include "integrators/radiosity/radiosity.h"
#include "support/scenes.h"

using namespace iride;
using namespace iride::radiosity;

namespace {

// Three patches; everything about them is a ratio of whole numbers.
System three() {
    Eigen::MatrixXd F(3, 3);
    F << .2, .3, .5, .15, .35, .5, 1. / 6, 1. / 3, .5;
    return {Eigen::Array3d(1, 2, 3), F.sparseView(), Eigen::Array3d(.5, .8, .3), Eigen::Array3d(4, 0, 0)};
}
System sphere(double rho) {
    constexpr int n = 200;
    return {Eigen::ArrayXd::Ones(n), Eigen::MatrixXd::Constant(n, n, 1. / n).sparseView(), Spectra::Constant(n, 1, rho),
            Spectra::Constant(n, 1, 1. / n)};
}
LineSource lines_of(System const& s) {
    return {[&s](int from, Sampler& sampler) {
        auto u = static_cast<double>(sampler.next());
        int last = -1;
        for (FormFactors::InnerIterator F(s.form_factors, from); F; ++F) {
            last = static_cast<int>(F.col());
            if ((u -= F.value()) < 0) break;
        }
        return last;
    }};
}
constexpr std::array<double, 3> reflected{4576. / 969 - 4, 976. / 969, 128. / 323};

}  // namespace

// Fails for a single formula rho W / A b', often given for all three: it has 1.44, 1.61, .159.
TEST_CASE("walks scatter by their closed forms", "[law]") {
    System const s = three();
    LineSource const source = lines_of(s);
    struct Expected {
        Walk kind;
        std::array<double, 3> variance;
    };
    constexpr std::uint64_t walks = 1'000'000;
    for (Expected const& e : {Expected{Walk::survival, {3.411430, 3.228522, .688693}},
                              {Walk::collision, {1.444788, 2.379917, .096679}},
                              {Walk::absorption, {2.367723, 7.043291, .069407}}}) {
        StochasticSolution const found = random_walks(s, source, e.kind, walks, 1);
        for (Eigen::Index k = 0; k < 3; ++k) {
            auto const i = static_cast<std::size_t>(k);
            double const sigma = std::sqrt(e.variance[i] / static_cast<double>(walks));
            CHECK(std::abs(found.radiosity(k, 0) - s.emission(k, 0) - reflected[i]) < 4 * sigma);
            CHECK(std::pow(found.standard_error(k, 0), 2) * static_cast<double>(walks) ==
                  Approx(e.variance[i]).epsilon(.02));
        }
        CHECK(static_cast<double>(found.lines) / static_cast<double>(walks) == Approx(640. / 323).epsilon(.005));
    }
}

TEST_CASE("in an integrating sphere walks scatter as the reflectance says", "[law]") {
    constexpr std::uint64_t walks = 200'000;
    for (auto const& [rho, kind, variance] : {std::tuple(.5, Walk::collision, .002498),
                                              {.5, Walk::survival, .00504},
                                              {.5, Walk::absorption, .00496},
                                              {.2, Walk::collision, .000249},
                                              {.2, Walk::survival, .001256},
                                              {.2, Walk::absorption, .000310}}) {
        System const s = sphere(rho);
        LineSource const source = lines_of(s);
        StochasticSolution const found = random_walks(s, source, kind, walks, 2);
        CHECK((found.standard_error.square() * static_cast<double>(walks)).mean() == Approx(variance).epsilon(.01));
    }
}

// rho |w| b' / A per line: .5 x 2 x .005.
TEST_CASE("increments scatter by their closed form, and say so", "[law]") {
    System const s = sphere(.5);
    LineSource const source = lines_of(s);
    double squares = 0, said = 0, mean = 0;
    constexpr int runs = 40, lines = 4000;
    for (int run = 0; run < runs; ++run) {
        StochasticSolution const found =
            stochastic_solvers()[0].solve(s, source, lines, static_cast<std::uint64_t>(17 * run));
        auto const count = static_cast<double>(found.lines);
        squares += (found.radiosity - .01).square().mean() * count / runs;
        said += found.standard_error.square().mean() * count / runs;
        mean += found.radiosity.mean() / runs;
    }
    CHECK(squares == Approx(.005).epsilon(.07));  // 4 sigma of 8000 squares
    CHECK(said == Approx(.005).epsilon(.03));
    CHECK(mean == Approx(.01).epsilon(1e-3));
}

// A closed cube, every face of which emits 1 and reflects a half: b = 2 pi, to the error bars given.
TEST_CASE("every stochastic solver finds the furnace of a cube", "[law]") {
    std::string shapes;
    for (char const* corners : {"[[0,1,0],[1,1,0],[1,1,1],[0,1,1]]", "[[0,0,0],[0,0,1],[1,0,1],[1,0,0]]",
                                "[[0,0,0],[0,1,0],[0,1,1],[0,0,1]]", "[[1,0,0],[1,0,1],[1,1,1],[1,1,0]]",
                                "[[0,0,1],[0,1,1],[1,1,1],[1,0,1]]", "[[0,0,0],[1,0,0],[1,1,0],[0,1,0]]"})
        shapes += fmt::format(R"({}{{"type":"quad","material":"m","corners":{},"emission":{{"radiance":1}}}})",
                              shapes.empty() ? "" : ",", corners);
    auto const scene = test::scene_from(fmt::format(
        R"({{"camera":{{"eye":[0.5,0.5,0.1],"target":[0.5,0.5,1],"field_deg":90}},
        "materials":{{"m":{{"type":"diffuse","reflectance":0.5}}}},"shapes":[{}]}})",
        shapes));
    for (StochasticEntry const& e : stochastic_solvers()) {
        INFO(e.name);
        SceneRadiosity const solution(*scene, visible_range,
                                      {.size_m = .5, .wavelengths = 3, .solver = e.name, .lines = 4000});
        Spectra const off = (solution.radiosity() - 2 * pi_double) / solution.standard_error();
        CHECK(off.abs().maxCoeff() < 5);
        CHECK(solution.standard_error().maxCoeff() < .1 * 2 * pi_double);
        CHECK(solution.radiosity().mean() == Approx(2 * pi_double).epsilon(.01));
    }
}
