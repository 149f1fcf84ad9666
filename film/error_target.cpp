// SPDX-License-Identifier: Apache-2.0
#include "film/error_target.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <charconv>
#include <cmath>
#include <limits>

#include "base/diagnostics.h"
#include "colour/difference.h"

namespace iride {

namespace {

constexpr double share_beyond = 0.01;  // of the pixels

// The share of pixels expected beyond `target`.
double expected_beyond(std::vector<double> const& errors, double target) {
    double total = 0;
    for (double e : errors) total += e > 0 ? std::erfc(target / (std::sqrt(2.0) * e)) : 0;
    return total / static_cast<double>(errors.size());
}

}  // namespace

ErrorTarget ErrorTarget::parse(std::string const& text) {
    bool const difference = text.starts_with("de=");
    std::string const number = difference ? text.substr(3) : text;
    double target = 0;
    auto const [end, error] = std::from_chars(number.data(), number.data() + number.size(), target);
    if (error != std::errc() || end != number.data() + number.size() || !(target > 0) || !std::isfinite(target))
        throw InputError({}, "--error",
                         fmt::format("found '{}', allowed: a relative error above 0, or de=D with a CIEDE2000 "
                                     "difference above 0, e.g. 0.01 or de=0.5",
                                     text));
    return {difference ? Kind::colour_difference : Kind::relative, target};
}

void ErrorTarget::set_display(Chromaticity const& white, double exposure) {
    white_ = to_xyz(white, 1);
    exposure_ = exposure;
}

double ErrorTarget::error(Xyz const& m, MatrixDouble const& covariance) const {
    if (!covariance.allFinite()) return std::numeric_limits<double>::infinity();
    if (kind_ == Kind::colour_difference) return colour_difference(m, covariance);
    VectorDouble const mean = to_vector(m);
    constexpr double floor = 0.01;  // as in Film::relative_error()
    return std::sqrt((covariance.diagonal().array() / (mean.array().square() + floor)).mean());
}

double ErrorTarget::colour_difference(Xyz const& mean, MatrixDouble const& covariance) const {
    Eigen::SelfAdjointEigenSolver<MatrixDouble> axes;
    axes.computeDirect(covariance);
    Lab const seen = to_lab(exposure_ * mean, white_);
    double squares = 0;
    for (Eigen::Index k = 0; k < 3; ++k) {
        double const variance = axes.eigenvalues()[k];
        if (!(variance > 0)) continue;  // rounding of a flat ellipsoid
        VectorDouble const step = axes.eigenvectors().col(k) * std::sqrt(3 * variance);
        for (double sign : {1.0, -1.0}) {
            Xyz const off{mean.X + sign * step.x(), mean.Y + sign * step.y(), mean.Z + sign * step.z()};
            squares += square(delta_e_2000(seen, to_lab(exposure_ * off, white_)));
        }
    }
    return std::sqrt(squares / 6);
}

double ErrorTarget::error(Film const& film) const {
    std::vector<double> errors;
    for (int y = 0; y < film.height(); ++y)
        for (int x = 0; x < film.width(); ++x) {
            errors.push_back(error(film.mean(x, y), film.covariance(x, y)));
            if (!std::isfinite(errors.back())) return std::numeric_limits<double>::infinity();
        }
    if (kind_ == Kind::relative) {
        double total = 0;
        for (double e : errors) total += e * e;
        return std::sqrt(total / static_cast<double>(errors.size()));
    }
    double low = 0, high = 1;
    while (expected_beyond(errors, high) > share_beyond) high *= 2;
    for (int i = 0; i < 50; ++i) {
        double const middle = (low + high) / 2;
        (expected_beyond(errors, middle) > share_beyond ? low : high) = middle;
    }
    return high;
}

}  // namespace iride
