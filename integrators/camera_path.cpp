// SPDX-License-Identifier: Apache-2.0
#include "integrators/camera_path.h"

#include "film/filter.h"

namespace iride {

PathStarter::PathStarter(Scene const& scene, RenderPlan const& plan, int width, int height, SamplerKind kind,
                         std::uint64_t seed)
    : camera_(scene.camera, width, height),
      wavelengths_(make_wavelength_sampler(scene, plan)),
      filter_(scene.film.filter),
      filter_radius_(scene.film.filter_radius),
      width_(width),
      kind_(kind),
      seed_(seed) {}

void PathStarter::start(int x, int y, std::uint32_t sample, CameraPath& path) const {
    path.sampler = Sampler(kind_, seed_, static_cast<std::uint32_t>(y * width_ + x), sample);
    Sample2 const place = place_in_pixel(path.sampler.next2());
    path.wavelengths = wavelengths_.sample(path.sampler.next());
    path.ray = camera_.ray(static_cast<float>(x) + 0.5f + place.x, static_cast<float>(y) + 0.5f + place.y,
                           path.sampler.next2());
    path.radiance = Radiance();
    path.complete = true;
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

WavelengthSampler make_wavelength_sampler(Scene const& scene, RenderPlan const& plan) {
    SpectralFunction const visible = visible_importance();
    if (!plan.bands) return WavelengthSampler(plan.wavelengths, visible, scene.grid);
    WavelengthRange const bands = scene.film.band_range;
    double const total = visible.integral(plan.wavelengths);
    TabulatedShape mixed;
    for (double nm = plan.wavelengths.min_nm; nm < plan.wavelengths.max_nm + 1; ++nm) {
        bool const in_bands = nm >= bands.min_nm && nm <= bands.max_nm;
        mixed.nm.push_back(nm);
        mixed.value.push_back((total > 0 ? visible.at(nm) / total : 0) + (in_bands ? 1 / bands.width() : 0));
    }
    return WavelengthSampler(plan.wavelengths, SpectralFunction(std::move(mixed), Outside::hold), scene.grid);
}

}  // namespace iride
