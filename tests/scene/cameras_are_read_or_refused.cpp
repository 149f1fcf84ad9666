// SPDX-License-Identifier: Apache-2.0
// Cameras and exposures of scene files: what they say in other words is the same, and what cannot be is refused.
#include <fmt/format.h>

#include <catch2/catch.hpp>

#include "support/scenes.h"

using namespace iride;
using Catch::Matchers::Contains;

namespace {

std::string scene_text(std::string const& camera, std::string const& film = "") {
    return fmt::format(R"({{ "camera": {{ "eye": [0,0,-5], "target": [0,0,0]{} }}, "film": {{ "size": [4,4]{} }},
                            "lights": [ {{ "type": "environment", "radiance": 1 }} ] }})",
                       camera, film);
}
std::string refusal(std::string const& camera, std::string const& film = "") {
    try {
        test::scene_from(scene_text(camera, film));
    } catch (InputError const& e) {
        return e.what();
    }
    return "(accepted)";
}
std::string const plain = R"(, "field_deg": 40)";
std::string const reflex = R"(, "focal_length_mm": 50, "sensor_height_mm": 24)";

}  // namespace

TEST_CASE("a sensor and a focal length are a field, and an f-number an aperture", "[unit]") {
    CameraSettings const c = test::scene_from(scene_text(reflex + R"(, "f_number": 2)"))->camera;
    CHECK(std::tan(radians(c.field_deg) / 2) == Approx(12. / 50).epsilon(1e-12));
    CHECK(c.aperture_radius == Approx(.0125).epsilon(1e-12));
    CHECK(c.focus_distance == Approx(5).epsilon(1e-12));
}

// Y = 1 is 683 lm/W times the integral of ybar, 106.8569 nm. H = pi / 4 L t / N^2, full at 78 / S. An evenly bright sky
// is full at L = 78 N^2 4 / (pi S t): what the file then says white is.
TEST_CASE("exposure by speed, time and f-number fills the sensor at 78 over S", "[law]") {
    std::string const photograph = R"(, "photograph": { "iso": 100, "shutter_s": 0.008, "f_number": 16 })";
    auto const scene = test::scene_from(scene_text(plain, photograph));
    double const luminance = 683 * 106.8569, H = pi_double / 4 * luminance * .008 / 256;
    CHECK(scene->film.exposure == Approx(H * 100 / 78).epsilon(1e-5));
    CHECK(luminance / scene->film.exposure == Approx(78. * 256 * 4 / (pi_double * 100 * .008)).epsilon(1e-5));
    Film const film = test::rendered(*scene, "path", {.spp = 4, .seed = 1});
    CHECK(film.mean(1, 1).Y * scene->film.exposure == Approx(H * 100 / 78).epsilon(.02));
    // With the camera's own f-number.
    auto const same = test::scene_from(
        scene_text(reflex + R"(, "f_number": 16)", R"(, "photograph": { "iso": 100, "shutter_s": 0.008 })"));
    CHECK(same->film.exposure == Approx(scene->film.exposure).epsilon(1e-12));
}

TEST_CASE("contradictory or impossible cameras are refused", "[input]") {
    CHECK_THAT(refusal(R"(, "type": "obliqe", "window": 1)"), Contains("'oblique'"));
    CHECK_THAT(refusal(plain + reflex), Contains("camera.sensor_height_mm: found together with 'field_deg'"));
    CHECK_THAT(refusal(R"(, "sensor_height_mm": 24)"), Contains("focal_length_mm"));
    CHECK_THAT(refusal(plain + R"(, "f_number": 2)"), Contains("focal_length_mm"));
    CHECK_THAT(refusal(reflex + R"(, "f_number": 2, "aperture_radius": 0.1)"),
               Contains("camera.f_number: found together with 'aperture_radius'"));
    CHECK_THAT(refusal(plain + R"(, "aperture_radius": 0.1, "blades": 2)"), Contains("camera.blades"));
    CHECK_THAT(refusal(plain + R"(, "aperture_radius": 0.1, "blade_rotation_deg": 2)"), Contains("needs 'blades'"));
    CHECK_THAT(refusal(plain + R"(, "focus_tilt_deg": [10, 0])"), Contains("a pinhole is sharp everywhere"));
    CHECK_THAT(refusal(plain + R"(, "aperture_radius": 0.1, "focus_tilt_deg": [90, 0])"), Contains("-89 .. 89"));
    CHECK_THAT(refusal(plain + R"(, "aperture_radius": 0.1, "lens_tilt_deg": [9, 0])"), Contains("focal_length_mm"));
    CHECK_THAT(refusal(reflex + R"(, "f_number": 2, "lens_tilt_deg": [9, 0], "focus_tilt_deg": [9, 0])"),
               Contains("found together"));
    CHECK_THAT(refusal(reflex + R"(, "f_number": 2, "lens_tilt_deg": [9, 0], "focus_distance": 0.05)"),
               Contains("nearer than its focal length"));
    CHECK_THAT(refusal(R"(, "type": "equirectangular", "field_deg": 90)"), Contains("field_deg"));
    CHECK_THAT(refusal(R"(, "type": "fisheye-equisolid", "field_deg": 400)"), Contains("360"));
    CHECK_THAT(refusal(R"(, "type": "oblique", "window": 1, "receding_scale": -1)"), Contains("0 .. 100"));
    CHECK(refusal(R"(, "type": "fisheye-equidistant")") == "(accepted)");
}
TEST_CASE("contradictory or impossible exposures are refused", "[input]") {
    std::string const full = R"("iso": 100, "shutter_s": 0.01)";
    CHECK_THAT(refusal(plain, R"(, "exposure": 2, "photograph": { "iso": 100, "shutter_s": 1, "f_number": 8 })"),
               Contains("film.photograph: found together with 'exposure'"));
    CHECK_THAT(refusal(plain, ", \"photograph\": { " + full + " }"), Contains("f_number"));
    CHECK_THAT(refusal(reflex + R"(, "f_number": 2)", ", \"photograph\": { " + full + R"(, "f_number": 4 })"),
               Contains("the camera has one already"));
    CHECK_THAT(refusal(plain, R"(, "photograph": { "iso": -1, "shutter_s": 1, "f_number": 8 })"), Contains("iso"));
}
