// SPDX-License-Identifier: Apache-2.0
// Packets of wavelengths: each lane has the stated density, all lanes the same one, every lane sits in its cell, and a
// spectrum read there is the described function.
#include <array>
#include <catch2/catch.hpp>

#include "base/sampler.h"
#include "colour/observer.h"
#include "colour/rgb_to_spectrum.h"
#include "spectral/spectrum.h"
#include "support/statistics.h"

using namespace iride;

namespace {

WavelengthSampler sampler(WavelengthRange const& range, SpectralFunction const& importance = visible_importance()) {
    return WavelengthSampler(range, importance, WavelengthGrid::covering(range));
}

SpectralFunction table(std::vector<double> nm, std::vector<double> value, Outside outside = Outside::zero) {
    return SpectralFunction(TabulatedShape{std::move(nm), std::move(value)}, outside);
}

// Importances as a scene may ask for: the default, flat, steep, and one that vanishes over half of the range.
std::vector<SpectralFunction> importances() {
    return {visible_importance(), SpectralFunction::constant(1), table({360, 830}, {0.01, 3}),
            table({360, 589, 590, 591, 830}, {.1, .1, 4, .1, .1}), table({360, 500, 501, 830}, {1, 1, 0, 0})};
}

constexpr std::uint64_t seed = 20240611;
float random_number(std::uint32_t i) { return to_unit_float(static_cast<std::uint32_t>(hash_words(seed, i) >> 32)); }

}  // namespace

TEST_CASE("the grid covers its range by whole nanometres", "[unit]") {
    auto const covers = [](WavelengthRange const& range, int first, int count) {
        WavelengthGrid const grid = WavelengthGrid::covering(range);
        return grid.first_nm == first && grid.count == count;
    };
    CHECK(covers({360, 830}, 360, 471));
    CHECK(covers({400.2, 700.9}, 400, 302));
    CHECK(covers({550, 550}, 550, 2));  // a cell at least
}

// The range is 1 / p summed over steps of u, and p summed over the range is 1: both for the very density stated.
TEST_CASE("the density integrates to one over the whole range", "[law]") {
    for (WavelengthRange const& range : {visible_range, WavelengthRange{412.5, 691.25}, WavelengthRange{550, 551}})
        for (SpectralFunction const& importance : importances()) {
            WavelengthSampler const s = sampler(range, importance);
            constexpr int steps = 1 << 14;
            double width = 0, total = 0, last = range.min_nm;
            for (int i = 0; i < steps; ++i) {
                Wavelengths const w = s.sample((static_cast<float>(i) + 0.5f) / steps);
                width += 1 / static_cast<double>(w.density[0]) / steps;
                CHECK(w.nm[0] >= last);
                total += static_cast<double>(w.density[0]) * (w.nm[0] - last);
                last = w.nm[0];
            }
            total += static_cast<double>(s.sample(one_minus_epsilon).density[0]) * (range.max_nm - last);
            CHECK(width == Approx(range.width()).epsilon(1e-5));
            CHECK(total == Approx(1).epsilon(2e-3));  // rectangles, against a density that steps
        }
}

// Knots of the map share the importance into equal parts: in each its mean is the density, which is constant there.
// Fails for the importance at either end of a segment (the ramp's first one reaches from 360 to 364 nm).
TEST_CASE("the density is the importance, normalised, in the mean of each segment of the map", "[law]") {
    constexpr int segments = WavelengthSampler::segment_count;
    for (SpectralFunction const& importance : {visible_importance(), table({360, 830}, {0.01, 3})}) {
        WavelengthSampler const s = sampler(visible_range, importance);
        double const norm = importance.integral(visible_range);
        for (int i = 0; i < segments; ++i) {
            Wavelengths const low = s.sample(static_cast<float>(i) / segments);
            double const end = i + 1 < segments
                                   ? static_cast<double>(s.sample(static_cast<float>(i + 1) / segments).nm[0])
                                   : visible_range.max_nm;
            WavelengthRange const segment{low.nm[0], end};
            double const share = importance.integral(segment) / norm;
            INFO(segment.min_nm << " .. " << segment.max_nm);
            // A wavelength as float is known to 3e-5 nm, two of them .15 nm apart or more.
            CHECK(share == Approx(1.0 / segments).epsilon(1e-3));
            CHECK(static_cast<double>(low.density[0]) == Approx(share / segment.width()).epsilon(1e-3));
        }
    }
}

TEST_CASE("wavelengths of no importance are reached at the floor", "[law]") {
    WavelengthSampler const s = sampler(visible_range, table({360, 500, 501, 830}, {1, 1, 0, 0}));
    Wavelengths const w = s.sample(one_minus_epsilon);
    CHECK(w.nm[0] == Approx(830).margin(0.5));
    CHECK(w.density[0] > 0.9e-3 / 470);
    CHECK(sampler({900, 1000}).sample(0.5f).nm[0] == Approx(950).margin(0.5));  // nothing to see: uniform
}

// The distribution that the map means: the floored importance's quantiles, computed here by a sum at 1/64 nm, with the
// probability spread evenly between them. Shares of the bins [360 + 5 i, 365 + 5 i).
std::vector<double> bin_shares(SpectralFunction const& importance, int bins) {
    double const mean = importance.integral(visible_range) / visible_range.width();
    constexpr int per_nm = 64, parts = 470 * per_nm;
    std::vector<double> cumulative{0};
    for (int i = 0; i < parts; ++i)  // the floor: 1e-3 of the mean, where the importance has less
        cumulative.push_back(cumulative.back() + std::max(importance.at(360 + (i + 0.5) / per_nm), 1e-3 * mean));
    auto const quantile = [&](double share) {
        auto const above = std::ranges::lower_bound(cumulative, share * cumulative.back());
        auto const i = std::max<std::ptrdiff_t>(1, above - cumulative.begin());
        double const low = cumulative[static_cast<std::size_t>(i - 1)], high = cumulative[static_cast<std::size_t>(i)];
        return 360 + (static_cast<double>(i - 1) + (share * cumulative.back() - low) / (high - low)) / per_nm;
    };
    constexpr int segments = WavelengthSampler::segment_count;
    TabulatedShape density{{}, {}, true};
    for (int k = 0; k <= segments; ++k) density.nm.push_back(quantile(static_cast<double>(k) / segments));
    for (std::size_t k = 0; k < segments; ++k)
        density.value.push_back(1 / (density.nm[k + 1] - density.nm[k]) / segments);
    SpectralFunction const function(std::move(density), Outside::zero);
    std::vector<double> shares;
    for (int b = 0; b < bins; ++b) shares.push_back(function.integral({360.0 + 5 * b, 365.0 + 5 * b}));
    return shares;
}

// 1e6 packets, 94 bins of 5 nm; each lane by itself, at the level 1e-4 / lanes. Fails if lanes i > 0 share the hero's
// density, if the density is that of bins shifted by 1 nm, or if one lane's rotation is missing its factor.
TEST_CASE("every lane has the importance as its marginal distribution", "[law]") {
    for (SpectralFunction const& importance : importances()) {
        WavelengthSampler const s = sampler(visible_range, importance);
        constexpr int bins = 94, packets = 1000000;
        std::vector<std::array<double, bins>> count(lane_count);
        for (std::uint32_t i = 0; i < packets; ++i) {
            Wavelengths const w = s.sample(random_number(i));
            for (std::size_t lane = 0; lane < lane_count; ++lane) {
                int const k = static_cast<int>(lane), bin = std::min(static_cast<int>((w.nm[k] - 360) / 5), bins - 1);
                ++count[lane][static_cast<std::size_t>(bin)];
            }
        }
        std::vector<double> const shares = bin_shares(importance, bins);
        for (std::size_t lane = 0; lane < lane_count; ++lane) {
            test::ChiSquared verdict;
            for (std::size_t b = 0; b < bins; ++b) verdict.add(packets * shares[b], count[lane][b]);
            INFO("lane " << lane);
            CHECK(verdict.p_value() > 1e-4 / lane_count);
        }
    }
}

// Rotation by one lane maps the packet onto itself. Fails if the rotation is in wavelength instead of u.
TEST_CASE("every lane could have been the hero", "[law]") {
    WavelengthSampler const s = sampler(visible_range);
    for (int k = 0; k < 64; ++k) {
        float const u = static_cast<float>(k) / (64.0f * lane_count);  // exact in float, as are the rotations
        Wavelengths const a = s.sample(u);
        for (int lane = 0; lane < lane_count; ++lane) {
            Wavelengths const b = s.sample(u + static_cast<float>(lane) / lane_count);
            CHECK(b.nm[0] == a.nm[lane]);
            CHECK(b.density[0] == a.density[lane]);
            CHECK(b.cell[0] == a.cell[lane]);
            CHECK(b.fraction[0] == a.fraction[lane]);
        }
    }
}

TEST_CASE("every lane lies in its cell and in the range", "[law]") {
    for (WavelengthRange const& range :
         {visible_range, WavelengthRange{400.3, 699.7}, WavelengthRange{550.25, 550.5}, WavelengthRange{800, 2500}}) {
        WavelengthGrid const grid = WavelengthGrid::covering(range);
        WavelengthSampler const s(range, visible_importance(), grid);
        auto const check_packet = [&](float u) {
            Wavelengths const w = s.sample(u);
            for (int i = 0; i < lane_count; ++i) {
                bool const inside = w.nm[i] >= static_cast<float>(range.min_nm) &&
                                    w.nm[i] <= static_cast<float>(range.max_nm) && w.cell[i] >= 0 &&
                                    w.cell[i] <= grid.count - 2 && w.fraction[i] >= 0 && w.fraction[i] <= 1;
                float const put_together = static_cast<float>(grid.first_nm + w.cell[i]) + w.fraction[i];
                if (!inside || std::abs(put_together - w.nm[i]) > 2e-4f || !(w.density[i] > 0)) {
                    INFO("u " << u << " lane " << i << ": " << w.nm[i]);
                    CHECK(false);
                }
            }
        };
        check_packet(0);
        check_packet(one_minus_epsilon);
        for (std::uint32_t i = 0; i < 100000; ++i) check_packet(random_number(i));
        SUCCEED();
    }
}

// Knots at whole nanometres: to rounding (a lane's place is known to 6e-5 nm). Fails with a look-up of the nearest
// knot.
TEST_CASE("a spectrum read in the loop is the table's linear interpolation", "[law]") {
    SpectralFunction const f = table({360, 400, 401, 530, 640, 641, 830}, {0, 1, .25, 2, .5, 1, 0});
    WavelengthGrid const grid = WavelengthGrid::covering(visible_range);
    Spectrum<dim::none> const spectrum(f, grid);
    WavelengthSampler const s = sampler(visible_range);
    double worst = 0;
    for (std::uint32_t i = 0; i < 20000; ++i) {
        Wavelengths const w = s.sample(random_number(i));
        Lanes const value = spectrum.at(w);
        for (int lane = 0; lane < lane_count; ++lane)
            worst = std::max(worst, std::abs(value[lane] - f.at(static_cast<double>(w.nm[lane]))));
    }
    CHECK(worst < 1e-6);  // slope .75 per nm at most, values of order 1 in float
    Spectrum<dim::none> const constant(SpectralFunction::constant(0.3), grid);
    CHECK(constant.is_constant());
    CHECK(constant.at(s.sample(0.4f))[0] == 0.3f);
}

// A bend of slope 1 -> -1 at a half nanometre: a quarter of the change of slope is lost at its tip, nothing elsewhere.
TEST_CASE("resampling costs at most a quarter of the change of slope", "[law]") {
    SpectralFunction const tent = table({400, 500.5, 601}, {0, 100.5, 0});
    WavelengthGrid const grid = WavelengthGrid::covering(visible_range);
    Spectrum<dim::none> const spectrum(tent, grid);
    auto const read = [&](double nm) {
        Wavelengths w{};
        w.cell = LaneIndex{} + (static_cast<int>(nm) - grid.first_nm);
        w.fraction = LaneRegister{} + static_cast<float>(nm - std::floor(nm));
        return static_cast<double>(spectrum.at(w)[0]);
    };
    CHECK(tent.at(500.5) - read(500.5) == Approx(0.25 * 2).margin(1e-4));
    for (double nm = 480; nm < 520; nm += 0.0625) {
        CHECK(tent.at(nm) - read(nm) <= 0.5 + 1e-4);
        CHECK(tent.at(nm) - read(nm) >= -1e-4);
    }
}

// The first reason for eight lanes: the standard deviations stated in spectral/wavelengths.cpp, by quadrature over u.
// Lanes drawn independently have .28, .29, .58; a single 1 / cosh^2 has .0193, .0055, .0689 and fails.
TEST_CASE("eight lanes leave little noise in the XYZ of white", "[law]") {
    if (lane_count != 8) return;
    WavelengthSampler const s = sampler(visible_range);
    Observer const& eye = cie1931_2deg();
    constexpr int steps = 1 << 15;
    Eigen::Vector3d sum(0, 0, 0), sum2(0, 0, 0);
    for (int i = 0; i < steps; ++i) {
        Wavelengths const w = s.sample((static_cast<float>(i) + 0.5f) / steps);
        Eigen::Vector3d v(0, 0, 0);
        for (int lane = 0; lane < lane_count; ++lane) {
            double const nm = w.nm[lane];
            v += to_vector(eye.at(nm)) * unit_d65().at(nm) /
                 (static_cast<double>(w.density[lane]) * eye.ybar_integral * lane_count);
        }
        sum += v / steps;
        sum2 += v.cwiseProduct(v) / steps;
    }
    Eigen::Vector3d const deviation = (sum2 - sum.cwiseProduct(sum)).cwiseMax(0).cwiseSqrt();
    CHECK(deviation[0] < 0.0058);
    CHECK(deviation[1] < 0.0020);
    CHECK(deviation[2] < 0.0119);
    CHECK((sum - to_vector(eye.integrate(unit_d65()))).cwiseAbs().maxCoeff() < 1e-5);  // and no bias
}
