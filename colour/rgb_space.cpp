// SPDX-License-Identifier: Apache-2.0
#include "colour/rgb_space.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <map>

#include "base/diagnostics.h"
#include "colour/illuminant.h"
#include "colour/rgb_encoding.h"
#include "colour/tristimulus.h"

namespace iride {

namespace {

constexpr Chromaticity d65{0.3127, 0.3290}, aces_white{0.32168, 0.33767};

}  // namespace

// Primaries and whites: SMPTE ST 2065-1 (AP0), ACES S-2014-004 (AP1), ITU-R BT.709, BT.2020, SMPTE RP 431-2 with D65,
// Adobe RGB (1998).
RgbSpace const rgb::aces2065_1{"ACES2065-1",      {0.7347, 0.2653}, {0.0, 1.0},
                               {0.0001, -0.0770}, aces_white,       "lin_ap0_scene"};
RgbSpace const rgb::acescg{"ACEScg", {0.713, 0.293}, {0.165, 0.830}, {0.128, 0.044}, aces_white, "lin_ap1_scene"};
RgbSpace const rgb::rec709{"Rec709", {0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}, d65, "lin_rec709_scene"};
RgbSpace const rgb::rec2020{"Rec2020", {0.708, 0.292}, {0.170, 0.797}, {0.131, 0.046}, d65, "lin_rec2020_scene"};
RgbSpace const rgb::display_p3{"DisplayP3", {0.680, 0.320}, {0.265, 0.690}, {0.150, 0.060}, d65, "lin_p3d65_scene"};
RgbSpace const rgb::adobe_rgb{"AdobeRGB", {0.64, 0.33}, {0.21, 0.71}, {0.15, 0.06}, d65, "lin_adobergb_scene"};

MatrixDouble RgbSpace::to_xyz_matrix() const {
    // Columns: the primaries' (x, y, z), scaled so that they add up to the white with Y = 1.
    MatrixDouble primaries;
    auto const column = [](Chromaticity const& c) { return VectorDouble(c.x, c.y, 1 - c.x - c.y); };
    primaries << column(red), column(green), column(blue);
    VectorDouble const scale = primaries.inverse() * to_vector(to_xyz(white, 1));
    return primaries * scale.asDiagonal();
}

MatrixDouble RgbSpace::from_xyz_matrix() const { return to_xyz_matrix().inverse(); }

Chromaticity named_white(std::string const& name) {
    // CIE 15:2018, table T.3 to four digits as RGB standards quote them; E by definition; ACES: TB-2018-001.
    static std::map<std::string, Chromaticity> const published{
        {"A", {0.4476, 0.4074}},   {"C", {0.3101, 0.3162}},   {"D50", {0.3457, 0.3585}}, {"D55", {0.3324, 0.3474}},
        {"D65", {0.3127, 0.3290}}, {"D75", {0.2990, 0.3149}}, {"E", {1.0 / 3, 1.0 / 3}}, {"ACES", aces_white}};
    if (auto const found = published.find(name); found != published.end()) return found->second;
    if (auto const colon = name.rfind(":table"); colon != std::string::npos && colon + 6 == name.size()) {
        return to_chromaticity(xyz_of_light(illuminant(name.substr(0, colon)), cie1931_2deg()));
    }
    std::vector<std::string> names;
    for (auto const& entry : published) names.push_back(entry.first);
    throw InputError({}, "", fmt::format("unknown white '{}'{}", name, suggestion(name, names)));
}

OutputSpace output_space(std::string const& name, Chromaticity const& scene_white) {
    if (name == "XYZ") return {name, MatrixDouble::Identity(), nullptr};
    std::vector<std::string> names{"XYZ"};
    for (RgbEncoding const& encoding : rgb_encodings()) {
        if (encoding.name == "sRGB") continue;
        names.emplace_back(encoding.name);
        RgbSpace const& space = *encoding.space;
        if (name == encoding.name)
            return {name, space.from_xyz_matrix() * bradford_adaptation(scene_white, space.white), &space};
    }
    throw InputError({}, "colourspace", fmt::format("unknown colour space '{}'{}", name, suggestion(name, names)));
}

}  // namespace iride
