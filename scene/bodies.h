// SPDX-License-Identifier: Apache-2.0
// Where transparent bodies lie in one another. A ray from a point out of the scene leaves every closed body around the
// point once more often than it enters it.
#pragma once

#include "scene/scene.h"

namespace iride {

inline Body const* body_at(Scene const& scene, Hit const& hit) { return scene.material(hit.shape->material).body(); }
inline bool is_met_in_front(Hit const& hit, Direction const& travel) {
    return travel.dot(hit.point.geometric_normal) < 0;
}

// What a point is in: the median of what rays in several directions say, so that a hole in a surface does not decide.
Surroundings surroundings_at(Scene const& scene, Vector const& point);

// Bodies that can be shown to overlap and do not say which of them fills the place. Lines through the bodies are
// followed, so what is smaller than their spacing may be missed. Remarks on bodies whose surface is open.
std::vector<Diagnostic> check_nesting(Scene const& scene, std::string const& file, std::vector<std::string>& remarks);

// Tell the bodies that have a priority what may lie in front of them: the open medium, and the others that have one.
void prepare_nested_bodies(Scene& scene);

}  // namespace iride
