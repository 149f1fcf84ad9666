// SPDX-License-Identifier: Apache-2.0
// When a picture is good enough, told from the covariance C of each pixel's mean (X, Y, Z).
//   relative  e = sqrt(mean over X, Y, Z of variance / (mean^2 + .01)); reached when the root mean square of e over the
//             pixels is the target or less: the root of the relMSE against the true picture
//   de        e^2 = expected square of the CIEDE2000 difference [Sharma 2005] that the noise makes, of exposed XYZ
//   under
//             the scene's white: the mean over the 6 sigma points m +- c_k, C = sum of c_k c_k^T / 3 [Julier 1997],
//             which is exact where the difference is a quadratic form. Reached when the expected share of pixels beyond
//             the target, mean of erfc(target / (sqrt 2 e)), is 1 %: noise along one line in colour has the heaviest
//             tail of all with this mean square.
#pragma once

#include <string>

#include "film/film.h"

namespace iride {

class ErrorTarget {
  public:
    enum class Kind { relative, colour_difference };
    // "0.01" or "de=0.5". Throws InputError: neither, or not above 0.
    static ErrorTarget parse(std::string const& text);
    static ErrorTarget relative(double target) { return {Kind::relative, target}; }
    // What "de" is measured under; D65 and 1 until said.
    void set_display(Chromaticity const& white, double exposure);

    Kind kind() const { return kind_; }
    double target() const { return target_; }

    // e of a pixel whose mean has this covariance; infinite if the covariance is.
    double error(Xyz const& mean, MatrixDouble const& covariance) const;
    // Over the film: the root mean square of e, or the e that 1 % of the pixels are expected to exceed: to be compared
    // with the target.
    double error(Film const& film) const;
    bool is_reached(Film const& film) const { return error(film) <= target_; }

  private:
    ErrorTarget(Kind kind, double target) : kind_(kind), target_(target) {}
    double colour_difference(Xyz const& mean, MatrixDouble const& covariance) const;

    Kind kind_;
    double target_, exposure_ = 1;
    Xyz white_ = to_xyz(Chromaticity{0.3127, 0.3290}, 1);
};

}  // namespace iride
