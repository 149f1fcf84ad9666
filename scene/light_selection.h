// SPDX-License-Identifier: Apache-2.0
// Which light is asked: each equally often, by power, or by what it may bring to the place, by a tree. Lights from
// infinity have no place in a tree: each of n is chosen with probability 1 / (n + 1), the tree with the rest.
// [Pharr 2023, sec. 12.6]
// Where directions of scattering go along with light samples, light that is the same from everywhere need not be asked:
// of the density that would make up for what those directions miss, max(0, L - mean L), it leaves nothing, and every
// sample goes to the lamps. [Karlik 2019]
#pragma once

#include "scene/light.h"
#include "scene/light_tree.h"

namespace iride {

enum class LightSelection { uniform, power, tree };
inline constexpr std::array<char const*, 3> light_selection_names{"uniform", "power", "tree"};

enum class UniformLight { asked, left_to_scattering };

// Whether a light is among those that are asked.
inline bool is_asked(LightSet const& lights, int light, UniformLight uniform) {
    return lights.probability(light) > 0 && (uniform == UniformLight::asked || !lights.light(light).is_uniform());
}

class LightSelector {
  public:
    LightSelector(LightSet const& lights, LightSelection selection, UniformLight uniform = UniformLight::asked);

    // Whether no light is ever asked.
    bool none() const { return by_power_.size() == 0; }

    struct Choice {
        int light;  // -1: none can be seen from there
        float probability;
    };
    Choice choose(LightReceiver const& receiver, float u) const {
        return only_ >= 0 ? Choice{only_, 1} : choose_among_many(receiver, u);
    }
    // That of choose() for this light.
    float probability(LightReceiver const& receiver, int light) const {
        return only_ >= 0 ? (light == only_ ? 1.0f : 0.0f) : probability_among_many(receiver, light);
    }

    // Whether it matters who asks.
    bool looks_at_receiver() const { return only_ < 0 && selection_ == LightSelection::tree; }

  private:
    Choice choose_among_many(LightReceiver const& receiver, float u) const;
    float probability_among_many(LightReceiver const& receiver, int light) const;

    LightSelection selection_;
    DiscreteDistribution by_power_;  // of those that are asked
    int only_ = -1;                  // the one light that is asked
    std::vector<int> bright_;        // uniform: those that are asked; tree: those of them from infinity
    std::vector<int> lamp_;          // of the tree -> light
    std::vector<int> place_;         // light -> lamp of the tree, or -1
    LightTree tree_;
    float share_of_tree_ = 0;
};

}  // namespace iride
