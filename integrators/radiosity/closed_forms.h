// SPDX-License-Identifier: Apache-2.0
// Form factors that have a formula: F from the first to the second, nothing between. Lengths in any one unit.
// [Cohen 1993, appendix]
#pragma once

#include <span>

#include "base/vector.h"

namespace iride::radiosity {

// Opposite rectangles a x b at distance c.
double opposite_rectangles(double a, double b, double c);
// Rectangles at right angles with a common edge of length l: from w x l to h x l.
double adjacent_rectangles(double w, double h, double l);
// Coaxial discs: from radius r to radius s, at distance d.
double coaxial_discs(double r, double s, double d);
// From a small patch to a coaxial disc of radius r at distance d: r^2 / (r^2 + d^2).
double patch_to_disc(double r, double d);
// From a small patch to a sphere that is wholly before it: cos (R / d)^2, `cosine` of the angle between the patch's
// normal and the centre at distance d.
double patch_to_sphere(double cosine, double R, double d);
// Inside of a sphere of radius R, from anywhere to a part of area A: A / (4 pi R^2), itself included.
double inside_sphere(double A, double R);
// A cap of half angle theta and the disc that closes it: from the cap to itself, (1 - cos theta) / 2.
double cap_to_itself(double theta);
// The side of a cone of base radius r and height h: to itself, 1 - r / sqrt(r^2 + h^2).
double cone_to_itself(double r, double h);

// From a small patch at `from` with unit `normal` to a planar or spherical-image polygon, vertices counter-clockwise as
// seen from the patch; what lies below the patch's horizon is cut off. Lambert's contour sum
//   F = 1 / (2 pi) sum over edges of angle(v_k, v_k+1) normal . (v_k x v_k+1) / |v_k x v_k+1|.
double patch_to_polygon(VectorDouble const& from, VectorDouble const& normal, std::span<VectorDouble const> polygon);

}  // namespace iride::radiosity
