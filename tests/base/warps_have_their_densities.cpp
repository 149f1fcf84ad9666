// SPDX-License-Identifier: Apache-2.0
// Maps of the unit square to directions and points: counts against the density that each states.
#include "base/warp.h"

#include <catch2/catch.hpp>

#include "base/bilinear.h"
#include "base/spherical.h"
#include "support/statistics.h"

using namespace iride;

namespace {

constexpr std::uint32_t draws = 200000;
constexpr double level = 1e-3 / 8;

Sample2 pair_of(std::uint32_t i) { return Sampler(SamplerKind::independent, 41, 0, i).next2(); }

template <class Map, class Density>
double p_value(Map const& map, Density const& density) {
    test::DirectionHistogram histogram;
    for (std::uint32_t i = 0; i < draws; ++i) histogram.add(map(pair_of(i)));
    constexpr int rules = 48;  // for edges across a cell
    return histogram.p_value([&](Direction const& w) { return static_cast<double>(density(w)); }, rules);
}

// Counts in equal squares of what should be uniform in the unit square.
template <class Place>
double p_value_of_uniform(Place const& place) {
    constexpr int side = 20;
    std::vector<double> count(side * side);
    for (std::uint32_t i = 0; i < draws; ++i) {
        auto const [x, y] = place(i);
        int const column = std::clamp(static_cast<int>(x * side), 0, side - 1),
                  row = std::clamp(static_cast<int>(y * side), 0, side - 1);
        ++count[static_cast<std::size_t>(row * side + column)];
    }
    test::ChiSquared verdict;
    for (double c : count) verdict.add(draws / static_cast<double>(side * side), c);
    return verdict.p_value();
}

}  // namespace

TEST_CASE("directions have the densities that their maps state", "[law]") {
    CHECK(p_value([](Sample2 u) { return to_sphere(u); },
                  [](Direction const&) { return uniform_sphere_density.value; }) > level);
    for (float height : {1.0f, 0.3f})
        CHECK(p_value([&](Sample2 u) { return to_cone(u, height); },
                      [&](Direction const& w) { return w.z() > 1 - height ? cone_density(height).value : 0; }) > level);
    CHECK(p_value([](Sample2 u) { return to_cosine_hemisphere(u); },
                  [](Direction const& w) { return cosine_hemisphere_density(w.z()).value; }) > level);
}

// Fails for sqrt(u) left out of a disc's radius and for a triangle's square cut without folding.
TEST_CASE("points of discs and triangles are uniform in area", "[law]") {
    CHECK(p_value_of_uniform([](std::uint32_t i) {
              Vector2 const d = to_disc(pair_of(i));
              auto const turn = std::atan2(static_cast<double>(d.y()), static_cast<double>(d.x())) / (2 * pi_double);
              return std::pair(static_cast<double>(d.squaredNorm()), turn < 0 ? turn + 1 : turn);
          }) > level);
    // Of a uniform point with b0 + b1 <= 1: (b0 + b1)^2 and b0 / (b0 + b1) are uniform.
    CHECK(p_value_of_uniform([](std::uint32_t i) {
              Vector2 const b = to_triangle(pair_of(i));
              double const sum = static_cast<double>(b.x()) + static_cast<double>(b.y());
              return std::pair(sum * sum, sum > 0 ? static_cast<double>(b.x()) / sum : 0.5);
          }) > level);
}

// Of its density f, the mean of g / f over samples is the integral of g. Fails for x and y in each other's place.
TEST_CASE("places in the unit square have their bilinear density", "[law]") {
    BilinearDensity<float> const density({0.2f, 1.1f, 0.01f, 2.5f});
    constexpr std::uint32_t count = 1 << 16;
    double area = 0, moment = 0, mean_x = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
        Sample2 const u = Sampler(SamplerKind::sobol, 42, 0, i).next2();
        auto const [x, y, f] = density.sample(u.x, u.y);
        auto const one = 1 / static_cast<double>(f);
        area += one / count;
        moment += one * static_cast<double>(x * x * y) / count;
        mean_x += static_cast<double>(x) / count;
    }
    CHECK(area == Approx(1).epsilon(1e-3));
    CHECK(moment == Approx(1.0 / 6).epsilon(1e-3));
    // (1/4) (c00 + c01) / 6 + (c10 + c11) / 3 over the mean of all four.
    CHECK(mean_x == Approx((0.21 / 6 + 3.6 / 3) * 0.5 / (3.81 / 4)).epsilon(1e-4));
}

TEST_CASE("directions in spherical triangles and rectangles are uniform in solid angle", "[law]") {
    Direction const a = Vector(1, 0.2f, 0.3f).normalized(), b = Vector(0.1f, 1, 0.2f).normalized(),
                    c = Vector(0.2f, 0.1f, 1).normalized();
    auto const within = [&](Direction const& w) {
        return a.cross(b).dot(w) > 0 && b.cross(c).dot(w) > 0 && c.cross(a).dot(w) > 0;
    };
    float const triangle = triangle_solid_angle(a, b, c);
    CHECK(p_value([&](Sample2 u) { return sample_spherical_triangle(a, b, c, u); },
                  [&](Direction const& w) { return within(w) ? 1 / triangle : 0; }) > level);
    Rectangle const r = Rectangle::from_edges({-0.5f, -0.8f, 1}, {1.2f, 0, 0}, {0, 1.5f, 0});
    SphericalRectangle<float> const seen(r, {0, 0, 0});
    CHECK(p_value(
              [&](Sample2 u) {
                  auto const d = seen.sample(u.x, u.y);
                  return Vector(d[0], d[1], d[2]).normalized();
              },
              [&](Direction const& w) {
                  if (!(w.z() > 0)) return 0.0f;
                  float const x = w.x() / w.z(), y = w.y() / w.z();
                  return x > -0.5f && x < 0.7f && y > -0.8f && y < 0.7f ? 1 / seen.solid_angle() : 0;
              }) > level);
}
