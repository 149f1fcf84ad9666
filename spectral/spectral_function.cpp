// SPDX-License-Identifier: Apache-2.0
#include "spectral/spectral_function.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/check.h"

namespace iride {

namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();

double evaluate(ConstantShape const& c, Outside, double) { return c.value; }

double evaluate(BlackbodyShape const& b, Outside, double nm) { return planck_radiance(nm, b.temperature_K); }

double evaluate(TabulatedShape const& t, Outside outside, double nm) {
    bool const before = nm<t.nm.front(), after = nm> t.nm.back();
    if ((before || after) && outside == Outside::zero) return 0;
    if ((before || after) && outside != Outside::extrapolate) return before ? t.value.front() : t.value.back();
    auto const above = std::upper_bound(t.nm.begin(), t.nm.end(), nm);
    auto const last = static_cast<std::ptrdiff_t>(t.nm.size()) - 1;
    auto const i = static_cast<std::size_t>(
        std::clamp<std::ptrdiff_t>(above - t.nm.begin() - 1, 0, std::max<std::ptrdiff_t>(last - 1, 0)));
    if (t.step || t.value.size() == 1) return t.value[i];
    double const f = (nm - t.nm[i]) / (t.nm[i + 1] - t.nm[i]);
    return t.value[i] + f * (t.value[i + 1] - t.value[i]);
}

// sellmeier_squared: n^2 - 1 = c0 + sum c[2i+1] L^2 / (L^2 - c[2i+2]^2)      sellmeier: the same with c[2i+2]
// general:           n^2 = c0 + sum over the first two terms c1 L^c2 / (L^2 - c3^c4) + sum over further c9 L^c10
double evaluate(DispersionShape const& d, Outside outside, double nm) {
    if (outside != Outside::extrapolate) nm = std::clamp(nm, d.valid.min_nm, d.valid.max_nm);
    double const L = nm * 1e-3, L2 = L * L;
    auto const& c = d.coefficients;
    double n2 = c[0];
    if (d.formula == DispersionShape::Formula::general) {
        for (std::size_t i = 1; i + 3 < c.size() && i <= 5; i += 4)
            n2 += c[i] * std::pow(L, c[i + 1]) / (L2 - std::pow(c[i + 2], c[i + 3]));
        for (std::size_t i = 9; i + 1 < c.size(); i += 2) n2 += c[i] * std::pow(L, c[i + 1]);
        return std::sqrt(n2);
    }
    n2 += 1;
    for (std::size_t i = 1; i + 1 < c.size(); i += 2) {
        double const pole = d.formula == DispersionShape::Formula::sellmeier_squared ? c[i + 1] * c[i + 1] : c[i + 1];
        n2 += c[i] * L2 / (L2 - pole);
    }
    return std::sqrt(n2);
}

double evaluate(SigmoidShape const& s, Outside outside, double nm) {
    bool const inside = nm >= visible_range.min_nm && nm <= visible_range.max_nm;
    if (!inside && outside == Outside::zero) return 0;
    if (outside != Outside::extrapolate) nm = std::clamp(nm, visible_range.min_nm, visible_range.max_nm);
    return sigmoid_value(s, nm);
}

}  // namespace

SpectralFunction::SpectralFunction(SpectrumShape shape, Outside outside, std::string name)
    : shape_(std::move(shape)), outside_(outside), name_(std::move(name)) {
    if (auto const* t = std::get_if<TabulatedShape>(&shape_))
        check(!t->value.empty() && t->nm.size() == t->value.size() + (t->step ? 1 : 0) && std::ranges::is_sorted(t->nm),
              "a table of a spectrum is sorted and has a value per wavelength");
}

double SpectralFunction::at(double wavelength_nm) const {
    return scale_ * std::visit([&](auto const& shape) { return evaluate(shape, outside_, wavelength_nm); }, shape_);
}

WavelengthRange SpectralFunction::defined_on() const {
    if (auto const* t = std::get_if<TabulatedShape>(&shape_)) return {t->nm.front(), t->nm.back()};
    if (auto const* d = std::get_if<DispersionShape>(&shape_)) return d->valid;
    if (std::holds_alternative<SigmoidShape>(shape_)) return visible_range;
    return {0, unbounded};
}

std::vector<double> SpectralFunction::knots(WavelengthRange const& range) const {
    std::vector<double> all{range.min_nm, range.max_nm};
    for (double nm = std::ceil(range.min_nm); nm < range.max_nm; ++nm) all.push_back(nm);
    if (auto const* t = std::get_if<TabulatedShape>(&shape_))
        for (double nm : t->nm)
            if (nm > range.min_nm && nm < range.max_nm) all.push_back(nm);
    return all;
}

double SpectralFunction::largest(WavelengthRange const& range) const {
    double most = -unbounded;
    for (double nm : knots(range)) most = std::max(most, at(nm));
    return most;
}

double SpectralFunction::smallest(WavelengthRange const& range) const {
    double least = unbounded;
    for (double nm : knots(range)) least = std::min(least, at(nm));
    return least;
}

double SpectralFunction::integral(WavelengthRange const& range, SpectralFunction const& weight) const {
    std::vector<double> all = knots(range), others = weight.knots(range);
    all.insert(all.end(), others.begin(), others.end());
    std::ranges::sort(all);
    double total = 0;
    for (std::size_t i = 0; i + 1 < all.size(); ++i) {
        // Two-point Gauss rule: exact up to cubics, so for the product of two linear pieces; never touches a knot.
        double const half = (all[i + 1] - all[i]) / 2, middle = (all[i + 1] + all[i]) / 2;
        double const offset = half / std::sqrt(3.0);
        total += half *
                 (at(middle - offset) * weight.at(middle - offset) + at(middle + offset) * weight.at(middle + offset));
    }
    return total;
}

SpectralFunction SpectralFunction::scaled(double factor) const {
    SpectralFunction copy = *this;
    copy.scale_ *= factor;
    return copy;
}

SpectralFunction SpectralFunction::with_outside(Outside outside) const {
    SpectralFunction copy = *this;
    copy.outside_ = outside;
    return copy;
}

double sigmoid_value(SigmoidShape const& s, double wavelength_nm) {
    double const t = (2 * wavelength_nm - visible_range.min_nm - visible_range.max_nm) / visible_range.width();
    double const x = (s.a * t + s.b) * t + s.c;
    return 0.5 + 0.5 * x / std::hypot(1.0, x);  // hypot: x^2 may overflow
}

double planck_radiance(double wavelength_nm, double temperature_K) {
    double const lambda = wavelength_nm * 1e-9;
    constexpr double c1L = 2 * planck_constant * speed_of_light * speed_of_light;
    // 1e-9: per metre of wavelength -> per nanometre.
    return 1e-9 * c1L / std::pow(lambda, 5) / std::expm1(second_radiation_constant / (lambda * temperature_K));
}

}  // namespace iride
