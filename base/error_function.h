// SPDX-License-Identifier: Apache-2.0
// The inverse of the error function in single precision, |error| < 5e-7 (1 + |x|) for |erf x| < 1 - 1e-6 (tested).
// Polynomials in log(1 - y^2). [Giles 2012]
#pragma once

#include <algorithm>
#include <cmath>

#include "base/constants.h"

namespace iride {

// x with erf x = y; |y| is cut to the float below 1, whose x is 3.8.
inline float inverse_error_function(float y) {
    constexpr float last = one_minus_epsilon;
    float const z = std::clamp(y, -last, last);
    float w = -std::log((1 - z) * (1 + z)), p;
    if (w < 5) {
        w -= 2.5f;
        p = 2.81022636e-08f;
        for (float const c : {3.43273939e-07f, -3.5233877e-06f, -4.39150654e-06f, 2.1858087e-04f, -1.25372503e-03f,
                              -4.17768164e-03f, 2.46640727e-01f, 1.50140941f})
            p = c + p * w;
    } else {
        w = std::sqrt(w) - 3;
        p = -2.00214257e-04f;
        for (float const c : {1.00950558e-04f, 1.34934322e-03f, -3.67342844e-03f, 5.73950773e-03f, -7.6224613e-03f,
                              9.43887047e-03f, 1.00167406f, 2.83297682f})
            p = c + p * w;
    }
    return p * z;
}

}  // namespace iride
