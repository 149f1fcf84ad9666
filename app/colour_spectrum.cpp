// SPDX-License-Identifier: Apache-2.0
// iride colour spectrum: what colorimetry says about spectra; and their plot, value against wavelength.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/colour.h"
#include "app/given_spectra.h"
#include "app/palette.h"
#include "base/atomic_file.h"
#include "base/diagnostics.h"
#include "colour/description.h"
#include "colour/illuminant.h"

namespace iride {

namespace {

struct Options {
    std::vector<std::string> names;
    std::string illuminant = "D65", observer = "cie1931_2deg", quantity, plot;
    bool json = false, astm = false;
};

using Json = nlohmann::ordered_json;

Json optional(std::optional<double> const& value) { return value ? Json(*value) : Json(); }

// A temperature means nothing far from the locus: absent there, with its Duv.
std::optional<CorrelatedTemperature> temperature_of(ColourDescription const& d) {
    if (!d.cct_K || !d.duv) return {};
    CorrelatedTemperature const t{*d.cct_K, *d.duv};
    return t.is_meaningful() ? std::optional(t) : std::nullopt;
}

Json json_of(GivenSpectrum const& s, ColourDescription const& d, Options const& o) {
    auto const t = temperature_of(d);
    return {{"name", s.function.name()},
            {"quantity", s.quantity},
            {"illuminant", o.illuminant},
            {"observer", o.observer},
            {"XYZ", {d.xyz.X, d.xyz.Y, d.xyz.Z}},
            {"xy", d.xy ? Json{d.xy->x, d.xy->y} : Json()},
            {"uv_prime", d.uv_prime ? Json{d.uv_prime->u, d.uv_prime->v} : Json()},
            {"Luv", {d.luv.L, d.luv.u, d.luv.v}},
            {"Lab", {d.lab.L, d.lab.a, d.lab.b}},
            {"dominant_wavelength_nm", optional(d.dominant_wavelength_nm)},
            {"complementary_wavelength_nm", optional(d.complementary_wavelength_nm)},
            {"excitation_purity", d.excitation_purity},
            {"cct_K", t ? Json(t->cct_K) : Json()},
            {"duv", t ? Json(t->duv) : Json()}};
}

std::string words(std::optional<double> const& value, char const* unit) {
    return value ? fmt::format("{:.2f} {}", *value, unit) : "none";
}

void print_text(GivenSpectrum const& s, ColourDescription const& d, Options const& o) {
    if (s.is_light)
        fmt::print("{}: a light, {}\n", s.function.name(), o.observer);
    else
        fmt::print("{}: {} under {}, {}\n", s.function.name(), s.quantity, o.illuminant, o.observer);
    fmt::print("  XYZ                     {:.4f} {:.4f} {:.4f}\n", d.xyz.X, d.xyz.Y, d.xyz.Z);
    if (d.xy) fmt::print("  xy                      {:.5f} {:.5f}\n", d.xy->x, d.xy->y);
    if (d.uv_prime) fmt::print("  u'v'                    {:.5f} {:.5f}\n", d.uv_prime->u, d.uv_prime->v);
    fmt::print("  L*u*v*                  {:.3f} {:.3f} {:.3f}\n", d.luv.L, d.luv.u, d.luv.v);
    fmt::print("  L*a*b*                  {:.3f} {:.3f} {:.3f}\n", d.lab.L, d.lab.a, d.lab.b);
    fmt::print("  dominant wavelength     {}\n", words(d.dominant_wavelength_nm, "nm"));
    fmt::print("  complementary           {}\n", words(d.complementary_wavelength_nm, "nm"));
    fmt::print("  excitation purity       {:.4f}\n", d.excitation_purity);
    if (auto const t = temperature_of(d))
        fmt::print("  correlated temperature  {:.1f} K, Duv {:+.5f}\n", t->cct_K, t->duv);
    else
        fmt::print("  correlated temperature  none\n");
}

void check_finite(GivenSpectrum const& s, ColourDescription const& d) {
    for (double const v : {d.xyz.X, d.xyz.Y, d.xyz.Z, d.luv.L, d.luv.u, d.luv.v, d.lab.L, d.lab.a, d.lab.b})
        if (!std::isfinite(v)) throw InputError({}, s.function.name(), "values too large or too small for a colour");
}

std::vector<PlotPoint> curve_of(GivenSpectrum const& s, WavelengthRange const& shown) {
    double const scale = s.is_light ? 1 / s.function.largest(shown) : 1;
    WavelengthRange const own = s.function.defined_on();
    double const from = std::max(own.min_nm, shown.min_nm), to = std::min(own.max_nm, shown.max_nm);
    std::vector<PlotPoint> points;
    constexpr double step_nm = 0.5;
    for (double nm = from; nm < to; nm += step_nm) points.push_back({nm, scale * s.function.at(nm)});
    points.push_back({to, scale * s.function.at(to)});
    return points;
}

void plot(std::vector<GivenSpectrum> const& spectra, std::string const& file) {
    constexpr WavelengthRange shown{360, 830};
    bool const lights = std::ranges::any_of(spectra, &GivenSpectrum::is_light);
    bool const objects = std::ranges::any_of(spectra, [](GivenSpectrum const& s) { return !s.is_light; });
    std::string const title = !lights    ? "Reflectance or transmittance"
                              : !objects ? "Power relative to its largest"
                                         : "Reflectance, or power relative to its largest";
    double most = 1;
    std::size_t longest = 0;
    for (GivenSpectrum const& s : spectra) {
        longest = std::max(longest, s.function.name().size());
        if (!s.is_light) most = std::max(most, s.function.largest(shown));
    }
    constexpr double letter_px = 14, beside_px = 140;
    Plot page(1400, 900, {shown.min_nm, shown.max_nm, 50, "Wavelength / nm"}, {0, most * 1.02, 0.1, title},
              static_cast<int>(beside_px + letter_px * static_cast<double>(longest)));
    for (std::size_t i = 0; i < spectra.size(); ++i)
        page.line(curve_of(spectra[i], shown),
                  {line_palette[i % line_palette.size()], i < 2 * line_palette.size() ? 3.0 : 1.5,
                   i / line_palette.size() % 2 == 1, spectra[i].function.name()});
    page.legend();
    page.write(file);
}

int run_spectrum(Options const& o) {
    if (!o.plot.empty()) check_output("--plot", o.plot, ".png");
    ColourDescriber const describer(illuminant(o.illuminant), observer(o.observer));
    std::vector<GivenSpectrum> const spectra = given_spectra(o.names, o.quantity);
    std::vector<ColourDescription> descriptions;
    auto const between = o.astm ? ColourDescriber::Between::astm : ColourDescriber::Between::linear;
    for (GivenSpectrum const& s : spectra) {
        descriptions.push_back(s.is_light ? describer.of_light(s.function) : describer.of_object(s.function, between));
        check_finite(s, descriptions.back());
    }
    if (!o.plot.empty()) plot(spectra, o.plot);
    Json all = Json::array();
    for (std::size_t i = 0; i < spectra.size(); ++i)
        if (o.json)
            all.push_back(json_of(spectra[i], descriptions[i], o));
        else
            print_text(spectra[i], descriptions[i], o);
    if (o.json)
        fmt::print("{}\n", (all.size() == 1 ? all[0] : all).dump(-1, ' ', false, Json::error_handler_t::replace));
    return exit_done;
}

}  // namespace

Command add_colour_spectrum(CLI::App& colour) {
    CLI::App* const parser = colour.add_subcommand("spectrum", "What colorimetry says about spectra");
    auto const o = std::make_shared<Options>();
    parser
        ->add_option(
            "NAME", o->names,
            "shipped spectra or groups (D65, colorchecker:red, colorchecker), blackbody:KELVIN, daylight:KELVIN, "
            "files (.csv, .spd, CGATS, refractiveindex.info), FILE:COLUMN; of an n + ik (Au) the reflectance at normal "
            "incidence")
        ->required();
    parser->add_option("--illuminant", o->illuminant, "light on reflectances, and the white: a name or a file")
        ->capture_default_str();
    parser->add_option("--observer", o->observer, fmt::format("one of {}", fmt::join(observer_names(), " ")))
        ->capture_default_str();
    parser->add_option(
        "--quantity", o->quantity,
        "power, reflectance or transmittance, if a file does not say it (.spd: power; else reflectance)");
    parser->add_flag("--astm", o->astm,
                     "weigh reflectances at 5, 10 or 20 nm by ASTM E2022 (else linear between points)");
    parser->add_flag("--json", o->json, "print JSON: an object, or an array of them for several spectra");
    parser->add_option("--plot", o->plot, "PNG file to draw the spectra to");
    parser->footer(
        "Y = 100 for the perfect diffuser or the light itself. What a colour does not have is 'none', or null in "
        "JSON.");
    return {parser, [o] { return run_spectrum(*o); }};
}

}  // namespace iride
