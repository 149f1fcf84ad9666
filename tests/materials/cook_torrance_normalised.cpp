// SPDX-License-Identifier: Apache-2.0
// The classic model, Beckmann facets under the v-cavity's masking, against values worked out independently from the
// closed form F D G / (4 cos cos) with D over pi.
#include <catch2/catch.hpp>

#include "support/conductors.h"

using namespace iride;

namespace {

Facets classic(float m) { return {{{1, m, m}}, FacetShape::beckmann, Masking::v_cavity}; }

Direction at_angle(double degrees, double azimuth_deg = 0) {
    double const t = radians(degrees), a = radians(azimuth_deg);
    return VectorDouble(std::sin(t) * std::cos(a), std::sin(t) * std::sin(a), std::cos(t)).cast<float>();
}

}  // namespace

TEST_CASE("the classic model of n = 1.5 has its closed form's values", "[unit]") {
    struct Row {
        float m;
        double light, eye, azimuth, f;
    };
    for (Row const& r :
         {Row{.1f, 0, 0, 0, .318309886}, Row{.2f, 0, 0, 0, .0795774715}, Row{.3f, 0, 0, 0, .0353677651},
          Row{.2f, 30, 30, 180, .110142186}, Row{.2f, 60, 60, 180, .70972531}, Row{.3f, 30, 30, 180, .0489520828},
          Row{.3f, 60, 60, 180, .315433471}, Row{.3f, 0, 60, 0, .00321545048}, Row{.3f, 30, 60, 90, .000501303003},
          Row{.2f, 0, 60, 0, .000070599519}, Row{.2f, 30, 60, 90, 6.60411475e-7}}) {
        Facets const facets = classic(r.m);
        RoughMetal<BareFresnel, FacetsOfMaterial> const model{{Lanes(1.5f), Lanes(0)}, {&facets}};
        INFO("m " << r.m << ", " << r.light << " and " << r.eye);
        CHECK(model.evaluate(at_angle(r.eye, r.azimuth), at_angle(r.light)).value[0] == Approx(r.f).epsilon(2e-5));
    }
}

TEST_CASE("the classic model loses what the normalised formula loses", "[law]") {
    std::array<double, 6> const angles{0, 30, 45, 60, 75, 85};
    auto const check = [&](float m, std::array<double, 6> const& albedo) {
        FacetLoss const& loss = test::facet_loss(classic(m));
        for (std::size_t i = 0; i < angles.size(); ++i) {
            INFO("m " << m << " at " << angles[i]);
            CHECK(1 - static_cast<double>(loss.loss(at_angle(angles[i]))) == Approx(albedo[i]).margin(5e-4).epsilon(0));
        }
    };
    check(.1f, {1, 1, 1, .99907, .96988, .93748});
    check(.2f, {.99998, .99885, .99216, .96559, .92752, .95976});
    check(.3f, {.99558, .98119, .95666, .92477, .92731, .97024});
}
