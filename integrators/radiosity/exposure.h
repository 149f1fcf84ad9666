// SPDX-License-Identifier: Apache-2.0
// What of each patch lies open. Where a body stands on a floor, the floor's patches go on under it: there no light
// comes or goes, and b of a patch is the mean over the rest. A point lies against a body when most rays from it meet
// surfaces from inside, where light cannot reach. A patch's area, centre and points become those of its open part, so
// that every method sees A_i F_ij = A_j F_ji between open parts.
#pragma once

#include "base/warp.h"
#include "integrators/radiosity/patches.h"

namespace iride::radiosity {

// Of patches that are doubtful.
void find_open_parts(PatchMesh& mesh);

// A point of a patch, uniform over its open part.
VectorDouble point_on(PatchMesh const& mesh, Patch const& p, Sample2 u);

// The open one nearest to `place`, of a patch that lies open in part.
VectorDouble open_point_by(PatchMesh const& mesh, Patch const& p, VectorDouble const& place);

// A direction by the cosine to a unit normal.
inline VectorDouble way_by_cosine(VectorDouble const& normal, Sampler& sampler) {
    return Frame::around(normal.cast<float>()).to_world(to_cosine_hemisphere(sampler.next2())).cast<double>();
}

// A line that leaves a patch, as its light does: from such a point, by the cosine.
struct Line {
    VectorDouble from, way;
};
inline Line line_from(PatchMesh const& mesh, Patch const& p, Sampler& sampler) {
    return {point_on(mesh, p, sampler.next2()), way_by_cosine(p.normal, sampler)};
}

}  // namespace iride::radiosity
