// SPDX-License-Identifier: Apache-2.0
// Which light is asked: each equally often, by power, or by what it may bring to the place, by a tree. Lights from
// infinity have no place in a tree: each of n is chosen with probability 1 / (n + 1), the tree with the rest.
// [Pharr 2023, sec. 12.6]
#pragma once

#include "scene/light.h"
#include "scene/light_tree.h"

namespace iride {

enum class LightSelection { uniform, power, tree };
inline constexpr std::array<char const*, 3> light_selection_names{"uniform", "power", "tree"};

class LightSelector {
  public:
    LightSelector(LightSet const& lights, LightSelection selection);

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

    LightSet const& lights_;
    LightSelection selection_;
    int only_ = -1;            // the one light with power
    std::vector<int> bright_;  // uniform: those with power; tree: those of them from infinity
    std::vector<int> lamp_;    // of the tree -> light
    std::vector<int> place_;   // light -> lamp of the tree, or -1
    LightTree tree_;
    float share_of_tree_ = 0;
};

}  // namespace iride
