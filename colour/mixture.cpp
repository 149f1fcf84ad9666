// SPDX-License-Identifier: Apache-2.0
#include "colour/mixture.h"

#include <fmt/format.h>

#include <cmath>

#include "base/diagnostics.h"

namespace iride {

std::optional<LuminanceShares> mixing_to(Chromaticity const& target, Chromaticity const& a, Chromaticity const& b) {
    constexpr double tolerance = 1e-9;  // of x, y: rounding of chromaticities from integrals
    double const dx = b.x - a.x, dy = b.y - a.y, length = std::hypot(dx, dy);
    if (!(length > tolerance)) return std::nullopt;
    double const along = ((target.x - a.x) * dx + (target.y - a.y) * dy) / length;
    double const aside = ((target.x - a.x) * dy - (target.y - a.y) * dx) / length;
    if (!(std::abs(aside) <= tolerance && along >= -tolerance && along <= length + tolerance)) return std::nullopt;
    double const Y_a = (length - along) * a.y, Y_b = along * b.y;  // m_a : m_b = distances to the other light
    return LuminanceShares{Y_a / (Y_a + Y_b), Y_b / (Y_a + Y_b)};
}

std::optional<Complementary> complementary(double wavelength_nm, Chromaticity const& white, Observer const& observer,
                                           SpectralLocus const& locus) {
    double const from = locus.wavelengths_nm().front(), to = locus.wavelengths_nm().back();
    if (!(from <= wavelength_nm && wavelength_nm <= to))
        throw InputError({}, "wavelength", fmt::format("{:g} nm: allowed is {:g} .. {:g} nm", wavelength_nm, from, to));
    Chromaticity const pure = to_chromaticity(observer.at(wavelength_nm));
    auto const opposite = locus.crossing(white, white.x - pure.x, white.y - pure.y);
    if (!opposite.wavelength_nm) return std::nullopt;
    auto const shares = mixing_to(white, pure, opposite.at);
    if (!shares) return std::nullopt;
    return Complementary{*opposite.wavelength_nm, *shares};
}

}  // namespace iride
