// SPDX-License-Identifier: Apache-2.0
#include "colour/reference_space.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "colour/cie_space.h"
#include "colour/transfer_function.h"

namespace iride {

namespace {

double odd_power(double x, double exponent) { return std::copysign(std::pow(std::abs(x), exponent), x); }

// Exponent of a power law that is no TransferFunction.
double gamma_of(SpaceCurve curve) { return curve == SpaceCurve::gamma22 ? 2.2 : 2.6; }

constexpr double pq_peak = 100;  // L = 1 is a hundredth of the curve's 10000 cd/m^2

// On a display of 1000 cd/m^2; its system gamma stands between the light and the camera's curve. [ITU-R BT.2100]
namespace hlg {
constexpr double system_gamma = 1.2, peak = 10;

double luminance(VectorDouble const& rgb) {
    static VectorDouble const weights = rgb::rec2020.to_xyz_matrix().row(1);
    return weights.dot(rgb);
}
VectorDouble encode(VectorDouble const& display) {
    VectorDouble const light = display / peak;
    double const Y = luminance(light);
    if (Y <= 0) return VectorDouble::Zero();
    VectorDouble const scene = light * std::pow(Y, 1 / system_gamma - 1);
    return scene.unaryExpr([](double E) { return iride::encode(TransferFunction::hlg, E); });
}
VectorDouble decode(VectorDouble const& value) {
    VectorDouble const scene = value.unaryExpr([](double V) { return iride::decode(TransferFunction::hlg, V); });
    double const Y = luminance(scene);
    if (Y <= 0) return VectorDouble::Zero();
    return peak * scene * std::pow(Y, system_gamma - 1);
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

TransferFunction transfer_function(SpaceCurve curve) {
    switch (curve) {
        case SpaceCurve::srgb:
            return TransferFunction::srgb;
        case SpaceCurve::rec2020:
            return TransferFunction::rec2020;
        case SpaceCurve::adobe:
            return TransferFunction::adobe_rgb;
        case SpaceCurve::bt1886:
            return TransferFunction::bt1886;
        default:
            return TransferFunction::linear;
    }
}

CieSpace const& cie_space(SpaceCurve curve) {
    return *find_cie_space(curve == SpaceCurve::uvY ? "uvY" : curve == SpaceCurve::Luv ? "Luv" : "Lab");
}

}  // namespace

VectorDouble ReferenceSpace::from_reference(VectorDouble const& reference) const {
    VectorDouble const v = linear * reference;
    auto const each = [&](auto f) { return VectorDouble(v.unaryExpr(f)); };
    switch (curve) {
        case SpaceCurve::gamma22:
        case SpaceCurve::gamma26:
            return each([g = 1 / gamma_of(curve)](double L) { return odd_power(L, g); });
        case SpaceCurve::pq:
            return each([](double L) { return encode(TransferFunction::pq, std::max(L, 0.0) / pq_peak); });
        case SpaceCurve::hlg:
            return hlg::encode(v);
        case SpaceCurve::acescc:
            return each(acescc::encode);
        case SpaceCurve::acescct:
            return each(acescct::encode);
        case SpaceCurve::uvY:
        case SpaceCurve::Luv:
        case SpaceCurve::Lab: {
            CieSpace::Triple const c = cie_space(curve).from_xyz(to_xyz(v), white);
            return {c[0], c[1], c[2]};
        }
        default:
            return each([f = transfer_function(curve)](double L) { return encode(f, L); });
    }
}

VectorDouble ReferenceSpace::decoded(VectorDouble const& value) const {
    auto const each = [&](auto f) { return VectorDouble(value.unaryExpr(f)); };
    switch (curve) {
        case SpaceCurve::gamma22:
        case SpaceCurve::gamma26:
            return each([g = gamma_of(curve)](double V) { return odd_power(V, g); });
        case SpaceCurve::pq:
            return each([](double V) { return pq_peak * decode(TransferFunction::pq, V); });
        case SpaceCurve::hlg:
            return hlg::decode(value);
        case SpaceCurve::acescc:
            return each(acescc::decode);
        case SpaceCurve::acescct:
            return each(acescct::decode);
        case SpaceCurve::uvY:
        case SpaceCurve::Luv:
        case SpaceCurve::Lab:
            return to_vector(cie_space(curve).to_xyz({value[0], value[1], value[2]}, white));
        default:
            return each([f = transfer_function(curve)](double V) { return decode(f, V); });
    }
}

VectorDouble ReferenceSpace::to_reference(VectorDouble const& value) const { return linear.inverse() * decoded(value); }

}  // namespace iride
