// SPDX-License-Identifier: Apache-2.0
#include "colour/rgb_encoding.h"

#include <fmt/format.h>

#include "base/diagnostics.h"

namespace iride {

std::vector<RgbEncoding> const& rgb_encodings() {
    using enum TransferFunction;
    static std::vector<RgbEncoding> const all{
        {"sRGB", &rgb::rec709, srgb},
        {"linear-sRGB", &rgb::rec709, linear},
        {"Rec709", &rgb::rec709, rec709},
        {"Rec2020", &rgb::rec2020, rec2020},
        {"linear-Rec2020", &rgb::rec2020, linear},
        {"DisplayP3", &rgb::display_p3, srgb},
        {"linear-DisplayP3", &rgb::display_p3, linear},
        {"AdobeRGB", &rgb::adobe_rgb, adobe_rgb},
        {"linear-AdobeRGB", &rgb::adobe_rgb, linear},
        {"ACES2065-1", &rgb::aces2065_1, linear},
        {"ACEScg", &rgb::acescg, linear},
    };
    return all;
}

RgbEncoding const& rgb_encoding(std::string const& name) {
    std::vector<std::string> names;
    for (RgbEncoding const& encoding : rgb_encodings()) {
        if (encoding.name == name) return encoding;
        names.emplace_back(encoding.name);
    }
    throw InputError({}, "space", fmt::format("unknown RGB space '{}'{}", name, suggestion(name, names)));
}

RgbConversion::RgbConversion(RgbEncoding const& from, RgbEncoding const& to, Adaptation method)
    : RgbConversion(from.transfer, MatrixDouble::Identity(), to.transfer) {
    if (from.space == to.space) return;  // the curves alone, not a matrix times its inverse
    matrix_ = to.space->from_xyz_matrix() * adaptation_matrix(from.space->white, to.space->white, method) *
              from.space->to_xyz_matrix();
}

RgbConversion RgbConversion::to_xyz(RgbEncoding const& from, Chromaticity const& white, Adaptation method) {
    return {from.transfer, adaptation_matrix(from.space->white, white, method) * from.space->to_xyz_matrix(),
            TransferFunction::linear};
}

RgbConversion RgbConversion::from_xyz(Chromaticity const& white, RgbEncoding const& to, Adaptation method) {
    return {TransferFunction::linear, to.space->from_xyz_matrix() * adaptation_matrix(white, to.space->white, method),
            to.transfer};
}

}  // namespace iride
