// SPDX-License-Identifier: Apache-2.0
// Cameras and exposures, as a scene file gives them.
#include <fmt/format.h>

#include "colour/observer.h"
#include "scene/photographic_exposure.h"
#include "scene/readers.h"

namespace iride {

namespace {

using Projection = CameraSettings::Projection;

struct ProjectionName {
    char const* name;
    Projection projection;
};
constexpr std::array<ProjectionName, 7> projections{{
    {"perspective", Projection::perspective},
    {"orthographic", Projection::orthographic},
    {"oblique", Projection::oblique},
    {"equirectangular", Projection::equirectangular},
    {"cylindrical", Projection::cylindrical},
    {"fisheye-equidistant", Projection::fisheye_equidistant},
    {"fisheye-equisolid", Projection::fisheye_equisolid},
}};

Projection read_projection(Fields& f) {
    std::vector<std::string> names;
    for (ProjectionName const& p : projections) names.emplace_back(p.name);
    auto const type = f.choice("type", names);
    for (ProjectionName const& p : projections)
        if (type == p.name) return p.projection;
    return Projection::perspective;
}

void read_place(SceneBuilder& b, Fields& f, CameraSettings& c) {
    c.eye = b.placed_exactly(f.required_vector("eye"));
    c.target = b.placed_exactly(f.required_vector("target"));
    c.up = f.vector("up").value_or(VectorDouble(0, 1, 0));
    VectorDouble const forward = c.target - c.eye;
    constexpr double parallel = 1e-6;  // sine of the angle below which 'right' is rounding
    if (forward.norm() == 0)
        f.error("'eye' and 'target' are the same point");
    else if (!(forward.normalized().cross(c.up).norm() >= parallel))
        f.error_at("up", "'up' is parallel to the line of sight");
}

// Two keys that say the same in different ways: whether only one of them is there.
bool one_of(Fields& f, std::string const& key, std::string const& other) {
    if (!f.find(key) || !f.find(other)) return true;
    f.error_at(other, fmt::format("found together with '{}', allowed: one of them", key));
    return false;
}

std::array<double, 2> read_pair(Fields& f, std::string const& key, double largest) {
    auto const pair = f.numbers(key, 2);
    if (!pair) return {0, 0};
    for (double x : *pair)
        if (!(std::abs(x) <= largest))
            f.error_at(key, fmt::format("found {:g}, allowed: {:g} .. {:g}", x, -largest, largest));
    return {(*pair)[0], (*pair)[1]};
}

// From "field_deg", or a sensor behind a lens that is focused far away: tan(field / 2) = height / (2 focal length).
void read_field(Fields& f, CameraSettings& c) {
    constexpr double millimetre = 1e-3;
    if (auto const length = f.number("focal_length_mm", positive())) c.focal_length = *length * millimetre;
    auto const height = f.number("sensor_height_mm", positive());
    one_of(f, "field_deg", "sensor_height_mm");
    if (!height) {
        c.field_deg = f.required_number("field_deg", {.least = 0, .most = 179, .least_excluded = true});
    } else if (c.focal_length > 0) {
        c.field_deg = 2 * std::atan(*height * millimetre / (2 * c.focal_length)) / radians(1);
    } else {
        f.require("focal_length_mm");
    }
}

void read_aperture(SceneBuilder& b, Fields& f, CameraSettings& c) {
    constexpr int most_blades = 64;
    c.aperture_radius = f.number("aperture_radius", at_least(0)).value_or(0) * b.length_unit_m;
    one_of(f, "aperture_radius", "f_number");
    if (auto const n = f.number("f_number", positive())) {
        c.f_number = *n;
        if (c.focal_length > 0)
            c.aperture_radius = c.focal_length / (2 * *n);
        else
            f.require("focal_length_mm");
    }
    c.blades = f.integer("blades", 3, most_blades).value_or(0);
    c.blade_rotation_deg = f.number("blade_rotation_deg", between(-360, 360)).value_or(0);
    if (f.find("blade_rotation_deg") && !f.find("blades"))
        f.error_at("blade_rotation_deg", "a round aperture does not turn: it needs 'blades'");
}

void read_focus(SceneBuilder& b, Fields& f, CameraSettings& c) {
    constexpr double steepest_deg = 89;
    auto const focus = f.number("focus_distance", positive());
    c.focus_distance = focus ? *focus * b.length_unit_m : (c.target - c.eye).norm();
    c.focus_tilt_deg = read_pair(f, "focus_tilt_deg", steepest_deg);
    c.lens_tilt_deg = read_pair(f, "lens_tilt_deg", steepest_deg);
    for (char const* key : {"focus_tilt_deg", "lens_tilt_deg"})
        if (f.find(key) && c.aperture_radius == 0)
            f.error_at(key, "a pinhole is sharp everywhere: it needs 'aperture_radius' or 'f_number'");
    if (!one_of(f, "focus_tilt_deg", "lens_tilt_deg") || !f.find("lens_tilt_deg")) return;
    if (c.focal_length == 0) {
        f.require("focal_length_mm");
        return;
    }
    double const along_lens =
        c.focus_distance * std::cos(radians(c.lens_tilt_deg[0])) * std::cos(radians(c.lens_tilt_deg[1]));
    if (!(along_lens > c.focal_length))
        f.error_at("lens_tilt_deg", fmt::format("the point in focus is {:g} m before the lens, nearer than its focal "
                                                "length, {:g} m: nothing there has an image",
                                                along_lens, c.focal_length));
}

void read_perspective(SceneBuilder& b, Fields& f, CameraSettings& c) {
    constexpr double furthest_shift = 100;  // picture heights
    read_field(f, c);
    read_aperture(b, f, c);
    read_focus(b, f, c);
    c.shift = read_pair(f, "shift", furthest_shift);
}

}  // namespace

void read_camera(SceneBuilder& b, Fields& top) {
    JsonValue const* const value = top.require("camera");
    if (!value) return;
    Fields f(b.context, *value, "camera");
    CameraSettings& c = b.scene.camera;
    c.projection = read_projection(f);
    read_place(b, f, c);
    switch (c.projection) {
        case Projection::perspective:
            read_perspective(b, f, c);
            break;
        case Projection::oblique:
            c.receding_scale = f.number("receding_scale", between(0, 100)).value_or(c.receding_scale);
            c.receding_angle_deg = f.number("receding_angle_deg", between(-360, 360)).value_or(c.receding_angle_deg);
            [[fallthrough]];
        case Projection::orthographic:
            c.window = f.required_number("window", positive()) * b.length_unit_m;
            break;
        case Projection::equirectangular:
            break;
        case Projection::cylindrical:
        case Projection::fisheye_equidistant:
        case Projection::fisheye_equisolid:
            c.field_deg = f.number("field_deg", {.least = 0, .most = 360, .least_excluded = true})
                              .value_or(c.projection == Projection::cylindrical ? 360 : 180);
            break;
    }
    f.finish();
}

double read_exposure(SceneBuilder& b, Fields& film) {
    double const exposure = film.number("exposure", positive()).value_or(1);
    JsonValue const* const value = film.find("photograph");
    if (!value) return exposure;
    one_of(film, "exposure", "photograph");
    Fields f(b.context, *value, film.path("photograph"));
    Photograph p{f.required_number("iso", positive()), f.required_number("shutter_s", positive()),
                 b.scene.camera.f_number};
    if (p.f_number == 0)
        p.f_number = f.required_number("f_number", positive());
    else if (f.find("f_number"))
        f.error_at("f_number", "the camera has one already, allowed: one of them");
    f.finish();
    return p.signal(luminance_of_unit_Y(cie1931_2deg()));
}

}  // namespace iride
