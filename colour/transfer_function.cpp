// SPDX-License-Identifier: Apache-2.0
#include "colour/transfer_function.h"

#include <algorithm>
#include <cmath>

namespace iride {

namespace {

// V = slope L below the break, else scale L^power - (scale - 1).
struct LinearThenPower {
    double slope, scale, power, break_linear;

    double encode(double L) const { return L < break_linear ? slope * L : scale * std::pow(L, power) - (scale - 1); }
    double decode(double V) const {
        if (V < slope * break_linear) return V / slope;
        return std::max(std::pow((V + (scale - 1)) / scale, 1 / power), break_linear);  // a gap decodes to the break
    }
};

// Newton's method from a rounded root; quadratic, so that a handful of steps reaches the last digit.
template <class Function, class Derivative>
double root_near(double x, Function f, Derivative derivative) {
    constexpr int steps = 8;
    for (int i = 0; i < steps; ++i) x -= f(x) / derivative(x);
    return x;
}

LinearThenPower const& srgb() {
    static LinearThenPower const curve = [] {
        LinearThenPower c{12.92, 1.055, 1 / 2.4, 0.0031308};
        c.break_linear = root_near(
            c.break_linear, [&](double L) { return c.scale * std::pow(L, c.power) - (c.scale - 1) - c.slope * L; },
            [&](double L) { return c.scale * c.power * std::pow(L, c.power - 1) - c.slope; });
        return c;
    }();
    return curve;
}

constexpr LinearThenPower rec709{4.5, 1.099, 0.45, 0.018};

LinearThenPower const& rec2020() {
    static LinearThenPower const curve = [] {
        // Equal slopes: scale = 10 beta^.55. Equal values, with that: scale = 1 + 5.5 beta.
        double const beta = root_near(
            0.018, [](double b) { return 10 * std::pow(b, 0.55) - 1 - 5.5 * b; },
            [](double b) { return 5.5 * std::pow(b, -0.45) - 5.5; });
        return LinearThenPower{4.5, 1 + 5.5 * beta, 0.45, beta};
    }();
    return curve;
}

constexpr double adobe_gamma = 563.0 / 256, display_gamma = 2.4;

namespace pq {
constexpr double m1 = 2610.0 / 16384, m2 = 2523.0 / 4096 * 128;
constexpr double c1 = 3424.0 / 4096, c2 = 2413.0 / 4096 * 32, c3 = 2392.0 / 4096 * 32;

double encode(double L) {
    double const y = std::pow(L, m1);
    return std::pow((c1 + c2 * y) / (1 + c3 * y), m2);
}
double decode(double V) {
    double const y = std::pow(V, 1 / m2);
    return std::pow(y > c1 ? (y - c1) / (c2 - c3 * y) : y * 0, 1 / m1);  // y * 0: NaN stays NaN
}
}  // namespace pq

namespace hlg {
constexpr double a = 0.17883277, b = 1 - 4 * a;
double const c = 0.5 - a * std::log(4 * a);

double encode(double L) { return L <= 1.0 / 12 ? std::sqrt(3 * L) : a * std::log(12 * L - b) + c; }
double decode(double V) { return V <= 0.5 ? V * V / 3 : (std::exp((V - c) / a) + b) / 12; }
}  // namespace hlg

}  // namespace

double encode(TransferFunction function, double linear) {
    double const L = std::abs(linear);
    switch (function) {
        case TransferFunction::linear:
            return linear;
        case TransferFunction::srgb:
            return std::copysign(srgb().encode(L), linear);
        case TransferFunction::rec709:
            return std::copysign(rec709.encode(L), linear);
        case TransferFunction::rec2020:
            return std::copysign(rec2020().encode(L), linear);
        case TransferFunction::adobe_rgb:
            return std::copysign(std::pow(L, 1 / adobe_gamma), linear);
        case TransferFunction::bt1886:
            return std::copysign(std::pow(L, 1 / display_gamma), linear);
        case TransferFunction::pq:
            return std::copysign(pq::encode(L), linear);
        case TransferFunction::hlg:
            return std::copysign(hlg::encode(L), linear);
    }
    return linear;
}

double decode(TransferFunction function, double encoded) {
    double const V = std::abs(encoded);
    switch (function) {
        case TransferFunction::linear:
            return encoded;
        case TransferFunction::srgb:
            return std::copysign(srgb().decode(V), encoded);
        case TransferFunction::rec709:
            return std::copysign(rec709.decode(V), encoded);
        case TransferFunction::rec2020:
            return std::copysign(rec2020().decode(V), encoded);
        case TransferFunction::adobe_rgb:
            return std::copysign(std::pow(V, adobe_gamma), encoded);
        case TransferFunction::bt1886:
            return std::copysign(std::pow(V, display_gamma), encoded);
        case TransferFunction::pq:
            return std::copysign(pq::decode(V), encoded);
        case TransferFunction::hlg:
            return std::copysign(hlg::decode(V), encoded);
    }
    return encoded;
}

}  // namespace iride
