// SPDX-License-Identifier: Apache-2.0
#include "integrators/ambient_occlusion.h"

#include "base/warp.h"

namespace iride {

namespace {

class AmbientOcclusion final : public Integrator {
  public:
    AmbientOcclusion(bool by_cosine, float distance) : by_cosine_(by_cosine), distance_(distance) {}

    void follow(Scene const& scene, std::span<CameraPath> paths, RayStatistics& statistics) const override {
        for (CameraPath& path : paths) path.radiance = Radiance(seen(scene, path, statistics));
    }

  private:
    float seen(Scene const& scene, CameraPath& path, RayStatistics& statistics) const {
        std::optional<Hit> const hit = scene.accelerator->closest(path.ray, statistics);
        if (!hit) return 0;
        Direction g = hit->point.geometric_normal, n = hit->point.normal;
        if (g.dot(path.ray.direction) > 0) g = -g;
        if (n.dot(g) < 0) n = -n;
        path.sampler.begin_vertex(0);
        Sample2 const u = path.sampler.next2();
        Direction const local = by_cosine_ ? to_cosine_hemisphere(u) : to_cone(u, 1);
        Direction const wi = Frame::around(n).to_world(local);
        if (!(wi.dot(g) > 0)) return 0;
        Ray ray = spawn_ray(hit->point, wi);
        ray.t_max = distance_;
        if (scene.accelerator->occluded(ray, statistics)) return 0;
        return by_cosine_ ? 1 : local.z() * inverse_pi / cone_density(1).value;
    }

    bool by_cosine_;
    float distance_;  // m
};

}  // namespace

std::unique_ptr<Integrator> make_ambient_occlusion(Scene const&, RenderPlan const&, IntegratorOptions& options) {
    constexpr std::pair<char const*, bool> samplings[]{{"uniform", false}, {"cosine", true}};
    bool const by_cosine = options.one_of("sampling", samplings, true);
    double const distance = options.number("distance", positive(), std::numeric_limits<double>::infinity());
    options.finish();
    return std::make_unique<AmbientOcclusion>(by_cosine, static_cast<float>(distance));
}

}  // namespace iride
