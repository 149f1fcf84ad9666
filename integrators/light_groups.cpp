// SPDX-License-Identifier: Apache-2.0
#include "integrators/light_groups.h"

#include <algorithm>

namespace iride {

LightGroups light_groups(Scene const& scene) {
    LightGroups groups;
    bool some_without = false;
    for (LightDescription const& light : scene.light_descriptions) {
        some_without = some_without || light.group.empty();
        if (!light.group.empty() && std::ranges::find(groups.names, light.group) == groups.names.end())
            groups.names.push_back(light.group);
    }
    groups.named = !groups.names.empty();
    std::string const ungrouped = "ungrouped";
    if (some_without && std::ranges::find(groups.names, ungrouped) == groups.names.end())
        groups.names.push_back(ungrouped);
    for (LightDescription const& light : scene.light_descriptions) {
        auto const found = std::ranges::find(groups.names, light.group.empty() ? ungrouped : light.group);
        groups.of_light.push_back(static_cast<int>(found - groups.names.begin()));
    }
    return groups;
}

LightGroupFilms::LightGroupFilms(LightGroups groups, Film const& like, WavelengthGrid const& grid)
    : groups_(std::move(groups)),
      films_(groups_.names.size(), Film(like.width(), like.height(), like.place(), like.observer(), grid, {})) {}

void LightGroupFilms::add(int x, int y, Wavelengths const& wavelengths, LightShares const& shares) {
    for (std::size_t g = 0; g < films_.size(); ++g) films_[g].add(x, y, wavelengths, shares.of_group[g]);
}

void LightGroupFilms::reject(int x, int y, Rejection cause) {
    for (Film& film : films_) film.reject(x, y, cause);
}

}  // namespace iride
