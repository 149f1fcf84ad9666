// SPDX-License-Identifier: Apache-2.0
// The table of models that the laws of bsdf_laws.cpp are tried on: a family gives its models in a file of its own,
// tests/materials/models_of_<family>.cpp, and gets every test for free.
#pragma once

#include <string>
#include <vector>

#include "materials/closure.h"

namespace iride::test {

struct NamedModel {
    std::string name;
    Bsdf bsdf;
    int quadrature = 32;  // points per side of a histogram cell: a narrow lobe is a tenth of a cell wide
    bool reciprocal = true, conserving = true;
};

std::vector<NamedModel> diffuse_models();
std::vector<NamedModel> metal_models();
std::vector<NamedModel> plastic_models();
std::vector<NamedModel> heuristic_models();

// first, first + step, ... : a parameter that differs in each lane.
inline Lanes rising_lanes(float first, float step) {
    Lanes lanes;
    for (int i = 0; i < lane_count; ++i) lanes.set(i, first + step * static_cast<float>(i));
    return lanes;
}

}  // namespace iride::test
