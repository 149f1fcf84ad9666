// SPDX-License-Identifier: Apache-2.0
// Free flight through media that scatter. The hero's extinction decides how far: at t with density
//   p_i(t) = sigma_t,i exp(-sigma_t,i t),   or past the end d of a segment with probability exp(-sigma_t,i d),
// i being a lane. As any lane could have been the hero, the others keep p_i / p_hero in their reach, and a path divides
// by the mean: a balance heuristic over the lanes, bounded however much they differ. [Wilkie 2014] [Miller 2019]
#pragma once

#include "integrators/media.h"
#include "materials/phase.h"

namespace iride {

class Flight {
  public:
    // u in [0, 1) decides for the whole flight: through several media the hero's optical depths add up.
    explicit Flight(float u) : depth_left_(-std::log1p(-u)) {}

    // The way to the scattering in `medium` before `distance` (which may be infinite) is over; none: it gets past.
    // Updates weight and reach; multiplies `passing`, the hero's probability of having got past.
    std::optional<float> scattered(Medium const& medium, float distance, Wavelengths const& wavelengths,
                                   PathState& state, float& passing) {
        if (!medium.scatters) {
            state.weight *= medium.transmittance(distance, wavelengths);
            return std::nullopt;
        }
        Lanes const sigma_t(medium.sigma_t(wavelengths).lane);
        float const hero = sigma_t[0], finite = std::min(distance, std::numeric_limits<float>::max());
        if (!(hero * finite > depth_left_)) {
            depth_left_ -= hero * finite;
            passing *= std::exp(-hero * finite);
            Lanes const ratio = relative_transmittance(sigma_t, finite);
            state.weight *= ratio;
            state.reach *= ratio;
            return std::nullopt;
        }
        float const t = depth_left_ / hero;
        Lanes const ratio = relative_transmittance(sigma_t, t) / hero;
        state.weight *= ratio * Lanes(medium.sigma_s.at(wavelengths).lane);
        state.reach *= ratio * sigma_t;
        return t;
    }

  private:
    // Over the hero's.
    static Lanes relative_transmittance(Lanes sigma_t, float distance) {
        return map(sigma_t, [hero = sigma_t[0], distance](float s) { return std::exp((hero - s) * distance); });
    }

    float depth_left_;
};

// The probability with which each lane's free flight gets as far; 1 where nothing is left to chance.
inline Lanes passing_probability(Medium const& medium, float distance, Wavelengths const& wavelengths) {
    return medium.scatters ? medium.transmittance(distance, wavelengths) : Lanes(1);
}

// A scattering in a medium: where, and how far the ray came.
struct Afloat {
    Vector position;
    float distance;
};

// As travel() of integrators/media.h, or to a scattering before, which is then put into `afloat`. Multiplies `passing`
// as Flight::scattered does.
inline bool fly(Scene const& scene, Hit const* hit, Wavelengths const& wavelengths, Flight& flight, Ray& ray,
                Surroundings& surroundings, PathState& state, float& passing, std::optional<Afloat>& afloat) {
    Medium const& medium = medium_before(scene, hit, ray, surroundings);
    auto const way = flight.scattered(medium, hit ? hit->distance : infinity, wavelengths, state, passing);
    if (way) afloat.emplace(Afloat{ray.origin + *way * ray.direction, *way});
    return !way && pass(scene, hit, ray, surroundings);
}

}  // namespace iride
