// SPDX-License-Identifier: Apache-2.0
// The reflectance of a colour: the sigmoid of a quadratic polynomial (SigmoidShape) whose colour under a light is the
// wanted one, by Levenberg's and Marquardt's damped Gauss-Newton method in double, residual and metric CIE 1976 L*a*b*.
// The limits of the family are the steps between 0 and 1 with at most two transitions, which bound all reflectances, so
// every colour that some reflectance has, they approach. Here the slope is bounded, so that a spectrum is smooth and 1
// nm tables hold it; of a colour beyond that, the nearest found is told. [Jakob 2019]
#pragma once

#include <array>

#include "base/vector.h"
#include "colour/observer.h"

namespace iride {

// The steepest a fitted reflectance may be, per nm: a transition from 0 to 1 takes 5 nm at least.
inline constexpr double steepest_reflectance = 0.2;

struct SigmoidFit {
    SigmoidShape sigmoid;
    VectorDouble colour;  // that it has: XYZ over the light's XYZ, as in `wanted`
    double difference;    // CIE 1976, to the wanted colour
};

// When to stop: at this CIE 1976 difference, or after so many rounds.
struct FitEffort {
    double difference = 1e-8;  // that is none
    int rounds = 300;
};

class SigmoidFitter {
  public:
    SigmoidFitter(SpectralFunction const& light, Observer const& observer);

    // `wanted`: XYZ over the light's XYZ, the perfect reflector being (1, 1, 1). A grey is exactly the constant.
    // `start`: of a nearby colour, saves rounds; without it, the grey of the same luminance. Ten to twenty
    // microseconds.
    SigmoidFit fit(VectorDouble const& wanted) const;
    SigmoidFit fit(VectorDouble const& wanted, SigmoidShape const& start, FitEffort const& effort = {}) const;

    // Of a colour beyond reach: the best of the fits from 81 colours around it, in half a millisecond. One fit may end
    // in a valley of its own, up to 12 farther; these are within .3 of the best that 380 starts find.
    SigmoidFit nearest(VectorDouble const& wanted) const;

  private:
    struct Evaluation;
    // Quadrature over 360 .. 830 nm: weights of light times observer for reflectances sampled every 2.5 nm and cubic
    // between (Lagrange, the two nearest samples on either side).
    static constexpr int knots = 189, padded = 192;
    template <class Real>
    struct Quadrature {
        std::array<Real, padded> t{};                      // wavelength as SigmoidShape takes it
        std::array<std::array<Real, padded>, 3> weight{};  // of X, Y, Z; each sums to 1

        Evaluation evaluate(VectorDouble const& coefficients) const;
    };
    Evaluation evaluate(VectorDouble const& coefficients, FitEffort const& effort) const;

    Quadrature<double> fine_;
    Quadrature<float> quick_;  // the same: errs by 1e-4 in L*a*b*
};

}  // namespace iride
