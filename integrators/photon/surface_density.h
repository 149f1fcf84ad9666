// SPDX-License-Identifier: Apache-2.0
// The density of n points of the unit square, estimated in three ways [Picardello 2022, sec. 10.5]:
//   histogram          d = n_cell / (n A_cell), which is the projection onto the cells' indicators
//   orthogonal basis   d = sum_ij c_ij P_i P_j,  c_ij = mean over the points of P_i P_j, P_i Legendre polynomials of
//                      unit norm on [0, 1], or cosines sqrt(2) cos(pi i u)
//   nearest neighbours d = (k - 1) / (n A(r_k)), A the disc's area, or that of its part inside the square
#pragma once

#include <vector>

#include "integrators/photon/photon_grid.h"

namespace iride {

class SurfaceDensity {
  public:
    virtual ~SurfaceDensity() = default;
    // Per unit area of the square, so that the integral over it is 1 where the estimate keeps it.
    virtual double at(Vector2 const& uv) const = 0;
};

class HistogramDensity final : public SurfaceDensity {
  public:
    // side x side cells.
    HistogramDensity(std::vector<Vector2> const& points, int side);
    double at(Vector2 const& uv) const override;

  private:
    int cell(float u) const;
    int side_;
    std::vector<double> density_;
};

enum class SeriesBasis { legendre, cosine };

class SeriesDensity final : public SurfaceDensity {
  public:
    // Functions 0 .. side - 1 along u and v.
    SeriesDensity(std::vector<Vector2> const& points, int side, SeriesBasis basis);
    double at(Vector2 const& uv) const override;

  private:
    void values(double u, std::vector<double>& into) const;
    int side_;
    SeriesBasis basis_;
    std::vector<double> coefficient_;  // [i][j]
};

class NeighbourDensity final : public SurfaceDensity {
  public:
    // k >= 2 neighbours, or all points if there are fewer. `clipped`: the disc ends where the square does.
    NeighbourDensity(std::vector<Vector2> const& points, int k, bool clipped);
    double at(Vector2 const& uv) const override;

  private:
    PhotonGrid points_;
    std::size_t k_;
    bool clipped_;
};

// Area of the part of a disc that lies in the unit square.
double disc_area_in_square(Eigen::Vector2d const& centre, double radius);

}  // namespace iride
