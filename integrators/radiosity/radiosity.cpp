// SPDX-License-Identifier: Apache-2.0
#include "integrators/radiosity/radiosity.h"

#include <fmt/format.h>

#include "integrators/radiosity/vertex_transfer.h"

namespace iride::radiosity {

namespace {

constexpr std::size_t most_patches = 30000;  // their form factors fill 14 GB if all see all

double total_area(Scene const& scene) {
    double sum = 0;
    constexpr double coarse = 1e9;  // m: the shapes' own faces, uncut
    for (PatchMesh const mesh = make_patches(scene, coarse, most_patches); Patch const& p : mesh.patch) sum += p.area;
    return sum;
}

double patch_size(Scene const& scene, Settings const& s) {
    return s.size_m > 0 ? s.size_m : std::sqrt(total_area(scene) / s.patches);
}

template <class Entry>
Entry const& entry_of(std::span<Entry const> table, std::string const& name, char const* option) {
    std::vector<std::string> names;
    for (Entry const& e : table) {
        if (name == e.name) return e;
        names.emplace_back(e.name);
    }
    throw InputError({}, option, fmt::format("unknown name '{}'{}", name, suggestion(name, names)));
}

std::vector<double> evenly_spaced(WavelengthRange const& range, int count) {
    if (count < 2) return {(range.min_nm + range.max_nm) / 2};
    std::vector<double> nm;
    for (int i = 0; i < count; ++i) nm.push_back(range.min_nm + range.width() * i / (count - 1));
    return nm;
}

// Albedo under even light: the mean of a sample's weight over cosine-distributed directions. Exact for Lambert's law.
Lanes albedo(Material const& material, SurfacePoint const& point, Wavelengths const& wavelengths, bool back) {
    constexpr std::uint32_t samples = 64;
    Bsdf const bsdf = material.at(point, wavelengths);
    Lanes sum;
    for (std::uint32_t k = 0; k < samples; ++k) {
        Sampler sampler(SamplerKind::sobol, 3, 0, k);
        Direction wo = to_cosine_hemisphere(sampler.next2());
        if (back && !material.traits.two_sided) wo.z() = -wo.z();
        auto const sample = bsdf.sample(wo, {sampler.next(), sampler.next2()});
        if (sample && (sample->wi.z() > 0) == (wo.z() > 0)) sum += sample->weight * (1.0f / samples);
    }
    return sum;
}

// Irradiance from lamps without extent and from the environment.
Irradiance outside_light(Scene const& scene, PatchTracer const& tracer, Patch const& p,
                         Wavelengths const& wavelengths) {
    constexpr std::uint32_t samples = 64;
    Irradiance sum;
    for (std::size_t l = 0; l < scene.lights.size(); ++l) {
        Light const& light = scene.lights.light(static_cast<int>(l));
        std::uint32_t const count = light.is_environment() ? samples : 1;
        for (std::uint32_t k = 0; k < count; ++k) {
            Sampler sampler(SamplerKind::sobol, 4, static_cast<std::uint32_t>(l), k);
            auto const s = light.sample(p.centre.cast<float>(), wavelengths, sampler.next2());
            if (!s || (s->density && !light.is_environment())) continue;  // lamps of extent are patches
            float const cosine = s->wi.dot(p.normal.cast<float>());
            if (cosine <= 0) continue;
            auto const hit = tracer.closest(p.centre, p.normal, s->wi.cast<double>());
            if (hit && (hit->position - p.centre).norm() < static_cast<double>(s->distance)) continue;
            float const solid_angle = s->density ? 1 / s->density->value : 1;
            sum += Irradiance(s->radiance.lane * (cosine * solid_angle / static_cast<float>(count)));
        }
    }
    return sum;
}

}  // namespace

SceneRadiosity::SceneRadiosity(Scene const& scene, WavelengthRange const& range, Settings const& settings)
    : mesh_(make_patches(scene, patch_size(scene, settings), most_patches)),
      tracer_(mesh_),
      nm_(evenly_spaced(range, settings.wavelengths)) {
    FormFactorMethod const& method = entry_of(form_factor_methods(), settings.form_factors, "--form-factors");
    SolverEntry const& solver = entry_of(solvers(), settings.solver, "--solver");
    read_spectra(scene);
    system_.form_factors = method.compute(mesh_, tracer_, settings.fineness > 0 ? settings.fineness : method.fineness);
    report_.reciprocity_defect = reciprocity_defect(system_);
    report_.closure_defect = closure_defect(system_);
    make_reciprocal(system_);
    Solution const solution = solve(system_, solver, settings.stop);
    radiosity_ = solution.radiosity;
    report_.iterations = solution.iterations;
    report_.residual = solution.residual;
    at_vertex_ = to_vertices(mesh_, radiosity_).max(0.0).cast<float>();
}

void SceneRadiosity::read_spectra(Scene const& scene) {
    auto const n = static_cast<Eigen::Index>(mesh_.patch.size()), w = static_cast<Eigen::Index>(nm_.size());
    system_.area.resize(n);
    system_.reflectance.resize(n, w);
    system_.emission = Spectra::Zero(n, w);
    for (Eigen::Index first = 0; first < w; first += lane_count) {
        Eigen::Index const lanes = std::min<Eigen::Index>(lane_count, w - first);
        LaneRegister nm{};
        for (int k = 0; k < lane_count; ++k)
            nm[k] = static_cast<float>(nm_[static_cast<std::size_t>(std::min<Eigen::Index>(first + k, w - 1))]);
        Wavelengths const packet = wavelengths_at(nm, scene.grid);
        for (Eigen::Index i = 0; i < n; ++i) {
            Patch const& p = mesh_.patch[static_cast<std::size_t>(i)];
            Shape const& shape = *mesh_.shape[static_cast<std::size_t>(p.shape)];
            Direction const normal = (p.back ? -1.0 : 1.0) * p.normal.cast<float>();
            SurfacePoint const point{p.centre.cast<float>(), normal, normal};
            system_.area[i] = p.area;
            Lanes const rho = albedo(scene.material(shape.material), point, packet, p.back);
            Irradiance const arriving = outside_light(scene, tracer_, p, packet);
            Radiance emitted;
            if (shape.light >= 0)
                emitted = scene.lights.light(shape.light).emitted(point, p.normal.cast<float>(), packet);
            for (int k = 0; k < lanes; ++k) {
                system_.reflectance(i, first + k) = static_cast<double>(rho[k]);
                system_.emission(i, first + k) = pi_double * static_cast<double>(emitted[k]) +
                                                 static_cast<double>(rho[k]) * static_cast<double>(arriving[k]);
            }
        }
    }
    constexpr double largest = 0.9999;  // beyond, a closed scene has no solution, or one of 1e4 bounces
    if (double const rho = system_.reflectance.maxCoeff(); rho > largest) {
        Eigen::Index i, k;
        system_.reflectance.maxCoeff(&i, &k);
        Shape const& shape = *mesh_.shape[static_cast<std::size_t>(mesh_.patch[static_cast<std::size_t>(i)].shape)];
        throw InputError({},
                         fmt::format("material '{}'", scene.materials[static_cast<std::size_t>(shape.material)].name),
                         fmt::format("reflects {:g} at {:g} nm: a closed scene of it has no radiosity; allowed: at "
                                     "most {}",
                                     rho, nm_[static_cast<std::size_t>(k)], largest));
    }
}

// Wachspress coordinates: barycentric in a triangle, bilinear in a rectangle, smooth and linear along edges in between.
Radiance SceneRadiosity::radiance(PatchHit const& hit, Wavelengths const& wavelengths) const {
    Patch const& p = mesh_.patch[static_cast<std::size_t>(hit.patch)];
    auto const n = static_cast<std::size_t>(p.corners);
    std::array<VectorDouble, 4> v;
    for (std::size_t k = 0; k < n; ++k) v[k] = mesh_.position[static_cast<std::size_t>(p.vertex[k])];
    auto const area = [&](VectorDouble const& a, VectorDouble const& b, VectorDouble const& c) {
        return p.normal.dot((b - a).cross(c - a));
    };
    std::array<double, 4> side{}, weight{};
    for (std::size_t k = 0; k < n; ++k) side[k] = std::max(0.0, area(hit.position, v[k], v[(k + 1) % n]));
    double total = 0;
    for (std::size_t k = 0; k < n; ++k) {
        weight[k] = area(v[(k + n - 1) % n], v[k], v[(k + 1) % n]);
        for (std::size_t j = 0; j < n; ++j)
            if (j != k && j != (k + n - 1) % n) weight[k] *= side[j];
        total += weight[k];
    }
    Radiance L;
    if (!(total > 0)) return L;
    auto const last = static_cast<float>(nm_.size()) - 2;
    float const first_nm = static_cast<float>(nm_.front());
    float const per_nm = nm_.size() < 2 ? 0 : 1 / static_cast<float>(nm_[1] - nm_[0]);
    for (int lane = 0; lane < lane_count; ++lane) {
        float const place = (wavelengths.nm[lane] - first_nm) * per_nm;
        float const cell = std::clamp(std::floor(place), 0.0f, std::max(0.0f, last)), fraction = place - cell;
        auto const column = static_cast<Eigen::Index>(cell), next = std::min(column + 1, at_vertex_.cols() - 1);
        float b = 0;
        for (std::size_t k = 0; k < n; ++k) {
            auto const row = p.vertex[k];
            b += static_cast<float>(weight[k] / total) *
                 (at_vertex_(row, column) + fraction * (at_vertex_(row, next) - at_vertex_(row, column)));
        }
        L.lane[lane] = std::max(0.0f, b) * inverse_pi;
    }
    return L;
}

namespace {

class Show final : public Integrator {
  public:
    Show(Scene const& scene, RenderPlan const& plan) : solution_(scene, plan.wavelengths, {}) {}
    void follow(Scene const& scene, std::span<CameraPath> paths, RayStatistics& statistics) const override {
        statistics.closest_rays += paths.size();
        for (CameraPath& path : paths) {
            auto const hit = solution_.tracer().closest(path.ray);
            if (hit && hit->patch >= 0) path.radiance += solution_.radiance(*hit, path.wavelengths);
            if (hit) continue;
            for (int e : scene.lights.environments())
                path.radiance += scene.lights.light(e).arriving(path.ray.direction, path.wavelengths);
        }
    }

  private:
    SceneRadiosity solution_;
};

}  // namespace

std::unique_ptr<Integrator> make_radiosity(Scene const& scene, RenderPlan const& plan, IntegratorOptions& options) {
    options.finish();
    return std::make_unique<Show>(scene, plan);
}

}  // namespace iride::radiosity
