// SPDX-License-Identifier: Apache-2.0
// Correlated colour temperature and Duv: the blackbody nearest in u, v (1960) and the distance to it, positive above
// the locus. The locus is Planck's law (exact c2 of the SI) seen by the observer, summed at 1 nm, and the nearest point
// is found on it, not on a fit: where the connecting line is perpendicular to it. [Ohno 2014] [CIE 15:2018, 9.5]
#pragma once

#include <optional>
#include <vector>

#include "colour/chromaticity.h"
#include "colour/observer.h"

namespace iride {

struct CorrelatedTemperature {
    double cct_K, duv;

    // CIE 15 gives a correlated temperature no meaning farther than this from the locus.
    static constexpr double largest_duv = 0.05;
    bool is_meaningful() const { return -largest_duv <= duv && duv <= largest_duv; }
};

class PlanckianLocus {
  public:
    static constexpr double coldest_K = 1000, hottest_K = 100000;

    explicit PlanckianLocus(Observer const& observer);

    Uv1960 at(double temperature_K) const;

    // Absent where the nearest blackbody is colder than coldest_K or hotter than hottest_K, and for what is no
    // chromaticity (black). Error below 1e-3 K for |Duv| <= 0.05.
    std::optional<CorrelatedTemperature> nearest(Uv1960 const& colour) const;

  private:
    struct Point {
        Uv1960 uv, slope;  // slope: derivative by 1e6 / T [per mired]
    };
    Point at_mired(double mired) const;

    std::vector<double> exponent_;         // c2 / (1e6 lambda), per wavelength
    std::vector<Eigen::Vector3d> weight_;  // lambda^-5 times the matching functions
    std::vector<double> node_mired_;
    std::vector<Uv1960> node_;
};

}  // namespace iride
