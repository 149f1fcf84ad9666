// SPDX-License-Identifier: Apache-2.0
// Spectral bands of rendered pictures: they are the same estimator as XYZ, and no pattern of the lanes shows in them,
// where wavelengths part company too.
#include <fmt/format.h>

#include <catch2/catch.hpp>

#include "support/scenes.h"

using namespace iride;

namespace {

std::unique_ptr<Scene> small_prism(int side) {
    auto scene = load_scene(find_scene("prism"));
    scene->film.width = scene->film.height = side;
    REQUIRE(make_plan(*scene).dispersion);
    return scene;
}

// The shipped prism in a furnace: radiance 1 from everywhere at every wavelength. Glass takes nothing away and L / n^2
// is invariant, so every pixel of every band is 1.
std::string prism_in_a_furnace(int side, int bands) {
    auto const scene = load_scene(find_scene("prism"));
    Mesh const& mesh = *std::get<MeshShape>(scene->shapes.front().geometry).mesh;
    auto const list = [](auto const& rows) {
        std::string text;
        for (auto const& r : rows) text += fmt::format("{}[{},{},{}]", text.empty() ? "" : ",", r[0], r[1], r[2]);
        return text;
    };
    return fmt::format(
        R"({{ "camera": {{ "eye": [0,0,-6], "target": [0,0,0], "field_deg": 20 }},
              "film": {{ "size": [{0},{0}], "bands": {{ "count": {1} }} }},
              "lights": [{{ "type": "environment", "radiance": 1 }}],
              "shapes": [{{ "type": "mesh", "vertices": [{2}], "triangles": [{3}],
                            "material": {{ "type": "dielectric", "ior": {{ "data": "SF11", "outside": "hold" }} }} }}] }})",
        side, bands, list(mesh.position), list(mesh.triangle));
}

}  // namespace

// Fails when lanes are deposited with the hero's density, and when a lane that a refraction left behind still brings
// light.
TEST_CASE("bands of a prism in a furnace show no comb, for 1 to 47 bands", "[law]") {
    constexpr int side = 16, pixels = side * side;
    constexpr double level = 4.9;  // normal quantile of 1e-3 / (2 x 1128 bands)
    for (int count = 1; count <= 47; ++count) {
        auto const scene = test::scene_from(prism_in_a_furnace(side, count));
        Film const film = test::rendered(*scene, "path", {.spp = 64, .seed = 8});
        CHECK(film.rejected() == std::array<std::uint64_t, rejection_count>{});
        for (int b = 0; b < count; ++b) {
            double sum = 0, sum_of_squares = 0;
            for (int p = 0; p < pixels; ++p) {
                double const deviation = film.band(p % side, p / side, b) - 1;
                sum += deviation;
                sum_of_squares += deviation * deviation;
            }
            double const mean = sum / pixels;
            double const error = std::sqrt((sum_of_squares / pixels - mean * mean) / (pixels - 1));
            INFO(count << " bands, band " << b << ": deviation " << mean << ", error " << error);
            constexpr double rounding = 1e-6;  // a single band holds every lane: little but float is left of its error
            CHECK(std::abs(mean) < level * error + rounding);
        }
    }
}

// The observer is linear between whole nanometres, the bands are the nanometres: at the centre it is off by at most
// half its step there, and by nothing in the mean. Fails for bands shifted by one nanometre, and for a film without the
// hero's density.
TEST_CASE("bands of one nanometre times the CIE observer are XYZ, in the prism too", "[law]") {
    constexpr int side = 24;
    auto const scene = small_prism(side);
    scene->film.band_count = 470;
    Film const film = test::rendered(*scene, "path", {.spp = 16, .seed = 4});
    Observer const& eye = cie1931_2deg();
    constexpr double pixels = side * side;
    Eigen::Vector3d mean(0, 0, 0), deviation(0, 0, 0), square_deviation(0, 0, 0);  // of sum from XYZ, over the pixels
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            Eigen::Vector3d sum(0, 0, 0), allowed(0, 0, 0);
            for (int b = 0; b < 470; ++b) {
                double const radiance = film.band(x, y, b) / eye.ybar_integral;
                sum += radiance * to_vector(eye.at(360.5 + b));
                allowed += radiance * (to_vector(eye.at(361 + b)) - to_vector(eye.at(360 + b))).cwiseAbs() / 2;
            }
            Eigen::Vector3d const xyz = to_vector(film.mean(x, y));
            REQUIRE(((xyz - sum).cwiseAbs() - allowed - 1e-6 * xyz).maxCoeff() <= 0);
            mean += xyz / pixels;
            deviation += (sum - xyz) / pixels;
            square_deviation += (sum - xyz).cwiseAbs2() / pixels;
        }
    Eigen::Vector3d const error = ((square_deviation - deviation.cwiseAbs2()) / (pixels - 1)).cwiseSqrt();
    constexpr double curvature = 5e-5;  // relative: lamp and density are not quite even over a nanometre
    CHECK((deviation.cwiseAbs() - 4 * error - curvature * mean).maxCoeff() < 0);
}

// A piecewise constant observer makes XYZ a weighted sum of bands exactly; the bands of one sample fall into the same
// cells as its XYZ whatever the density, dispersion or the number of bands.
TEST_CASE("bands times observer are XYZ to float rounding, with dispersion too", "[law]") {
    auto const scene = small_prism(24);
    RenderPlan const plan = make_plan(*scene);
    for (int count : {1, 2, 7, 16, 47}) {
        Bands const bands{visible_range, count};
        TabulatedShape x, y, z;
        for (int b = 0; b <= count; ++b) x.nm.push_back(bands.range.min_nm + b * bands.width_nm());
        y.nm = z.nm = x.nm;
        for (int b = 0; b < count; ++b) {
            x.value.push_back(0.1 + 0.02 * b);
            y.value.push_back(1 + 0.5 * (b % 3));
            z.value.push_back(2 - 0.03 * b);
        }
        x.step = y.step = z.step = true;
        auto const step = [](TabulatedShape const& t) { return SpectralFunction(t, Outside::zero); };
        Observer eye{"steps", step(x), step(y), step(z), 0};
        eye.ybar_integral = eye.ybar.integral(visible_range);
        Film film(24, 24, eye, scene->grid, bands);
        render(*scene, plan, *make_integrator("path", *scene, plan), {.spp = 16, .seed = 4}, film);
        for (int py = 0; py < 24; ++py)
            for (int px = 0; px < 24; ++px) {
                double X = 0, Y = 0, Z = 0, scale = bands.width_nm() / eye.ybar_integral;
                for (int b = 0; b < count; ++b) {
                    X += film.band(px, py, b) * x.value[static_cast<std::size_t>(b)] * scale;
                    Y += film.band(px, py, b) * y.value[static_cast<std::size_t>(b)] * scale;
                    Z += film.band(px, py, b) * z.value[static_cast<std::size_t>(b)] * scale;
                }
                Xyz const m = film.mean(px, py);
                REQUIRE(m.X == Approx(X).epsilon(2e-6).margin(1e-9));
                REQUIRE(m.Y == Approx(Y).epsilon(2e-6).margin(1e-9));
                REQUIRE(m.Z == Approx(Z).epsilon(2e-6).margin(1e-9));
            }
    }
}
