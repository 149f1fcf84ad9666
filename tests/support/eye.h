// SPDX-License-Identifier: Apache-2.0
// The colour of a reflectance by a quadrature that shares nothing with the fitter's.
#pragma once

#include "colour/lab.h"
#include "colour/observer.h"
#include "colour/rgb_space.h"

namespace iride::test {

// Midpoint rule in tenths of a nanometre of reflectance times light times observer,, over the
// light's own.
class Eye {
  public:
    explicit Eye(SpectralFunction const& light) {
        for (double nm = 360.05; nm < 830; nm += .1)
            density_.push_back(light.at(nm) * to_vector(cie1931_2deg().at(nm)));
        for (VectorDouble const& d : density_) white_ += d;
    }
    VectorDouble ratio(SpectralFunction const& reflectance) const {
        VectorDouble sum = VectorDouble::Zero();
        double nm = 360.05;
        for (VectorDouble const& d : density_) sum += reflectance.at(nm) * d, nm += .1;
        return sum.cwiseQuotient(white_);
    }

  private:
    std::vector<VectorDouble> density_;
    VectorDouble white_ = VectorDouble::Zero();
};

inline VectorDouble wanted_ratio(RgbSpace const& space, Eigen::Vector3d const& rgb) {
    return (space.to_xyz_matrix() * rgb).cwiseQuotient(to_vector(to_xyz(space.white, 1)));
}

inline double difference_1976(VectorDouble const& a, VectorDouble const& b) {
    Lab const p = to_lab(to_xyz(a), {1, 1, 1}), q = to_lab(to_xyz(b), {1, 1, 1});
    return std::hypot(p.L - q.L, p.a - q.a, p.b - q.b);
}

}  // namespace iride::test
