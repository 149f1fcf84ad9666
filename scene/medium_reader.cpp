// SPDX-License-Identifier: Apache-2.0
// What fills a transparent body, as a scene file gives it: an index, and how it absorbs. All that absorbs is added up:
//   sigma_a = 4 pi k / lambda - ln(transmittance) / distance + absorption_per_m        [1/m]
// and what it scatters, in a body or all around.
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

// Whether what is stated lets as much light through as a transparent body must.
bool is_weak(SceneBuilder& b, Fields& f, Coefficient const& stated) {
    double strongest = 0, at_nm = 0;
    WavelengthRange const range = b.scene.wavelengths;
    for (double nm = range.min_nm; nm <= range.max_nm; ++nm)
        if (double const k = k_of(stated(nm), nm); !(k <= strongest)) strongest = k, at_nm = nm;
    if (strongest <= largest_transparent_k) return true;
    f.error_at(f.find("absorption") ? "absorption" : "absorption_per_m",
               fmt::format("found {:g} 1/m at {} nm, as much as k = {:g}, allowed for a transparent body: k of 0 "
                           ".. {}; a metal is a 'conductor'",
                           stated(at_nm), at_nm, strongest, largest_transparent_k));
    return false;
}

// In a medium without end a path is over when it is absorbed, and those of longest_path are dropped.
void refuse_endless_paths(SceneBuilder& b, Fields& f, Coefficient const& absorption, SpectralFunction const& sigma_s) {
    constexpr double largest_albedo = 0.998;  // of 10000 scatterings a share of 2e-9 survives
    if (b.scene.render.max_bounces) return;
    WavelengthRange const range = b.scene.wavelengths;
    for (double nm = range.min_nm; nm <= range.max_nm; ++nm) {
        double const s = sigma_s.at(nm), albedo = s > 0 ? s / (s + absorption(nm)) : 0;
        if (albedo <= largest_albedo) continue;
        return f.error(
            fmt::format("it fills all space and absorbs {:.3g} of what it takes out of a ray at {} nm: its "
                        "light would be scattered without end; allowed: {:g} or more by absorption, a "
                        "render.max_bounces, or a body that ends",
                        1 - albedo, nm, 1 - largest_albedo));
    }
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
    if (!index || !stated || !is_transparent(b, f, key, *index) || !is_weak(b, f, *stated)) return std::nullopt;
    return medium_of(b, *index, *stated);
}

std::optional<SpectralFunction> read_scattering(SceneBuilder& b, Fields& f, Medium& medium) {
    constexpr double steepest = 0.999;  // beyond, lobes are narrower than floats tell directions apart
    auto const g = f.number("asymmetry", between(-steepest, steepest));
    if (!f.find("scattering_per_m")) {
        if (g) f.error_at("asymmetry", "nothing scatters here without 'scattering_per_m'");
        return std::nullopt;
    }
    auto const sigma_s = read_spectrum(b, f, "scattering_per_m", absorption_kind);
    if (!sigma_s) return std::nullopt;
    medium.scatters = sigma_s->largest(b.scene.wavelengths) > 0;
    if (medium.scatters) medium.sigma_s = Absorption(*sigma_s, b.scene.grid);
    medium.asymmetry = static_cast<float>(g.value_or(0));
    return sigma_s;
}

void read_open_medium(SceneBuilder& b, Fields& top) {
    JsonValue const* const value = top.find("medium");
    if (!value) return;
    Fields f(b.context, *value, "medium");
    auto const stated = read_stated_absorption(b, f);
    if (stated && is_weak(b, f, *stated)) {
        Medium& medium = b.scene.open_medium = medium_of(b, {}, *stated);
        if (auto const sigma_s = read_scattering(b, f, medium)) refuse_endless_paths(b, f, *stated, *sigma_s);
    }
    f.finish();
}

}  // namespace iride
