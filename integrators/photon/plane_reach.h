// SPDX-License-Identifier: Apache-2.0
// How far from a point its surface may be taken for a plane without edges, for discs that photons are spread over: half
// of what its shape measures from its middle across, where it is narrower. Of a disc wider than that light would go
// where there is no surface: a ball within glass, met by few photons, was 15 to 70 % dark.
#pragma once

#include <unordered_map>

#include "scene/scene.h"

namespace iride {

class PlaneReach {
  public:
    explicit PlaneReach(Scene const& scene);
    float of(Shape const& shape) const { return of_shape_.at(&shape).reach; }  // [m]
    // Where its edges are known: a quad that is not part of an object. Null: nothing is known.
    Quad const* edges(Shape const& shape) const { return of_shape_.at(&shape).edges; }

  private:
    struct Extent {
        float reach;  // of an object that is placed: in its smallest instance
        Quad const* edges;
    };
    std::unordered_map<Shape const*, Extent> of_shape_;
};

}  // namespace iride
