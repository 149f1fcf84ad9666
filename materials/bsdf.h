// SPDX-License-Identifier: Apache-2.0
// The contract of a scattering model at one point and one packet of wavelengths.
//
//   wo   towards the viewer, wi towards the light: both unit, away from the surface, in the local frame (z = normal;
//        for dielectrics z points out of the body, for opaque models it is turned to the side of wo)
//   f    the value, per steradian; radiance leaving along wo = integral of f |cos wi| L(wi)
//   p    density of the directions that sample() draws, per steradian of wi, for each lane as the hero
//
// A Dirac lobe has no density and evaluate() does not see it. evaluate() returns value and density together: they share
// their terms. A sample carries weight = f |cos| / p_hero and reach = p_lane / p_hero, the ratio that the lane mixture
// needs; reach is 0 in lanes for which the direction is impossible, as after a dispersive refraction. Samples are built
// in place (std::in_place): a copy of what was just stored piece by piece stalls the processor.
#pragma once

#include <concepts>
#include <optional>
#include <type_traits>
#include <variant>

#include "base/sampler.h"
#include "base/vector.h"
#include "spectral/sampled.h"

namespace iride {

// Cosine below which a surface is seen edge-on and scatters nothing: half vectors have lost their digits, and values
// that grow as 1 / cos would leave the range of floats.
inline constexpr float edge_on = 1e-6f;

// Three random numbers: which lobe, and where in it.
struct Sample3 {
    float lobe;
    Sample2 direction;
};

struct BsdfEvaluation {
    BsdfValue value;
    LaneDensity density;
};

struct BsdfSample {
    Direction wi;
    Throughput weight;
    Lanes reach;
    std::optional<PerSteradian> density;  // p_hero; absent for a Dirac lobe
};

template <class T>
concept BsdfModel = requires(T const& model, Direction const& w, Sample3 u) {
    { model.evaluate(w, w) } -> std::same_as<BsdfEvaluation>;
    { model.sample(w, u) } -> std::same_as<std::optional<BsdfSample>>;
    { T::has_density } -> std::convertible_to<bool>;  // false: every lobe is a Dirac one, light sampling is in vain
};

}  // namespace iride
