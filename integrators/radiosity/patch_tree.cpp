// SPDX-License-Identifier: Apache-2.0
#include "integrators/radiosity/patch_tree.h"

#include <algorithm>

namespace iride::radiosity {

namespace {

class Builder {
  public:
    Builder(PatchMesh const& mesh, PatchTree& tree) : mesh_(mesh), tree_(tree) {}

    int build(int first, int last) {
        int const index = static_cast<int>(tree_.node.size());
        tree_.node.push_back(describe(first, last));
        if (last - first == 1) return index;
        int const middle = split(first, last, tree_.node.back());
        int const left = build(first, middle), right = build(middle, last);
        tree_.node[static_cast<std::size_t>(index)].left = left;
        tree_.node[static_cast<std::size_t>(index)].right = right;
        return index;
    }

  private:
    Patch const& patch(int k) const {
        return mesh_.patch[static_cast<std::size_t>(tree_.order[static_cast<std::size_t>(k)])];
    }
    // Surface sides are runs of `order`, since its first order is theirs.
    static bool same_side(Patch const& a, Patch const& b) { return a.shape == b.shape && a.back == b.back; }

    PatchNode describe(int first, int last) const {
        PatchNode n;
        n.first = first;
        n.count = last - first;
        n.centre = n.normal = VectorDouble::Zero();
        for (int k = first; k < last; ++k) {
            n.area += patch(k).area;
            n.centre += patch(k).area * patch(k).centre;
            n.normal += patch(k).area * patch(k).normal;
        }
        n.centre /= n.area;
        double const length = n.normal.norm();
        n.normal = length > 0 ? VectorDouble(n.normal / length) : VectorDouble(0, 0, 1);
        n.low = n.high = patch(first).centre;
        double off_plane = 0;
        for (int k = first; k < last; ++k)
            for (VectorDouble const& v : mesh_.polygon(patch(k))) {
                n.low = n.low.cwiseMin(v);
                n.high = n.high.cwiseMax(v);
                n.radius = std::max(n.radius, (v - n.centre).norm());
                off_plane = std::max(off_plane, std::abs(n.normal.dot(v - n.centre)));
            }
        constexpr double rounding = 1e-5;  // of the radius: scenes are in single precision
        n.flat = off_plane <= rounding * n.radius && length > (1 - rounding) * n.area;
        return n;
    }

    // Between two surface sides while there are several, else at the middle patch along the longest extent.
    int split(int first, int last, PatchNode const& n) {
        if (!same_side(patch(first), patch(last - 1))) {
            int const wanted = (first + last) / 2;
            int below = wanted, above = wanted;
            while (below > first && same_side(patch(below), patch(below - 1))) --below;
            while (above < last && same_side(patch(above), patch(above - 1))) ++above;
            return below == first || (above < last && above - wanted < wanted - below) ? above : below;
        }
        int axis;
        (n.high - n.low).maxCoeff(&axis);
        auto const begin = tree_.order.begin();
        int const middle = (first + last) / 2;
        std::nth_element(begin + first, begin + middle, begin + last, [&](int a, int b) {
            double const x = mesh_.patch[static_cast<std::size_t>(a)].centre[axis],
                         y = mesh_.patch[static_cast<std::size_t>(b)].centre[axis];
            return x != y ? x < y : a < b;
        });
        return middle;
    }

    PatchMesh const& mesh_;
    PatchTree& tree_;
};

}  // namespace

PatchTree::PatchTree(PatchMesh const& mesh) {
    for (std::size_t i = 0; i < mesh.patch.size(); ++i)
        if (mesh.patch[i].open > 0) order.push_back(static_cast<int>(i));
    node.reserve(2 * order.size());
    Builder(mesh, *this).build(0, static_cast<int>(order.size()));
}

}  // namespace iride::radiosity
