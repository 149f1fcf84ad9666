// SPDX-License-Identifier: Apache-2.0
#include "colour/rgb_to_spectrum.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <map>
#include <mutex>

#include "base/diagnostics.h"
#include "colour/lab.h"
#include "colour/sigmoid_fit.h"
#include "spectral/catalogue.h"

namespace iride {

namespace {

constexpr double reachable_difference = 1e-3;  // CIE 1976: below what any eye or 8-bit picture tells
constexpr double rounding = 1e-12;             // relative, of components that came through matrices
constexpr int most_doublings = 4;              // of the scale of a saturated emission

// What a white needs to make spectra; made once, kept for the program's life.
struct Uplift {
    SpectralFunction light;
    SigmoidFitter fitter;
};

SpectralFunction daylight_of(Chromaticity const& white) {
    SpectrumFile const file = read_spectrum_file(data_folder() / "cie" / "daylight_basis.csv");
    std::array<std::vector<double> const*, 3> const basis{&file.column.at("S0"), &file.column.at("S1"),
                                                          &file.column.at("S2")};
    MatrixDouble xyz;
    for (std::size_t k = 0; k < 3; ++k)
        xyz.col(static_cast<Eigen::Index>(k)) = to_vector(
            cie1931_2deg().integrate(SpectralFunction(TabulatedShape{file.wavelength_nm, *basis[k]}, Outside::zero)));
    // X = x (X + Y + Z) and Y = y (X + Y + Z) are linear in M1 and M2.
    Eigen::RowVector3d const sum = xyz.colwise().sum();
    Eigen::Matrix<double, 2, 3> rows;
    rows << xyz.row(0) - white.x * sum, xyz.row(1) - white.y * sum;
    Eigen::Vector2d const M = -rows.rightCols<2>().inverse() * rows.col(0);
    TabulatedShape table{file.wavelength_nm, {}};
    bool negative = false;
    for (std::size_t i = 0; i < file.wavelength_nm.size(); ++i) {
        table.value.push_back((*basis[0])[i] + M[0] * (*basis[1])[i] + M[1] * (*basis[2])[i]);
        negative = negative || !(table.value.back() >= 0);
    }
    if (negative) throw InputError({}, "", fmt::format("no daylight has the white ({}, {})", white.x, white.y));
    return luminance_weighted(SpectralFunction(std::move(table), Outside::zero, "daylight"), 1, cie1931_2deg());
}

Uplift const& uplift_under(Chromaticity const& white) {
    static std::map<std::pair<double, double>, Uplift> made;
    static std::mutex guard;
    std::lock_guard const lock(guard);
    auto const found = made.find({white.x, white.y});
    if (found != made.end()) return found->second;
    SpectralFunction light = white == named_white("D65") ? unit_d65() : daylight_of(white);
    SigmoidFitter const fitter(light, cie1931_2deg());
    return made.emplace(std::pair(white.x, white.y), Uplift{std::move(light), fitter}).first->second;
}

double lab_difference(VectorDouble const& a, VectorDouble const& b) {
    Lab const p = to_lab(to_xyz(a), {1, 1, 1}), q = to_lab(to_xyz(b), {1, 1, 1});
    return std::hypot(p.L - q.L, p.a - q.a, p.b - q.b);
}

[[noreturn]] void unreachable(Eigen::Vector3d const& rgb, Eigen::Vector3d const& nearest, double difference,
                              RgbSpace const& space, RgbRole role) {
    throw InputError(
        {}, "",
        fmt::format("no smooth {} has the colour ({:.4g}, {:.4g}, {:.4g}) of linear {}; the nearest found is "
                    "({:.4g}, {:.4g}, {:.4g}), CIE 1976 difference {:.3g}",
                    role == RgbRole::reflectance ? "reflectance" : "spectrum", rgb[0], rgb[1], rgb[2], space.name,
                    nearest[0], nearest[1], nearest[2], difference));
}

// s S(c / s) for the first s that serves; of a reflectance, s = 1 alone.
SpectralFunction fitted(Eigen::Vector3d const& rgb, RgbSpace const& space, RgbRole role) {
    SigmoidFitter const& fitter = uplift_under(space.white).fitter;
    MatrixDouble const matrix = space.to_xyz_matrix();
    VectorDouble const white = to_vector(to_xyz(space.white, 1)), ratio = (matrix * rgb).cwiseQuotient(white);
    bool const bounded = role == RgbRole::reflectance;
    double const brightness = bounded ? 1 : 2 * std::max(rgb.cwiseAbs().maxCoeff(), 1e-300);
    double scale = brightness;
    for (int doublings = 0; doublings <= (bounded ? 0 : most_doublings); ++doublings) {
        scale = std::ldexp(brightness, doublings);
        SigmoidFit const fit = fitter.fit(ratio / scale);
        if (lab_difference(scale / brightness * fit.colour, ratio / brightness) < reachable_difference)
            return SpectralFunction(fit.sigmoid, Outside::extrapolate, "rgb").scaled(scale);
    }
    VectorDouble const colour = scale * fitter.nearest(ratio / scale).colour;
    unreachable(rgb, matrix.inverse() * colour.cwiseProduct(white),
                lab_difference(colour / brightness, ratio / brightness), space, role);
}

}  // namespace

SpectralFunction const& unit_d65() {
    static SpectralFunction const light =
        luminance_weighted(load_spectrum("D65", SpectralQuantity::power), 1, cie1931_2deg());
    return light;
}

SpectralFunction const& white_light(Chromaticity const& white) { return uplift_under(white).light; }

SpectralFunction rgb_to_spectrum(Eigen::Vector3d const& rgb, RgbSpace const& space, RgbRole role) {
    if (!rgb.allFinite())
        throw InputError({}, "", fmt::format("found ({}, {}, {}), but a colour is finite", rgb[0], rgb[1], rgb[2]));
    double const grey = std::abs(rgb[0] - 1) <= rounding ? 1 : rgb[0];
    bool const is_grey = (rgb.array() - grey).abs().maxCoeff() <= rounding * std::abs(grey);
    bool const exists = grey >= 0 && (grey <= 1 || role != RgbRole::reflectance);
    SpectralFunction const factor = is_grey && exists ? SpectralFunction::constant(grey) : fitted(rgb, space, role);
    if (role != RgbRole::emission) return factor;
    SpectralFunction const& light = white_light(space.white);
    if (factor.is_constant()) return light.scaled(grey);
    // The product as a table at 1 nm: linear between, where the sigmoid bends by less than its slope.
    TabulatedShape table;
    for (double nm = light.defined_on().min_nm; nm <= light.defined_on().max_nm; ++nm) {
        table.nm.push_back(nm);
        table.value.push_back(factor.at(nm) * light.at(nm));
    }
    return SpectralFunction(std::move(table), Outside::zero, "rgb");
}

}  // namespace iride
