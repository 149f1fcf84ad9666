// SPDX-License-Identifier: Apache-2.0
#include "scene/light_selection.h"

namespace iride {

LightSelector::LightSelector(LightSet const& lights, LightSelection selection, UniformLight uniform)
    : selection_(selection), place_(lights.size(), -1) {
    std::vector<LightBounds> bounds;
    std::vector<int> asked;
    std::vector<double> power(lights.size());
    for (int i = 0; i < static_cast<int>(lights.size()); ++i) {
        if (!is_asked(lights, i, uniform)) continue;
        asked.push_back(i);
        power[static_cast<std::size_t>(i)] = static_cast<double>(lights.probability(i));
        auto const b = selection == LightSelection::tree ? lights.light(i).bounds() : std::nullopt;
        if (!b) {
            bright_.push_back(i);
            continue;
        }
        place_[static_cast<std::size_t>(i)] = static_cast<int>(bounds.size());
        lamp_.push_back(i);
        bounds.push_back(*b);
    }
    if (!asked.empty()) by_power_ = DiscreteDistribution(power);
    if (asked.size() == 1) only_ = asked.front();
    if (selection != LightSelection::tree || only_ >= 0) return;
    tree_ = LightTree(bounds);
    share_of_tree_ = tree_.empty() ? 0 : 1 / static_cast<float>(bright_.size() + 1);
}

LightSelector::Choice LightSelector::choose_among_many(LightReceiver const& receiver, float u) const {
    if (none()) return {-1, 0};
    if (selection_ == LightSelection::power) {
        auto const choice = by_power_.sample(u);
        return {choice.index, choice.probability};
    }
    if (selection_ == LightSelection::tree && (u < share_of_tree_ || bright_.empty())) {
        if (tree_.empty()) return {-1, 0};
        auto const [lamp, probability] = tree_.choose(receiver, u / share_of_tree_);
        if (lamp < 0) return {-1, 0};
        return {lamp_[static_cast<std::size_t>(lamp)], share_of_tree_ * probability};
    }
    auto const count = static_cast<float>(bright_.size());
    if (bright_.empty()) return {-1, 0};
    float const rest = (u - share_of_tree_) / (1 - share_of_tree_);
    std::size_t const i = std::min(static_cast<std::size_t>(rest * count), bright_.size() - 1);
    return {bright_[i], (1 - share_of_tree_) / count};
}

float LightSelector::probability_among_many(LightReceiver const& receiver, int light) const {
    if (none() || !(by_power_.probability(light) > 0)) return 0;
    if (selection_ == LightSelection::power) return by_power_.probability(light);
    int const lamp = place_[static_cast<std::size_t>(light)];
    if (lamp >= 0) return share_of_tree_ * tree_.probability(receiver, lamp);
    return (1 - share_of_tree_) / static_cast<float>(bright_.size());
}

}  // namespace iride
