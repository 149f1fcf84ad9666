// SPDX-License-Identifier: Apache-2.0
#include "integrators/beams.h"

#include "base/equiangular.h"

namespace iride {

Beams::Beams(LightSet const& lights) : of_light_(lights.size(), -1) {
    std::vector<double> power;
    for (int i = 0; i < static_cast<int>(lights.size()); ++i) {
        Light const& light = lights.light(i);
        if (light.extent() != LightExtent::point || !(lights.probability(i) > 0)) continue;
        LightBounds const bounds = light.bounds().value();
        double const half_angle = bounds.normals_rad + bounds.emission_rad;
        of_light_[static_cast<std::size_t>(i)] = static_cast<int>(lamps_.size());
        lamps_.push_back({i, 0, bounds.lower.cast<float>(), bounds.axis.cast<float>(),
                          half_angle > pi_double / 2 ? -1 : static_cast<float>(std::cos(half_angle))});
        power.push_back(static_cast<double>(lights.probability(i)));
    }
    if (lamps_.empty()) return;
    by_power_ = DiscreteDistribution(power);
    for (int k = 0; k < by_power_.size(); ++k)
        lamps_[static_cast<std::size_t>(k)].probability = by_power_.probability(k);
}

std::vector<Vector> Beams::places() const {
    std::vector<Vector> places;
    for (Lamp const& lamp : lamps_) places.push_back(lamp.place);
    return places;
}

RayPart Beams::Lamp::lit(Ray const& ray) const {
    return cos_cone < 0 ? RayPart{} : part_in_cone(ray, place, axis, cos_cone);
}

Beams::Lamp const* Beams::lamp_of(int light) const {
    int const place = lamps_.empty() ? -1 : of_light_[static_cast<std::size_t>(light)];
    return place < 0 ? nullptr : &lamps_[static_cast<std::size_t>(place)];
}

std::optional<Beams::OnRay> Beams::on_ray(Ray const& ray, float length, Sample2 u) const {
    Lamp const& lamp = lamps_[static_cast<std::size_t>(by_power_.sample(u.x).index)];
    RayPart const lit = lamp.lit(ray), seen = lit.before(length);
    if (seen.empty()) return std::nullopt;
    Equiangular const about_lamp(ray, lamp.place);
    float const angle = about_lamp.angle(seen), whole = about_lamp.angle(lit);
    float const distance = about_lamp.turned(seen.from, u.y * angle);
    if (!(distance >= seen.from && distance < seen.to)) return std::nullopt;
    return OnRay{lamp.light, distance, lamp.probability * about_lamp.angle_per_metre(distance) / whole, angle / whole};
}

float Beams::density_on_ray(Ray const& ray, float distance, int light) const {
    Lamp const* const lamp = lamp_of(light);
    if (!lamp) return 0;
    RayPart const lit = lamp->lit(ray);
    if (!(distance >= lit.from && distance < lit.to)) return 0;
    Equiangular const about_lamp(ray, lamp->place);
    return lamp->probability * about_lamp.angle_per_metre(distance) / about_lamp.angle(lit);
}

namespace {

// p(d) r^2 / d^2.
float seen_from(Vector const& x1, Equiangular const& about_x1, Vector const& place, float d) {
    return about_x1.angle_per_metre(d) / about_x1.angle({}) * (place - x1).squaredNorm() / square(d);
}

}  // namespace

std::optional<Beams::OnBeam> Beams::on_beam(LightSet const& lights, Vector const& x1, Wavelengths const& wavelengths,
                                            Sample2 u, Sample2 direction) const {
    Lamp const& lamp = lamps_[static_cast<std::size_t>(by_power_.sample(u.x).index)];
    auto const e = lights.light(lamp.light).emit({}, wavelengths, {}, direction);
    if (!e) return std::nullopt;
    Ray const beam{lamp.place, e->travel};
    Equiangular const about_x1(beam, x1);
    float const d = about_x1.turned(0, u.y * about_x1.angle({}));
    Vector const place = beam.origin + d * beam.direction;
    float const distance = (place - x1).norm();
    if (!(d > 0 && distance > 0 && distance < infinity)) return std::nullopt;
    float const density = lamp.probability * e->density.direction.value * seen_from(x1, about_x1, place, d);
    return OnBeam{lamp.light, place, e->travel, d, e->radiance, (place - x1) / distance, distance, density};
}

float Beams::density_on_beam(LightSet const& lights, Vector const& x1, Vector const& place, int light,
                             Direction const& to_lamp, float lamp_distance) const {
    Lamp const* const lamp = lamp_of(light);
    if (!lamp) return 0;
    float const direction = lights.light(light).emission_density({}, -to_lamp, 1).direction.value;
    Equiangular const about_x1(Ray{lamp->place, -to_lamp}, x1);
    return lamp->probability * direction * seen_from(x1, about_x1, place, lamp_distance);
}

}  // namespace iride
