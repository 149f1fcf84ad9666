// SPDX-License-Identifier: Apache-2.0
#include "integrators/radiosity/patches.h"

#include <fmt/format.h>

#include <set>

#include "base/diagnostics.h"
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

// What rays meet that leave the backs of some of a shape's patches: anything that light may come from, or backs of
// shapes.
struct SeenBehind {
    bool lit = false;
    std::set<int> backs;
};
SeenBehind seen_behind(PatchMesh const& fronts, PatchTracer const& tracer, int shape) {
    constexpr int patches = 16, rays = 16;
    std::vector<Patch const*> own;
    for (Patch const& p : fronts.patch)
        if (p.shape == shape) own.push_back(&p);
    std::size_t const step = std::max<std::size_t>(1, own.size() / patches);
    SeenBehind seen;
    for (std::size_t i = 0; i < own.size(); i += step)
        for (int k = 0; k < rays; ++k) {
            Sampler sampler(SamplerKind::sobol, 0, static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(k));
            Direction const local = to_cosine_hemisphere(sampler.next2());
            Direction const behind = Frame::around((-own[i]->normal).cast<float>()).to_world(local);
            auto const hit = tracer.closest(own[i]->centre, -own[i]->normal, behind.cast<double>());
            if (!hit) continue;
            int const met = fronts.patch[static_cast<std::size_t>(std::max(hit->patch, hit->other_side))].shape;
            if (hit->patch >= 0 || fronts.shape[static_cast<std::size_t>(met)]->light >= 0)
                seen.lit = true;
            else
                seen.backs.insert(met);
        }
    return seen;
}

// Shapes whose backs light may reach: they see a front, a lamp, or another such back. The inside of a closed body is
// dark.
std::vector<bool> lit_backs(PatchMesh const& fronts) {
    PatchTracer const tracer(fronts);
    std::vector<SeenBehind> seen;
    std::vector<bool> lit;
    for (std::size_t s = 0; s < fronts.shape.size(); ++s) {
        seen.push_back(seen_behind(fronts, tracer, static_cast<int>(s)));
        lit.push_back(seen.back().lit);
    }
    for (bool changed = true; changed;) {
        changed = false;
        for (std::size_t s = 0; s < lit.size(); ++s)
            if (!lit[s] && std::ranges::any_of(seen[s].backs, [&](int b) { return lit[static_cast<std::size_t>(b)]; }))
                lit[s] = changed = true;
    }
    return lit;
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

PatchMesh make_patches(Scene const& scene, double size_m) {
    struct Placed {
        Shape const* shape;
        ShapeGeometry geometry;
    };
    std::vector<Placed> all;
    for (Shape const& s : scene.shapes) all.push_back({&s, s.geometry});
    for (InstancePlacement const& i : scene.instances)
        for (Shape const& s : scene.objects[static_cast<std::size_t>(i.object)].shapes)
            all.push_back({&s, placed(s.geometry, i.to_world, size_m)});

    if (all.empty()) throw InputError({}, "", "radiosity: the scene has no surfaces");

    PatchMesh fronts;
    std::vector<Faces> faces;
    std::vector<int> first;
    for (Placed const& p : all) {
        faces.push_back(tessellate(p.geometry, size_m));
        first.push_back(static_cast<int>(fronts.patch.size()));
        add_side(fronts, faces.back(), static_cast<int>(fronts.shape.size()), p.shape->flipped, -1);
        fronts.shape.push_back(p.shape);
    }
    std::vector<bool> const lit = lit_backs(fronts);
    PatchMesh mesh = fronts;
    for (std::size_t s = 0; s < all.size(); ++s)
        if (lit[s]) add_side(mesh, faces[s], static_cast<int>(s), !all[s].shape->flipped, first[s]);
    return mesh;
}

PatchTracer::PatchTracer(PatchMesh const& mesh) {
    auto triangles = std::make_shared<Mesh>();
    for (VectorDouble const& p : mesh.position) triangles->position.push_back(p.cast<float>());
    auto const index = [](int i) { return static_cast<std::uint32_t>(i); };
    for (std::size_t i = 0; i < mesh.patch.size(); ++i) {
        Patch const& p = mesh.patch[i];
        if (p.back) continue;
        for (std::size_t k = 2; k < static_cast<std::size_t>(p.corners); ++k) {
            triangles->triangle.push_back({index(p.vertex[0]), index(p.vertex[k - 1]), index(p.vertex[k])});
            sides_.push_back({static_cast<int>(i), p.opposite});
        }
    }
    shapes_.emplace_back().geometry = MeshShape{triangles, false};
    accelerator_ =
        std::make_unique<Accelerator>(shapes_, std::vector<ObjectGeometry>{}, std::vector<InstancePlacement>{});
    constexpr double relative = 1e-5;  // of the scene: a hundred units in the last place of its coordinates
    clearance_ = relative * static_cast<double>((accelerator_->upper_bound() - accelerator_->lower_bound()).norm());
}

std::optional<PatchHit> PatchTracer::closest(Ray const& ray) const {
    RayStatistics unused;
    std::optional<Hit> const hit = accelerator_->closest(ray, unused);
    if (!hit) return std::nullopt;
    bool const front = ray.direction.dot(hit->point.geometric_normal) < 0;
    std::array<int, 2> const& side = sides_[hit->primitive];
    return PatchHit{side[front ? 0 : 1], side[front ? 1 : 0], hit->point.position.cast<double>()};
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
