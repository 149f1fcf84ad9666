// SPDX-License-Identifier: Apache-2.0
#include "scene/accelerator.h"

#include <embree3/rtcore.h>
#include <x86intrin.h>

#include <array>
#include <limits>
#include <stdexcept>

#include "scene/frustum_intersection.h"

namespace iride {

std::uint64_t processor_ticks() { return __rdtsc(); }

void RayStatistics::add(RayStatistics const& other) {
    closest_rays += other.closest_rays;
    shadow_rays += other.shadow_rays;
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
    RTCGeometry const g = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_QUAD);
    copy_vertices(g, q.corner.data(), 4);
    auto* const index = static_cast<std::uint32_t*>(
        rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT4, 4 * sizeof(std::uint32_t), 1));
    for (std::uint32_t i = 0; i < 4; ++i) index[i] = i;
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

Ray lane_of(RTCRayN* rays, unsigned n, unsigned i) {
    return {{RTCRayN_org_x(rays, n, i), RTCRayN_org_y(rays, n, i), RTCRayN_org_z(rays, n, i)},
            {RTCRayN_dir_x(rays, n, i), RTCRayN_dir_y(rays, n, i), RTCRayN_dir_z(rays, n, i)},
            RTCRayN_tnear(rays, n, i),
            RTCRayN_tfar(rays, n, i)};
}

void frustum_intersect(RTCIntersectFunctionNArguments const* a) {
    auto const& f = std::get<Frustum>(static_cast<Shape const*>(a->geometryUserPtr)->geometry);
    RTCRayN* const rays = RTCRayHitN_RayN(a->rayhit, a->N);
    RTCHitN* const hits = RTCRayHitN_HitN(a->rayhit, a->N);
    for (unsigned i = 0; i < a->N; ++i) {
        std::optional<float> const t = a->valid[i] ? intersect(f, lane_of(rays, a->N, i)) : std::nullopt;
        if (!t) continue;
        RTCRayN_tfar(rays, a->N, i) = *t;
        RTCHitN_geomID(hits, a->N, i) = a->geomID;
        RTCHitN_primID(hits, a->N, i) = a->primID;
        RTCHitN_instID(hits, a->N, i, 0) = a->context->instID[0];
    }
}

void frustum_occluded(RTCOccludedFunctionNArguments const* a) {
    auto const& f = std::get<Frustum>(static_cast<Shape const*>(a->geometryUserPtr)->geometry);
    for (unsigned i = 0; i < a->N; ++i)
        if (a->valid[i] && intersect(f, lane_of(a->ray, a->N, i))) RTCRayN_tfar(a->ray, a->N, i) = -infinity;
}

RTCGeometry make_geometry(RTCDevice device, Frustum const&) {
    RTCGeometry const g = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(g, 1);
    rtcSetGeometryBoundsFunction(g, frustum_bounds, nullptr);
    rtcSetGeometryIntersectFunction(g, frustum_intersect);
    rtcSetGeometryOccludedFunction(g, frustum_occluded);
    return g;
}

// Position, normals and uv of a hit, in the coordinates of the shape. `on_ray` is the point along the ray: shapes with
// a closed form pull it onto the surface, which leaves an error of a few units in the last place.
SurfacePoint surface_point(Sphere const& s, Vector const& on_ray, RTCHit const&) {
    Direction const n = (on_ray - s.centre).normalized();
    return {s.centre + s.radius * n, n, n};
}
SurfacePoint surface_point(Quad const& q, Vector const&, RTCHit const& hit) {
    // Embree's quad is the triangles (0 1 3), parametrised by (u, v), and (2 3 1), by (1 - u, 1 - v).
    auto const& c = q.corner;
    float const u = hit.u, v = hit.v;
    Vector const p = u + v <= 1 ? Vector(c[0] + u * (c[1] - c[0]) + v * (c[3] - c[0]))
                                : Vector(c[2] + (1 - u) * (c[3] - c[2]) + (1 - v) * (c[1] - c[2]));
    return {p, q.normal, q.normal, {u, v}};
}
SurfacePoint surface_point(Disc const& d, Vector const& on_ray, RTCHit const&) {
    return {on_ray - d.normal * d.normal.dot(on_ray - d.centre), d.normal, d.normal};
}
SurfacePoint surface_point(Frustum const& f, Vector const& on_ray, RTCHit const&) {
    auto const [position, normal] = project(f, on_ray);
    return {position, normal, normal};
}
SurfacePoint surface_point(MeshShape const& m, Vector const&, RTCHit const& hit) {
    auto const& t = m.mesh->triangle[hit.primID];
    Vector const &a = m.mesh->position[t[0]], &b = m.mesh->position[t[1]], &c = m.mesh->position[t[2]];
    float const u = hit.u, v = hit.v, w = 1 - u - v;
    Direction const n = (b - a).cross(c - a).normalized();
    SurfacePoint point{w * a + u * b + v * c, n, n};
    if (m.smooth && !m.mesh->normal.empty()) {
        auto const& N = m.mesh->normal;
        point.normal = (w * N[t[0]] + u * N[t[1]] + v * N[t[2]]).normalized();
        if (point.normal.dot(n) < 0) point.normal = -point.normal;  // the winding decides which side is the front
    }
    if (!m.mesh->uv.empty()) point.uv = w * m.mesh->uv[t[0]] + u * m.mesh->uv[t[1]] + v * m.mesh->uv[t[2]];
    return point;
}

void flip(SurfacePoint& p) {
    p.geometric_normal = -p.geometric_normal;
    p.normal = -p.normal;
}

constexpr std::size_t packet_size = 8;

RTCRay to_embree(Ray const& r) {
    return {r.origin.x(),
            r.origin.y(),
            r.origin.z(),
            r.t_min,
            r.direction.x(),
            r.direction.y(),
            r.direction.z(),
            0 /* time */,
            r.t_max,
            ~0u /* mask */,
            0,
            0};
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
            attach(s, g);
        }
    }

    // What Embree found at `distance` along a ray, as a point of a surface.
    void describe(Ray const& ray, float distance, RTCHit const& embree_hit, Hit& hit) const {
        hit.distance = distance;
        hit.primitive = embree_hit.primID;
        bool const in_instance = embree_hit.instID[0] != RTC_INVALID_GEOMETRY_ID;
        PlacedObject const* const placed = in_instance ? &instances[embree_hit.instID[0] - first_instance] : nullptr;
        hit.shape = placed ? &placed->object->shapes[embree_hit.geomID] : &(*shapes)[embree_hit.geomID];
        Vector on_ray = ray.origin + hit.distance * ray.direction;
        if (placed) on_ray = placed->to_object * on_ray;
        hit.point =
            std::visit([&](auto const& g) { return surface_point(g, on_ray, embree_hit); }, hit.shape->geometry);
        if (hit.shape->flipped) flip(hit.point);
        if (placed) {
            // Normals are covectors: they go by the inverse transpose.
            auto const normal_map = placed->to_object.linear().transpose();
            hit.point.position = placed->to_world * hit.point.position;
            hit.point.geometric_normal = (normal_map * hit.point.geometric_normal).normalized();
            hit.point.normal = (normal_map * hit.point.normal).normalized();
        }
    }

    void closest_one(ClosestQuery& query, RayStatistics& statistics) const {
        RTCRayHit rh;
        rh.ray = to_embree(*query.ray);
        rh.hit.geomID = rh.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
        RTCIntersectContext context = context_of(RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT);
        {
            Stopwatch const watch(statistics);
            rtcIntersect1(scene, &context, &rh);
        }
        query.found = rh.hit.geomID != RTC_INVALID_GEOMETRY_ID;
        if (query.found) describe(*query.ray, rh.ray.tfar, rh.hit, *query.hit);
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
                describe(*queries[i].ray, rh.ray.tfar[i],
                         rtcGetHitFromHitN(hits, packet_size, static_cast<unsigned>(i)), *queries[i].hit);
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
}

Accelerator::~Accelerator() = default;
Accelerator::Accelerator(Accelerator&&) noexcept = default;

std::optional<Hit> Accelerator::closest(Ray const& ray, RayStatistics& statistics) const {
    Hit hit;
    ClosestQuery query{&ray, &hit};
    closest({&query, 1}, Coherence::none, statistics);
    return query.found ? std::optional(hit) : std::nullopt;
}

void Accelerator::closest(std::span<ClosestQuery> queries, Coherence coherence, RayStatistics& statistics) const {
    statistics.closest_rays += queries.size();
    if (statistics.recording)
        for (ClosestQuery const& q : queries) statistics.recording->push_back({*q.ray, false});
    if (coherence == Coherence::none)
        for (ClosestQuery& q : queries) implementation_->closest_one(q, statistics);
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
void* Accelerator::embree_scene() const { return implementation_->scene; }

}  // namespace iride
