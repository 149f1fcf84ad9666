// SPDX-License-Identifier: Apache-2.0
// The integrator that looks at a solution: the first patch along a camera ray that is no mirror, or the environment.
#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <atomic>

#include "integrators/path.h"
#include "integrators/radiosity/mirrors.h"
#include "integrators/radiosity/radiosity.h"

namespace iride::radiosity {

namespace {

class Show final : public Integrator {
  public:
    Show(std::shared_ptr<RadiosityField const> field, std::vector<std::string> remarks)
        : field_(std::move(field)), remarks_(std::move(remarks)) {}
    std::vector<std::string> remarks() const override { return remarks_; }
    void follow(Scene const& scene, std::span<CameraPath> paths, RayStatistics& statistics) const override {
        statistics.closest_rays += paths.size();
        for (CameraPath& path : paths) look(scene, path);
    }

  private:
    void look(Scene const& scene, CameraPath& path) const {
        PatchMesh const& mesh = field_->mesh();
        Throughput weight(1);
        VectorDouble way = path.ray.direction.cast<double>();
        auto hit = field_->tracer().closest(path.ray);
        for (int mirrors = 0; hit && hit->patch >= 0 && mirrors < most_mirrors; ++mirrors) {
            Patch const& p = mesh.patch[static_cast<std::size_t>(hit->patch)];
            Shape const& shape = *mesh.shape[static_cast<std::size_t>(p.shape)];
            NamedMaterial const& m = scene.materials[static_cast<std::size_t>(shape.material)];
            if (!is_mirror(m)) break;
            if (shape.light >= 0)
                path.radiance +=
                    weight *
                    scene.lights.light(shape.light).emitted(front_point(p), (-way).cast<float>(), path.wavelengths);
            weight *= mirror_reflectance(*m.material, -way.dot(p.normal), path.wavelengths);
            way = mirrored(way, p.normal);
            hit = field_->tracer().closest(hit->position, p.normal, way);
        }
        if (hit) {
            path.radiance += weight * field_->radiance(*hit, path.wavelengths);
            return;
        }
        for (int e : scene.lights.environments())
            path.radiance += weight * scene.lights.light(e).arriving(way.cast<float>(), path.wavelengths);
    }

    std::shared_ptr<RadiosityField const> field_;
    std::vector<std::string> remarks_;
};

// By a camera ray through each pixel.
Seen seen_by_camera(Scene const& scene, RenderPlan const& plan) {
    int const width = scene.film.width, height = scene.film.height;
    return [width, height, starter = PathStarter(scene, plan, width, height, SamplerKind::sobol, 0)](
               PatchTracer const& tracer, std::size_t patches) {
        std::vector<int> seen(patches, 0);
        tbb::parallel_for(0, height, [&](int y) {
            CameraPath path;
            for (int x = 0; x < width; ++x) {
                starter.start(x, y, 0, path);
                if (auto const hit = tracer.closest(path.ray); hit && hit->patch >= 0)
                    std::atomic_ref(seen[static_cast<std::size_t>(hit->patch)]).fetch_add(1, std::memory_order_relaxed);
            }
        });
        return seen;
    };
}

}  // namespace

std::unique_ptr<Integrator> show(std::shared_ptr<RadiosityField const> field, std::vector<std::string> remarks) {
    return std::make_unique<Show>(std::move(field), std::move(remarks));
}

std::unique_ptr<Integrator> make_radiosity(Scene const& scene, RenderPlan const& plan, IntegratorOptions& options) {
    constexpr std::pair<char const*, bool> direct_light[]{{"patches", false}, {"lamps", true}};
    Settings settings{.wavelengths = 95};  // 5 nm apart, as illuminants are tabulated
    bool const from_lamps = options.one_of("direct_light", direct_light, false);
    settings.patches = options.integer("patches", 1, 1000000, settings.patches);
    settings.wavelengths = options.integer("wavelengths", 2, 1000, settings.wavelengths);
    int const last_gather = options.integer("last_gather", 0, 1 << 20, 0);
    settings.form_factors = options.word("form_factors", form_factor_methods(), settings.form_factors);
    if (from_lamps && std::ranges::any_of(scene.materials, is_mirror))
        options.error_at(
            "direct_light",
            "found a mirror among the materials, by which lamps light surfaces that patches would leave out; "
            "allowed: patches");
    if (last_gather > 0 && !from_lamps)
        options.error_at(
            "last_gather",
            fmt::format("found {}, allowed: 0, or direct_light=lamps beside it: rays of vertices find what "
                        "came from no lamp",
                        last_gather));
    options.finish();
    SceneRadiosity const solution(scene, plan.wavelengths, settings);
    if (!from_lamps) return show(solution.field(), solution.report().remarks);
    KnownIndirect known{.remarks = solution.report().remarks};
    if (last_gather > 0) {
        LampLight const lamps(scene, plan, solution.tracer(), solution.wavelengths_nm());
        known.field = solution.indirect_field(seen_by_camera(scene, plan), lamps, {last_gather, settings.memory_bytes},
                                              known.remarks);
    } else {
        known.field = solution.indirect_field();
    }
    return path_until_known(scene, plan, std::move(known));
}

}  // namespace iride::radiosity
