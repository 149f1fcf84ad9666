// SPDX-License-Identifier: Apache-2.0
// Which nodes of a patch tree exchange light over one link, and how much (hierarchy.h has the oracle's equation).
#pragma once

#include "integrators/radiosity/hierarchy.h"

namespace iride::radiosity {

class LinkRefiner {
  public:
    using Link = Hierarchy::Link;

    LinkRefiner(PatchMesh const& mesh, PatchTracer const& tracer, PatchTree const& tree, System const& system,
                HierarchyLimits const& limits);

    // All links, in parts whose order does not depend on threads.
    std::vector<std::vector<Link>> links() const;

  private:
    struct Pair {
        int r, s;
    };
    // Either links a pair, or gives the pairs that take its place, or neither.
    template <class OnLink, class OnPair>
    void refine(Pair pair, OnLink const& link, OnPair const& go_on) const;
    bool never_face(PatchNode const& a, PatchNode const& b) const;
    double exchange(PatchNode const& r, PatchNode const& s) const;
    double near_exchange(int r, int s, double seen) const;
    double visibility(int r, int s, int lines, int series) const;
    Patch const& patch(PatchNode const& n, int k, int of) const;

    PatchMesh const& mesh_;
    PatchTracer const& tracer_;
    PatchTree const& tree_;
    std::vector<double> sends_, takes_;  // [node] radiosity and reflectance of the wavelength that matters most
    double allowed_;                     // W nm^-1
    HierarchyLimits limits_;
};

}  // namespace iride::radiosity
