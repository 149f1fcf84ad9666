// SPDX-License-Identifier: Apache-2.0
#include "colour/config_check.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/diagnostics.h"
#include "base/random.h"
#include "colour/difference.h"
#include "colour/lab.h"
#include "colour/reference_space.h"

namespace iride {

namespace {

using Colours = std::vector<VectorDouble>;

// Below it, a power law turns the rounding of a float matrix into errors that no picture shows.
constexpr double darkest = 0x1p-10;

// Scene colours beyond the white; differences are then seen under a white as bright.
constexpr double bright = 16;

// What an error counts as that is infinite or NaN, which JSON cannot say.
constexpr double not_finite = std::numeric_limits<double>::max();

// XYZ and white of a reference space, for colour differences.
struct Reference {
    MatrixDouble to_xyz;
    Xyz white;
    explicit Reference(bool display)
        : to_xyz(display ? MatrixDouble(MatrixDouble::Identity()) : rgb::aces2065_1.to_xyz_matrix()),
          white(iride::to_xyz(display ? rgb::rec709.white : rgb::aces2065_1.white, 1)) {}
    VectorDouble white_value() const { return to_xyz.inverse() * to_vector(white); }
    double difference(VectorDouble const& a, VectorDouble const& b) const {
        return delta_e_2000(to_lab(iride::to_xyz(to_xyz * a), white), to_lab(iride::to_xyz(to_xyz * b), white));
    }
};

VectorDouble as_float(VectorDouble const& v) { return v.cast<float>().cast<double>(); }

Colours converted(ColourTransform const& transform, Colours const& colours) {
    std::vector<float> numbers;
    for (VectorDouble const& c : colours)
        for (double const v : c) numbers.push_back(static_cast<float>(v));
    transform.apply(numbers);
    Colours result;
    for (std::size_t i = 0; i < numbers.size(); i += 3)
        result.push_back(Eigen::Vector3f(numbers[i], numbers[i + 1], numbers[i + 2]).cast<double>());
    return result;
}

bool is_cie(ReferenceSpace const& space) { return space.white.Y > 0; }

// From linear numbers of which 0 .. 1 are wanted to the reference: the space's own RGB, or AP1 for XYZ and its kin.
MatrixDouble gamut(ReferenceSpace const& space) {
    if (is_cie(space)) return rgb::aces2065_1.from_xyz_matrix() * rgb::acescg.to_xyz_matrix();
    return space.linear.inverse();
}

// A grid, random colours that reach into the dark, greys, black and white: as floats hold them, in the reference.
Colours samples(ReferenceSpace const& space) {
    MatrixDouble const to_reference = gamut(space);
    Colours all;
    auto const add = [&](VectorDouble const& linear) { all.push_back(as_float(to_reference * linear)); };
    constexpr int steps = 8, random_count = 4096, grey_count = 64;
    auto const level = [](double t) { return darkest + (1 - darkest) * t; };
    for (int r = 0; r <= steps; ++r)
        for (int g = 0; g <= steps; ++g)
            for (int b = 0; b <= steps; ++b)
                add({level(double(r) / steps), level(double(g) / steps), level(double(b) / steps)});
    for (std::uint64_t i = 0; i < random_count; ++i) {
        auto const dark = [i](std::uint64_t component) {
            double const u = static_cast<double>(hash_words(i, component) >> 11) * 0x1p-53;
            return u * u * u;
        };
        add({level(dark(0)), level(dark(1)), level(dark(2))});
    }
    VectorDouble const white = Reference(space.display_referred).white_value();
    for (int i = 0; i <= grey_count; ++i) all.push_back(as_float(white * level(double(i) / grey_count)));
    all.push_back(VectorDouble::Zero());
    // ACEScc clips negative ACES2065-1 by definition, though it would be positive AP1.
    if (space.curve == SpaceCurve::acescc) std::erase_if(all, [](VectorDouble const& c) { return c.minCoeff() < 0; });
    return all;
}

Colours samples_at(double exposure, ReferenceSpace const& space) {
    Colours all;
    for (VectorDouble const& c : samples(space)) all.push_back(as_float(exposure * c));
    return all;
}

Colours negative_samples(ReferenceSpace const& space) {
    MatrixDouble const to_reference = space.linear.inverse();
    Colours all;
    for (double const low : {-0.01, -0.1, -0.5})
        for (VectorDouble const& rest : {VectorDouble(0, .5, .3), VectorDouble(.5, 0, .2), VectorDouble(.2, .9, 0)})
            all.push_back(as_float(to_reference * rest.unaryExpr([low](double v) { return v == 0 ? low : v; })));
    return all;
}

std::string negative_handling(ReferenceSpace const& space, ColourTransform const& there, ColourTransform const& back) {
    Colours const given = negative_samples(space), value = converted(there, given), again = converted(back, value);
    constexpr double same = 1e-3;  // of the white: what a clamp to 0 would exceed
    bool kept = true;
    for (std::size_t i = 0; i < given.size(); ++i) {
        if (!value[i].allFinite() || !again[i].allFinite()) return "not finite";
        kept = kept && (again[i] - given[i]).cwiseAbs().maxCoeff() < same;
    }
    return kept ? "kept" : "clamped";
}

std::string nan_handling(ColourTransform const& there) {
    double const nan = std::nan("");
    for (VectorDouble const& v : converted(there, {{nan, .2, .3}, {.2, nan, .3}, {.2, .3, nan}}))
        if (!v.hasNaN()) return "lost";
    return "kept";
}

double tolerance_of(SpaceCurve curve) {
    switch (curve) {
        case SpaceCurve::none:
        case SpaceCurve::uvY:
            return 1e-5;  // some ten roundings of floats near 1; a wrong fifth digit of a matrix is more
        case SpaceCurve::Luv:
        case SpaceCurve::Lab:
            return 2e-3;  // the same for numbers of some hundreds
        default:
            return 5e-5;  // OpenColorIO's sRGB joins its pieces smoothly, the standard's rounded constants do
                          // not: 1.3e-5
    }
}

SpaceCheck check_space(ColourConfig const& config, ConfigSpace const& named, ReferenceSpace const& space) {
    std::string const role = space.display_referred ? "cie_xyz_d65_interchange" : "aces_interchange";
    ColourTransform const there = config.between(role, named.name), back = config.between(named.name, role);
    Reference const reference(space.display_referred);
    SpaceCheck check{named.name, space.name, 0, tolerance_of(space.curve), 0, 0, 0, {}, {}, {}, true};
    auto const larger = [&](double& maximum, double error) {
        // A comparison with NaN is false: what is not finite must not pass for small.
        if (!std::isfinite(error)) check.ok = false, error = not_finite;
        maximum = std::max(maximum, error);
    };
    auto const compare = [&](Colours const& given, double exposure) {
        Colours const value = converted(there, given), again = converted(back, value);
        auto const difference = [&](VectorDouble const& a, VectorDouble const& b) {
            return reference.difference(a / exposure, b / exposure);
        };
        for (std::size_t i = 0; i < given.size(); ++i) {
            VectorDouble const error = value[i] - space.from_reference(given[i]);
            if (exposure == 1) larger(check.max_error, error.hasNaN() ? std::nan("") : error.cwiseAbs().maxCoeff());
            larger(check.delta_e_2000_max, difference(space.to_reference(value[i]), given[i]));
            larger(check.round_trip_delta_e_2000_max, difference(again[i], given[i]));
        }
    };
    compare(samples(space), 1);
    if (!space.display_referred) compare(samples_at(bright, space), bright);
    VectorDouble const white = reference.white_value();
    VectorDouble const got = converted(there, {white}).front();
    larger(check.white_error, got.hasNaN() ? std::nan("") : (got - space.from_reference(white)).cwiseAbs().maxCoeff());
    check.negative = negative_handling(space, there, back);
    check.nan = nan_handling(there);
    check.ok = check.ok && std::max(check.max_error, check.white_error) <= check.tolerance &&
               std::max(check.delta_e_2000_max, check.round_trip_delta_e_2000_max) < tolerable_delta_e &&
               check.negative != "not finite";
    return check;
}

SpaceCheck checked_or_failed(ColourConfig const& config, ConfigSpace const& named, ReferenceSpace const& space) {
    try {
        return check_space(config, named, space);
    } catch (InputError const& e) {
        return {named.name, space.name, not_finite, tolerance_of(space.curve),
                not_finite, not_finite, not_finite, "not finite",
                "lost",     e.what(),   false};
    }
}

}  // namespace

ConfigCheck check_config(ColourConfig const& config) {
    if (!config.has_role("aces_interchange"))
        throw InputError({config.path().string()}, "roles",
                         "the role aces_interchange is missing: it names the space that is ACES2065-1, from which the "
                         "others are checked");
    bool const displays = config.has_role("cie_xyz_d65_interchange");
    ConfigCheck result{{}, {}, true};
    for (ConfigSpace const& named : config.spaces()) {
        std::vector<std::string> names{named.name};
        names.insert(names.end(), named.aliases.begin(), named.aliases.end());
        ReferenceSpace const* const space = find_reference_space(names, named.display_referred);
        if (named.is_data)
            result.unchecked.push_back({named.name, "data, no colour"});
        else if (!space)
            result.unchecked.push_back({named.name, "not recognised by its name or aliases"});
        else if (space->display_referred && !displays)
            result.unchecked.push_back({named.name, "the config has no role cie_xyz_d65_interchange"});
        else
            result.spaces.push_back(checked_or_failed(config, named, *space));
    }
    auto const passes = [](SpaceCheck const& check) { return check.ok; };
    result.ok = result.spaces.size() > 1 && std::ranges::all_of(result.spaces, passes);
    return result;
}

}  // namespace iride
