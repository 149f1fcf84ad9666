// SPDX-License-Identifier: Apache-2.0
// Mixtures make what they were mixed for; metamers match under one light alone; gamuts hold what they can make.
#include <Eigen/LU>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "base/diagnostics.h"
#include "colour/gamut.h"
#include "colour/illuminant.h"
#include "colour/metamerism.h"
#include "colour/mixture.h"
#include "colour/monitor.h"
#include "spectral/catalogue.h"

using namespace iride;

namespace {

Primaries constexpr rec709{{.64, .33}, {.30, .60}, {.15, .06}};
Primaries constexpr rec2020{{.708, .292}, {.170, .797}, {.131, .046}};
Chromaticity constexpr d65{.3127, .3290};
Xyz const white = to_xyz(d65, 1);

}  // namespace

// Shares in proportion to the distances alone, without y, would miss the white.
TEST_CASE("complementary lights in their shares make the white", "[law]") {
    Observer const& eye = cie1931_2deg();
    SpectralLocus const locus(eye);
    for (double nm : {450., 480., 487.3, 575., 600., 650.}) {
        auto const pair = complementary(nm, d65, eye, locus);
        REQUIRE(pair.has_value());
        auto const light = [&](double at, double Y) { return to_xyz(to_chromaticity(eye.at(at)), Y); };
        Chromaticity const mix =
            to_chromaticity(light(nm, pair->shares.first) + light(pair->wavelength_nm, pair->shares.second));
        CHECK(mix.x == Approx(d65.x).epsilon(1e-9));
        CHECK(mix.y == Approx(d65.y).epsilon(1e-9));
        CHECK(pair->shares.first + pair->shares.second == Approx(1).epsilon(1e-15));
        CHECK(complementary(pair->wavelength_nm, d65, eye, locus)->wavelength_nm == Approx(nm).margin(1e-6));
    }
    CHECK(!complementary(530, d65, eye, locus));
    CHECK(!mixing_to(d65, {.3, .6}, {.64, .33}));
    CHECK_THROWS_WITH(complementary(300, d65, eye, locus), Catch::Contains("300 nm: allowed is"));
}

// The sample is the standard plus a part that nobody sees under D65: orthogonal to the weights there.
TEST_CASE("metamers under D65 differ under A, and themselves differ from themselves nowhere", "[law]") {
    TristimulusWeights const reference(illuminant("D65"), cie1931_2deg()), test(illuminant("A"), cie1931_2deg());
    auto const bump = [](double nm, double at) { return std::exp(-std::pow((nm - at) / 30, 2)); };
    double const centres[] = {430, 480, 540, 600};
    MatrixDouble seen;
    VectorDouble fourth = VectorDouble::Zero();
    seen.setZero();
    for (std::size_t i = 0; i < reference.weights().size(); ++i) {
        double const nm = reference.wavelengths_nm()[i];
        for (int j = 0; j < 3; ++j) seen.col(j) += bump(nm, centres[j]) * to_vector(reference.weights()[i]);
        fourth += bump(nm, centres[3]) * to_vector(reference.weights()[i]);
    }
    VectorDouble const amount = seen.inverse() * fourth;
    TabulatedShape grey, metamer;
    for (double nm = 360; nm <= 830; ++nm) {
        double unseen = -bump(nm, centres[3]);
        for (int j = 0; j < 3; ++j) unseen += amount[j] * bump(nm, centres[j]);
        grey.nm.push_back(nm), grey.value.push_back(.5);
        metamer.nm.push_back(nm), metamer.value.push_back(.5 + .1 * unseen);
    }
    SpectralFunction const standard(grey, Outside::hold), sample(metamer, Outside::hold);
    auto const& formula = difference_formula("cie1976");
    Metamerism const m = metamerism(standard, sample, reference, test, formula);
    CHECK(m.reference_difference < 1e-9);
    CHECK(m.are_metamers(1e-6));
    CHECK(m.index > 1);
    CHECK(m.index == Approx(m.uncorrected).epsilon(1e-9));  // nothing to correct
    CHECK(metamerism(standard, standard, reference, test, formula).index == 0);
    // A neutral factor of .9 is a mismatch under both lights; the correction takes out all of it.
    Metamerism const darker = metamerism(standard, standard.scaled(.9), reference, test, formula);
    CHECK(darker.reference_difference > 1);
    CHECK(darker.uncorrected == Approx(darker.reference_difference).epsilon(1e-9));
    CHECK(darker.index < 1e-9);
    CHECK_THROWS_AS(metamerism(standard, standard.scaled(0), reference, test, formula), InputError);
}

TEST_CASE("a monitor's two matrices agree when its phosphors have the luminances that make its white", "[law]") {
    MatrixDouble const by_white = monitor_matrix(rec709, white);
    CHECK((by_white * VectorDouble::Ones() - to_vector(white)).norm() < 1e-14);
    MatrixDouble const by_luminance =
        monitor_matrix(rec709, std::array{by_white(1, 0), by_white(1, 1), by_white(1, 2)});
    CHECK((by_white - by_luminance).cwiseAbs().maxCoeff() < 1e-14);
    CHECK(by_white(1, 0) == Approx(.2126).margin(5e-5));  // ITU-R BT.709
    CHECK(by_white(1, 2) == Approx(.0722).margin(5e-5));
}

TEST_CASE("from one monitor to another a colour stays itself or is reported as clipped", "[law]") {
    MatrixDouble const small = monitor_matrix(rec709, white), wide = monitor_matrix(rec2020, white);
    MonitorToMonitor const widen(small, wide), narrow(wide, small);
    Carried const inside = widen(VectorDouble(.2, .5, .9));
    CHECK((wide * inside.rgb - small * VectorDouble(.2, .5, .9)).norm() < 1e-14);
    CHECK(inside.largest_excess == 0);
    CHECK((narrow.matrix() * widen.matrix() - MatrixDouble::Identity()).norm() < 1e-13);
    Carried const green = narrow(VectorDouble(0, 1, 0));  // ITU-R BT.2087: -.5876, 1.1329, -.1006
    CHECK(green.unclipped[0] == Approx(-.5876).margin(1e-4));
    CHECK(green.clipped[0]);
    CHECK(green.clipped[1]);
    CHECK(green.clipped[2]);
    CHECK(green.largest_excess == Approx(.5876).margin(1e-4));
    CHECK(green.rgb == VectorDouble(0, 1, 0));
    Carried const same = MonitorToMonitor(small, small)(VectorDouble(1, 0, 1));
    CHECK(!same.clipped[0]);
    CHECK(!same.clipped[1]);
}

TEST_CASE("a monitor that cannot be is refused", "[input]") {
    CHECK_THROWS_WITH(monitor_matrix({{.3, .3}, {.4, .4}, {.5, .5}}, white), Catch::Contains("lie on a line"));
    CHECK_THROWS_WITH(monitor_matrix({{.64, 0}, {.3, .6}, {.15, .06}}, white), Catch::Contains("y must be above 0"));
    CHECK_THROWS_WITH(monitor_matrix(rec709, to_xyz(Chromaticity{.1, .8}, 1)),
                      Catch::Contains("outside the primaries"));
    CHECK_THROWS_WITH(monitor_matrix(rec709, std::array{20., std::nan(""), 7.}), Catch::Contains("it must be above 0"));
}

TEST_CASE("objects have colours within the optimal ones, and no others", "[law]") {
    TristimulusWeights const weights(illuminant("D65"), cie1931_2deg());
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform(0, 1);
    VectorDouble const middle = .5 * to_vector(weights.white());
    for (int i = 0; i < 12; ++i) {
        double const from = 400 + 250 * uniform(random), to = 400 + 250 * uniform(random);
        VectorDouble const optimal = to_vector(optimal_colour(from, to, weights));
        INFO(from << " to " << to);
        CHECK(is_object_colour(to_xyz(VectorDouble(middle + .999 * (optimal - middle))), weights));
        CHECK(!is_object_colour(to_xyz(VectorDouble(middle + 1.001 * (optimal - middle))), weights));
    }
    CHECK(is_object_colour(weights.white(), weights));
    CHECK(is_object_colour({}, weights));
    CHECK(!is_object_colour(1.001 * weights.white(), weights));
    CHECK(!is_object_colour({NAN, 0, 0}, weights));
    CHECK(optimal_colour(360, 830, weights).Y == Approx(1).epsilon(1e-12));
    SpectralLocus const locus(cie1931_2deg());
    CHECK(is_light(cie1931_2deg().at(520), locus));
    CHECK(is_light({}, locus));
    CHECK(!is_light(to_xyz(Chromaticity{.1, .8 + .05}, 1), locus));
    CHECK(!is_light({.1, -.1, .1}, locus));
}

// Clipping each channel, which is no nearest colour by either measure, fails both.
TEST_CASE("the nearest colour of a gamut is inside it and nothing in it is nearer", "[law]") {
    RgbGamut const gamut(monitor_matrix(rec709, white));
    std::mt19937 random(3);
    std::uniform_real_distribution<double> uniform(0, 1);
    MatrixDouble const to_xyz_matrix = monitor_matrix(rec709, white);
    for (Xyz const& c : {to_xyz(Chromaticity{.1, .7}, .6), to_xyz(Chromaticity{.7, .3}, .2),
                         to_xyz(Chromaticity{.16, .02}, .05), to_xyz(Chromaticity{.32, .33}, 1.5)}) {
        Lab const wanted = to_lab(c, white);
        Xyz const near = gamut.nearest_by_difference(c, white), same_hue = gamut.nearest_by_chroma(c, white);
        CHECK(gamut.contains(near));
        CHECK(gamut.contains(same_hue));
        double const distance = delta_e_1976(to_lab(near, white), wanted);
        CHECK(distance <= delta_e_1976(to_lab(same_hue, white), wanted) + 1e-4);
        for (int i = 0; i < 20000; ++i) {
            VectorDouble rgb(uniform(random), uniform(random), uniform(random));
            if (i % 2) rgb[i % 3] = i % 4 < 2 ? 0 : 1;  // on a face, where the nearest is
            CHECK(delta_e_1976(to_lab(to_xyz(VectorDouble(to_xyz_matrix * rgb)), white), wanted) >= distance - 1e-4);
        }
        Lab const kept = to_lab(same_hue, white);
        if (wanted.L < 100) {
            CHECK(kept.L == Approx(wanted.L).margin(1e-9));
            CHECK(kept.a * wanted.b == Approx(kept.b * wanted.a).margin(1e-6));
        }
    }
    Xyz const inside = to_xyz(d65, .4);
    CHECK(gamut.nearest_by_difference(inside, white).X == inside.X);
    CHECK(gamut.nearest_by_chroma(inside, white).Z == inside.Z);
}
