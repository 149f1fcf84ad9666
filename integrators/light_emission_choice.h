// SPDX-License-Identifier: Apache-2.0
// Which rays light paths start with: those that the lamps send, or those aimed at what throws caustics.
//   lamps:  p = P(lamp) p_A p_w, as the lamp emits
//   aimed:  p = P(lamp) p_A sum_t P(t | lamp) [w in cone_t] / |cone_t|
// with a cone from the place on the lamp around each target t, the ball about a mirror or a glass. What is not aimed at
// has density 0 and is left to other techniques. As a projection map, but weighed. [Jensen 2001, sec. 5.3]
#pragma once

#include "scene/scene.h"

namespace iride {

// Where a light's ray starts.
struct LightStart {
    int light;
    float probability;  // of the choice among lights
    EmissionSample sample;
};

struct LampEmission {
    std::optional<LightStart> start(Scene const& scene, Ball const& ball, Wavelengths const& wavelengths, float choice,
                                    Sample2 place, Sample2 direction) const;
    // Of the start of a path at `from` on a light; `cosine` as in Light::emission_density().
    float density(Scene const& scene, Ball const& ball, int light, Vector const& from, Direction const& travel,
                  float cosine) const;
};

class AimedEmission {
  public:
    explicit AimedEmission(Scene const& scene);
    // Whether some lamp of a place shines at a target.
    bool has_targets() const { return lights_.size() > 0; }

    std::optional<LightStart> start(Scene const& scene, Ball const& ball, Wavelengths const& wavelengths, float choice,
                                    Sample2 place, Sample2 direction) const;
    float density(Scene const& scene, Ball const& ball, int light, Vector const& from, Direction const& travel,
                  float cosine) const;

  private:
    float direction_density(int light, Vector const& from, Direction const& travel) const;

    // Balls side by side in registers.
    struct BallRegister {
        Real8 x{}, y{}, z{}, radius2{};
    };
    std::vector<Ball> targets_;
    std::vector<BallRegister> registers_;         // the same
    DiscreteDistribution lights_;                 // empty: none can be aimed
    std::vector<DiscreteDistribution> of_light_;  // over targets; empty for a light that is not aimed
};

// Throws light into narrow directions, or may.
bool throws_caustics(NamedMaterial const& material);

// Balls about the shapes of such materials, together where they are many.
std::vector<Ball> caustic_targets(Scene const& scene);

}  // namespace iride
