// SPDX-License-Identifier: Apache-2.0
#include "scene/float_grid.h"

#include <fmt/format.h>

#include <limits>

namespace iride {

namespace {

float size_of(Sphere const& s) { return 2 * s.radius; }
float size_of(Disc const& d) { return 2 * d.radius; }
float size_of(Frustum const& f) { return std::min(f.length(), 2 * std::max(f.radius, f.top_radius)); }
float size_of(Quad const& q) {
    return std::min((q.corner[1] - q.corner[0]).norm(), (q.corner[3] - q.corner[0]).norm());
}
float size_of(MeshShape const& m) { return box_about(m.mesh->position).diagonal().norm(); }

float smallest_of(std::vector<Shape> const& shapes) {
    float smallest = infinity;
    for (Shape const& s : shapes)
        smallest = std::min(smallest, std::visit([](auto const& g) { return size_of(g); }, s.geometry));
    return smallest;
}

}  // namespace

std::optional<std::string> remark_on_float_grid(Scene const& scene) {
    float smallest = smallest_of(scene.shapes);
    for (InstancePlacement const& i : scene.instances) {
        auto const least_scale = static_cast<float>(i.to_world.linear().colwise().norm().minCoeff());
        smallest =
            std::min(smallest, least_scale * smallest_of(scene.objects[static_cast<std::size_t>(i.object)].shapes));
    }
    float const largest = std::max(scene.accelerator->lower_bound().cwiseAbs().maxCoeff(),
                                   scene.accelerator->upper_bound().cwiseAbs().maxCoeff());
    float const grid = largest * std::numeric_limits<float>::epsilon(),
                offset = uncertainty(Vector::Constant(largest), 0);
    constexpr float tolerable = 0.01f;  // of the smallest object
    if (!(offset > tolerable * smallest)) return std::nullopt;
    return fmt::format(
        "coordinates reach {:.3g} m, where floats are {:.2g} m apart and rays start {:.2g} m off surfaces, but the "
        "smallest object measures {:.2g} m: light may leak there; bring the objects nearer together",
        largest, grid, offset, smallest);
}

}  // namespace iride
