// SPDX-License-Identifier: Apache-2.0
// RGB as numbers that a person writes: a linear space and the curve its standard puts on it.
//   `iride colour convert` and "space" of a scene's RGB: the name means the standard's own signal, so sRGB, Rec709,
//       Rec2020, DisplayP3 and AdobeRGB are encoded; linear-sRGB, linear-Rec2020, ... are their linear light;
//       ACES2065-1 and ACEScg are linear by definition.
//   EXR output (`--colourspace`): always scene-linear, so there the name says primaries and white alone (OutputSpace in
//       rgb_space.h); sRGB is refused in favour of linear-sRGB.
#pragma once

#include <vector>

#include "colour/rgb_space.h"
#include "colour/transfer_function.h"

namespace iride {

struct RgbEncoding {
    std::string_view name;  // as on the command line
    RgbSpace const* space;
    TransferFunction transfer;
};

// Every name, in the order of the documentation; readers and messages iterate it.
std::vector<RgbEncoding> const& rgb_encodings();

// By name. Throws InputError with the nearest name, or all.
RgbEncoding const& rgb_encoding(std::string const& name);

// Between two encodings, or one and XYZ: decode, one matrix (through XYZ, adapted from white to white), encode. Made
// once, applied to many; components out of range and negative ones are carried through, NaN stays NaN.
class RgbConversion {
  public:
    RgbConversion(RgbEncoding const& from, RgbEncoding const& to, Adaptation method = Adaptation::bradford);
    // XYZ with Y = 1 for `white`, to or from the RGB of an encoding, whose (1,1,1) is that white.
    static RgbConversion to_xyz(RgbEncoding const& from, Chromaticity const& white,
                                Adaptation method = Adaptation::bradford);
    static RgbConversion from_xyz(Chromaticity const& white, RgbEncoding const& to,
                                  Adaptation method = Adaptation::bradford);

    VectorDouble operator()(VectorDouble const& colour) const {
        VectorDouble const linear = matrix_ * colour.unaryExpr([&](double v) { return decode(decode_, v); });
        return linear.unaryExpr([&](double v) { return encode(encode_, v); });
    }

  private:
    RgbConversion(TransferFunction decode, MatrixDouble const& matrix, TransferFunction encode)
        : decode_(decode), encode_(encode), matrix_(matrix) {}

    TransferFunction decode_, encode_;
    MatrixDouble matrix_;
};

}  // namespace iride
