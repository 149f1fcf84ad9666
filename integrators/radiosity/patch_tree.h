// SPDX-License-Identifier: Apache-2.0
// A binary tree over the open patches of a scene, of which there must be one: first by surface side (coplanar patches
// stay together), then halved along the longest extent of the patches' centres. A node's patches are neighbours in
// `order`; parents precede children.
#pragma once

#include <vector>

#include "integrators/radiosity/patches.h"

namespace iride::radiosity {

struct PatchNode {
    VectorDouble centre, normal;  // means over the area; the normal has length 1
    VectorDouble low, high;       // of the box around its patches
    double area = 0, radius = 0;  // radius: from the centre to the farthest vertex
    bool flat = false;            // all its patches lie in one plane, to rounding
    int first = 0, count = 0;     // patches order[first .. first + count)
    int left = -1, right = -1;    // -1: a single patch
    bool is_leaf() const { return left < 0; }
};

struct PatchTree {
    std::vector<PatchNode> node;  // [0]: the root
    std::vector<int> order;       // patch numbers

    explicit PatchTree(PatchMesh const& mesh);
};

}  // namespace iride::radiosity
