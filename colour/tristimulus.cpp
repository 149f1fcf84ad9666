// SPDX-License-Identifier: Apache-2.0
#include "colour/tristimulus.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/check.h"
#include "base/diagnostics.h"
#include "spectral/interpolation.h"

namespace iride {

namespace {

[[noreturn]] void fail(SpectralFunction const& f, std::string const& message) {
    throw InputError({}, f.name(), message);
}

// Wavelengths and the width [nm] that each stands for.
struct Points {
    std::vector<double> nm, width;
};

std::vector<double> whole_nanometres(WavelengthRange const& range) {
    std::vector<double> nm;
    for (double x = std::ceil(range.min_nm); x <= range.max_nm; ++x) nm.push_back(x);
    return nm;
}

// Each width is half the distance between the neighbours; at both ends the whole distance to the one neighbour, as in
// a plain sum at equal steps.
Points with_widths(std::vector<double> nm) {
    Points points{std::move(nm), {}};
    std::size_t const last = points.nm.size() - 1;
    for (std::size_t i = 0; i <= last; ++i) {
        std::size_t const below = i == 0 ? 0 : i - 1, above = i == last ? last : i + 1;
        double const distance = points.nm[above] - points.nm[below];
        points.width.push_back(last == 0 ? 1 : i == 0 || i == last ? distance : distance / 2);
    }
    return points;
}

// Where a spectrum is summed: see the head of the header.
Points points_of(SpectralFunction const& f, WavelengthRange const& domain) {
    auto const* table = std::get_if<TabulatedShape>(&f.shape());
    if (!table) return with_widths(whole_nanometres(domain));
    std::vector<double> own;
    for (double nm : table->nm)
        if (domain.min_nm <= nm && nm <= domain.max_nm) own.push_back(nm);
    if (table->summation == Summation::tabulated) {
        if (own.empty()) fail(f, "has no wavelength of its own in the observer's domain");
        return with_widths(std::move(own));
    }
    std::vector<double> all = whole_nanometres(domain);
    bool const fine =
        std::adjacent_find(own.begin(), own.end(), [](double a, double b) { return b - a < 1; }) != own.end();
    if (!fine) return with_widths(std::move(all));
    all.insert(all.end(), own.begin(), own.end());
    std::ranges::sort(all);
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return with_widths(std::move(all));
}

// f xbar d(lambda) at every point, and the points.
struct Products {
    std::vector<double> nm;
    std::vector<Xyz> xyz;
    Xyz total;
};

Products products(SpectralFunction const& f, Observer const& observer) {
    Points points = points_of(f, observer.ybar.defined_on());
    Products result{std::move(points.nm), {}, {}};
    for (std::size_t i = 0; i < result.nm.size(); ++i) {
        double const nm = result.nm[i], value = f.at(nm);
        if (!std::isfinite(value)) fail(f, fmt::format("is not finite at {:g} nm", nm));
        if (value < 0) fail(f, fmt::format("is negative at {:g} nm: {:g}", nm, value));
        result.xyz.push_back(value * points.width[i] * observer.at(nm));
        result.total = result.total + result.xyz.back();
    }
    if (!(result.total.Y > 0) || !std::isfinite(result.total.Y)) {
        WavelengthRange const own = f.defined_on(), domain = observer.ybar.defined_on();
        fail(f, fmt::format("gives Y = {:g}: it is defined on {:g} .. {:g} nm, the observer on {:g} .. {:g} nm",
                            result.total.Y, own.min_nm, own.max_nm, domain.min_nm, domain.max_nm));
    }
    return result;
}

double ybar_sum(Observer const& observer) { return products(SpectralFunction::constant(1), observer).total.Y; }

}  // namespace

Xyz xyz_of_light(SpectralFunction const& radiance, Observer const& observer) {
    return 1 / ybar_sum(observer) * products(radiance, observer).total;
}

double luminance_of(SpectralFunction const& radiance, Observer const& observer) {
    return maximum_luminous_efficacy * products(radiance, observer).total.Y;
}

TristimulusWeights::TristimulusWeights(SpectralFunction const& illuminant, Observer const& observer) {
    Products sums = products(illuminant, observer);
    double const k = 1 / sums.total.Y;
    nm_ = std::move(sums.nm);
    weight_ = std::move(sums.xyz);
    for (Xyz& w : weight_) w = k * w;
    white_ = k * sums.total;
}

Xyz TristimulusWeights::of(SpectralFunction const& factor) const {
    Xyz sum;
    for (std::size_t i = 0; i < nm_.size(); ++i) sum = sum + factor.at(nm_[i]) * weight_[i];
    return sum;
}

Xyz TristimulusWeights::of(std::span<double const> factor) const {
    check(factor.size() == weight_.size(), "a factor has a value per weight");
    Xyz sum;
    for (std::size_t i = 0; i < weight_.size(); ++i) sum = sum + factor[i] * weight_[i];
    return sum;
}

Xyz TristimulusWeights::of_measured(SpectralFunction const& factor) const {
    auto const* table = std::get_if<TabulatedShape>(&factor.shape());
    double const step = table && !table->step ? equal_step(table->nm) : 0;
    if (table == nullptr || table->nm.size() < 3 || (step != 5 && step != 10 && step != 20)) return of(factor);
    std::vector<double> values;
    for (double nm : table->nm) values.push_back(factor.at(nm));
    return at_steps(table->nm.front(), table->nm.back(), step).of(values);
}

TristimulusWeights TristimulusWeights::at_steps(double first_nm, double last_nm, double step_nm) const {
    double const intervals = (last_nm - first_nm) / step_nm;
    if (!(first_nm > 0 && step_nm > 0 && intervals >= 2) || intervals != std::floor(intervals) || intervals > 1e6)
        throw InputError({}, "",
                         fmt::format("weights from {:g} to {:g} nm in steps of {:g}: at least three equally spaced "
                                     "wavelengths are wanted",
                                     first_nm, last_nm, step_nm));
    TristimulusWeights result;
    auto const last = static_cast<std::size_t>(intervals);
    for (std::size_t i = 0; i <= last; ++i) result.nm_.push_back(first_nm + step_nm * static_cast<double>(i));
    result.weight_.resize(last + 1);
    result.white_ = white_;
    auto const share = [&](std::size_t at, double part, Xyz const& w) {
        result.weight_[at] = result.weight_[at] + part * w;
    };
    for (std::size_t i = 0; i < nm_.size(); ++i) {
        double const place = std::clamp((nm_[i] - first_nm) / step_nm, 0.0, intervals);  // beyond: the end value
        std::size_t const cell = std::min(static_cast<std::size_t>(place), last - 1);
        if (cell == 0 || cell == last - 1) {
            std::size_t const from = cell == 0 ? 0 : last - 2;
            auto const part = lagrange_quadratic(place - static_cast<double>(from));
            for (std::size_t j = 0; j < part.size(); ++j) share(from + j, part[j], weight_[i]);
        } else {
            auto const part = lagrange_cubic(place - static_cast<double>(cell - 1));
            for (std::size_t j = 0; j < part.size(); ++j) share(cell - 1 + j, part[j], weight_[i]);
        }
    }
    return result;
}

}  // namespace iride
