// SPDX-License-Identifier: Apache-2.0
#include "app/material_colour.h"

#include "app/fresnel_approximations.h"
#include "base/constants.h"
#include "colour/gamut.h"
#include "colour/illuminant.h"

namespace iride {

namespace {

RgbEncoding const& linear_srgb() { return rgb_encoding("linear-sRGB"); }

// A reflectance of 1 has no index.
constexpr double most_R0 = 1 - 1e-12;

}  // namespace

MaterialColorimetry::MaterialColorimetry(std::string const& name)
    : weights_(illuminant(name), cie1931_2deg()),
      to_rgb_(RgbConversion::from_xyz(to_chromaticity(weights_.white()), linear_srgb())),
      to_xyz_(RgbConversion::to_xyz(linear_srgb(), to_chromaticity(weights_.white()))) {}

MaterialColour MaterialColorimetry::of(Xyz const& xyz) const {
    MaterialColour c{xyz, {}, to_lab(xyz, weights_.white()), to_rgb_(to_vector(xyz))};
    if (xyz.X + xyz.Y + xyz.Z > 0) c.xy = to_chromaticity(xyz);
    return c;
}

MaterialColour MaterialColorimetry::of(std::span<double const> reflectance) const {
    return of(weights_.of(reflectance));
}

MaterialColour MaterialColorimetry::of_linear_srgb(VectorDouble const& rgb) const { return of(to_xyz(to_xyz_(rgb))); }

VectorDouble MaterialColorimetry::shown(MaterialColour const& colour) const {
    static RgbGamut const gamut(rgb::rec709.to_xyz_matrix());
    static MatrixDouble const to_xyz_matrix = rgb::rec709.to_xyz_matrix(), from_xyz = rgb::rec709.from_xyz_matrix();
    Xyz const adapted = to_xyz(VectorDouble(to_xyz_matrix * colour.linear_srgb));
    Xyz const inside =
        gamut.contains(adapted) ? adapted : gamut.nearest_by_chroma(adapted, to_xyz(rgb::rec709.white, 1));
    return VectorDouble(from_xyz * to_vector(inside)).unaryExpr([](double v) {
        return encode(TransferFunction::srgb, std::clamp(v, 0.0, 1.0));
    });
}

ApproximateColours::ApproximateColours(GivenMaterial const& material, MaterialColorimetry const& colorimetry)
    : material_(material), colorimetry_(colorimetry), R0_(reflectances(material, 0, colorimetry.wavelengths_nm())) {
    for (double& R0 : R0_) R0 = std::min(R0, most_R0);
    MaterialColour const normal = colorimetry_.of(R0_);
    mean_R0_ = std::min(normal.xyz.Y, most_R0);
    normal_rgb_ = normal.linear_srgb;
}

std::vector<ApproximateColours::Entry> ApproximateColours::at(double angle_deg) const {
    double const cosine = angle_deg == 90 ? 0 : std::cos(radians(angle_deg));
    auto const per_wavelength = [&](auto const& formula) {
        std::vector<double> R;
        for (std::size_t i = 0; i < R0_.size(); ++i) R.push_back(formula(i));
        return colorimetry_.of(R);
    };
    double const share = colour_shift_1982(cosine, mean_R0_);
    std::vector<Entry> all{
        {"interpolated_1982", "RGB between metal and light, 1982",
         colorimetry_.of_linear_srgb(normal_rgb_ + share * (VectorDouble(1, 1, 1) - normal_rgb_))},
        {"real_index", "real n from the normal reflectance", per_wavelength([&](std::size_t i) {
             return fresnel(cosine, index_of_reflectance(R0_[i]), 0.0).unpolarised();
         })},
        {"schlick", "Schlick", per_wavelength([&](std::size_t i) { return schlick(cosine, R0_[i]); })}};
    if (material_.plane->layers.empty()) {
        std::vector<double> const& nm = colorimetry_.wavelengths_nm();
        all.push_back({"fast_conductor", "fast conductor formula", per_wavelength([&](std::size_t i) {
                           std::complex<double> const n =
                               index_at(material_.plane->inside, nm[i]) / material_.plane->outside.n.at(nm[i]);
                           return fast_conductor(cosine, n.real(), n.imag()).unpolarised();
                       })});
    }
    return all;
}

}  // namespace iride
