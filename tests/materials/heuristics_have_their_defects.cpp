// SPDX-License-Identifier: Apache-2.0
// The heuristic models as their authors wrote them: the shares of light that their lobes give back, by independent
// quadrature to seven digits, and the laws that they break.
#include <catch2/catch.hpp>

#include "materials/heuristic.h"
#include "support/quadrature.h"

using namespace iride;

namespace {

// Of light arriving at an angle, by a lobe with k_s = 1.
template <HeuristicLobe lobe>
double given_back(float exponent, double angle) {
    Heuristic<lobe> const model{Lanes(0), Lanes(1), exponent};
    return static_cast<double>(test::albedo(model, test::at_angle(angle), true, 512, 512)[0]);
}

struct Row {
    float exponent;
    double normal, at30, at60, at80;
};
template <HeuristicLobe lobe>
void check_table(std::initializer_list<Row> const& rows) {
    for (Row const& row : rows) {
        INFO("exponent " << row.exponent);
        CHECK(given_back<lobe>(row.exponent, 0) == Approx(row.normal).epsilon(1e-4));
        CHECK(given_back<lobe>(row.exponent, 30) == Approx(row.at30).epsilon(1e-4));
        CHECK(given_back<lobe>(row.exponent, 60) == Approx(row.at60).epsilon(1e-4));
        CHECK(given_back<lobe>(row.exponent, 80) == Approx(row.at80).epsilon(1e-4));
    }
}

template <class Model>
double asymmetry(Model const& model) {
    Direction const a = test::at_angle(20), b = test::at_angle(60, 3.3);
    double const there = static_cast<double>(model.evaluate(a, b).value[0]),
                 back = static_cast<double>(model.evaluate(b, a).value[0]);
    return std::abs(there - back) / std::max(there, back);
}

}  // namespace

// Fails for the exponent e + 1, and for the cosine of wo in place of wi's.
TEST_CASE("Phong's lobe gives back the shares of the literature", "[law]") {
    check_table<HeuristicLobe::phong>({{1, 2.094395, 2.130230, 2.550964, 4.944408},
                                       {10, .523599, .523601, .528558, .687655},
                                       {50, .120831, .120830, .120831, .125813}});
}
TEST_CASE("Blinn and Phong's lobe gives back the shares of the literature", "[law]") {
    check_table<HeuristicLobe::blinn_phong>(
        {{10, 1.500672, 1.394302, 1.201509, 1.523818}, {50, .447521, .392733, .251192, .171180}});
}
TEST_CASE("the modified lobe of Blinn and Phong gives back the shares of the literature", "[law]") {
    check_table<HeuristicLobe::modified_blinn_phong>({{10, 1.500671, 1.207501, .600754, .264608}});
    CHECK(given_back<HeuristicLobe::modified_blinn_phong>(1, 0) == Approx(2.860285).epsilon(1e-5));
    CHECK(given_back<HeuristicLobe::modified_blinn_phong>(50, 0) == Approx(.447520).epsilon(1e-4));
}

TEST_CASE("a normalised lobe gives back all of the light along the normal", "[unit]") {
    for (float e : {0.0f, 1.0f, 10.0f, 50.0f}) {
        double const x = static_cast<double>(e);
        CHECK(given_back<HeuristicLobe::phong>(e, 0) == Approx(lobe_albedo(HeuristicLobe::phong, x)).epsilon(1e-4));
        CHECK(given_back<HeuristicLobe::blinn_phong>(e, 0) ==
              Approx(lobe_albedo(HeuristicLobe::blinn_phong, x)).epsilon(1e-4));
        CHECK(given_back<HeuristicLobe::modified_blinn_phong>(e, 0) ==
              Approx(lobe_albedo(HeuristicLobe::modified_blinn_phong, x)).epsilon(1e-4));
    }
}

TEST_CASE("Phong's and Blinn's lobes are not reciprocal, the modified one is", "[law]") {
    CHECK(asymmetry(Phong{Lanes(.1f), Lanes(1), 10}) > .2);
    CHECK(asymmetry(BlinnPhong{Lanes(.1f), Lanes(1), 10}) > .2);
    CHECK(asymmetry(ModifiedBlinnPhong{Lanes(.1f), Lanes(1), 10}) < 1e-5);
}

// Half of the light along the normal is given back, more than all of it at 89 degrees.
TEST_CASE("Phong's and Blinn's lobes give back more than they get near grazing, the modified one does not", "[law]") {
    auto const scaled = [](HeuristicLobe lobe) { return static_cast<float>(.5 / lobe_albedo(lobe, 10)); };
    auto const grazing = [](auto const& model) {
        return static_cast<double>(test::albedo(model, test::at_angle(89), true)[0]);
    };
    CHECK(grazing(Phong{Lanes(0), Lanes(scaled(HeuristicLobe::phong)), 10}) > 1);
    CHECK(grazing(BlinnPhong{Lanes(0), Lanes(scaled(HeuristicLobe::blinn_phong)), 10}) > 1);
    CHECK(grazing(ModifiedBlinnPhong{Lanes(0), Lanes(scaled(HeuristicLobe::modified_blinn_phong)), 10}) < .5);
}

TEST_CASE("heuristic models are finite at grazing incidence and for every exponent", "[law]") {
    auto const check = [](auto const& model) {
        for (double a : {0., 60., 89.999999, 90.})
            for (double b : {0., 60., 89.999999, 90.})
                for (double azimuth : {.4, 3.5415926}) {
                    auto const e = model.evaluate(test::at_angle(a), test::at_angle(b, azimuth));
                    CHECK(is_finite(e.value));
                    CHECK(is_finite(e.density));
                }
    };
    for (float e : {0.0f, 1.0f, 1e5f})
        for (float k_s : {0.0f, 1e3f})
            for (float k_d : {0.0f, 1e3f}) {
                check(Phong{Lanes(k_d), Lanes(k_s), e});
                check(BlinnPhong{Lanes(k_d), Lanes(k_s), e});
                check(ModifiedBlinnPhong{Lanes(k_d), Lanes(k_s), e});
            }
}
