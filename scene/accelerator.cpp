// SPDX-License-Identifier: Apache-2.0
#include "scene/accelerator.h"

#include <embree3/rtcore.h>
#include <x86intrin.h>

#include <array>
#include <limits>
#include <stdexcept>

#include "scene/cut_out.h"
#include "scene/parametrisation.h"

namespace iride {

std::uint64_t processor_ticks() { return __rdtsc(); }

void RayStatistics::add(RayStatistics const& other) {
    closest_rays += other.closest_rays;
    shadow_rays += other.shadow_rays;
    shared_rays += other.shared_rays;
    traced_ticks += other.traced_ticks;
}

namespace {

// Adds its lifetime to the ticks spent in Embree, on timed paths only.
class Stopwatch {
  public:
    explicit Stopwatch(RayStatistics& s) : statistics_(s), start_(s.timed ? processor_ticks() : 0) {}
    ~Stopwatch() {
        if (statistics_.timed) statistics_.traced_ticks += processor_ticks() - start_;
    }

  private:
    RayStatistics& statistics_;
    std::uint64_t start_;
};

// Embree reads vertices in 16-byte loads: one float of padding behind the last.
void copy_vertices(RTCGeometry geometry, Vector const* vertices, std::size_t count) {
    auto* const buffer = static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), count));
    for (std::size_t i = 0; i < count; ++i) Eigen::Map<Vector>(buffer + 3 * i) = vertices[i];
}

RTCGeometry make_geometry(RTCDevice device, Sphere const& s) {
    RTCGeometry const g = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_SPHERE_POINT);
    auto* const v = static_cast<float*>(
        rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, 4 * sizeof(float), 1));
    Eigen::Map<Vector>{v} = s.centre;
    v[3] = s.radius;
    return g;
}

RTCGeometry make_geometry(RTCDevice device, Quad const& q) {
    RTCGeometry const g = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    copy_vertices(g, q.corner.data(), 4);
    auto* const index = static_cast<std::uint32_t*>(
        rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), 2));
    std::ranges::copy(std::array<std::uint32_t, 6>{0, 1, 3, 2, 3, 1}, index);
    return g;
}

RTCGeometry make_geometry(RTCDevice device, Disc const& d) {
    RTCGeometry const g = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_ORIENTED_DISC_POINT);
    auto* const v = static_cast<float*>(
        rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, 4 * sizeof(float), 1));
    Eigen::Map<Vector>{v} = d.centre;
    v[3] = d.radius;
    auto* const n = static_cast<float*>(
        rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_NORMAL, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), 1));
    Eigen::Map<Vector>{n} = d.normal;
    return g;
}

RTCGeometry make_geometry(RTCDevice device, MeshShape const& m) {
    RTCGeometry const g = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    copy_vertices(g, m.mesh->position.data(), m.mesh->position.size());
    std::size_t const count = m.mesh->triangle.size();
    auto* const index = static_cast<std::uint32_t*>(
        rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), count));
    for (std::size_t i = 0; i < count; ++i) std::copy_n(m.mesh->triangle[i].data(), 3, index + 3 * i);
    return g;
}

void frustum_bounds(RTCBoundsFunctionArguments const* a) {
    auto const& f = std::get<Frustum>(static_cast<Shape const*>(a->geometryUserPtr)->geometry);
    Vector const reach = Vector::Constant(std::max(f.radius, f.top_radius) * 1.0001f);  // covers rounding
    Vector const low = f.from.cwiseMin(f.to) - reach, high = f.from.cwiseMax(f.to) + reach;
    *a->bounds_o = {low.x(), low.y(), low.z(), 0, high.x(), high.y(), high.z(), 0};
}

// Those of a hit; both triangles of a quad share the coordinates of its first.
HitCoordinates coordinates(Shape const& shape, float u, float v, std::uint32_t primitive) {
    if (primitive == 1 && std::holds_alternative<Quad>(shape.geometry)) return {1 - u, 1 - v, primitive};
    return {u, v, primitive};
}

Ray lane_of(RTCRayN* rays, unsigned n, unsigned i) {
    return {{RTCRayN_org_x(rays, n, i), RTCRayN_org_y(rays, n, i), RTCRayN_org_z(rays, n, i)},
            {RTCRayN_dir_x(rays, n, i), RTCRayN_dir_y(rays, n, i), RTCRayN_dir_z(rays, n, i)},
            RTCRayN_tnear(rays, n, i),
            RTCRayN_tfar(rays, n, i)};
}

// Embree asks this of each hit on a shape with alpha, in the shape's coordinates.
void filter_by_alpha(RTCFilterFunctionNArguments const* a) {
    Shape const& shape = *static_cast<Shape const*>(a->geometryUserPtr);
    for (unsigned i = 0; i < a->N; ++i) {
        if (!a->valid[i]) continue;
        HitCoordinates const at =
            coordinates(shape, RTCHitN_u(a->hit, a->N, i), RTCHitN_v(a->hit, a->N, i), RTCHitN_primID(a->hit, a->N, i));
        Ray const ray = lane_of(a->ray, a->N, i);
        if (!stops(shape, ray, ray.t_max, at)) a->valid[i] = 0;
    }
}

void frustum_intersect(RTCIntersectFunctionNArguments const* a) {
    Shape const& shape = *static_cast<Shape const*>(a->geometryUserPtr);
    RTCRayN* const rays = RTCRayHitN_RayN(a->rayhit, a->N);
    RTCHitN* const hits = RTCRayHitN_HitN(a->rayhit, a->N);
    for (unsigned i = 0; i < a->N; ++i) {
        std::optional<float> const t =
            a->valid[i] ? first_stop(shape, std::get<Frustum>(shape.geometry), lane_of(rays, a->N, i)) : std::nullopt;
        if (!t) continue;
        RTCRayN_tfar(rays, a->N, i) = *t;
        RTCHitN_geomID(hits, a->N, i) = a->geomID;
        RTCHitN_primID(hits, a->N, i) = a->primID;
        RTCHitN_instID(hits, a->N, i, 0) = a->context->instID[0];
    }
}

void frustum_occluded(RTCOccludedFunctionNArguments const* a) {
    Shape const& shape = *static_cast<Shape const*>(a->geometryUserPtr);
    for (unsigned i = 0; i < a->N; ++i)
        if (a->valid[i] && first_stop(shape, std::get<Frustum>(shape.geometry), lane_of(a->ray, a->N, i)))
            RTCRayN_tfar(a->ray, a->N, i) = -infinity;
}

RTCGeometry make_geometry(RTCDevice device, Frustum const&) {
    RTCGeometry const g = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(g, 1);
    rtcSetGeometryBoundsFunction(g, frustum_bounds, nullptr);
    rtcSetGeometryIntersectFunction(g, frustum_intersect);
    rtcSetGeometryOccludedFunction(g, frustum_occluded);
    return g;
}

void flip(SurfacePoint& p) {
    p.geometric_normal = -p.geometric_normal;
    p.normal = -p.normal;
}

constexpr std::size_t packet_size = 8;

// Embree reads a ray four numbers at a time: so they are written, since a load of fresh narrower stores waits.
void set_ray(RTCRay& ray, Ray const& r) {
    using Four = float __attribute__((vector_size(4 * sizeof(float)), may_alias));
    auto* const fours = reinterpret_cast<Four*>(&ray);
    fours[0] = Four{r.origin.x(), r.origin.y(), r.origin.z(), r.t_min};
    fours[1] = Four{r.direction.x(), r.direction.y(), r.direction.z(), 0 /* time */};
    ray.tfar = r.t_max;
    ray.mask = ~0u;
    ray.id = ray.flags = 0;
}

// The same in lane i of a packet.
void set_lane(RTCRay8& packet, std::size_t i, Ray const& r) {
    packet.org_x[i] = r.origin.x();
    packet.org_y[i] = r.origin.y();
    packet.org_z[i] = r.origin.z();
    packet.tnear[i] = r.t_min;
    packet.dir_x[i] = r.direction.x();
    packet.dir_y[i] = r.direction.y();
    packet.dir_z[i] = r.direction.z();
    packet.time[i] = 0;
    packet.tfar[i] = r.t_max;
    packet.mask[i] = ~0u;
    packet.id[i] = packet.flags[i] = 0;
}

// Which lanes of a packet hold one of `count` rays.
std::array<int, packet_size> valid_lanes(std::size_t count) {
    std::array<int, packet_size> valid;
    for (std::size_t i = 0; i < packet_size; ++i) valid[i] = i < count ? -1 : 0;
    return valid;
}

RTCIntersectContext context_of(RTCIntersectContextFlags flags) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = flags;
    return context;
}

struct PlacedObject {
    ObjectGeometry const* object;
    Eigen::Affine3f to_world, to_object;
};

}  // namespace

struct Accelerator::Implementation {
    RTCDevice device = rtcNewDevice(nullptr);
    RTCScene scene = nullptr;
    std::vector<RTCScene> object_scenes;
    std::vector<Shape> const* shapes = nullptr;
    std::vector<PlacedObject> instances;
    unsigned first_instance = 0;  // geometry ids below are shapes, from here on instances
    float least_size = 0;         // of its points: usual_size, less in scenes that are small themselves

    ~Implementation() {
        for (RTCScene s : object_scenes) rtcReleaseScene(s);
        if (scene) rtcReleaseScene(scene);
        rtcReleaseDevice(device);
    }

    RTCScene new_scene() const {
        RTCScene const s = rtcNewScene(device);
        rtcSetSceneFlags(s, RTC_SCENE_FLAG_ROBUST);
        rtcSetSceneBuildQuality(s, RTC_BUILD_QUALITY_HIGH);
        return s;
    }

    void attach(RTCScene s, RTCGeometry geometry) const {
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(s, geometry);
        rtcReleaseGeometry(geometry);
    }

    void attach_shapes(RTCScene s, std::vector<Shape> const& all) const {
        for (Shape const& shape : all) {
            RTCGeometry const g =
                std::visit([&](auto const& geometry) { return make_geometry(device, geometry); }, shape.geometry);
            rtcSetGeometryUserData(g, const_cast<Shape*>(&shape));
            if (shape.alpha && !std::holds_alternative<Frustum>(shape.geometry)) {
                rtcSetGeometryIntersectFilterFunction(g, filter_by_alpha);
                rtcSetGeometryOccludedFilterFunction(g, filter_by_alpha);
            }
            attach(s, g);
        }
    }

    // What Embree found at `distance` along the ray of a query, as a point of a surface.
    [[gnu::always_inline]] void describe(ClosestQuery const& query, float distance, RTCHit const& embree_hit) const {
        Ray const& ray = *query.ray;
        Hit& hit = *query.hit;
        hit.distance = distance;
        hit.primitive = embree_hit.primID;
        bool const in_instance = embree_hit.instID[0] != RTC_INVALID_GEOMETRY_ID;
        PlacedObject const* const placed = in_instance ? &instances[embree_hit.instID[0] - first_instance] : nullptr;
        hit.shape = placed ? &placed->object->shapes[embree_hit.geomID] : &(*shapes)[embree_hit.geomID];
        HitCoordinates const at = coordinates(*hit.shape, embree_hit.u, embree_hit.v, embree_hit.primID);
        Vector on_ray = ray.origin + hit.distance * ray.direction;
        if (placed) on_ray = placed->to_object * on_ray;
        std::visit([&](auto const& g) { locate(g, on_ray, at, hit.point); }, hit.shape->geometry);
        if (hit.shape->parametrised) parametrise(hit.shape->geometry, at, hit.point);
        if (hit.shape->flipped) flip(hit.point);
        if (placed) place(*placed, hit);
        hit.point.size = std::max(hit.point.size, least_size);
        if (!hit.shape->parametrised) return;
        set_tangent_and_footprint(hit.point, ray.direction, query.cone.width_at(distance));
        if (hit.shape->relief) turn_normal(hit.point, hit.shape->relief->normal_at(hit.point));
    }

    static void place(PlacedObject const& placed, Hit& hit) {
        // Normals are covectors: they go by the inverse transpose.
        auto const normal_map = placed.to_object.linear().transpose();
        SurfacePoint& point = hit.point;
        point.position = placed.to_world * point.position;
        if (point.size > 0) point.size *= placed.to_world.linear().norm();
        point.geometric_normal = (normal_map * point.geometric_normal).normalized();
        point.normal = (normal_map * point.normal).normalized();
        if (!hit.shape->parametrised) return;
        point.dp_du = placed.to_world.linear() * point.dp_du;
        point.dp_dv = placed.to_world.linear() * point.dp_dv;
    }

    void closest_one(ClosestQuery& query, RTCIntersectContext& context, RayStatistics& statistics) const {
        RTCRayHit rh;
        set_ray(rh.ray, *query.ray);
        rh.hit.geomID = rh.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
        {
            Stopwatch const watch(statistics);
            rtcIntersect1(scene, &context, &rh);
        }
        query.found = rh.hit.geomID != RTC_INVALID_GEOMETRY_ID;
        if (query.found) describe(query, rh.ray.tfar, rh.hit);
    }

    void closest_packet(std::span<ClosestQuery> queries, RayStatistics& statistics) const {
        RTCRayHit8 rh;
        for (std::size_t i = 0; i < packet_size; ++i) {
            set_lane(rh.ray, i, *queries[std::min(i, queries.size() - 1)].ray);
            rh.hit.geomID[i] = rh.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
        }
        alignas(32) auto const valid = valid_lanes(queries.size());
        RTCIntersectContext context = context_of(RTC_INTERSECT_CONTEXT_FLAG_COHERENT);
        {
            Stopwatch const watch(statistics);
            rtcIntersect8(valid.data(), scene, &context, &rh);
        }
        auto* const hits = reinterpret_cast<RTCHitN*>(&rh.hit);
        for (std::size_t i = 0; i < queries.size(); ++i) {
            queries[i].found = rh.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID;
            if (queries[i].found)
                describe(queries[i], rh.ray.tfar[i], rtcGetHitFromHitN(hits, packet_size, static_cast<unsigned>(i)));
        }
    }

    void occluded_packet(std::span<ShadowQuery> queries, RayStatistics& statistics) const {
        RTCRay8 r;
        for (std::size_t i = 0; i < packet_size; ++i) set_lane(r, i, queries[std::min(i, queries.size() - 1)].ray);
        alignas(32) auto const valid = valid_lanes(queries.size());
        RTCIntersectContext context = context_of(RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT);
        {
            Stopwatch const watch(statistics);
            rtcOccluded8(valid.data(), scene, &context, &r);
        }
        for (std::size_t i = 0; i < queries.size(); ++i) queries[i].occluded = r.tfar[i] < 0;
    }
};

Accelerator::Accelerator(std::vector<Shape> const& shapes, std::vector<ObjectGeometry> const& objects,
                         std::vector<InstancePlacement> const& instances)
    : implementation_(std::make_unique<Implementation>()) {
    Implementation& self = *implementation_;
    self.shapes = &shapes;
    for (ObjectGeometry const& object : objects) {
        RTCScene const s = self.new_scene();
        self.attach_shapes(s, object.shapes);
        rtcCommitScene(s);
        self.object_scenes.push_back(s);
    }
    self.scene = self.new_scene();
    self.attach_shapes(self.scene, shapes);
    self.first_instance = static_cast<unsigned>(shapes.size());
    for (InstancePlacement const& placement : instances) {
        RTCGeometry const g = rtcNewGeometry(self.device, RTC_GEOMETRY_TYPE_INSTANCE);
        rtcSetGeometryInstancedScene(g, self.object_scenes[static_cast<std::size_t>(placement.object)]);
        Eigen::Matrix<float, 3, 4> const m = placement.to_world.matrix().topRows<3>().cast<float>();  // column major
        rtcSetGeometryTransform(g, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, m.data());
        self.attach(self.scene, g);
        self.instances.push_back({&objects[static_cast<std::size_t>(placement.object)],
                                  placement.to_world.cast<float>(), placement.to_world.inverse().cast<float>()});
    }
    rtcCommitScene(self.scene);
    if (RTCError const error = rtcGetDeviceError(self.device); error != RTC_ERROR_NONE)
        throw std::runtime_error("Embree could not build the scene (error " + std::to_string(error) + ")");
    constexpr float of_the_scene = 2e-5f;
    self.least_size = std::min(usual_size, of_the_scene * (upper_bound() - lower_bound()).norm());
}

Accelerator::~Accelerator() = default;
Accelerator::Accelerator(Accelerator&&) noexcept = default;

std::optional<Hit> Accelerator::closest(Ray const& ray, RayStatistics& statistics) const {
    std::optional<Hit> hit(std::in_place);
    ClosestQuery query{&ray, &*hit};
    closest({&query, 1}, Coherence::none, statistics);
    if (!query.found) hit.reset();
    return hit;
}

void Accelerator::closest(std::span<ClosestQuery> queries, Coherence coherence, RayStatistics& statistics) const {
    statistics.closest_rays += queries.size();
    if (statistics.recording)
        for (ClosestQuery const& q : queries) statistics.recording->push_back({*q.ray, false});
    RTCIntersectContext context = context_of(RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT);
    if (coherence == Coherence::none)
        for (ClosestQuery& q : queries) implementation_->closest_one(q, context, statistics);
    else
        for (; !queries.empty(); queries = queries.subspan(std::min(packet_size, queries.size())))
            implementation_->closest_packet(queries.first(std::min(packet_size, queries.size())), statistics);
}

bool Accelerator::occluded(Ray const& ray, RayStatistics& statistics) const {
    ShadowQuery query{ray};
    occluded({&query, 1}, statistics);
    return query.occluded;
}

void Accelerator::occluded(std::span<ShadowQuery> queries, RayStatistics& statistics) const {
    statistics.shadow_rays += queries.size();
    if (statistics.recording)
        for (ShadowQuery const& q : queries) statistics.recording->push_back({q.ray, true});
    for (; !queries.empty(); queries = queries.subspan(std::min(packet_size, queries.size())))
        implementation_->occluded_packet(queries.first(std::min(packet_size, queries.size())), statistics);
}

Vector Accelerator::lower_bound() const {
    RTCBounds b;
    rtcGetSceneBounds(implementation_->scene, &b);
    return b.lower_x <= b.upper_x ? Vector(b.lower_x, b.lower_y, b.lower_z) : Vector(0, 0, 0);
}
Vector Accelerator::upper_bound() const {
    RTCBounds b;
    rtcGetSceneBounds(implementation_->scene, &b);
    return b.lower_x <= b.upper_x ? Vector(b.upper_x, b.upper_y, b.upper_z) : Vector(0, 0, 0);
}

std::uint64_t Accelerator::trace_bare(std::span<RecordedRay const> rays) const {
    std::uint64_t hits = 0;
    for (RecordedRay const& recorded : rays) {
        RTCRayHit rh;
        set_ray(rh.ray, recorded.ray);
        rh.hit.geomID = rh.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        if (recorded.shadow) {
            rtcOccluded1(implementation_->scene, &context, &rh.ray);
            hits += rh.ray.tfar < 0;
        } else {
            rtcIntersect1(implementation_->scene, &context, &rh);
            hits += rh.hit.geomID != RTC_INVALID_GEOMETRY_ID;
        }
    }
    return hits;
}

}  // namespace iride
