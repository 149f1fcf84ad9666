// SPDX-License-Identifier: Apache-2.0
#include "integrators/photon/plane_reach.h"

namespace iride {

namespace {

// From the middle to the nearest edge or to where the surface has turned, roughly.
struct HalfWidth {
    float operator()(Sphere const& s) const { return s.radius; }
    float operator()(Disc const& d) const { return d.radius; }
    float operator()(Frustum const& f) const { return std::min(f.length() / 2, std::max(f.radius, f.top_radius)); }
    float operator()(Quad const& q) const {
        return std::min((q.corner[1] - q.corner[0]).norm(), (q.corner[2] - q.corner[1]).norm()) / 2;
    }
    // Of a box around it the middle one of three sides: of a plane the shorter one.
    float operator()(MeshShape const& m) const {
        Vector side = box_about(m.mesh->position).sizes();
        std::ranges::sort(side);
        return side.y() / 2;
    }
};

}  // namespace

PlaneReach::PlaneReach(Scene const& scene) {
    constexpr float share = 0.5f;
    auto const take = [&](std::vector<Shape> const& shapes, float scale) {
        for (Shape const& shape : shapes) {
            float const reach = share * scale * std::visit(HalfWidth{}, shape.geometry);
            auto const [known, is_new] = of_shape_.emplace(&shape, Extent{reach, nullptr});
            if (!is_new) known->second.reach = std::min(known->second.reach, reach);
        }
    };
    take(scene.shapes, 1);
    for (Shape const& shape : scene.shapes) of_shape_.at(&shape).edges = std::get_if<Quad>(&shape.geometry);
    for (InstancePlacement const& placed : scene.instances)
        take(scene.objects[static_cast<std::size_t>(placed.object)].shapes,
             static_cast<float>(placed.to_world.linear().colwise().norm().minCoeff()));
}

}  // namespace iride
