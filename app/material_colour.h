// SPDX-License-Identifier: Apache-2.0
// The colour of a material by angle under an illuminant, seen by the CIE 1931 observer and adapted to it: a mirror that
// reflects everything is white, Y = 1. And what approximations of Fresnel's equations make of that colour.
#pragma once

#include "app/given_material.h"
#include "base/vector.h"
#include "colour/lab.h"
#include "colour/rgb_encoding.h"
#include "colour/tristimulus.h"

namespace iride {

struct MaterialColour {
    Xyz xyz;
    std::optional<Chromaticity> xy;  // black has none
    Lab lab;
    VectorDouble linear_srgb;  // adapted to D65 by Bradford's method, not clamped
};

class MaterialColorimetry {
  public:
    // Throws InputError as illuminant() does.
    explicit MaterialColorimetry(std::string const& illuminant);

    std::vector<double> const& wavelengths_nm() const { return weights_.wavelengths_nm(); }
    MaterialColour of(std::span<double const> reflectance) const;  // at wavelengths_nm()
    MaterialColour of(GivenMaterial const& material, double angle_deg) const {
        return of(reflectances(material, angle_deg, wavelengths_nm()));
    }
    MaterialColour of_linear_srgb(VectorDouble const& rgb) const;
    // Encoded sRGB for a picture: what is outside its gamut goes to the nearest colour of equal L* and hue, L* <= 100.
    VectorDouble shown(MaterialColour const& colour) const;

  private:
    MaterialColour of(Xyz const& xyz) const;

    TristimulusWeights weights_;
    RgbConversion to_rgb_, to_xyz_;
};

// The formulas of fresnel_approximations.h, per wavelength but for the interpolation of 1982, whose colours are three
// numbers, linear sRGB, and whose mean reflectance is the luminous one.
class ApproximateColours {
  public:
    // Of a smooth material.
    ApproximateColours(GivenMaterial const& material, MaterialColorimetry const& colorimetry);

    struct Entry {
        char const *key, *title;
        MaterialColour colour;
    };
    std::vector<Entry> at(double angle_deg) const;
    double mean_reflectance() const { return mean_R0_; }

  private:
    GivenMaterial const& material_;
    MaterialColorimetry const& colorimetry_;
    std::vector<double> R0_;  // at the colorimetry's wavelengths
    double mean_R0_;
    VectorDouble normal_rgb_;
};

}  // namespace iride
