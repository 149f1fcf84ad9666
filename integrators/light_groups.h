// SPDX-License-Identifier: Apache-2.0
// The picture by the lamps its light comes from: one film per group of lights, filled from the picture's own paths.
// Every term of a path comes from one light, so that with L_g = sum of the terms from the lights of group g
//   sum over g of L_g = L,   sample by sample, and so in every pixel.
#pragma once

#include <string>
#include <vector>

#include "film/film.h"
#include "integrators/camera_path.h"

namespace iride {

// The groups that a scene names, in the order of its lights; lights that are in none make the last, "ungrouped".
struct LightGroups {
    std::vector<std::string> names;
    std::vector<int> of_light;
    bool named = false;  // whether the scene names any
};
LightGroups light_groups(Scene const& scene);

class LightGroupFilms {
  public:
    // Films of the size and place of `like`.
    LightGroupFilms(LightGroups groups, Film const& like, WavelengthGrid const& grid);

    std::size_t count() const { return films_.size(); }
    std::string const& name(std::size_t group) const { return groups_.names[group]; }
    Film const& film(std::size_t group) const { return films_[group]; }

    // Where a path has to leave its shares; `of_group` has room for count().
    LightShares shares(Radiance* of_group) const { return {groups_.of_light.data(), of_group}; }
    // As of the picture's film.
    void add(int x, int y, Wavelengths const& wavelengths, LightShares const& shares);
    void reject(int x, int y, Rejection cause);

  private:
    LightGroups groups_;
    std::vector<Film> films_;
};

}  // namespace iride
