// SPDX-License-Identifier: Apache-2.0
// Lights without extent: point and spot (intensity / r^2), distant (irradiance on a facing plane).
#include "scene/light.h"

namespace iride {

namespace {

class SpotLight final : public Light {
  public:
    SpotLight(Vector const& position, SpotCone cone, Spectrum<dim::spectral_intensity> intensity, double luminance)
        : position_(position), cone_(std::move(cone)), intensity_(std::move(intensity)), luminance_(luminance) {}

    std::optional<LightSample> sample(Vector const& from, Wavelengths const& wavelengths, Sample2) const override {
        Vector const d = position_ - from;
        float const distance = d.norm();
        if (!(distance > 0)) return std::nullopt;
        Direction const wi = d / distance;
        float const share = falloff(-wi.dot(cone_.axis));
        if (share == 0) return std::nullopt;
        Radiance const arriving((intensity_.at(wavelengths) * (share / square(distance))).lane);
        return std::optional<LightSample>(std::in_place, wi, distance, arriving, std::nullopt);
    }
    // Intensity times the solid angle of the cone's middle.
    double power(double) const override {
        return luminance_ * 2 * pi_double * (1 - 0.5 * static_cast<double>(cone_.cos_full + cone_.cos_end));
    }

  private:
    float falloff(float cosine) const {
        if (cosine >= cone_.cos_full) return 1;
        if (cosine <= cone_.cos_end) return 0;
        float const t = (cosine - cone_.cos_end) / (cone_.cos_full - cone_.cos_end);
        return t * t * (3 - 2 * t);
    }

    Vector position_;
    SpotCone cone_;
    Spectrum<dim::spectral_intensity> intensity_;
    double luminance_;
};

class DistantLight final : public Light {
  public:
    DistantLight(Direction const& travel, Spectrum<dim::spectral_irradiance> irradiance, double luminance)
        : wi_(-travel), irradiance_(std::move(irradiance)), luminance_(luminance) {}

    std::optional<LightSample> sample(Vector const&, Wavelengths const& wavelengths, Sample2) const override {
        return std::optional<LightSample>(std::in_place, wi_, infinity, Radiance(irradiance_.at(wavelengths).lane),
                                          std::nullopt);
    }
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
