// SPDX-License-Identifier: Apache-2.0
#include "scene/bodies.h"

#include <fmt/format.h>

#include <map>
#include <set>

#include "base/warp.h"

namespace iride {

namespace {

constexpr int most_surfaces = 10000;  // along one line

// Every surface along a ray, in order.
template <class Visit>
void follow_line(Scene const& scene, Ray ray, Visit&& visit) {
    RayStatistics uncounted;
    for (int i = 0; i < most_surfaces; ++i) {
        auto const hit = scene.accelerator->closest(ray, uncounted);
        if (!hit) return;
        visit(*hit);
        ray = spawn_ray(hit->point, ray.direction);
    }
}

// In no plane of symmetry of anything.
constexpr int direction_count = 5;
Direction direction_out(int i) {
    constexpr float turns[direction_count][2] = {
        {.137f, .921f}, {.359f, .117f}, {.571f, .683f}, {.743f, .291f}, {.929f, .473f}};
    auto const& u = turns[i];
    float const z = 1 - 2 * u[1], r = std::sqrt(1 - z * z);
    return Direction(r * std::cos(2 * pi * u[0]), r * std::sin(2 * pi * u[0]), z).normalized();
}

// How often each material's bodies are around a point, as each direction says, and the nearest way out of them.
struct Around {
    std::array<int, direction_count> times{};
    float way_out = infinity;

    int median() const {
        auto sorted = times;
        std::ranges::sort(sorted);
        return std::max(0, sorted[direction_count / 2]);
    }
};
std::map<int, Around> bodies_around(Scene const& scene, Vector const& point) {
    std::map<int, Around> around;
    for (int i = 0; i < direction_count; ++i)
        follow_line(scene, Ray{point, direction_out(i)}, [&](Hit const& hit) {
            if (!body_at(scene, hit)) return;
            Around& a = around[hit.shape->material];
            bool const enters = is_met_in_front(hit, direction_out(i));
            a.times[static_cast<std::size_t>(i)] += enters ? -1 : 1;
            if (!enters) a.way_out = std::min(a.way_out, (hit.point.position - point).norm());
        });
    return around;
}

using Box = Eigen::AlignedBox3f;

struct BoxOf {
    Box operator()(Sphere const& s) const { return around(s.centre, s.radius); }
    Box operator()(Disc const& d) const { return around(d.centre, d.radius); }
    Box operator()(Frustum const& f) const { return around(f.from, f.radius).merged(around(f.to, f.top_radius)); }
    Box operator()(Quad const& q) const { return spanned(q.corner); }
    Box operator()(MeshShape const& m) const { return spanned(m.mesh->position); }

  private:
    static Box around(Vector const& centre, float radius) {
        return {Vector(centre.array() - radius), Vector(centre.array() + radius)};
    }
    static Box spanned(std::span<Vector const> points) {
        Box box;
        for (Vector const& p : points) box.extend(p);
        return box;
    }
};

struct PlacedShape {
    Shape const* shape;
    Transform to_world;
};
std::vector<PlacedShape> surfaces_of_bodies(Scene const& scene) {
    std::vector<PlacedShape> all;
    auto const add = [&](std::vector<Shape> const& shapes, Transform const& t) {
        for (Shape const& s : shapes)
            if (scene.material(s.material).body()) all.push_back({&s, t});
    };
    add(scene.shapes, Transform::Identity());
    for (InstancePlacement const& i : scene.instances)
        add(scene.objects[static_cast<std::size_t>(i.object)].shapes, i.to_world);
    return all;
}

// A line through the scene from one end to the other: how often it is in each material's bodies.
class NestingSurvey {
  public:
    explicit NestingSurvey(Scene const& scene) : scene_(scene), radius_(scene.radius()), centre_(scene.centre()) {}

    void take_line_through(Vector const& point, Direction const& direction) {
        std::map<int, int> inside;
        std::set<int> unbalanced;
        std::map<std::pair<int, int>, Vector> both;
        Vector last = point;
        follow_line(scene_, Ray{point - (2 * radius_ + (point - centre_).norm()) * direction, direction},
                    [&](Hit const& hit) {
                        for (auto a = inside.begin(); a != inside.end(); ++a)
                            for (auto b = std::next(a); b != inside.end(); ++b)
                                if (a->second > 0 && b->second > 0)
                                    both.emplace(std::pair(a->first, b->first), (last + hit.point.position) / 2);
                        last = hit.point.position;
                        if (!body_at(scene_, hit)) return;
                        int const material = hit.shape->material;
                        inside[material] += is_met_in_front(hit, direction) ? 1 : -1;
                        if (inside[material] < 0) unbalanced.insert(material);
                    });
        for (auto const& [material, times] : inside) {
            if (times != 0) unbalanced.insert(material);
            ++lines_[material];
        }
        for (int material : unbalanced) ++unbalanced_[material];
        for (auto const& [pair, place] : both)
            if (!overlaps_.contains(pair) && !unbalanced.contains(pair.first) && !unbalanced.contains(pair.second) &&
                lie_in_one_another(pair, place))
                overlaps_.emplace(pair, place);
    }

    std::map<std::pair<int, int>, Vector> const& overlaps() const { return overlaps_; }
    // An open surface, or one that coincides with another, over which rays may step.
    bool is_open(int material) const {
        auto const found = unbalanced_.find(material);
        constexpr int share = 4;  // rays that slip through an edge are far fewer
        return found != unbalanced_.end() && found->second * share > lines_.at(material);
    }

  private:
    bool lie_in_one_another(std::pair<int, int> const& pair, Vector const& place) const {
        auto around = bodies_around(scene_, place);
        return around[pair.first].median() > 0 && around[pair.second].median() > 0;
    }

    Scene const& scene_;
    float radius_;
    Vector centre_;
    std::map<std::pair<int, int>, Vector> overlaps_;  // materials, a point in both
    std::map<int, int> lines_, unbalanced_;
};

NestingSurvey survey(Scene const& scene) {
    constexpr std::size_t most_lines = 8192;
    NestingSurvey result(scene);
    std::vector<PlacedShape> const surfaces = surfaces_of_bodies(scene);
    std::size_t const lines = std::clamp<std::size_t>(most_lines / std::max<std::size_t>(1, surfaces.size()), 4, 64);
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
        Box const box = std::visit(BoxOf{}, surfaces[i].shape->geometry);
        for (std::size_t k = 0; k < lines; ++k) {
            Sampler s(SamplerKind::independent, 1, static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(k));
            Sample2 const xy = s.next2();
            Vector const in_box = box.min() + box.sizes().cwiseProduct(Vector(xy.x, xy.y, s.next()));
            result.take_line_through((surfaces[i].to_world * in_box.cast<double>()).cast<float>(),
                                     to_sphere(s.next2()));
        }
    }
    return result;
}

// Whether light that leaves `inner` into `outer` goes on as it should.
bool tells_what_is_around(Body const& inner, Body const& outer) {
    return !inner.priority && inner.outside_is_stated &&
           (outer.priority || !outer.inside.attenuates() || inner.outside.absorbs);
}

// What is wrong with two bodies that overlap; empty if nothing is.
std::string conflict(Body const& a, Body const& b, std::string const& other) {
    if (a.priority && b.priority) {
        if (*a.priority != *b.priority) return "";
        return fmt::format("has the priority {} of '{}' too, which it overlaps", *a.priority, other);
    }
    if (tells_what_is_around(a, b) || tells_what_is_around(b, a)) return "";
    return fmt::format("overlaps '{}', and not both have a 'priority'", other);
}

}  // namespace

Surroundings surroundings_at(Scene const& scene, Vector const& point) {
    Surroundings result(scene.open_medium);
    Body const* told = nullptr;
    float nearest = infinity;
    for (auto const& [material, around] : bodies_around(scene, point)) {
        Body const& body = *scene.material(material).body();
        if (body.priority)
            for (int i = 0; i < around.median(); ++i) result.cross(body, true);
        else if (around.median() > 0 && around.way_out < nearest)
            told = &body, nearest = around.way_out;
    }
    if (told) result.meet(*told, false);
    return result;
}

std::vector<Diagnostic> check_nesting(Scene const& scene, std::string const& file, std::vector<std::string>& remarks) {
    std::vector<int> bodies;
    bool interiors = false;
    for (std::size_t i = 0; i < scene.materials.size(); ++i)
        if (Body const* const b = scene.materials[i].material->body()) {
            bodies.push_back(static_cast<int>(i));
            interiors = interiors || b->priority || b->inside.attenuates();
        }
    if (bodies.size() < 2 && !interiors) return {};
    NestingSurvey const found = survey(scene);
    std::vector<Diagnostic> diagnostics;
    for (auto const& [pair, place] : found.overlaps()) {
        NamedMaterial const& a = scene.materials[static_cast<std::size_t>(pair.first)];
        NamedMaterial const& b = scene.materials[static_cast<std::size_t>(pair.second)];
        std::string const text = conflict(*a.material->body(), *b.material->body(), b.name);
        if (text.empty()) continue;
        VectorDouble const in_file = place.cast<double>() + scene.origin;
        diagnostics.push_back(
            {{file, a.line, a.column},
             a.key_path,
             fmt::format("near ({:.3g}, {:.3g}, {:.3g}) m it {}; allowed: whole numbers that differ, the higher fills "
                         "the place, or, for a body that lies in another, its 'exterior_ior'",
                         in_file.x(), in_file.y(), in_file.z(), text)});
    }
    for (int i : bodies) {
        NamedMaterial const& m = scene.materials[static_cast<std::size_t>(i)];
        if (found.is_open(i) && !m.material->body()->outside_is_stated)
            remarks.push_back(m.key_path +
                              ": a surface of it is open, or coincides with another: what lies behind it "
                              "is told by the side from which it is met");
    }
    return diagnostics;
}

void prepare_nested_bodies(Scene& scene) {
    std::vector<Medium const*> media{&scene.open_medium};
    auto const nested = [](NamedMaterial const& m) { return m.material->body() && m.material->body()->priority; };
    for (NamedMaterial const& m : scene.materials)
        if (nested(m)) media.push_back(&m.material->body()->inside);
    for (NamedMaterial const& m : scene.materials)
        if (nested(m)) m.material->prepare_for(media);
}

}  // namespace iride
