// SPDX-License-Identifier: Apache-2.0
// What fills a transparent body, as a scene file gives it: an index, and how it absorbs. All that absorbs is added up:
//   sigma_a = 4 pi k / lambda - ln(transmittance) / distance + absorption_per_m        [1/m]
#include <fmt/format.h>

#include <cmath>

#include "scene/material_readers.h"

namespace iride {

namespace {

double k_of(double sigma_a, double nm) { return sigma_a * nm * 1e-9 / (4 * pi_double); }
double sigma_a_of(double k, double nm) { return 4 * pi_double * k / (nm * 1e-9); }

using Coefficient = std::function<double(double nm)>;  // 1/m

// The colour at a distance; nothing after an error.
std::optional<Coefficient> read_colour_at_distance(SceneBuilder& b, Fields& f) {
    Fields colour(b.context, *f.find("absorption"), f.path("absorption"));
    auto const transmittance = read_spectrum(b, colour, "transmittance", transmittance_kind);
    double const distance = colour.required_number("distance", positive()) * b.length_unit_m;
    colour.finish();
    if (!transmittance) return std::nullopt;
    if (!(transmittance->smallest(b.scene.wavelengths) > 0)) {
        colour.error_at(
            "transmittance",
            "found 0 in the render range, allowed: above 0 .. 1: nothing that absorbs lets no light through");
        return std::nullopt;
    }
    return [=](double nm) { return -std::log(std::min(1.0, transmittance->at(nm))) / distance; };
}

std::optional<Coefficient> read_stated_absorption(SceneBuilder& b, Fields& f) {
    bool const colour = f.find("absorption"), coefficient = f.find("absorption_per_m");
    if (colour && coefficient) {
        f.error_at("absorption_per_m", "found together with 'absorption', allowed: one of them");
        return std::nullopt;
    }
    if (colour) return read_colour_at_distance(b, f);
    if (!coefficient) return [](double) { return 0.0; };
    auto const sigma_a = read_spectrum(b, f, "absorption_per_m", absorption_kind);
    if (!sigma_a) return std::nullopt;
    return [=](double nm) { return sigma_a->at(nm); };
}

bool is_transparent(SceneBuilder& b, Fields& f, std::string const& key, ComplexIndex const& index) {
    double const k = index.k.largest(b.scene.wavelengths);
    if (k <= largest_transparent_k) return true;
    f.error_at(key, fmt::format("found k up to {:g}, allowed for a transparent body: 0 .. {}; a metal is a 'conductor'",
                                k, largest_transparent_k));
    return false;
}

Medium medium_of(SceneBuilder& b, ComplexIndex const& index, Coefficient const& stated) {
    TabulatedShape sigma_a;
    for (int i = 0; i < b.scene.grid.count; ++i) {
        sigma_a.nm.push_back(b.scene.grid.first_nm + i);
        double const nm = std::clamp(sigma_a.nm.back(), b.scene.wavelengths.min_nm, b.scene.wavelengths.max_nm);
        sigma_a.value.push_back(stated(nm) + sigma_a_of(index.k.at(nm), nm));
    }
    bool const absorbs = std::ranges::any_of(sigma_a.value, [](double a) { return a > 0; });
    Medium medium{Index(index.n, b.scene.grid)};
    if (absorbs) medium.sigma_a = Absorption(SpectralFunction(std::move(sigma_a), Outside::hold), b.scene.grid);
    medium.absorbs = absorbs;
    medium.index = index;
    return medium;
}

}  // namespace

std::optional<Medium> read_medium_of_index(SceneBuilder& b, Fields& f, std::string const& key) {
    auto const index = read_complex_index(b, f, key);
    if (!index || !is_transparent(b, f, key, *index)) return std::nullopt;
    return medium_of(b, *index, [](double) { return 0.0; });
}

std::optional<Medium> read_medium(SceneBuilder& b, Fields& f, std::string const& key) {
    auto const index = read_complex_index(b, f, key);
    auto const stated = read_stated_absorption(b, f);
    if (!index || !stated || !is_transparent(b, f, key, *index)) return std::nullopt;
    double strongest = 0, at_nm = 0;
    WavelengthRange const range = b.scene.wavelengths;
    for (double nm = range.min_nm; nm <= range.max_nm; ++nm)
        if (double const k = k_of((*stated)(nm), nm); !(k <= strongest)) strongest = k, at_nm = nm;
    if (!(strongest <= largest_transparent_k)) {
        f.error_at(f.find("absorption") ? "absorption" : "absorption_per_m",
                   fmt::format("found {:g} 1/m at {} nm, as much as k = {:g}, allowed for a transparent body: k of 0 "
                               ".. {}; a metal is a 'conductor'",
                               (*stated)(at_nm), at_nm, strongest, largest_transparent_k));
        return std::nullopt;
    }
    return medium_of(b, *index, *stated);
}

}  // namespace iride
