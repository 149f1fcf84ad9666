// SPDX-License-Identifier: Apache-2.0
// Emitters on shapes.
#include <array>

#include "base/bilinear.h"
#include "base/simd.h"
#include "base/spherical.h"
#include "scene/light.h"

namespace iride {

namespace {

// Below this solid angle [sr] the spherical formulas lose their digits (angles of order 1e-3 subtracted in float) and
// sampling by area is as good: the density hardly varies.
constexpr float smallest_solid_angle = 1e-3f;

class AreaLight : public Light {
  public:
    AreaLight(EmitterStrength strength, double area, bool flipped)
        : strength_(std::move(strength)), area_(area), flipped_(flipped) {}

    std::optional<EmissionSample> emit(Ball const& scene, Wavelengths const& wavelengths, Sample2 place,
                                       Sample2 direction) const override {
        Place const at = uniform_place(place);
        Direction normal = flipped_ ? Direction(-at.outward) : at.outward;
        SurfacePoint from{at.point, normal, normal};
        if (strength_.emitter.two_sided) {
            bool const back = direction.x >= 0.5f;
            direction.x = 2 * direction.x - (back ? 1 : 0);
            if (back) normal = -normal;
        }
        Direction const local = strength_.emitter.profile.sample(direction);
        float const s = strength_.emitter.share(local.z());
        if (!(local.z() > 0 && s > 0)) return std::nullopt;
        Direction const travel = Frame::around(normal).to_world(local);
        return std::optional<EmissionSample>(std::in_place, from, at.primitive, travel, local.z(),
                                             emission_density(scene, travel, local.z()),
                                             strength_.emitter.radiance.at(wavelengths) * s);
    }
    EmissionDensity emission_density(Ball const&, Direction const&, float cosine) const override {
        float const both = strength_.emitter.share(cosine) * std::abs(cosine) /
                           static_cast<float>(strength_.emitter.profile.exitance() * sides());
        return {PerSquareMetre(1 / static_cast<float>(area_)), PerSteradian(both)};
    }
    LightExtent extent() const override { return LightExtent::area; }

    Radiance emitted(SurfacePoint const& on, Direction const& wo, Wavelengths const& wavelengths) const override {
        float const share = strength_.emitter.share(wo.dot(on.geometric_normal));
        return share > 0 ? strength_.emitter.radiance.at(wavelengths) * share : Radiance{};
    }
    std::optional<LightSample> sample_by_area(Vector const& from, Wavelengths const& wavelengths,
                                              Sample2 u) const override {
        auto const [point, n, primitive] = uniform_place(u);
        return towards(from, point, n, wavelengths, area_density(static_cast<float>(area_), from, point, n));
    }
    double power(double) const override {
        return strength_.emitter.profile.exitance() * area_ * strength_.luminance * sides();
    }

  protected:
    struct Place {
        Vector point;
        Direction outward;
        std::uint32_t primitive = 0;
    };
    // Uniform over the area.
    virtual Place uniform_place(Sample2 u) const = 0;
    // `projected`: the largest area seen from anywhere.
    LightBounds bounds_of(VectorDouble const& lower, VectorDouble const& upper, VectorDouble const& axis,
                          double normals_rad, double projected) const {
        return {lower,
                upper,
                flipped_ ? VectorDouble(-axis) : axis,
                normals_rad,
                std::acos(static_cast<double>(strength_.emitter.profile.cosine_end)),
                strength_.emitter.two_sided,
                projected * strength_.luminance};
    }

    int sides() const { return strength_.emitter.two_sided ? 2 : 1; }

    // Whether a point of outward normal n may shine along -d.
    bool shines(Vector const& d, Direction const& n) const {
        float const side = facing(d, n);
        return side > 0 || (side < 0 && strength_.emitter.two_sided);
    }
    // The share of the radiance that goes along -d, `distance` long, from where shines(d, n).
    float share(Vector const& d, float distance, Direction const& n) const {
        Emitter const& e = strength_.emitter;
        return e.profile.is_diffuse() ? 1 : e.share(facing(d, n) / distance);
    }

    // Answer with the place at d from the asking point, of outward normal n, where it shines; found with the given
    // density.
    void put(LightRequest& r, Vector const& d, Direction const& n, PerSteradian density) const {
        float const distance = d.norm();
        if (!(distance > 0 && density.value > 0 && density.value < infinity)) return;
        float const s = share(d, distance, n);
        if (s > 0)
            r.sample.emplace(d / distance, distance, strength_.emitter.radiance.at(*r.wavelengths) * s, density,
                             std::abs(facing(d, n)) / distance);
    }

    // A point of the surface with its outward normal, found with the given density.
    std::optional<LightSample> towards(Vector const& from, Vector const& point, Direction const& outward,
                                       Wavelengths const& wavelengths, PerSteradian density) const {
        LightRequest request{from, {}, &wavelengths};
        if (shines(point - from, outward)) put(request, point - from, outward, density);
        return request.sample;
    }

    static PerSteradian area_density(float area, Vector const& from, Vector const& point, Direction const& normal) {
        Vector const d = point - from;
        float const r = d.norm();
        return to_solid_angle(PerSquareMetre(1 / area), Metres(r), d.dot(normal) / r);
    }

    EmitterStrength strength_;
    double area_;
    bool flipped_;

  private:
    // |d| cos of the angle between -d and the front's normal.
    float facing(Vector const& d, Direction const& n) const { return flipped_ ? d.dot(n) : -d.dot(n); }
};

// Uniform in the cone that the sphere fills, seen from outside; by area from inside.
class SphereLight final : public AreaLight {
  public:
    SphereLight(Sphere const& sphere, EmitterStrength strength, bool flipped)
        : AreaLight(std::move(strength), 4 * pi_double * square(static_cast<double>(sphere.radius)), flipped),
          sphere_(sphere) {}

    std::optional<LightSample> sample(Vector const& from, Wavelengths const& wavelengths, Sample2 u) const override {
        if (!outside(from)) return sample_by_area(from, wavelengths, u);
        Vector const d = sphere_.centre - from;
        float const distance = d.norm(), height = height_of_cone(from);
        Direction const wi = Frame::around(d / distance).to_world(to_cone(u, height));
        // Where wi meets the sphere: the nearer of b -+ sqrt(r^2 - |across|^2).
        float const along = wi.dot(d);
        float const half_chord2 = square(sphere_.radius) - (d - along * wi).squaredNorm();
        Vector const point = from + (along - std::sqrt(std::max(0.0f, half_chord2))) * wi;
        Direction const n = (point - sphere_.centre).normalized();
        float const s = shines(wi, n) ? share(wi, 1, n) : 0;
        if (s == 0) return std::nullopt;
        return std::optional<LightSample>(std::in_place, wi, (point - from).norm(),
                                          strength_.emitter.radiance.at(wavelengths) * s, cone_density(height),
                                          std::abs(wi.dot(n)));
    }
    std::optional<LightBounds> bounds() const override {
        VectorDouble const centre = sphere_.centre.cast<double>();
        double const r = static_cast<double>(sphere_.radius);
        VectorDouble const reach = VectorDouble::Constant(r);
        return bounds_of(centre - reach, centre + reach, {0, 0, 1}, pi_double, pi_double * square(r));
    }
    PerSteradian density(Vector const& from, SurfacePoint const& on, std::uint32_t) const override {
        if (outside(from)) return cone_density(height_of_cone(from));
        return area_density(static_cast<float>(area_), from, on.position, on.geometric_normal);
    }

  private:
    Place uniform_place(Sample2 u) const override {
        Direction const n = to_sphere(u);
        return {sphere_.centre + sphere_.radius * n, n};
    }
    // A little clear of the surface, where the cone is a hemisphere and the density no longer helps.
    bool outside(Vector const& from) const {
        return (from - sphere_.centre).squaredNorm() > square(sphere_.radius) * 1.0001f;
    }
    float height_of_cone(Vector const& from) const {
        return cone_height(square(sphere_.radius) / (from - sphere_.centre).squaredNorm());
    }
    Sphere sphere_;
};

class RectangleLight final : public AreaLight {
  public:
    RectangleLight(Quad const& quad, EmitterStrength strength, bool flipped)
        : AreaLight(std::move(strength), quad.area(), flipped),
          rectangle_(Rectangle::from_edges(quad.corner[0], quad.corner[1] - quad.corner[0],
                                           quad.corner[3] - quad.corner[0])) {}

    std::optional<LightSample> sample(Vector const& from, Wavelengths const& wavelengths, Sample2 u) const override {
        LightRequest request{from, u, &wavelengths};
        answer({&request, 1});
        if (!request.sample) return std::nullopt;
        return *request.sample;
    }
    void answer(std::span<LightRequest> requests) const override {
        for (std::size_t first = 0; first < requests.size(); first += real_lanes)
            answer_eight(requests.subspan(first, std::min<std::size_t>(real_lanes, requests.size() - first)));
    }
    PerSteradian density(Vector const& from, SurfacePoint const& on, std::uint32_t) const override {
        SphericalRectangle<float> const seen(rectangle_, {from.x(), from.y(), from.z()});
        if (seen.solid_angle() > smallest_solid_angle) return PerSteradian(1 / seen.solid_angle());
        return area_density(static_cast<float>(area_), from, on.position, rectangle_.normal);
    }

    std::optional<LightBounds> bounds() const override {
        VectorDouble const a = rectangle_.corner.cast<double>(), x = (rectangle_.width * rectangle_.x).cast<double>(),
                           y = (rectangle_.height * rectangle_.y).cast<double>();
        VectorDouble const zero(0, 0, 0);
        return bounds_of(a + x.cwiseMin(zero) + y.cwiseMin(zero), a + x.cwiseMax(zero) + y.cwiseMax(zero),
                         rectangle_.normal.cast<double>(), 0, area_);
    }

  private:
    Place uniform_place(Sample2 u) const override {
        return {rectangle_.corner + u.x * rectangle_.width * rectangle_.x + u.y * rectangle_.height * rectangle_.y,
                rectangle_.normal};
    }
    // At most eight requests, side by side in registers.
    [[gnu::flatten]] void answer_eight(std::span<LightRequest> requests) const {
        Real8 x{}, y{}, z{}, u{}, v{};
        for (std::size_t i = 0; i < requests.size(); ++i) {
            LightRequest const& r = requests[i];
            x[i] = r.from.x(), y[i] = r.from.y(), z[i] = r.from.z(), u[i] = r.u.x, v[i] = r.u.y;
        }
        SphericalRectangle<Real8> const seen(rectangle_, {x, y, z});
        Real8 const solid_angle = seen.solid_angle();
        Real8 density = 1 / solid_angle;
        if (requests.front().normal != Vector(0, 0, 0)) {
            auto const place = BilinearDensity<Real8>(cosines_of_corners(requests, {x, y, z})).sample(u, v);
            u = place.x, v = place.y, density *= place.density;
        }
        std::array<Real8, 3> const d = seen.sample(u, v);
        for (std::size_t i = 0; i < requests.size(); ++i) {
            LightRequest& r = requests[i];
            r.sample.reset();
            if (!shines(rectangle_.corner - r.from, rectangle_.normal)) continue;
            if (solid_angle[i] > smallest_solid_angle)
                put(r, {d[0][i], d[1][i], d[2][i]}, rectangle_.normal, PerSteradian(density[i]));
            else
                sample_area(r);
        }
    }

    // At the receivers, of the directions to the rectangle's corners; a little above 0 where they are below.
    std::array<Real8, 4> cosines_of_corners(std::span<LightRequest const> requests,
                                            std::array<Real8, 3> const& from) const {
        constexpr float least = 0.01f;
        std::array<Real8, 3> n{};
        for (std::size_t i = 0; i < requests.size(); ++i)
            for (std::size_t k = 0; k < 3; ++k) n[k][i] = requests[i].normal[static_cast<Eigen::Index>(k)];
        std::array<Real8, 4> cosines;
        for (int c = 0; c < 4; ++c) {
            Vector const corner = rectangle_.corner + static_cast<float>(c % 2) * rectangle_.width * rectangle_.x +
                                  static_cast<float>(c / 2) * rectangle_.height * rectangle_.y;
            Real8 along{}, length2{};
            for (std::size_t k = 0; k < 3; ++k) {
                Real8 const d = corner[static_cast<Eigen::Index>(k)] - from[k];
                along += d * n[k];
                length2 += d * d;
            }
            cosines[static_cast<std::size_t>(c)] = larger(along / square_root(length2), Real8{} + least);
        }
        return cosines;
    }

    void sample_area(LightRequest& r) const {
        Vector const point = uniform_place(r.u).point;
        put(r, point - r.from, rectangle_.normal,
            area_density(static_cast<float>(area_), r.from, point, rectangle_.normal));
    }

    Rectangle rectangle_;
};

// Triangles, chosen by area, each then by its solid angle.
class TrianglesLight final : public AreaLight {
  public:
    using Triangle = std::array<Vector, 3>;

    TrianglesLight(std::vector<Triangle> triangles, EmitterStrength strength, bool flipped)
        : AreaLight(std::move(strength), 0, flipped), triangles_(std::move(triangles)) {
        std::vector<double> areas;
        for (Triangle const& t : triangles_) areas.push_back(area(t));
        by_area_ = DiscreteDistribution(areas);
        area_ = by_area_.total_weight();
    }

    std::optional<LightSample> sample(Vector const& from, Wavelengths const& wavelengths, Sample2 u) const override {
        auto const choice = by_area_.sample(u.x);
        Triangle const& t = triangles_[static_cast<std::size_t>(choice.index)];
        Sample2 const v{choice.rest, u.y};
        Direction const n = normal_of(t);
        Vector point;
        if (solid_angle(t, from) > smallest_solid_angle) {
            Direction const wi = sample_spherical_triangle((t[0] - from).normalized(), (t[1] - from).normalized(),
                                                           (t[2] - from).normalized(), v);
            point = from + wi * ((t[0] - from).dot(n) / wi.dot(n));
        } else {
            point = in_triangle(t, v);
        }
        return towards(from, point, n, wavelengths, triangle_density(t, from, point, n) * choice.probability);
    }
    PerSteradian density(Vector const& from, SurfacePoint const& on, std::uint32_t primitive) const override {
        std::size_t const i = triangles_.size() == 1 ? 0 : primitive;
        return triangle_density(triangles_[i], from, on.position, on.geometric_normal) *
               by_area_.probability(static_cast<int>(i));
    }

    // Around the mean normal; of a closed mesh a quarter of the area is seen.
    std::optional<LightBounds> bounds() const override {
        VectorDouble lower = triangles_[0][0].cast<double>(), upper = lower, sum(0, 0, 0);
        for (Triangle const& t : triangles_) {
            sum += area(t) * normal_of(t).cast<double>();
            for (Vector const& p : t)
                lower = lower.cwiseMin(p.cast<double>()), upper = upper.cwiseMax(p.cast<double>());
        }
        bool const closed = !(sum.norm() > 1e-6 * area_);  // no mean to speak of
        VectorDouble const axis = closed ? VectorDouble(0, 0, 1) : VectorDouble(sum.normalized());
        double widest = closed ? pi_double : 0;
        for (Triangle const& t : triangles_) {
            VectorDouble const n = normal_of(t).cast<double>();
            if (area(t) > 0) widest = std::max(widest, std::atan2(axis.cross(n).norm(), axis.dot(n)));
        }
        return bounds_of(lower, upper, axis, widest, std::max(sum.norm(), area_ / 4));
    }

  private:
    static Direction normal_of(Triangle const& t) { return (t[1] - t[0]).cross(t[2] - t[0]).normalized(); }
    Place uniform_place(Sample2 u) const override {
        auto const choice = by_area_.sample(u.x);
        Triangle const& t = triangles_[static_cast<std::size_t>(choice.index)];
        return {in_triangle(t, {choice.rest, u.y}), normal_of(t), static_cast<std::uint32_t>(choice.index)};
    }
    static Vector in_triangle(Triangle const& t, Sample2 u) {
        Vector2 const b = to_triangle(u);
        return t[0] + b.x() * (t[1] - t[0]) + b.y() * (t[2] - t[0]);
    }
    static double area(Triangle const& t) { return 0.5 * (t[1] - t[0]).cross(t[2] - t[0]).norm(); }
    static float solid_angle(Triangle const& t, Vector const& from) {
        return triangle_solid_angle((t[0] - from).normalized(), (t[1] - from).normalized(), (t[2] - from).normalized());
    }
    static PerSteradian triangle_density(Triangle const& t, Vector const& from, Vector const& point,
                                         Direction const& n) {
        float const seen = solid_angle(t, from);
        if (seen > smallest_solid_angle) return PerSteradian(1 / seen);
        return area_density(static_cast<float>(area(t)), from, point, n);
    }

    std::vector<Triangle> triangles_;
    DiscreteDistribution by_area_;
};

// Discs and frusta: uniform over the area.
class DiscLight final : public AreaLight {
  public:
    DiscLight(Disc const& disc, EmitterStrength strength, bool flipped)
        : AreaLight(std::move(strength), pi_double * square(static_cast<double>(disc.radius)), flipped),
          disc_(disc),
          frame_(Frame::around(disc.normal)) {}

    std::optional<LightSample> sample(Vector const& from, Wavelengths const& wavelengths, Sample2 u) const override {
        return sample_by_area(from, wavelengths, u);
    }
    PerSteradian density(Vector const& from, SurfacePoint const& on, std::uint32_t) const override {
        return area_density(static_cast<float>(area_), from, on.position, disc_.normal);
    }

    std::optional<LightBounds> bounds() const override {
        VectorDouble const n = disc_.normal.cast<double>(), centre = disc_.centre.cast<double>();
        VectorDouble const reach = static_cast<double>(disc_.radius) * (1 - n.array().square()).max(0).sqrt().matrix();
        return bounds_of(centre - reach, centre + reach, n, 0, area_);
    }

  private:
    Place uniform_place(Sample2 u) const override {
        Vector2 const d = disc_.radius * to_disc(u);
        return {disc_.centre + frame_.to_world({d.x(), d.y(), 0}), disc_.normal};
    }

    Disc disc_;
    Frame frame_;
};

class FrustumLight final : public AreaLight {
  public:
    FrustumLight(Frustum const& f, EmitterStrength strength, bool flipped)
        : AreaLight(std::move(strength), f.area(), flipped),
          frustum_(f),
          frame_(Frame::around((f.to - f.from).normalized())) {}

    std::optional<LightSample> sample(Vector const& from, Wavelengths const& wavelengths, Sample2 u) const override {
        return sample_by_area(from, wavelengths, u);
    }
    PerSteradian density(Vector const& from, SurfacePoint const& on, std::uint32_t) const override {
        return area_density(static_cast<float>(area_), from, on.position, on.geometric_normal);
    }

    // Seen from beside it, a side shows 1 / pi of its area.
    std::optional<LightBounds> bounds() const override {
        VectorDouble const a = frustum_.from.cast<double>(), b = frustum_.to.cast<double>();
        VectorDouble const reach =
            VectorDouble::Constant(static_cast<double>(std::max(frustum_.radius, frustum_.top_radius)));
        return bounds_of(a.cwiseMin(b) - reach, a.cwiseMax(b) + reach, {0, 0, 1}, pi_double, area_ / pi_double);
    }

  private:
    Place uniform_place(Sample2 u) const override {
        // Height with density proportional to the radius there, inverted without cancellation:
        // r(z)^2 = r0^2 + u (r1^2 - r0^2).
        float const r0 = frustum_.radius, r1 = frustum_.top_radius;
        float const r = std::sqrt(r0 * r0 + u.x * (r1 * r1 - r0 * r0));
        float const z = r0 + r1 > 0 ? u.x * (r1 + r0) / (r + r0) : 0;  // (r - r0) / (r1 - r0)
        float const m = (r1 - r0) / frustum_.length();
        auto const [sine, cosine] = sine_cosine_of_turns(u.y);
        Vector const outward = frame_.to_world({cosine, sine, 0});
        return {frustum_.from + z * (frustum_.to - frustum_.from) + r * outward,
                (outward - m * frame_.normal).normalized()};
    }

    Frustum frustum_;
    Frame frame_;
};

std::unique_ptr<Light> make(Sphere const& s, EmitterStrength e, bool flipped) {
    return std::make_unique<SphereLight>(s, std::move(e), flipped);
}
std::unique_ptr<Light> make(Quad const& q, EmitterStrength e, bool flipped) {
    if (q.is_rectangle()) return std::make_unique<RectangleLight>(q, std::move(e), flipped);
    auto const& c = q.corner;
    return std::make_unique<TrianglesLight>(
        std::vector<TrianglesLight::Triangle>{{c[0], c[1], c[3]}, {c[2], c[3], c[1]}}, std::move(e), flipped);
}
std::unique_ptr<Light> make(Disc const& d, EmitterStrength e, bool flipped) {
    return std::make_unique<DiscLight>(d, std::move(e), flipped);
}
std::unique_ptr<Light> make(Frustum const& f, EmitterStrength e, bool flipped) {
    return std::make_unique<FrustumLight>(f, std::move(e), flipped);
}
std::unique_ptr<Light> make(MeshShape const& m, EmitterStrength e, bool flipped) {
    std::vector<TrianglesLight::Triangle> triangles;
    for (auto const& t : m.mesh->triangle)
        triangles.push_back({m.mesh->position[t[0]], m.mesh->position[t[1]], m.mesh->position[t[2]]});
    return std::make_unique<TrianglesLight>(std::move(triangles), std::move(e), flipped);
}

}  // namespace

std::unique_ptr<Light> make_area_light(Shape const& shape, EmitterStrength strength) {
    return std::visit([&](auto const& g) { return make(g, std::move(strength), shape.flipped); }, shape.geometry);
}

}  // namespace iride
