// SPDX-License-Identifier: Apache-2.0
// Lamps without extent in a medium that scatters: places x2 in the medium that they light, drawn without a pole at the
// lamp, where light goes as 1 / r^2 and free flights hardly ever end.
//   on a path's ray:          equal angles about the lamp, within its cone: density p(t) per metre      [Kulla 2012]
//   on a beam, a lamp's ray:  drawn as light leaves the lamp, p_w per steradian, then at d by equal angles about the
//                             place x1 that looks; per steradian and metre there, with r = |x1 x2|,
//                             p_w p(d) r^2 / d^2                                                        [Georgiev 2013]
// Lamps are chosen by power.
#pragma once

#include <optional>
#include <vector>

#include "base/distribution.h"
#include "base/ray_part.h"
#include "scene/light_selection.h"

namespace iride {

class Beams {
  public:
    Beams() = default;
    explicit Beams(LightSet const& lights);

    bool none() const { return lamps_.empty(); }
    // Where the lamps are.
    std::vector<Vector> places() const;

    struct OnRay {
        int light;
        float distance;  // along the ray
        float density;   // of the whole ray
        float share;     // of the whole ray's angle that was drawn from: this place had density / share
    };
    // Before `length`, which may be infinite; absent: the lamp lights nothing there. u: which lamp, which place.
    std::optional<OnRay> on_ray(Ray const& ray, float length, Sample2 u) const;
    // OnRay::density of a place that was found otherwise; 0 for other lights.
    float density_on_ray(Ray const& ray, float distance, int light) const;

    struct OnBeam {
        int light;
        Vector place;
        Direction travel;     // of the light
        float lamp_distance;  // to the lamp
        Radiance intensity;   // in units of the Dirac
        Direction towards;    // from x1
        float distance;       // from x1
        float density;        // per steradian and metre at x1
    };
    // u: which lamp, how far along; direction: of the beam.
    std::optional<OnBeam> on_beam(LightSet const& lights, Vector const& x1, Wavelengths const& wavelengths, Sample2 u,
                                  Sample2 direction) const;
    // OnBeam::density of a place that was found otherwise; 0 for other lights.
    float density_on_beam(LightSet const& lights, Vector const& x1, Vector const& place, int light,
                          Direction const& to_lamp, float lamp_distance) const;

  private:
    struct Lamp {
        int light;
        float probability;
        Vector place;
        Direction axis;
        float cos_cone;  // below 0: light goes everywhere

        RayPart lit(Ray const& ray) const;
    };
    Lamp const* lamp_of(int light) const;

    std::vector<Lamp> lamps_;
    std::vector<int> of_light_;  // light -> lamp, or -1
    DiscreteDistribution by_power_;
};

}  // namespace iride
