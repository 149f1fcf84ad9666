// SPDX-License-Identifier: Apache-2.0
#include "integrators/camera_path.h"

#include "colour/observer.h"
#include "colour/rgb_to_spectrum.h"
#include "film/filter.h"

namespace iride {

// Of a pixel's width, what one look-up into a texture averages: its samples average the rest.
constexpr float texture_share = 0.5f;

PathStarter::PathStarter(Scene const& scene, RenderPlan const& plan, int width, int height, SamplerKind kind,
                         std::uint64_t seed)
    : camera_(scene.camera, width, height),
      wavelengths_(make_wavelength_sampler(scene, plan)),
      filter_(scene.film.filter),
      filter_radius_(scene.film.filter_radius),
      cone_(camera_.pixel_cone()),
      width_(width),
      height_(height),
      kind_(kind),
      seed_(seed) {
    cone_.width *= texture_share;
    cone_.spread *= texture_share;
}

void PathStarter::start(int x, int y, std::uint32_t sample, CameraPath& path, CameraPath const* block) const {
    std::construct_at(&path.sampler, kind_, seed_,
                      morton_number(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y)), sample);
    Sample2 const place = place_in_pixel(path.sampler.next2());
    float const wavelengths = path.sampler.next();
    path.wavelengths = block && block != &path ? block->wavelengths : wavelengths_.sample(wavelengths);
    path.x = static_cast<float>(x) + 0.5f + place.x, path.y = static_cast<float>(y) + 0.5f + place.y;
    path.ray = camera_.ray(path.x, path.y, path.sampler.next2());
    path.cone = cone_;
    path.part = 1;
    path.radiance = Radiance();
    path.complete = true;
    path.block = block;
    path.splats.clear();
}

Sample2 PathStarter::place_in_pixel(Sample2 u) const {
    switch (filter_) {
        case FilterKind::triangle:
            return {sample_triangle(u.x, filter_radius_), sample_triangle(u.y, filter_radius_)};
        case FilterKind::gaussian:
            return sample_gaussian(u, filter_radius_);
        case FilterKind::box:
            break;
    }
    return {sample_box(u.x, filter_radius_), sample_box(u.y, filter_radius_)};
}

float PathStarter::filter_at(Sample2 d) const {
    switch (filter_) {
        case FilterKind::triangle:
            return triangle_density(d.x, filter_radius_) * triangle_density(d.y, filter_radius_);
        case FilterKind::gaussian:
            return gaussian_density(d, filter_radius_);
        case FilterKind::box:
            break;
    }
    return box_density(d.x, filter_radius_) * box_density(d.y, filter_radius_);
}

namespace {

// How much of a light's X, Y and Z comes from a wavelength: the sum of the three shares [1/nm].
class SharesOfColour {
  public:
    explicit SharesOfColour(SpectralFunction const& light) : light_(light), colour_(cie1931_2deg().integrate(light)) {}
    double at(double nm) const {
        Xyz const eye = cie1931_2deg().at(nm);
        return light_.at(nm) * (eye.X / colour_.X + eye.Y / colour_.Y + eye.Z / colour_.Z);
    }

  private:
    SpectralFunction light_;
    Xyz colour_;
};

// What the lamps make of white, each of luminance 1; black if there is none.
SpectralFunction lamplight(Scene const& scene) {
    TabulatedShape table;
    for (double nm = scene.wavelengths.min_nm; nm < scene.wavelengths.max_nm + 1; ++nm) {
        double power = 0;
        for (LightDescription const& light : scene.light_descriptions)
            if (light.luminance > 0) power += light.spectrum.at(nm) / light.luminance;
        table.nm.push_back(nm);
        table.value.push_back(power);
    }
    return SpectralFunction(std::move(table), Outside::zero, "lamplight");
}

// The observer's importance was found for white D65: it is multiplied by the light's shares of colour over those of
// D65. A tenth is left as it is, so that no wavelength that a lamp hardly has becomes rare.
SpectralFunction fitted_importance(SpectralFunction const& light, WavelengthRange const& range) {
    constexpr double fitted = 0.9;
    SpectralFunction const visible = visible_importance();
    SharesOfColour const lamp(light), day(unit_d65());
    TabulatedShape table;
    for (double nm = range.min_nm; nm < range.max_nm + 1; ++nm) {
        double const ratio = day.at(nm) > 0 ? lamp.at(nm) / day.at(nm) : 1;
        table.nm.push_back(nm);
        table.value.push_back(visible.at(nm) * (1 - fitted + fitted * ratio));
    }
    return SpectralFunction(std::move(table), Outside::hold, "importance of the lamps as they are seen");
}

// Relative variance of the X, Y and Z that one packet gives of a white in this light, added up; by quadrature.
double packet_noise(WavelengthSampler const& sampler, SpectralFunction const& light) {
    constexpr int steps = 1024;
    Eigen::Array3d sum(0, 0, 0), squares(0, 0, 0);
    for (int i = 0; i < steps; ++i) {
        Wavelengths const w = sampler.sample((static_cast<float>(i) + 0.5f) / steps);
        Eigen::Array3d colour(0, 0, 0);
        for (int lane = 0; lane < lane_count; ++lane) {
            double const nm = static_cast<double>(w.nm[lane]), density = static_cast<double>(w.density[lane]);
            colour += to_vector(cie1931_2deg().at(nm)).array() * (light.at(nm) / density);
        }
        sum += colour;
        squares += colour.square();
    }
    return (squares * steps / sum.square() - 1).sum();
}

// The quieter of the two in this scene's light.
SpectralFunction seen_importance(Scene const& scene, RenderPlan const& plan) {
    SpectralFunction const plain = visible_importance(), light = lamplight(scene);
    WavelengthRange const& range = plan.wavelengths;
    if (plan.observer_alone || !(light.integral(range) > 0) || !(cie1931_2deg().integrate(light).Y > 0)) return plain;
    SpectralFunction const fitted = fitted_importance(light, range);
    double const noise_plain = packet_noise(WavelengthSampler(range, plain, scene.grid), light);
    return packet_noise(WavelengthSampler(range, fitted, scene.grid), light) < noise_plain ? fitted : plain;
}

}  // namespace

WavelengthSampler make_wavelength_sampler(Scene const& scene, RenderPlan const& plan) {
    SpectralFunction const seen = seen_importance(scene, plan);
    if (!plan.bands) return WavelengthSampler(plan.wavelengths, seen, scene.grid);
    WavelengthRange const bands = scene.film.band_range;
    double const total = seen.integral(plan.wavelengths);
    TabulatedShape mixed;
    for (double nm = plan.wavelengths.min_nm; nm < plan.wavelengths.max_nm + 1; ++nm) {
        bool const in_bands = nm >= bands.min_nm && nm <= bands.max_nm;
        mixed.nm.push_back(nm);
        mixed.value.push_back((total > 0 ? seen.at(nm) / total : 0) + (in_bands ? 1 / bands.width() : 0));
    }
    return WavelengthSampler(plan.wavelengths, SpectralFunction(std::move(mixed), Outside::hold), scene.grid);
}

}  // namespace iride
