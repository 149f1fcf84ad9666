// SPDX-License-Identifier: Apache-2.0
// Lights without extent: point and spot (intensity / r^2), distant (irradiance on a facing plane).
#include "scene/light.h"

namespace iride {

namespace {

class SpotLight final : public Light {
  public:
    SpotLight(Vector const& position, SpotCone cone, Spectrum<dim::spectral_intensity> intensity, double luminance)
        : position_(position), cone_(std::move(cone)), intensity_(std::move(intensity)), luminance_(luminance) {
        power_ = luminance * effective_solid_angle();
    }

    std::optional<LightSample> sample(Vector const& from, Wavelengths const& wavelengths, Sample2) const override {
        Vector const d = position_ - from;
        float const distance = d.norm();
        if (!(distance > 0 && distance < infinity)) return std::nullopt;
        Direction const wi = d / distance;
        float const share = share_along(-wi);
        if (share == 0) return std::nullopt;
        Radiance const arriving((intensity_.at(wavelengths) * (share / square(distance))).lane);
        return std::optional<LightSample>(std::in_place, wi, distance, arriving, std::nullopt);
    }
    std::optional<EmissionSample> emit(Ball const& scene, Wavelengths const& wavelengths, Sample2,
                                       Sample2 direction) const override {
        Direction const travel = Frame::around(cone_.axis).to_world(to_cone(direction, 1 - cone_.cos_end));
        float const share = share_along(travel);
        if (share == 0) return std::nullopt;
        return std::optional<EmissionSample>(std::in_place, SurfacePoint{position_, travel, travel}, 0u, travel, 1.0f,
                                             emission_density(scene, travel, 1),
                                             Radiance((intensity_.at(wavelengths) * share).lane));
    }
    EmissionDensity emission_density(Ball const&, Direction const& travel, float) const override {
        bool const inside = travel.dot(cone_.axis) >= cone_.cos_end;
        return {PerSquareMetre(1), inside ? cone_density(1 - cone_.cos_end) : PerSteradian(0)};
    }
    LightExtent extent() const override { return LightExtent::point; }
    double power(double) const override { return power_; }
    std::optional<LightBounds> bounds() const override {
        VectorDouble const place = position_.cast<double>();
        double const full = std::acos(static_cast<double>(cone_.cos_full)),
                     end = std::acos(static_cast<double>(cone_.cos_end));
        return LightBounds{place, place, cone_.axis.cast<double>(), full, end - full, false, luminance_};
    }

  private:
    // The share of the intensity that goes along d.
    float share_along(Direction const& d) const {
        float const cosine = d.dot(cone_.axis), within = falloff(cosine);
        if (within == 0 || !(cone_.exponent > 0 || cone_.flaps)) return within;
        if (!(cosine > 0)) return 0;
        if (cone_.flaps && !passes(*cone_.flaps, d, cosine)) return 0;
        return cone_.exponent == 0 ? within : within * std::pow(cosine, cone_.exponent);
    }
    static bool passes(SpotFlaps const& f, Direction const& d, float cosine) {
        float const x = d.dot(f.x) / cosine, y = d.dot(f.y) / cosine;
        return x >= f.least.x() && x <= f.most.x() && y >= f.least.y() && y <= f.most.y();
    }

    // int share(d) over all directions [sr], by the midpoint rule over the cone.
    double effective_solid_angle() const {
        int const heights = 512, azimuths = cone_.flaps ? 256 : 1;
        auto const height = 1 - static_cast<double>(cone_.cos_end);
        Frame const frame = Frame::around(cone_.axis);
        double sum = 0;
        for (int i = 0; i < heights; ++i)
            for (int j = 0; j < azimuths; ++j) {
                Sample2 const u{(static_cast<float>(i) + 0.5f) / static_cast<float>(heights),
                                (static_cast<float>(j) + 0.5f) / static_cast<float>(azimuths)};
                sum += static_cast<double>(share_along(frame.to_world(to_cone(u, static_cast<float>(height)))));
            }
        return sum / (heights * azimuths) * 2 * pi_double * height;
    }

    float falloff(float cosine) const {
        if (cosine >= cone_.cos_full) return 1;
        if (cosine <= cone_.cos_end) return 0;
        float const t = (cosine - cone_.cos_end) / (cone_.cos_full - cone_.cos_end);
        return t * t * (3 - 2 * t);
    }

    Vector position_;
    SpotCone cone_;
    Spectrum<dim::spectral_intensity> intensity_;
    double luminance_, power_;
};

class DistantLight final : public Light {
  public:
    DistantLight(Direction const& travel, Spectrum<dim::spectral_irradiance> irradiance, double luminance)
        : wi_(-travel), irradiance_(std::move(irradiance)), luminance_(luminance) {}

    std::optional<LightSample> sample(Vector const&, Wavelengths const& wavelengths, Sample2) const override {
        return std::optional<LightSample>(std::in_place, wi_, infinity, Radiance(irradiance_.at(wavelengths).lane),
                                          std::nullopt);
    }
    std::optional<EmissionSample> emit(Ball const& scene, Wavelengths const& wavelengths, Sample2 place,
                                       Sample2) const override {
        Direction const travel = -wi_;
        Vector const from = place_before_scene(scene, travel, place);
        return std::optional<EmissionSample>(std::in_place, SurfacePoint{from, travel, travel}, 0u, travel, 1.0f,
                                             emission_density(scene, travel, 1),
                                             Radiance(irradiance_.at(wavelengths).lane));
    }
    EmissionDensity emission_density(Ball const& scene, Direction const&, float) const override {
        return {density_before_scene(scene), PerSteradian(1)};
    }
    LightExtent extent() const override { return LightExtent::distant; }
    double power(double scene_radius) const override { return luminance_ * pi_double * square(scene_radius); }

  private:
    Direction wi_;
    Spectrum<dim::spectral_irradiance> irradiance_;
    double luminance_;
};

}  // namespace

// A point light is a spot whose cone is the whole sphere.
std::unique_ptr<Light> make_point_light(Vector const& position, Spectrum<dim::spectral_intensity> intensity,
                                        double luminance) {
    return make_spot_light(position, {Direction(0, 0, 1), -1, -1}, std::move(intensity), luminance);
}
std::unique_ptr<Light> make_spot_light(Vector const& position, SpotCone cone,
                                       Spectrum<dim::spectral_intensity> intensity, double luminance) {
    return std::make_unique<SpotLight>(position, std::move(cone), std::move(intensity), luminance);
}
std::unique_ptr<Light> make_distant_light(Direction const& travel, Spectrum<dim::spectral_irradiance> irradiance,
                                          double luminance) {
    return std::make_unique<DistantLight>(travel, std::move(irradiance), luminance);
}

}  // namespace iride
