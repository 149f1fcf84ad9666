// SPDX-License-Identifier: Apache-2.0
#include "colour/reference_space.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace iride {

namespace {

// V = slope L below the break, else scale L^power - (scale - 1); odd.
struct CameraCurve {
    double slope, scale, power, break_linear;

    double encode(double signed_L) const {
        double const L = std::abs(signed_L);
        return std::copysign(L < break_linear ? slope * L : scale * std::pow(L, power) - (scale - 1), signed_L);
    }
    double decode(double signed_V) const {
        double const V = std::abs(signed_V);
        return std::copysign(V < slope * break_linear ? V / slope : std::pow((V + scale - 1) / scale, 1 / power),
                             signed_V);
    }
};
constexpr CameraCurve srgb_curve{12.92, 1.055, 1 / 2.4, 0.0031308},
    rec2020_curve{4.5, 1.09929682680944, 0.45, 0.018053968510807};

double odd_power(double x, double exponent) { return std::copysign(std::pow(std::abs(x), exponent), x); }

// Exponent of a pure power law, 0 for another curve.
double gamma_of(SpaceCurve curve) {
    switch (curve) {
        case SpaceCurve::adobe:
            return 563.0 / 256;
        case SpaceCurve::gamma22:
            return 2.2;
        case SpaceCurve::bt1886:
            return 2.4;
        case SpaceCurve::gamma26:
            return 2.6;
        default:
            return 0;
    }
}

namespace pq {
constexpr double m1 = 2610.0 / 16384, m2 = 2523.0 / 32, c1 = 107.0 / 128, c2 = 2413.0 / 128, c3 = 2392.0 / 128;
constexpr double peak = 100;  // L = 1 is a hundredth of the curve's 10000 cd/m^2

double encode(double L) {
    double const y = std::pow(std::max(0.0, L / peak), m1);
    return std::pow((c1 + c2 * y) / (1 + c3 * y), m2);
}
double decode(double V) {
    double const y = std::pow(V, 1 / m2);
    return peak * std::pow(std::max(0.0, y - c1) / (c2 - c3 * y), 1 / m1);
}
}  // namespace pq

namespace hlg {
constexpr double a = 0.17883277, b = 1 - 4 * a, system_gamma = 1.2, peak = 10;
double const c = 0.5 - a * std::log(4 * a);

double luminance(VectorDouble const& rgb) {
    static VectorDouble const weights = rgb::rec2020.to_xyz_matrix().row(1);
    return weights.dot(rgb);
}
VectorDouble encode(VectorDouble const& display) {
    VectorDouble const light = display / peak;
    double const Y = luminance(light);
    VectorDouble const scene = Y > 0 ? VectorDouble(light * std::pow(Y, 1 / system_gamma - 1)) : light * 0;
    return scene.unaryExpr([](double E) {
        double const e = std::abs(E);
        return std::copysign(e <= 1.0 / 12 ? std::sqrt(3 * e) : a * std::log(12 * e - b) + c, E);
    });
}
VectorDouble decode(VectorDouble const& value) {
    VectorDouble const scene = value.unaryExpr([](double V) {
        double const v = std::abs(V);
        return std::copysign(v <= 0.5 ? v * v / 3 : (std::exp((v - c) / a) + b) / 12, V);
    });
    double const Y = luminance(scene);
    return Y > 0 ? VectorDouble(peak * scene * std::pow(Y, system_gamma - 1)) : scene * 0;
}
}  // namespace hlg

namespace acescc {
constexpr double floor = 0x1p-16, toe = 0x1p-15;
double encode(double L) {
    double const l = L < toe ? floor + std::max(L, 0.0) / 2 : L;
    return (std::log2(l) + 9.72) / 17.52;
}
double decode(double V) {
    double const l = std::exp2(V * 17.52 - 9.72);
    return l < toe ? 2 * (l - floor) : l;
}
}  // namespace acescc

namespace acescct {
constexpr double break_linear = 0.0078125, slope = 10.5402377416545, offset = 0.0729055341958355;
double encode(double L) { return L <= break_linear ? slope * L + offset : (std::log2(L) + 9.72) / 17.52; }
double decode(double V) {
    constexpr double break_encoded = 0.155251141552511;
    return V <= break_encoded ? (V - offset) / slope : std::exp2(V * 17.52 - 9.72);
}
}  // namespace acescct

constexpr double knee = 6.0 / 29;
double lightness(double Y) { return Y > knee * knee * knee ? 116 * std::cbrt(Y) - 16 : Y * 116 / (3 * knee * knee); }
double relative_luminance(double L) {
    double const f = (L + 16) / 116;
    return f > knee ? f * f * f : L * 3 * knee * knee / 116;
}

struct UvPrime {
    double u, v;
};
UvPrime uv_prime(VectorDouble const& xyz) {
    double const d = xyz[0] + 15 * xyz[1] + 3 * xyz[2];
    return {4 * xyz[0] / d, 9 * xyz[1] / d};
}
VectorDouble xyz_of(UvPrime const& c, double Y) {
    return {Y * 9 * c.u / (4 * c.v), Y, Y * (12 - 3 * c.u - 20 * c.v) / (4 * c.v)};
}

VectorDouble to_cie(SpaceCurve curve, VectorDouble const& xyz, VectorDouble const& white) {
    if (curve == SpaceCurve::Lab) {
        VectorDouble const L = xyz.cwiseQuotient(white).unaryExpr([](double t) { return lightness(t); });
        return {L[1], 500 * (L[0] - L[1]) / 116, 200 * (L[1] - L[2]) / 116};
    }
    UvPrime const c = uv_prime(xyz.isZero(0) ? white : xyz), w = uv_prime(white);
    if (curve == SpaceCurve::uvY) return {c.u, c.v, xyz[1]};
    double const L = lightness(xyz[1] / white[1]);
    return {L, 13 * L * (c.u - w.u), 13 * L * (c.v - w.v)};
}

VectorDouble from_cie(SpaceCurve curve, VectorDouble const& value, VectorDouble const& white) {
    if (curve == SpaceCurve::uvY) return xyz_of({value[0], value[1]}, value[2]);
    double const L = value[0];
    if (curve == SpaceCurve::Lab) {
        VectorDouble const all(L + value[1] * 116 / 500, L, L - value[2] * 116 / 200);
        return all.unaryExpr([](double l) { return relative_luminance(l); }).cwiseProduct(white);
    }
    UvPrime const w = uv_prime(white);
    if (L == 0) return VectorDouble::Zero();
    return xyz_of({value[1] / (13 * L) + w.u, value[2] / (13 * L) + w.v}, relative_luminance(L) * white[1]);
}

}  // namespace

VectorDouble ReferenceSpace::from_reference(VectorDouble const& reference) const {
    VectorDouble const v = linear * reference;
    auto const each = [&](auto f) { return VectorDouble(v.unaryExpr(f)); };
    switch (curve) {
        case SpaceCurve::none:
            return v;
        case SpaceCurve::srgb:
            return each([](double L) { return srgb_curve.encode(L); });
        case SpaceCurve::rec2020:
            return each([](double L) { return rec2020_curve.encode(L); });
        case SpaceCurve::pq:
            return each(pq::encode);
        case SpaceCurve::hlg:
            return hlg::encode(v);
        case SpaceCurve::acescc:
            return each(acescc::encode);
        case SpaceCurve::acescct:
            return each(acescct::encode);
        case SpaceCurve::uvY:
        case SpaceCurve::Luv:
        case SpaceCurve::Lab:
            return to_cie(curve, v, to_vector(white));
        default:
            return each([g = 1 / gamma_of(curve)](double L) { return odd_power(L, g); });
    }
}

VectorDouble ReferenceSpace::to_reference(VectorDouble const& value) const {
    auto const each = [&](auto f) { return VectorDouble(value.unaryExpr(f)); };
    auto const decoded = [&]() -> VectorDouble {
        switch (curve) {
            case SpaceCurve::none:
                return value;
            case SpaceCurve::srgb:
                return each([](double V) { return srgb_curve.decode(V); });
            case SpaceCurve::rec2020:
                return each([](double V) { return rec2020_curve.decode(V); });
            case SpaceCurve::pq:
                return each(pq::decode);
            case SpaceCurve::hlg:
                return hlg::decode(value);
            case SpaceCurve::acescc:
                return each(acescc::decode);
            case SpaceCurve::acescct:
                return each(acescct::decode);
            case SpaceCurve::uvY:
            case SpaceCurve::Luv:
            case SpaceCurve::Lab:
                return from_cie(curve, value, to_vector(white));
            default:
                return each([g = gamma_of(curve)](double V) { return odd_power(V, g); });
        }
    };
    return linear.inverse() * decoded();
}

}  // namespace iride
