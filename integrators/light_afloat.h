// SPDX-License-Identifier: Apache-2.0
// Light that a medium scatters towards a path: from a lamp to x2 in the medium, on to x1 where the path was scattered
// before. With the lanes' densities p_w of the direction from x1 to x2 and p_t = sigma_t exp(-sigma_t t) of a flight
// that ends there, x2 is found
//   by flight         p_w p_t P,     P the probability with which the lamp is then asked
//   on the ray        p_w p(t),      once the direction is there, by angle about the lamp
//   on a beam         p_b,           of the lamp, before there is a direction
// the last two for lamps without extent (integrators/beams.h). What each brings is divided by the mean over the lanes
// of reach (p_b + p_w (p(t) + p_t P)), with the reach at x1: the balance heuristic over lanes and techniques. Where a
// surface cuts the ray off before the end of what the lamp lights, p(t) is in truth 1 / share of what the weights take
// it for; they add up to 1 all the same.
// And how long a path is followed that has left all behind in a medium without end.
#pragma once

#include "integrators/beams.h"
#include "integrators/path_walk.h"

namespace iride {

class LightAfloat {
  public:
    using Walk = iride::Walk<true, true, false>;

    // `selector`: of the lamps that are asked where a flight ends; it must outlive this.
    LightAfloat(Scene const& scene, RenderPlan const& plan, LightSelector const& selector);

    // The path is about to fly along its ray, at most to its hit: what the lamps bring to a place on the way.
    void look_along(Scene const& scene, CameraPath& path, Walk& walk, Shadows& shadows,
                    RayStatistics& statistics) const;

    // What the light sample brings to where the path is afloat.
    void weigh(Scene const& scene, CameraPath& path, Walk const& walk, Shadows& shadows) const;

    // The path is about to be scattered, at a surface or afloat: what it sees of a place on a beam.
    void look_at_beam(Scene const& scene, Interaction const& here, CameraPath& path, Walk const& walk, Shadows& shadows,
                      RayStatistics& statistics) const;
    void look_at_beam(Scene const& scene, CameraPath& path, Walk const& walk, Shadows& shadows,
                      RayStatistics& statistics) const;

    // With which probability roulette lets the path go on: 1 in the ball of radius R around lamps, surfaces and camera.
    // Outside, at the farthest place r so far, R / r, the probability with which a random walk returns; what was paid
    // before is not paid again, so weights stay below r / R. Remembers the farthest place. [Arvo 1990]
    float chance_to_return(Walk& walk) const {
        if (!endless_) return 1;
        float const before = walk.floating.farthest, now = (walk.place() - around_.centre).norm() / around_.radius;
        walk.floating.farthest = std::max(before, now);
        return before / walk.floating.farthest;
    }

  private:
    // f |cos| and density of scattering towards a place that is seen along `ray`, through `medium`.
    struct Towards {
        Lanes value, density;
        Medium const& medium;
        Ray ray;
    };
    bool has_beams(Medium const& medium) const;
    std::optional<Beams::OnBeam> place_on_beam(Scene const& scene, CameraPath const& path, Walk const& walk) const;
    void add_beam(Scene const& scene, CameraPath& path, Walk const& walk, Beams::OnBeam const& on, Towards const& seen,
                  Shadows& shadows, RayStatistics& statistics) const;
    // p_t P, lane by lane, of a place at a distance where `passed` is left.
    Lanes by_flight(Medium const& medium, Wavelengths const& wavelengths, Lanes const& passed, Vector const& place,
                    int light) const;
    // Mean reach at x1 times p_b, over the hero's p_w; 0 where no beam was looked at from x1.
    float by_beam(Scene const& scene, Walk const& walk, Vector const& place, int light, Direction const& to_lamp,
                  float lamp_distance) const;

    LightSelector const* selector_;
    Beams beams_;
    std::vector<Medium const*> lit_;  // media that scatter, with a lamp without extent inside
    Ball around_{};
    bool endless_;  // the medium all around scatters
};

}  // namespace iride
