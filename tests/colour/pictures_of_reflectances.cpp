// SPDX-License-Identifier: Apache-2.0
// Many reflectances at once have their colours as well as one at a time: seen by an integration of its own.
#include <catch2/catch.hpp>

#include "base/diagnostics.h"
#include "base/random.h"
#include "colour/lab.h"
#include "colour/observer.h"
#include "colour/reflectance_table.h"
#include "colour/rgb_encoding.h"
#include "colour/rgb_to_spectrum.h"

using namespace iride;

namespace {

// Midpoint rule in fifths of a nanometre: nothing of the fitter's quadrature.
VectorDouble seen(SpectralFunction const& light, SpectralFunction const& reflectance) {
    VectorDouble sum = VectorDouble::Zero(), white = VectorDouble::Zero();
    for (double nm = 360.1; nm < 830; nm += .2) {
        VectorDouble const density = light.at(nm) * to_vector(cie1931_2deg().at(nm));
        sum += reflectance.at(nm) * density, white += density;
    }
    return sum.cwiseQuotient(white);
}
double difference_1976(VectorDouble const& a, VectorDouble const& b) {
    Lab const p = to_lab(to_xyz(a), {1, 1, 1}), q = to_lab(to_xyz(b), {1, 1, 1});
    return std::hypot(p.L - q.L, p.a - q.a, p.b - q.b);
}
SpectralFunction sigmoid(std::array<float, 3> const& s) {
    return SpectralFunction(
        SigmoidShape{static_cast<double>(s[0]), static_cast<double>(s[1]), static_cast<double>(s[2])},
        Outside::extrapolate);
}
VectorDouble wanted(RgbSpace const& space, Eigen::Array3f const& rgb) {
    VectorDouble const xyz = space.to_xyz_matrix() * rgb.matrix().cast<double>();
    return xyz.cwiseQuotient(to_vector(to_xyz(space.white, 1)));
}

// Random 8-bit sRGB colours: half of them dark, where fits are hardest.
std::vector<Eigen::Array3f> random_texels(int count) {
    std::vector<Eigen::Array3f> texels;
    for (int i = 0; i < count; ++i) {
        std::uint64_t const bits = hash_words(1, static_cast<std::uint64_t>(i));
        Eigen::Array3f rgb;
        for (int c = 0; c < 3; ++c)
            rgb[c] = static_cast<float>(decode(TransferFunction::srgb, static_cast<double>(bits >> 8 * c & 255) / 255));
        texels.push_back(rgb);
    }
    return texels;
}

}  // namespace

TEST_CASE("texels come back within a CIE 1976 difference of .02, and near the exact fit", "[law]") {
    std::vector<Eigen::Array3f> const texels = random_texels(2000);
    UpliftedColours const fast = uplift_reflectances(texels, rgb::rec709);
    CHECK(fast.unreachable == 0);
    SpectralFunction const& light = white_light(rgb::rec709.white);
    double most = 0, farthest = 0;
    for (std::size_t i = 0; i < texels.size(); i += 4) {
        SpectralFunction const s = sigmoid(fast.sigmoid[i]);
        most = std::max(most, difference_1976(seen(light, s), wanted(rgb::rec709, texels[i])));
        SpectralFunction const exact =
            rgb_to_spectrum(texels[i].matrix().cast<double>(), rgb::rec709, RgbRole::reflectance);
        for (double nm = 420; nm <= 680; nm += 20) farthest = std::max(farthest, std::abs(s.at(nm) - exact.at(nm)));
    }
    CHECK(most < .02);
    CHECK(farthest < .005);
}

TEST_CASE("grey texels are constants, black and white exactly", "[unit]") {
    std::vector<Eigen::Array3f> const greys{{0, 0, 0}, {.25f, .25f, .25f}, {1, 1, 1}};
    for (RgbSpace const* space : {&rgb::rec709, &rgb::acescg}) {
        UpliftedColours const u = uplift_reflectances(greys, *space);
        for (std::size_t i = 0; i < greys.size(); ++i)
            for (double nm : {360., 555., 830.})
                CHECK(sigmoid(u.sigmoid[i]).at(nm) == Approx(static_cast<double>(greys[i][0])).margin(1e-9));
        CHECK(u.unreachable == 0);
    }
}

TEST_CASE("colours that no reflectance has are counted, and get a near one", "[unit]") {
    std::vector<Eigen::Array3f> const texels{{.5f, .4f, .3f}, {0, 1, 0}, {.2f, .2f, .1f}};
    UpliftedColours const u = uplift_reflectances(texels, rgb::acescg);
    CHECK(u.unreachable == 1);
    CHECK(u.worst_difference > 1);
    // One fit, not the 81 of rgb_to_spectrum's refusal: it may end in a valley up to 12 farther (colour/sigmoid_fit.h).
    try {
        rgb_to_spectrum({0, 1, 0}, rgb::acescg, RgbRole::reflectance);
        FAIL("accepted");
    } catch (InputError const& e) {
        std::string const text = e.what();
        double const told = std::stod(text.substr(text.rfind(' ')));
        CHECK(u.worst_difference >= told - .3);
        CHECK(u.worst_difference <= told + 12);
    }
}
