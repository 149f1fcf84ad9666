// SPDX-License-Identifier: Apache-2.0
// Light from infinity in every direction: the same everywhere, or a lat-long picture sampled by luminance.
#include <algorithm>

#include "scene/light.h"

namespace iride {

namespace {

class Environment : public Light {
  public:
    std::optional<EmissionSample> emit(Ball const& scene, Wavelengths const& wavelengths, Sample2 place,
                                       Sample2 direction) const override {
        auto const seen = sample(scene.centre, wavelengths, direction);
        if (!seen) return std::nullopt;
        Direction const travel = -seen->wi;
        Vector const from = place_before_scene(scene, travel, place);
        return std::optional<EmissionSample>(std::in_place, SurfacePoint{from, travel, travel}, 0u, travel, 1.0f,
                                             EmissionDensity{density_before_scene(scene), *seen->density},
                                             seen->radiance);
    }
    EmissionDensity emission_density(Ball const& scene, Direction const& travel, float) const override {
        return {density_before_scene(scene), arriving_density(-travel)};
    }
    LightExtent extent() const override { return LightExtent::environment; }
    bool is_environment() const override { return true; }
};

class ConstantEnvironment final : public Environment {
  public:
    ConstantEnvironment(Emission radiance, double luminance) : radiance_(std::move(radiance)), luminance_(luminance) {}

    std::optional<LightSample> sample(Vector const&, Wavelengths const& wavelengths, Sample2 u) const override {
        return std::optional<LightSample>(std::in_place, to_sphere(u), infinity, radiance_.at(wavelengths),
                                          uniform_sphere_density);
    }
    Radiance arriving(Direction const&, Wavelengths const& wavelengths) const override {
        return radiance_.at(wavelengths);
    }
    PerSteradian arriving_density(Direction const&) const override { return uniform_sphere_density; }
    double power(double scene_radius) const override { return luminance_ * square(2 * pi_double * scene_radius); }
    bool is_uniform() const override { return true; }

  private:
    Emission radiance_;
    double luminance_;
};

// Direction <-> picture: x = 1/2 + azimuth / 2 pi with azimuth 0 at -z growing towards +x, y = polar angle / pi from
// +y. d omega = 2 pi^2 sin(polar) dx dy.
class PictureEnvironment final : public Environment {
  public:
    explicit PictureEnvironment(EnvironmentPicture picture) : picture_(std::move(picture)) {
        std::vector<double> weights;
        for (int y = 0; y < picture_.height; ++y)
            for (int x = 0; x < picture_.width; ++x) {
                auto const& t = picture_.texel[index(x, y)];
                double const luminance = 0.2126 * t[0] + 0.7152 * t[1] + 0.0722 * t[2];  // a weight, no colorimetry
                weights.push_back(luminance * std::sin(pi_double * (y + 0.5) / picture_.height));
            }
        distribution_ = SquareDistribution(weights, picture_.width, picture_.height);
    }

    std::optional<LightSample> sample(Vector const&, Wavelengths const& wavelengths, Sample2 u) const override {
        auto const p = distribution_.sample(u);
        float const polar = pi * p.y, azimuth = 2 * pi * (p.x - 0.5f) + picture_.rotation_rad, sine = std::sin(polar);
        if (!(p.density > 0) || !(sine > 0)) return std::nullopt;
        Direction const wi(sine * std::sin(azimuth), std::cos(polar), -sine * std::cos(azimuth));
        return std::optional<LightSample>(std::in_place, wi, infinity, radiance(p.x, p.y, wavelengths),
                                          PerSteradian(p.density / (2 * pi * pi * sine)));
    }
    Radiance arriving(Direction const& wi, Wavelengths const& wavelengths) const override {
        auto const [x, y] = place(wi);
        return radiance(x, y, wavelengths);
    }
    PerSteradian arriving_density(Direction const& wi) const override {
        auto const [x, y] = place(wi);
        float const sine = std::hypot(wi.x(), wi.z());  // no 1 - y^2: it loses its digits at the poles
        return PerSteradian(sine > 0 ? distribution_.density(x, y) / (2 * pi * pi * sine) : 0);
    }
    double power(double scene_radius) const override {
        // mean of luminance sin(polar) over the square, times 2 pi^2 sr, times the disc of the scene.
        return distribution_.mean_weight() * 2 * square(pi_double) * pi_double * square(scene_radius);
    }

  private:
    struct Place {
        float x, y;
    };
    Place place(Direction const& wi) const {
        float const turn = (std::atan2(wi.x(), -wi.z()) - picture_.rotation_rad) / (2 * pi) + 0.5f;
        return {turn - std::floor(turn), std::atan2(std::hypot(wi.x(), wi.z()), wi.y()) * inverse_pi};
    }
    std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(picture_.width) + static_cast<std::size_t>(x);
    }
    Radiance radiance(float x, float y, Wavelengths const& wavelengths) const {
        int const column = std::clamp(static_cast<int>(x * static_cast<float>(picture_.width)), 0, picture_.width - 1);
        int const row = std::clamp(static_cast<int>(y * static_cast<float>(picture_.height)), 0, picture_.height - 1);
        auto const& t = picture_.texel[index(column, row)];
        return picture_.basis[0].at(wavelengths) * t[0] + picture_.basis[1].at(wavelengths) * t[1] +
               picture_.basis[2].at(wavelengths) * t[2];
    }

    EnvironmentPicture picture_;
    SquareDistribution distribution_;
};

}  // namespace

std::unique_ptr<Light> make_constant_environment(Emission radiance, double luminance) {
    return std::make_unique<ConstantEnvironment>(std::move(radiance), luminance);
}
std::unique_ptr<Light> make_picture_environment(EnvironmentPicture picture) {
    return std::make_unique<PictureEnvironment>(std::move(picture));
}

}  // namespace iride
