// SPDX-License-Identifier: Apache-2.0
// Linear RGB spaces as their standards give them: chromaticities of three primaries and a white. Matrices are derived.
#pragma once

#include <string>
#include <string_view>

#include "colour/adaptation.h"

namespace iride {

struct RgbSpace {
    std::string_view name;  // as on the command line: "ACEScg"
    Chromaticity red, green, blue, white;
    std::string_view interop_id;  // ASWF colour interop id, e.g. "lin_ap1_scene"

    // XYZ of RGB; the white (1,1,1) has Y = 1. [SMPTE RP 177:1993]
    MatrixDouble to_xyz_matrix() const;
    MatrixDouble from_xyz_matrix() const;
};

namespace rgb {
extern RgbSpace const aces2065_1, acescg, rec709, rec2020, display_p3, adobe_rgb;  // all linear
}
// The published chromaticity of a named white ("D65" (.3127,.3290), "D50" (.3457,.3585), "A", "C", "D55", "D75", "E"
// (1/3,1/3), "ACES" (.32168,.33767)), or, as "D65:table", the one its spectrum gives. Throws InputError.
Chromaticity named_white(std::string const& name);

// What an output named on the command line means: XYZ itself, or an RGB space after adaptation from the scene's white.
struct OutputSpace {
    std::string name;
    MatrixDouble from_xyz;  // identity for XYZ
    RgbSpace const* rgb;    // null for XYZ
};
// "XYZ" or a name of rgb_encodings() but sRGB (which is encoded by its name): always scene-linear, so "Rec709" is
// "linear-sRGB". Adapted by Bradford's method. Throws InputError with the allowed names.
OutputSpace output_space(std::string const& name, Chromaticity const& scene_white);

}  // namespace iride
