// SPDX-License-Identifier: Apache-2.0
// iride material: reflectance by angle and wavelength, and colour by angle, of metals, glasses and materials of scenes;
// and how far approximations of Fresnel's equations are off.
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "app/command.h"
#include "app/material_colour.h"
#include "app/material_plot.h"
#include "app/plot.h"
#include "base/atomic_file.h"
#include "base/diagnostics.h"
#include "colour/difference.h"

namespace iride {

namespace {

struct Options {
    std::string name, illuminant = "D65", plot;
    std::vector<double> angles_deg, wavelengths_nm;
    bool json = false;
};

using Json = nlohmann::ordered_json;

// A colour needs the index over most of what the eye sees; what lies beyond has little weight and is held.
constexpr WavelengthRange needed_for_colour{450, 650};

std::vector<double> angles_of(Options const& o) {
    for (double const a : o.angles_deg)
        if (!(a >= 0 && a <= 90))
            throw InputError({}, "--angle", fmt::format("found {:g}, allowed: 0 .. 90 degrees from the normal", a));
    return o.angles_deg.empty() ? std::vector<double>{0, 15, 30, 45, 60, 75, 85, 90} : o.angles_deg;
}

std::vector<double> wavelengths_of(Options const& o, GivenMaterial const& m) {
    WavelengthRange const own = m.defined_on;
    for (double const nm : o.wavelengths_nm)
        if (!(nm >= own.min_nm && nm <= own.max_nm))
            throw InputError(
                {}, "--wavelength",
                fmt::format("found {:g} nm, but '{}' is given on {:g} .. {:g} nm", nm, m.name, own.min_nm, own.max_nm));
    if (!o.wavelengths_nm.empty()) return o.wavelengths_nm;
    std::vector<double> usual;
    for (double nm = 400; nm <= 700; nm += 50)
        if (nm >= own.min_nm && nm <= own.max_nm) usual.push_back(nm);
    return usual.empty() ? std::vector<double>{own.min_nm, own.max_nm} : usual;
}

// What is said of a material, on stdout in one form or the other.
struct Answer {
    GivenMaterial material;
    std::vector<double> angles_deg, wavelengths_nm;
    MaterialColorimetry const& colorimetry;
    bool has_colour;
};

Answer answer_of(GivenMaterial const& m, Options const& o, MaterialColorimetry const& colorimetry) {
    WavelengthRange const own = m.defined_on;
    Answer const answer{m, angles_of(o), wavelengths_of(o, m), colorimetry, own.contains(needed_for_colour)};
    if (!answer.has_colour)
        fmt::print(stderr, "iride: note: {} is given on {:g} .. {:g} nm: too little for a colour\n", m.name, own.min_nm,
                   own.max_nm);
    else if (!own.contains(visible_range))
        fmt::print(stderr, "iride: note: {} is given on {:g} .. {:g} nm: for its colour the end values are held\n",
                   m.name, own.min_nm, own.max_nm);
    return answer;
}

Json optional(std::optional<double> const& value) { return value ? Json(*value) : Json(); }
Json json_of(Xyz const& c) { return {c.X, c.Y, c.Z}; }
Json json_of(VectorDouble const& v) { return {v[0], v[1], v[2]}; }
Json json_of(std::optional<Chromaticity> const& c) { return c ? Json{c->x, c->y} : Json(); }

Json approximations_of(Answer const& a) {
    ApproximateColours const approximate(a.material, a.colorimetry);
    Json all = Json::array();
    for (double const angle : a.angles_deg) {
        Lab const exact = a.colorimetry.of(a.material, angle).lab;
        Json row{{"angle_deg", angle}};
        for (auto const& [key, title, colour] : approximate.at(angle))
            row[key] = {{"xy", json_of(colour.xy)},
                        {"linear_srgb", json_of(colour.linear_srgb)},
                        {"delta_e_2000", delta_e_2000(exact, colour.lab)}};
        all.push_back(row);
    }
    return {{"mean_normal_reflectance", approximate.mean_reflectance()}, {"colour", all}};
}

Json json_of(Answer const& a) {
    Json reflectance = Json::array(), colour = Json::array();
    for (double const angle : a.angles_deg) {
        for (double const nm : a.wavelengths_nm) {
            MaterialReflectance const r = reflectance_of(a.material, angle, nm);
            reflectance.push_back({{"angle_deg", angle},
                                   {"wavelength_nm", nm},
                                   {"n", optional(r.n)},
                                   {"k", optional(r.k)},
                                   {"Rs", optional(r.Rs)},
                                   {"Rp", optional(r.Rp)},
                                   {"R", r.R}});
        }
        if (!a.has_colour) continue;
        MaterialColour const c = a.colorimetry.of(a.material, angle);
        colour.push_back({{"angle_deg", angle},
                          {"XYZ", json_of(c.xyz)},
                          {"xy", json_of(c.xy)},
                          {"Lab", {c.lab.L, c.lab.a, c.lab.b}},
                          {"linear_srgb", json_of(c.linear_srgb)}});
    }
    return {{"name", a.material.name},
            {"source", a.material.source},
            {"reflectance", reflectance},
            {"colour", colour},
            {"approximations", a.has_colour && a.material.smooth() ? approximations_of(a) : Json()}};
}

std::string cell(std::optional<double> const& value) { return value ? fmt::format("{:9.5f}", *value) : "        -"; }

void print_text(Answer const& a, std::string const& illuminant) {
    fmt::print("{}: {}\n", a.material.name, a.material.source);
    fmt::print("  angle/deg  wavelength/nm         n         k        Rs        Rp         R\n");
    for (double const angle : a.angles_deg)
        for (double const nm : a.wavelengths_nm) {
            MaterialReflectance const r = reflectance_of(a.material, angle, nm);
            fmt::print("  {:9g}  {:13g} {} {} {} {} {}\n", angle, nm, cell(r.n), cell(r.k), cell(r.Rs), cell(r.Rp),
                       cell(r.R));
        }
    if (!a.has_colour) return;
    std::optional<ApproximateColours> approximate;
    if (a.material.smooth()) approximate.emplace(a.material, a.colorimetry);
    fmt::print("  under {}, cie1931_2deg; white: a mirror of reflectance 1{}\n", illuminant,
               approximate ? "; last: CIEDE2000 of the colour shift of 1982" : "");
    fmt::print(
        "  angle/deg         X        Y        Z         x        y        L*       a*       b*    linear sRGB\n");
    for (double const angle : a.angles_deg) {
        MaterialColour const c = a.colorimetry.of(a.material, angle);
        fmt::print(
            "  {:9g}  {:.6f} {:.6f} {:.6f}  {}  {:8.3f} {:8.3f} {:8.3f}  {:8.5f} {:8.5f} {:8.5f}{}\n", angle, c.xyz.X,
            c.xyz.Y, c.xyz.Z, c.xy ? fmt::format("{:.5f}  {:.5f}", c.xy->x, c.xy->y) : "      -        -", c.lab.L,
            c.lab.a, c.lab.b, c.linear_srgb[0], c.linear_srgb[1], c.linear_srgb[2],
            approximate ? fmt::format("  {:6.3f}", delta_e_2000(c.lab, approximate->at(angle).front().colour.lab))
                        : "");
    }
}

int run_material(Options const& o) {
    if (!o.plot.empty()) check_output("--plot", o.plot, ".png");
    MaterialColorimetry const colorimetry(o.illuminant);
    std::vector<GivenMaterial> const materials = given_materials(o.name);
    std::vector<Answer> answers;
    for (GivenMaterial const& m : materials) answers.push_back(answer_of(m, o, colorimetry));
    if (!o.plot.empty()) {
        if (answers.size() != 1)
            throw InputError({}, "--plot",
                             fmt::format("'{}' has {} materials: name one as '{}:{}'", o.name, answers.size(), o.name,
                                         materials.front().name));
        Answer const& a = answers.front();
        if (!a.has_colour) throw InputError({}, "--plot", fmt::format("'{}' has no colour", a.material.name));
        plot_material(a.material, colorimetry, a.angles_deg, o.illuminant, o.plot);
    }
    Json all = Json::array();
    for (Answer const& a : answers)
        if (o.json)
            all.push_back(json_of(a));
        else
            print_text(a, o.illuminant);
    if (o.json)
        fmt::print("{}\n", (all.size() == 1 ? all[0] : all).dump(-1, ' ', false, Json::error_handler_t::replace));
    return exit_done;
}

}  // namespace

Command add_material(CLI::App& app) {
    CLI::App* const parser = app.add_subcommand("material", "What a material reflects, and its colour, by angle");
    auto const o = std::make_shared<Options>();
    parser
        ->add_option("NAME", o->name,
                     "a shipped index of refraction (Au, Au:McPeak, N-BK7; data/README.md lists them), a file of n and "
                     "k, a scene file (.json) with all its materials, or one of them as FILE.json:MATERIAL")
        ->required();
    parser->add_option("--angle", o->angles_deg, "degrees from the normal, 0 .. 90, one or more");
    parser->add_option("--wavelength", o->wavelengths_nm, "nanometres, one or more");
    parser->add_option("--illuminant", o->illuminant, "light whose colour is shown: a name or a file")
        ->capture_default_str();
    parser->add_flag("--json", o->json, "print JSON: an object, or an array of them for a scene of several materials");
    parser->add_option("--plot", o->plot,
                       "PNG file: R against wavelength, the colour from 0 to 90 degrees as a polar strip, and how far "
                       "approximations are off");
    parser->footer(
        "Light comes from outside. Smooth metals, glasses and films are exact; of anything else R is the directional\n"
        "albedo of the renderer's own closure, to 1e-3, and Rs and Rp do not exist. XYZ and linear sRGB are those of "
        "a\n"
        "perfect mirror = 1 and not clamped.");
    return {parser, [o] { return run_material(*o); }};
}

}  // namespace iride
