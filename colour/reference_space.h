// SPDX-License-Identifier: Apache-2.0
// What the colour spaces that OpenColorIO configs name must hold, from primaries, whites and the formulas of standards,
// in double: a linear map from the reference (ACES2065-1, or CIE XYZ of a D65 display), then a curve or a CIE 1976
// formula. Scene-referred spaces are adapted from the ACES white by Bradford.
#pragma once

#include <string>
#include <vector>

#include "colour/rgb_space.h"

namespace iride {

// V = curve(L) per component, but for the CIE spaces, which take XYZ, and `hlg`, whose luminance joins the components.
enum class SpaceCurve {
    none,
    srgb,     // IEC 61966-2-1
    rec2020,  // ITU-R BT.2020-2, camera, with unrounded constants
    adobe,    // L = V^(563/256)
    gamma22,  // L = V^2.2
    bt1886,   // L = V^2.4
    gamma26,  // L = V^2.6
    pq,       // ITU-R BT.2100, L = 1 is 100 cd/m^2
    hlg,      // ITU-R BT.2100 on a display of 1000 cd/m^2, L = 1 is 100 cd/m^2
    acescc,   // ACES S-2014-003
    acescct,  // ACES S-2016-001
    uvY,      // CIE 1976 u', v' and Y
    Luv,      // CIE 1976 L*, u*, v*
    Lab,      // CIE 1976 L*, a*, b*
};

struct ReferenceSpace {
    std::string name;
    std::vector<std::string> keys;  // how configs call it, as space_key() gives it
    bool display_referred;          // its reference is CIE XYZ of a D65 display, else ACES2065-1
    MatrixDouble linear;            // from the reference to linear RGB or XYZ
    SpaceCurve curve = SpaceCurve::none;
    Xyz white{};  // of the CIE spaces

    VectorDouble from_reference(VectorDouble const& reference) const;
    // Not finite where the curve has no inverse.
    VectorDouble to_reference(VectorDouble const& value) const;
    // Linear RGB or XYZ of a value.
    VectorDouble decoded(VectorDouble const& value) const;
};

// Letters and digits alone, in lower case: "Linear Rec.709 (sRGB)" is "linearrec709srgb".
std::string space_key(std::string const& name);

std::vector<ReferenceSpace> const& reference_spaces();

// The space that a config calls by one of these names; null if none is known, or it hangs on the other reference.
ReferenceSpace const* find_reference_space(std::vector<std::string> const& names, bool display_referred);

}  // namespace iride
