// SPDX-License-Identifier: Apache-2.0
// Hierarchical radiosity: light goes between groups of patches along links, one for many pairs. A pair of nodes (r, s)
// of the patches' tree is linked when the light that could go wrong over it is little,
//   G max(rho_r b_s, rho_s b_r) err <= tolerance P,   err = (R_r + R_s) / d, or 1 where a shadow's edge lies between,
// else the larger is split, down to single patches. G = A_r F_rs: the kernel at pairs of points, or for near patches
// Lambert's contour sum, times the share of free lines; b as if all surfaces shared the reflected light, P the power
// emitted. Factors are scaled in pairs until rows sum to the share of light that does not leave the scene.
// [Hanrahan 1991]
#pragma once

#include <vector>

#include "integrators/radiosity/patch_tree.h"
#include "integrators/radiosity/system.h"

namespace iride::radiosity {

struct HierarchyLimits {
    double tolerance;  // of the emitted power, a link
    int lines;         // of sight per link
    double memory_bytes;
};

class Hierarchy final : public Transport {
  public:
    // `system`: areas and spectra of the mesh. Throws InputError when the links outgrow the memory.
    Hierarchy(PatchMesh const& mesh, PatchTracer const& tracer, System const& system, HierarchyLimits const& limits);
    Spectra gather(Spectra const& b) const override;

    std::size_t links() const { return entries_.size() / 2; }
    // The largest distance of a row's sum from the share of light that stays, before scaling.
    double closure_defect() const { return closure_defect_; }

  private:
    struct Link {
        int r, s;
        float exchange;  // G [m^2]
    };
    struct Entry {
        int from;
        float factor;  // F to that node
    };
    using Rows = Eigen::Array<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    friend class LinkRefiner;

    void store(std::vector<std::vector<Link>> const& parts);
    void close(PatchMesh const& mesh, PatchTracer const& tracer);

    PatchTree tree_;
    std::vector<std::size_t> first_;  // [node + 1] into entries_
    std::vector<Entry> entries_;
    Eigen::ArrayXf scale_;  // [patch]
    double closure_defect_ = 0;
};

}  // namespace iride::radiosity
