// SPDX-License-Identifier: Apache-2.0
// Tristimulus values and chromaticities. Scale: spectral radiance 1 W m^-2 sr^-1 nm^-1 at every wavelength is Y = 1.
#pragma once

#include <Eigen/Core>

namespace iride {

struct Chromaticity {
    double x, y;
    friend bool operator==(Chromaticity const&, Chromaticity const&) = default;
};

struct Xyz {
    double X = 0, Y = 0, Z = 0;

    friend Xyz operator+(Xyz a, Xyz b) { return {a.X + b.X, a.Y + b.Y, a.Z + b.Z}; }
    friend Xyz operator*(double s, Xyz a) { return {s * a.X, s * a.Y, s * a.Z}; }
};

inline Eigen::Vector3d to_vector(Xyz const& c) { return {c.X, c.Y, c.Z}; }
inline Xyz to_xyz(Eigen::Vector3d const& v) { return {v[0], v[1], v[2]}; }

// x = X / (X + Y + Z), y = Y / (X + Y + Z); of black: not a number.
inline Chromaticity to_chromaticity(Xyz const& c) {
    double const sum = c.X + c.Y + c.Z;
    return {c.X / sum, c.Y / sum};
}

// X = x Y / y, Z = (1 - x - y) Y / y; y > 0.
inline Xyz to_xyz(Chromaticity const& c, double Y) { return {c.x * Y / c.y, Y, (1 - c.x - c.y) * Y / c.y}; }

}  // namespace iride
