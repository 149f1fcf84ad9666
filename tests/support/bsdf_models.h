// SPDX-License-Identifier: Apache-2.0
// The table of models that the laws of bsdf_laws.cpp are tried on: a family gives its models in a file of its own,
// tests/materials/models_of_<family>.cpp, and gets every test for free.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "materials/closure.h"

namespace iride::test {

struct NamedModel {
    std::string name;
    Bsdf bsdf;
    int quadrature = 8;  // points per side of a histogram cell
    bool reciprocal = true, conserving = true;
    bool white = false;            // gives back all it gets, f / n_o^2 being weighed by n_i^2: so density = f cos
    float width = 2;               // of its lobes about the directions of mirror and refraction [rad]; 2: none
    Lanes index_below = Lanes(1);  // of the medium below the surface; of that above: 1
    std::function<Bsdf(int)> with_hero{};  // where lanes go different ways: the same with this lane first
};

std::vector<NamedModel> diffuse_models();
std::vector<NamedModel> metal_models();
std::vector<NamedModel> plastic_models();
std::vector<NamedModel> heuristic_models();
std::vector<NamedModel> glass_models();

// first, first + step, ... : a parameter that differs in each lane.
inline Lanes rising_lanes(float first, float step) {
    Lanes lanes;
    for (int i = 0; i < lane_count; ++i) lanes.set(i, first + step * static_cast<float>(i));
    return lanes;
}

}  // namespace iride::test
