// SPDX-License-Identifier: Apache-2.0
#include "integrators/radiosity/patches.h"

#include <fmt/format.h>

#include "base/diagnostics.h"
#include "integrators/radiosity/exposure.h"
#include "integrators/radiosity/lit_backs.h"
#include "integrators/radiosity/polygon_form_factor.h"
#include "integrators/radiosity/tessellation.h"

namespace iride::radiosity {

namespace {

// Shapes in world coordinates: those of instances as meshes, since their transforms may shear.
ShapeGeometry placed(ShapeGeometry const& geometry, Transform const& to_world, double size) {
    Faces const faces = tessellate(geometry, size);
    auto mesh = std::make_shared<Mesh>();
    for (VectorDouble const& p : faces.position) mesh->position.push_back((to_world * p).cast<float>());
    auto const index = [](int i) { return static_cast<std::uint32_t>(i); };
    for (auto const& f : faces.face) {
        mesh->triangle.push_back({index(f.vertex[0]), index(f.vertex[1]), index(f.vertex[2])});
        if (f.corners == 4) mesh->triangle.push_back({index(f.vertex[0]), index(f.vertex[2]), index(f.vertex[3])});
    }
    return MeshShape{std::move(mesh), false};
}

// The faces of a shape as patches of one side; `front`: the first patch of the other side, or -1.
void add_side(PatchMesh& mesh, Faces const& faces, int shape, bool turned, int front) {
    int const first = static_cast<int>(mesh.position.size());
    mesh.position.insert(mesh.position.end(), faces.position.begin(), faces.position.end());
    for (Faces::Face const& f : faces.face) {
        Patch p{f.vertex, f.corners, shape, front >= 0, -1, VectorDouble::Zero(), VectorDouble::Zero(), 0};
        for (int& v : p.vertex) v += first;
        if (turned) std::reverse(p.vertex.begin(), p.vertex.begin() + p.corners);
        measure(mesh, p);
        if (!(p.area > 0)) {
            if (front < 0) ++mesh.slivers;
            continue;
        }
        if (front >= 0) {
            p.opposite = front++;
            mesh.patch[static_cast<std::size_t>(p.opposite)].opposite = static_cast<int>(mesh.patch.size());
        }
        mesh.patch.push_back(p);
    }
}

}  // namespace

std::vector<VectorDouble> PatchMesh::polygon(Patch const& p) const {
    std::vector<VectorDouble> corners;
    for (int k = 0; k < p.corners; ++k)
        corners.push_back(position[static_cast<std::size_t>(p.vertex[static_cast<std::size_t>(k)])]);
    return corners;
}

SurfacePoint front_point(Patch const& p) {
    Direction const normal = (p.back ? -1.0 : 1.0) * p.normal.cast<float>();
    return {p.centre.cast<float>(), normal, normal};
}

void measure(PatchMesh const& mesh, Patch& p) {
    auto const polygon = mesh.polygon(p);
    p.centre.setZero();
    for (VectorDouble const& v : polygon) p.centre += v / static_cast<double>(polygon.size());
    VectorDouble const area = vector_area(polygon);
    p.area = area.norm();
    p.normal = p.area > 0 ? VectorDouble(area / p.area) : VectorDouble(VectorDouble::Zero());
}

double expected_patches(Scene const& scene, double size_m) {
    double expected = 0;
    for (Shape const& s : scene.shapes) expected += expected_faces(s.geometry, size_m);
    for (InstancePlacement const& i : scene.instances)
        for (Shape const& s : scene.objects[static_cast<std::size_t>(i.object)].shapes)
            expected += expected_faces(s.geometry, size_m);
    return expected;
}

namespace {

struct Fronts {
    PatchMesh mesh;
    std::vector<Faces> faces;      // [shape]
    std::vector<int> first_patch;  // likewise
};
Fronts cut_fronts(Scene const& scene, double size_m) {
    Fronts fronts;
    auto const add = [&](Shape const& shape, ShapeGeometry const& geometry) {
        fronts.faces.push_back(tessellate(geometry, size_m));
        fronts.first_patch.push_back(static_cast<int>(fronts.mesh.patch.size()));
        add_side(fronts.mesh, fronts.faces.back(), static_cast<int>(fronts.mesh.shape.size()), shape.flipped, -1);
        fronts.mesh.shape.push_back(&shape);
    };
    for (Shape const& s : scene.shapes) add(s, s.geometry);
    for (InstancePlacement const& i : scene.instances)
        for (Shape const& s : scene.objects[static_cast<std::size_t>(i.object)].shapes)
            add(s, placed(s.geometry, i.to_world, size_m));
    if (fronts.mesh.shape.empty()) throw InputError({}, "", "radiosity: the scene has no surfaces");
    return fronts;
}

}  // namespace

double area_of_fronts(Scene const& scene) {
    constexpr double coarse = 1e9;  // m: the shapes' own faces, uncut
    double area = 0;
    for (Patch const& p : cut_fronts(scene, coarse).mesh.patch) area += p.area;
    return area;
}

PatchMesh make_patches(Scene const& scene, double size_m) {
    Fronts fronts = cut_fronts(scene, size_m);
    PatchMesh mesh = std::move(fronts.mesh);
    std::vector<bool> const lit = lit_backs(scene, mesh, PatchTracer(mesh, PatchTracer::Fronts::drawn_in));
    for (std::size_t s = 0; s < lit.size(); ++s)
        if (lit[s])
            add_side(mesh, fronts.faces[s], static_cast<int>(s), !mesh.shape[s]->flipped, fronts.first_patch[s]);
    find_open_parts(mesh);
    if (std::ranges::all_of(mesh.patch, [](Patch const& p) { return p.open == 0; }))
        throw InputError({}, "", "radiosity: every surface lies inside of another");
    return mesh;
}

PatchTracer::PatchTracer(PatchMesh const& mesh, Fronts fronts) {
    VectorDouble low = mesh.position.front(), high = low;
    for (VectorDouble const& p : mesh.position) low = low.cwiseMin(p), high = high.cwiseMax(p);
    constexpr double relative = 1e-5;  // of the scene: a hundred units in the last place of its coordinates
    clearance_ = relative * (high - low).norm();
    double const inwards = fronts == Fronts::drawn_in ? clearance_ / 2 : 0;
    std::vector<VectorDouble> normal(mesh.position.size(), VectorDouble::Zero());
    for (Patch const& p : mesh.patch)
        for (std::size_t k = 0; k < static_cast<std::size_t>(p.corners); ++k)
            normal[static_cast<std::size_t>(p.vertex[k])] += p.normal;
    auto triangles = std::make_shared<Mesh>();
    for (std::size_t v = 0; v < normal.size(); ++v)
        triangles->position.push_back((mesh.position[v] - inwards * normal[v].stableNormalized()).cast<float>());
    auto const index = [](int i) { return static_cast<std::uint32_t>(i); };
    auto const of_open = [&](int i) { return i >= 0 && mesh.patch[static_cast<std::size_t>(i)].open > 0 ? i : -1; };
    for (std::size_t i = 0; i < mesh.patch.size(); ++i) {
        Patch const& p = mesh.patch[i];
        if (p.back) continue;
        for (std::size_t k = 2; k < static_cast<std::size_t>(p.corners); ++k) {
            triangles->triangle.push_back({index(p.vertex[0]), index(p.vertex[k - 1]), index(p.vertex[k])});
            sides_.push_back({of_open(static_cast<int>(i)), of_open(p.opposite)});
        }
    }
    shapes_.emplace_back().geometry = MeshShape{triangles, false};
    accelerator_ =
        std::make_unique<Accelerator>(shapes_, std::vector<ObjectGeometry>{}, std::vector<InstancePlacement>{});
}

PatchHit PatchTracer::patch_met(Ray const& ray, Hit const& hit) const {
    bool const front = ray.direction.dot(hit.point.geometric_normal) < 0;
    std::array<int, 2> const& side = sides_[hit.primitive];
    return {side[front ? 0 : 1], side[front ? 1 : 0], hit.point.position.cast<double>()};
}

std::optional<PatchHit> PatchTracer::closest(Ray const& ray) const {
    RayStatistics unused;
    std::optional<Hit> const hit = accelerator_->closest(ray, unused);
    if (!hit) return std::nullopt;
    return patch_met(ray, *hit);
}

void PatchTracer::closest(std::span<PatchQuery> queries, Accelerator::Coherence coherence,
                          RayStatistics& statistics) const {
    constexpr std::size_t together = 64;
    std::array<Hit, together> hits;
    std::array<ClosestQuery, together> rays;
    for (; !queries.empty(); queries = queries.subspan(std::min(together, queries.size()))) {
        std::size_t const count = std::min(together, queries.size());
        for (std::size_t k = 0; k < count; ++k) rays[k] = {queries[k].ray, &hits[k]};
        accelerator_->closest(std::span(rays).first(count), coherence, statistics);
        for (std::size_t k = 0; k < count; ++k)
            if (rays[k].found) queries[k].hit = patch_met(*queries[k].ray, hits[k]);
    }
}

std::optional<PatchHit> PatchTracer::closest(VectorDouble const& from, VectorDouble const& side,
                                             VectorDouble const& direction) const {
    return closest(Ray{(from + clearance_ * side).cast<float>(), direction.cast<float>().normalized()});
}

bool PatchTracer::visible(VectorDouble const& from, VectorDouble const& side, VectorDouble const& to,
                          VectorDouble const& other_side) const {
    VectorDouble const start = from + clearance_ * side, way = to + clearance_ * other_side - start;
    double const distance = way.norm();
    RayStatistics unused;
    return !accelerator_->occluded(
        Ray{start.cast<float>(), (way / distance).cast<float>(), 0, static_cast<float>(distance)}, unused);
}

}  // namespace iride::radiosity
