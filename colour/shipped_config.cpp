// SPDX-License-Identifier: Apache-2.0
#include "colour/shipped_config.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <vector>

#include "colour/rgb_space.h"

namespace iride {

namespace {

using Transforms = std::vector<std::string>;

constexpr char const* head = R"(# SPDX-License-Identifier: Apache-2.0
# Written by scripts/ocio_config.cpp from derived matrices; do not edit.
ocio_profile_version: 2

description: Iride - scene-linear ACES working space, CIE-managed displays, CIE spaces; no LUT files.
environment: {}
search_path: ""
strictparsing: true
)";

constexpr char const* roles_and_views = R"(
roles:
  aces_interchange: ACES2065-1
  cie_xyz_d65_interchange: CIE-XYZ-D65
  color_picking: sRGB - Texture
  color_timing: ACEScct
  compositing_log: ACEScct
  data: Raw
  default: ACEScg
  matte_paint: sRGB - Texture
  reference: ACES2065-1
  rendering: ACEScg
  scene_linear: ACEScg
  texture_paint: sRGB - Texture

file_rules:
  - !<Rule> {name: Default, colorspace: default}

shared_views:
  - !<View> {name: ACES SDR, view_transform: ACES 1.0 - SDR Video, display_colorspace: <USE_DISPLAY_NAME>}
  - !<View> {name: ACES SDR Cinema, view_transform: ACES 1.0 - SDR Cinema, display_colorspace: <USE_DISPLAY_NAME>}
  - !<View> {name: ACES HDR 1000 nit, view_transform: ACES 1.1 - HDR Video 1000 nit, display_colorspace: <USE_DISPLAY_NAME>}
  - !<View> {name: ACES HDR 2000 nit, view_transform: ACES 1.1 - HDR Video 2000 nit, display_colorspace: <USE_DISPLAY_NAME>}
  - !<View> {name: ACES HDR 4000 nit, view_transform: ACES 1.1 - HDR Video 4000 nit, display_colorspace: <USE_DISPLAY_NAME>}
  - !<View> {name: ACES HDR 1000 nit P3, view_transform: ACES 1.1 - HDR Video 1000 nit P3, display_colorspace: <USE_DISPLAY_NAME>}
  - !<View> {name: Un-tone-mapped, view_transform: Un-tone-mapped, display_colorspace: <USE_DISPLAY_NAME>}
  - !<View> {name: Raw, colorspace: Raw}

displays:
  sRGB:
    - !<Views> [ACES SDR, Un-tone-mapped, Raw]
  Display P3:
    - !<Views> [ACES SDR, Un-tone-mapped, Raw]
  Rec.1886 Rec.709:
    - !<Views> [ACES SDR, Un-tone-mapped, Raw]
  P3-D65:
    - !<Views> [ACES SDR, ACES SDR Cinema, Un-tone-mapped, Raw]
  Rec.2100 PQ:
    - !<Views> [ACES HDR 1000 nit, ACES HDR 2000 nit, ACES HDR 4000 nit, ACES HDR 1000 nit P3, Un-tone-mapped, Raw]
  Rec.2100 HLG:
    - !<Views> [ACES HDR 1000 nit, ACES HDR 1000 nit P3, Un-tone-mapped, Raw]

active_displays: [sRGB, Display P3, Rec.1886 Rec.709, P3-D65, Rec.2100 PQ, Rec.2100 HLG]
active_views: [ACES SDR, ACES SDR Cinema, ACES HDR 1000 nit, ACES HDR 2000 nit, ACES HDR 4000 nit, ACES HDR 1000 nit P3, Un-tone-mapped, Raw]

default_view_transform: Un-tone-mapped
)";

std::string numbers(std::vector<double> const& values) { return fmt::format("[{}]", fmt::join(values, ", ")); }

std::string matrix(MatrixDouble const& m, VectorDouble const& offset = VectorDouble::Zero()) {
    std::vector<double> rows;
    for (int i = 0; i < 3; ++i) rows.insert(rows.end(), {m(i, 0), m(i, 1), m(i, 2), 0});
    rows.insert(rows.end(), {0, 0, 0, 1});
    bool const moves = !offset.isZero(0);
    return fmt::format("!<MatrixTransform> {{matrix: {}{}}}", numbers(rows),
                       moves ? ", offset: " + numbers({offset[0], offset[1], offset[2], 0}) : "");
}

std::string builtin(std::string const& style, bool inverse = false) {
    return fmt::format("!<BuiltinTransform> {{style: {}{}}}", style, inverse ? ", direction: inverse" : "");
}

std::string const log2 = "!<LogTransform> {base: 2}", antilog2 = "!<LogTransform> {base: 2, direction: inverse}";

// Encoding with a linear piece; negative light goes on mirrored.
std::string monitor_curve(double gamma, double offset) {
    return fmt::format("!<ExponentWithLinearTransform> {{gamma: {}, offset: {}, style: mirror, direction: inverse}}",
                       gamma, offset);
}
std::string power(double gamma) {
    return fmt::format("!<ExponentTransform> {{value: {}, style: mirror, direction: inverse}}", gamma);
}

struct Space {
    std::string name, family, encoding, description, aliases;
    Transforms steps;  // from the reference space; none: it is the reference space
    bool linear = true;
};

std::string text(Space const& s, char const* direction) {
    std::string out = fmt::format(
        "\n  - !<ColorSpace>\n    name: {}\n    aliases: [{}]\n    family: {}\n    bitdepth: 32f\n"
        "    description: {}\n    isdata: {}\n",
        s.name, s.aliases, s.family, s.description, s.encoding == "data");
    if (s.encoding != "data") out += fmt::format("    encoding: {}\n", s.encoding);
    out += s.encoding == "scene-linear" ? "    allocation: lg2\n    allocationvars: [-8, 5, 0.00390625]\n"
                                        : "    allocation: uniform\n";
    if (s.steps.size() == 1) out += fmt::format("    {}: {}\n", direction, s.steps.front());
    if (s.steps.size() > 1) {
        out += fmt::format("    {}: !<GroupTransform>\n      children:\n", direction);
        for (std::string const& step : s.steps) out += fmt::format("        - {}\n", step);
    }
    return out;
}

std::string view_transform(char const* name, char const* description, char const* style) {
    return fmt::format("\n  - !<ViewTransform>\n    name: {}\n    description: {}\n    from_scene_reference: {}\n",
                       name, description, builtin(style));
}

std::string view_transforms() {
    std::string out = "\nview_transforms:";
    out += view_transform("ACES 1.0 - SDR Video", "ACES 1.0 output rendering for 100 cd/m^2 displays in a dim surround",
                          "ACES-OUTPUT - ACES2065-1_to_CIE-XYZ-D65 - SDR-VIDEO_1.0");
    out += view_transform("ACES 1.0 - SDR Cinema", "ACES 1.0 output rendering for projectors of 48 cd/m^2",
                          "ACES-OUTPUT - ACES2065-1_to_CIE-XYZ-D65 - SDR-CINEMA_1.0");
    for (int nits : {1000, 2000, 4000})
        out += view_transform(
            fmt::format("ACES 1.1 - HDR Video {} nit", nits).c_str(),
            fmt::format("ACES 1.1 output rendering for {} cd/m^2, grey at 15 cd/m^2, within Rec.2020", nits).c_str(),
            fmt::format("ACES-OUTPUT - ACES2065-1_to_CIE-XYZ-D65 - HDR-VIDEO-{}nit-15nit-REC2020lim_1.1", nits)
                .c_str());
    out += view_transform("ACES 1.1 - HDR Video 1000 nit P3",
                          "ACES 1.1 output rendering for 1000 cd/m^2, grey at 15 cd/m^2, within P3",
                          "ACES-OUTPUT - ACES2065-1_to_CIE-XYZ-D65 - HDR-VIDEO-1000nit-15nit-P3lim_1.1");
    out += view_transform("Un-tone-mapped", "Colorimetry as it is, adapted from the ACES white to D65 by Bradford",
                          "UTILITY - ACES-AP0_to_CIE-XYZ-D65_BFD");
    return out;
}

std::string display_spaces() {
    Transforms const display_p3{matrix(rgb::display_p3.from_xyz_matrix()), monitor_curve(2.4, 0.055)};
    std::vector<Space> const spaces{
        {"CIE-XYZ-D65",
         "Display",
         "display-linear",
         "CIE XYZ of a display whose white is D65 with Y = 1",
         "cie_xyz_d65, lin_ciexyzd65_display",
         {}},
        {"sRGB",
         "Display",
         "sdr-video",
         "IEC 61966-2-1",
         "srgb_display, srgb_rec709_display",
         {builtin("DISPLAY - CIE-XYZ-D65_to_sRGB")}},
        {"Display P3", "Display", "sdr-video", "P3 primaries with white D65 and the curve of sRGB",
         "displayp3_display, srgb_p3d65_display", display_p3},
        {"Rec.1886 Rec.709",
         "Display",
         "sdr-video",
         "ITU-R BT.709 primaries with the BT.1886 curve",
         "rec1886_rec709_display, g24_rec709_display",
         {builtin("DISPLAY - CIE-XYZ-D65_to_REC.1886-REC.709")}},
        {"P3-D65",
         "Display",
         "sdr-video",
         "P3 primaries with white D65, gamma 2.6",
         "p3d65_display, g26_p3d65_display",
         {builtin("DISPLAY - CIE-XYZ-D65_to_G2.6-P3-D65")}},
        {"Rec.2100 PQ",
         "Display",
         "hdr-video",
         "ITU-R BT.2100, perceptual quantiser; Y = 1 is 100 cd/m^2. OpenColorIO computes the curve by a table",
         "rec2100_pq_display, pq_rec2020_display",
         {builtin("DISPLAY - CIE-XYZ-D65_to_REC.2100-PQ")}},
        {"Rec.2100 HLG",
         "Display",
         "hdr-video",
         "ITU-R BT.2100, hybrid log-gamma on a display of 1000 cd/m^2; Y = 1 is 100 cd/m^2. OpenColorIO computes the "
         "curve by a table",
         "rec2100_hlg_display, hlg_rec2020_display",
         {builtin("DISPLAY - CIE-XYZ-D65_to_REC.2100-HLG-1000nit")}}};
    std::string out = "\ndisplay_colorspaces:";
    for (Space const& s : spaces) out += text(s, "from_display_reference");
    return out;
}

// From ACES2065-1, linear.
std::string to_linear(RgbSpace const& space) {
    RgbSpace const& aces = rgb::aces2065_1;
    return matrix(space.from_xyz_matrix() * bradford_adaptation(aces.white, space.white) * aces.to_xyz_matrix());
}

void add_rgb(std::vector<Space>& all) {
    std::string const linear = "scene-linear", texture = "sdr-video", adapted = "white D65 adapted by Bradford";
    all.insert(all.end(),
               {{"ACES2065-1", "ACES", linear, "SMPTE ST 2065-1, linear AP0", "aces2065_1, lin_ap0, lin_ap0_scene", {}},
                {"ACEScg",
                 "ACES",
                 linear,
                 "ACES S-2014-004, linear AP1",
                 "lin_ap1, lin_ap1_scene",
                 {builtin("ACEScg_to_ACES2065-1", true)}},
                {"ACEScc",
                 "ACES",
                 "log",
                 "ACES S-2014-003, logarithmic AP1; clips ACES2065-1 below 0 by definition",
                 "acescc_ap1_scene",
                 {builtin("ACEScc_to_ACES2065-1", true)}},
                {"ACEScct",
                 "ACES",
                 "log",
                 "ACES S-2016-001, logarithmic AP1",
                 "acescct_ap1, acescct_ap1_scene",
                 {builtin("ACEScct_to_ACES2065-1", true)}},
                {"Linear Rec.709 (sRGB)",
                 "Linear",
                 linear,
                 "Linear light, Rec.709 primaries, " + adapted,
                 "lin_rec709, lin_rec709_srgb, lin_rec709_scene",
                 {to_linear(rgb::rec709)}},
                {"Linear Rec.2020",
                 "Linear",
                 linear,
                 "Linear light, Rec.2020 primaries, " + adapted,
                 "lin_rec2020, lin_rec2020_scene",
                 {to_linear(rgb::rec2020)}},
                {"Linear P3-D65",
                 "Linear",
                 linear,
                 "Linear light, P3 primaries, " + adapted,
                 "lin_p3d65, lin_p3d65_scene",
                 {to_linear(rgb::display_p3)}},
                {"Linear AdobeRGB",
                 "Linear",
                 linear,
                 "Linear light, Adobe RGB (1998) primaries, " + adapted,
                 "lin_adobergb, lin_adobergb_scene",
                 {to_linear(rgb::adobe_rgb)}},
                {"sRGB - Texture",
                 "Texture",
                 texture,
                 "IEC 61966-2-1 encoded textures",
                 "srgb_tx, srgb_rec709_scene",
                 {to_linear(rgb::rec709), monitor_curve(2.4, 0.055)}},
                {"Display P3 - Texture",
                 "Texture",
                 texture,
                 "P3 primaries, white D65, curve of sRGB",
                 "p3d65_tx, srgb_p3d65_scene",
                 {to_linear(rgb::display_p3), monitor_curve(2.4, 0.055)}},
                {"AdobeRGB - Texture",
                 "Texture",
                 texture,
                 "Adobe RGB (1998), gamma 563/256",
                 "adobergb_tx, g22_adobergb_scene",
                 {to_linear(rgb::adobe_rgb), power(563.0 / 256)}},
                {"Camera Rec.2020",
                 "Texture",
                 texture,
                 "ITU-R BT.2020-2 camera curve, unrounded constants",
                 "rec2020_camera",
                 {to_linear(rgb::rec2020), monitor_curve(1 / 0.45, 0.09929682680944)}}});
}

// The CIE spaces under one white; `white` is its name.
void add_cie(std::vector<Space>& all, std::string const& name) {
    Chromaticity const white = named_white(name);
    VectorDouble const w = to_vector(to_xyz(white, 1));
    MatrixDouble const xyz = bradford_adaptation(rgb::aces2065_1.white, white) * rgb::aces2065_1.to_xyz_matrix();
    MatrixDouble tristimulus = MatrixDouble::Identity();
    tristimulus.row(2) << 1, 15, 3;
    VectorDouble const at_white = tristimulus * w;
    double const u = 4 * w[0] / at_white[2], v = 9 * w[1] / at_white[2];
    MatrixDouble const relative = at_white.cwiseInverse().asDiagonal() * tristimulus * xyz;
    MatrixDouble ratios, products, luv, lab;
    ratios << 1, 0, -1, 0, 1, -1, 0, 1, 0;
    products << 1, 0, 1, 0, 1, 1, 0, 0, 1;
    // A quarter of u'/u'n and v'/v'n: below 1 for every real colour, where gamma 1 is exactly the identity.
    luv << 0, 0, 100, 1300 * u * 4, 0, -1300 * u, 0, 1300 * v * 4, -1300 * v;
    lab << 0, 100, 0, 500 / 1.16, -500 / 1.16, 0, 0, 200 / 1.16, -200 / 1.16;
    VectorDouble const to_uv(std::log2(u), std::log2(v), 0), quarters(-2, -2, 0);
    std::string const L = "!<ExponentWithLinearTransform> {gamma: 3, offset: 0.16, direction: inverse}";
    std::string const L_third =
        "!<ExponentWithLinearTransform> {gamma: [1, 1, 3, 1], offset: [0, 0, 0.16, 0], direction: inverse}";
    std::string const of =
        fmt::format("white {} ({}, {}) with Y = 1, adapted from the ACES white by Bradford", name, white.x, white.y);
    std::string const positive = "; domain X, Y > 0 and X + 15Y + 3Z > 0, what is below counts as 0", key = name;
    all.push_back({fmt::format("CIE XYZ ({})", name),
                   "CIE",
                   "scene-linear",
                   "CIE XYZ, " + of,
                   fmt::format("cie_xyz_{}_scene{}", name, name == "D65" ? ", lin_ciexyzd65_scene" : ""),
                   {matrix(xyz)}});
    all.push_back({fmt::format("CIE uvY ({})", name),
                   "CIE",
                   "log",
                   "CIE 1976 u'v'Y, " + of + positive,
                   fmt::format("cie_uvY_{}", name),
                   {matrix(relative), log2, matrix(ratios, to_uv), antilog2}});
    all.push_back({fmt::format("CIE Luv ({})", name),
                   "CIE",
                   "log",
                   "CIE 1976 L*u*v*, " + of + positive,
                   fmt::format("cie_Luv_{}", name),
                   {matrix(relative), log2, matrix(ratios, quarters), antilog2, L_third, log2, matrix(products),
                    antilog2, matrix(luv)}});
    all.push_back({fmt::format("CIE Lab ({})", name),
                   "CIE",
                   "log",
                   "CIE 1976 L*a*b*, " + of + "; all XYZ",
                   fmt::format("cie_Lab_{}", name),
                   {matrix(w.cwiseInverse().asDiagonal() * xyz), L, matrix(lab)}});
}

}  // namespace

std::string shipped_config() {
    std::vector<Space> scene;
    add_rgb(scene);
    for (char const* white : {"D65", "D50", "E"}) add_cie(scene, white);
    scene.push_back({"Raw", "Utility", "data", "Numbers that are no colours", "data_raw", {}});
    VectorDouble const luma = rgb::rec709.to_xyz_matrix().row(1);
    std::string out = head + fmt::format("luma: {}\n", numbers({luma[0], luma[1], luma[2]})) + roles_and_views +
                      view_transforms() + display_spaces() + "\ncolorspaces:";
    for (Space const& s : scene) out += text(s, "from_scene_reference");
    return out;
}

}  // namespace iride
