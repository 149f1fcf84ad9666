// SPDX-License-Identifier: Apache-2.0
// A photograph's exposure in physical units. Light of luminance L, through a lens of f-number N that is focused far
// away, lossless and on its axis, falls on the sensor for the time t as
//   H = pi / 4 L t / N^2   [lx s]                                                    (ISO 2720:1974, with q = pi/4)
// and a sensor of saturation-based speed S is full at H = 78 / S (ISO 12232:2019). Full is 1 in the picture.
#pragma once

#include "base/constants.h"

namespace iride {

struct Photograph {
    double iso, shutter_s, f_number;

    double luminous_exposure(double luminance_cd_m2) const {
        return pi_double / 4 * luminance_cd_m2 * shutter_s / (f_number * f_number);
    }
    // Of what the sensor holds; 1: full.
    double signal(double luminance_cd_m2) const { return luminous_exposure(luminance_cd_m2) * iso / 78; }
};

}  // namespace iride
