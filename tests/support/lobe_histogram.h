// SPDX-License-Identifier: Apache-2.0
// Counts of directions against a density, in cells that follow a lobe however narrow: in each hemisphere polar
// coordinates about the lobe's centre c, even in the azimuth and in
//   rho = r / (r + width / 2),   r = tan(angle to c / 2),   dw = 4 r / (1 + r^2)^2 dr dazimuth
// so that a quarter to a half of the rings lie within the width.
#pragma once

#include <array>
#include <vector>

#include "support/statistics.h"

namespace iride::test {

class LobeHistogram {
  public:
    struct Lobe {
        Direction centre;
        double width;
    };
    // Of what is above (z >= 0) and below the surface.
    LobeHistogram(Lobe const& above, Lobe const& below)
        : frame_{Frame::around(below.centre), Frame::around(above.centre)},
          half_width_{below.width / 2, above.width / 2},
          count_(static_cast<std::size_t>(cell_count), 0.0) {}

    void add(Direction const& w) {
        ++total_;
        std::size_t const above = w.z() >= 0;
        Frame const& frame = frame_[above];
        double const half_width = half_width_[above];
        VectorDouble const local = frame.to_local(w).cast<double>();
        double const side = std::hypot(local.x(), local.y()), r = side / std::max(1e-300, 1 + local.z());
        // 1 + cos is lost near -c, sin near c: the same tangent either way.
        double const rho = local.z() > -0.5 ? r / (r + half_width) : 1 / (1 + half_width * side / (1 - local.z()));
        double const turn = std::atan2(local.y(), local.x()) / (2 * pi_double) + 0.5;
        int const ring = std::min(static_cast<int>(rho * rings), rings - 1);
        int const sector = std::clamp(static_cast<int>(turn * sectors), 0, sectors - 1);
        ++count_[static_cast<std::size_t>(((w.z() >= 0 ? rings : 0) + ring) * sectors + sector)];
    }
    void add_nothing() { ++total_; }  // a sample that failed: the density's integral is below 1

    // Integrals of a density [1/sr] over the cells, by `points` x `points` midpoints in each.
    template <class Density>
    std::vector<double> integrals(Density&& density, int points) const {
        std::vector<double> result(static_cast<std::size_t>(cell_count), 0.0);
        double const drho = 1.0 / (rings * points), dazimuth = 2 * pi_double / (sectors * points);
        for (int above : {0, 1})
            for (int i = 0; i < rings * points; ++i) {
                double const half_width = half_width_[static_cast<std::size_t>(above)];
                double const rho = (i + 0.5) * drho, r = half_width * rho / (1 - rho), r2 = r * r;
                double const area = 4 * r / square(1 + r2) * half_width / square(1 - rho) * drho * dazimuth;
                for (int j = 0; j < sectors * points; ++j) {
                    double const azimuth = (j + 0.5) * dazimuth - pi_double, sine = 2 * r / (1 + r2);
                    Vector const local =
                        VectorDouble(sine * std::cos(azimuth), sine * std::sin(azimuth), (1 - r2) / (1 + r2))
                            .cast<float>();
                    Direction const w = frame_[static_cast<std::size_t>(above)].to_world(local).normalized();
                    if ((w.z() >= 0) != (above == 1)) continue;
                    result[static_cast<std::size_t>((above * rings + i / points) * sectors + j / points)] +=
                        area * density(w);
                }
            }
        return result;
    }
    double p_value(std::vector<double> const& integrals) const {
        ChiSquared verdict;
        double expected_sum = 0, counted = 0;
        for (std::size_t i = 0; i < count_.size(); ++i) {
            expected_sum += total_ * integrals[i];
            counted += count_[i];
            verdict.add(total_ * integrals[i], count_[i]);
        }
        double const lost = total_ - expected_sum;
        constexpr double quadrature_error = 1e-3;
        if (lost > quadrature_error * total_) verdict.add(lost, total_ - counted);
        return verdict.p_value();
    }

  private:
    static constexpr int rings = 12, sectors = 16, cell_count = 2 * rings * sectors;

    std::array<Frame, 2> frame_;  // below, above
    std::array<double, 2> half_width_;
    std::vector<double> count_;  // [hemisphere][ring][sector]
    double total_ = 0;
};

}  // namespace iride::test
