// SPDX-License-Identifier: Apache-2.0
#include <catch2/catch.hpp>

#include "colour/observer.h"
#include "colour/rgb_space.h"
#include "colour/rgb_to_spectrum.h"
#include "materials/fresnel.h"
#include "spectral/catalogue.h"

using namespace iride;

namespace {

Xyz metal_colour(std::string const& name, double angle_deg) {
    ComplexIndex const m = load_complex_index(name);
    TabulatedShape t;
    for (double nm = 360; nm <= 830; ++nm) {
        t.nm.push_back(nm);
        t.value.push_back(fresnel(std::cos(radians(angle_deg)), m.n.at(nm), m.k.at(nm)).unpolarised() *
                          unit_d65().at(nm));
    }
    return cie1931_2deg().integrate(SpectralFunction(std::move(t), Outside::zero));
}

void check_metal(std::string const& name, double angle, double x, double y, double Y) {
    Xyz const c = metal_colour(name, angle);
    INFO(name << " at " << angle);
    CHECK(to_chromaticity(c).x == Approx(x).margin(1e-4).epsilon(0));
    CHECK(to_chromaticity(c).y == Approx(y).margin(1e-4).epsilon(0));
    CHECK(c.Y == Approx(Y).margin(2e-4).epsilon(0));
}

}  // namespace

// Independent evaluation from the same published n, k. Fails with Schlick's approximation at 60 and 88 degrees.
TEST_CASE("metals under D65 have the colours of their published n + ik", "[law]") {
    check_metal("Au", 0, .3818, .3887, .7679);
    check_metal("Au", 60, .3749, .3831, .7737);
    check_metal("Au", 88, .3206, .3373, .9619);
    check_metal("Cu", 0, .3558, .3456, .6811);
    check_metal("Al", 0, .3116, .3283, .9145);
}

TEST_CASE("gold is outside linear sRGB and is not clamped", "[law]") {
    VectorDouble const rgb = rgb::rec709.from_xyz_matrix() * to_vector(metal_colour("Au", 0));
    CHECK(rgb[0] == Approx(1.038).margin(1e-3).epsilon(0));
    CHECK(rgb[1] == Approx(.728).margin(1e-3).epsilon(0));
    CHECK(rgb[2] == Approx(.365).margin(1e-3).epsilon(0));
}

TEST_CASE("illuminants have their CIE chromaticities", "[law]") {  // CIE 15; E as the 1 nm tables give it
    struct Row {
        char const* name;
        double x, y;
    };
    for (Row const& r : {Row{"A", .44758, .40745},
                         {"D50", .34567, .35851},
                         {"D65", .31272, .32903},
                         {"D75", .29903, .31488},
                         {"E", .333314, .333288}}) {
        Chromaticity const c = named_white(std::string(r.name) + ":table");
        INFO(r.name);
        CHECK(c.x == Approx(r.x).margin(5e-5).epsilon(0));
        CHECK(c.y == Approx(r.y).margin(5e-5).epsilon(0));
    }
    CHECK(cie1931_2deg().ybar_integral == Approx(106.8569171).margin(3e-6).epsilon(0));
}

TEST_CASE("RGB matrices are the published ones", "[law]") {
    MatrixDouble ap1;  // ACES S-2014-004
    ap1 << 0.6624541811, 0.1340042065, 0.1561876870, 0.2722287168, 0.6740817658, 0.0536895174, -0.0055746495,
        0.0040607335, 1.0103391003;
    CHECK((rgb::acescg.to_xyz_matrix() - ap1).cwiseAbs().maxCoeff() < 1e-9);
    MatrixDouble srgb;  // IEC 61966-2-1, four digits
    srgb << .4124, .3576, .1805, .2126, .7152, .0722, .0193, .1192, .9505;
    CHECK((rgb::rec709.to_xyz_matrix() - srgb).cwiseAbs().maxCoeff() < 6e-5);
}
