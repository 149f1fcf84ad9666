// SPDX-License-Identifier: Apache-2.0
// The integrator that looks at a solution: the first patch along a camera ray, or the environment.
#include "integrators/radiosity/radiosity.h"

namespace iride::radiosity {

namespace {

class Show final : public Integrator {
  public:
    explicit Show(std::shared_ptr<RadiosityField const> field) : field_(std::move(field)) {}
    void follow(Scene const& scene, std::span<CameraPath> paths, RayStatistics& statistics) const override {
        statistics.closest_rays += paths.size();
        for (CameraPath& path : paths) {
            auto const hit = field_->tracer().closest(path.ray);
            if (hit) {
                path.radiance += field_->radiance(*hit, path.wavelengths);
                continue;
            }
            for (int e : scene.lights.environments())
                path.radiance += scene.lights.light(e).arriving(path.ray.direction, path.wavelengths);
        }
    }

  private:
    std::shared_ptr<RadiosityField const> field_;
};

}  // namespace

std::unique_ptr<Integrator> show(std::shared_ptr<RadiosityField const> field) {
    return std::make_unique<Show>(std::move(field));
}

std::unique_ptr<Integrator> make_radiosity(Scene const& scene, RenderPlan const& plan, IntegratorOptions& options) {
    options.finish();
    return show(SceneRadiosity(scene, plan.wavelengths, {}).field());
}

}  // namespace iride::radiosity
