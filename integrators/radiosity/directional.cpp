// SPDX-License-Identifier: Apache-2.0
#include "integrators/radiosity/directional.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "integrators/radiosity/exposure.h"
#include "integrators/radiosity/mirrors.h"
#include "integrators/radiosity/patch_spectra.h"

namespace iride::radiosity {

namespace {

constexpr int points = 4;  // of each of three patches, at which f is looked at

// Points of a patch, spread by a lattice; `turn`: another set for another part in a triple.
std::array<VectorDouble, points> spread_over(PatchMesh const& mesh, Patch const& p, float turn) {
    std::array<VectorDouble, points> at;
    for (int q = 0; q < points; ++q) {
        float const y = .5f + static_cast<float>(q) * .6180340f + turn;
        at[static_cast<std::size_t>(q)] =
            point_on(mesh, p, {(static_cast<float>(q) + .5f) / points, y - std::floor(y)});
    }
    return at;
}

// A patch as its material sees it.
struct Place {
    SurfacePoint point;
    Frame frame;
    float side = 1;  // -1: the back of a material that tells its sides apart

    Place(Patch const& p, Material const& material)
        : point(front_point(p)),
          frame(Frame::around(p.normal.cast<float>())),
          side(p.back && !material.traits.two_sided ? -1 : 1) {
        point.from_front = !p.back;
    }
    // Towards what the patch sees: where a part of that lies below the horizon, just above.
    Direction above(Direction const& world) const {
        constexpr float just_above = 1e-3f;
        Direction d = frame.to_local(world);
        d.z() = std::max(d.z(), just_above);
        return frame.to_world(d.normalized());
    }
    Direction local(Direction const& world) const {
        Direction d = frame.to_local(above(world));
        d.z() *= side;
        return d;
    }
};

}  // namespace

Material const& DirectionalRadiosity::material_of(Scene const& scene, Patch const& p) const {
    return scene.material(mesh_.shape[static_cast<std::size_t>(p.shape)]->material);
}

void DirectionalRadiosity::refuse_others(Scene const& scene) const {
    auto const refuse = [](std::string const& what) {
        throw InputError({}, "integrator", "directional-radiosity: " + what);
    };
    for (std::size_t l = 0; l < scene.lights.size(); ++l)
        if (std::ranges::none_of(mesh_.shape, [&](Shape const* s) { return s->light == static_cast<int>(l); }))
            refuse("found a lamp without extent or an environment; allowed: lamps that are surfaces of the scene");
    for (Shape const* s : mesh_.shape) {
        NamedMaterial const& m = scene.materials[static_cast<std::size_t>(s->material)];
        bool const black = m.type == "black";
        if (!black && (!m.material->traits.has_density || m.material->body()))
            refuse(
                fmt::format("material '{}' ({}) scatters into single directions; allowed: diffuse or rough surfaces "
                            "that let nothing through",
                            m.name, m.type));
        if (m.material->traits.anisotropic)
            refuse(fmt::format("material '{}' ({}) has a grain; allowed: surfaces that are alike all around", m.name,
                               m.type));
    }
}

DirectionalRadiosity::DirectionalRadiosity(Scene const& scene, WavelengthRange const& range,
                                           DirectionalSettings const& settings) {
    SceneRadiosity const diffuse(scene, range,
                                 {.patches = settings.patches,
                                  .wavelengths = settings.wavelengths,
                                  .fineness = settings.rays,
                                  .memory_bytes = settings.memory_bytes});
    mesh_ = diffuse.mesh();
    refuse_others(scene);
    tracer_ = std::make_unique<PatchTracer>(mesh_);
    nm_ = diffuse.wavelengths_nm();
    system_ = diffuse.system();
    find_neighbours();
    double triples = 0;
    for (std::size_t i = 0; i < mesh_.patch.size(); ++i)
        triples += static_cast<double>(neighbours(i)) * static_cast<double>(neighbours(i));
    if (double const bytes = triples * settings.wavelengths * sizeof(float); bytes > settings.memory_bytes)
        throw InputError({}, "patches",
                         fmt::format("directional-radiosity: {} patches have {:.3g} triples, which would take {:.2g} "
                                     "GB; allowed: {:.2g} GB",
                                     mesh_.patch.size(), triples, bytes * 1e-9, settings.memory_bytes * 1e-9));
    solve(scene, settings);
}

// The form factors are reciprocal: if i sees k, k sees i.
void DirectionalRadiosity::find_neighbours() {
    first_.push_back(0);
    for (Eigen::Index i = 0; i < system_.patches(); ++i) {
        for (FormFactors::InnerIterator F(system_.form_factors, i); F; ++F)
            if (F.value() > 0 && F.col() != i)
                neighbour_.push_back({static_cast<int>(F.col()), static_cast<float>(F.value()), 0});
        first_.push_back(neighbour_.size());
    }
    for (std::size_t i = 0; i + 1 < first_.size(); ++i)
        for (std::size_t e = first_[i]; e < first_[i + 1]; ++e) {
            auto const k = static_cast<std::size_t>(neighbour_[e].patch);
            auto const begin = neighbour_.begin();
            neighbour_[e].back =
                static_cast<std::size_t>(std::ranges::lower_bound(begin + static_cast<std::ptrdiff_t>(first_[k]),
                                                                  begin + static_cast<std::ptrdiff_t>(first_[k + 1]),
                                                                  static_cast<int>(i), {}, &Neighbour::patch) -
                                         begin);
        }
}

DirectionalRadiosity::Values DirectionalRadiosity::scattering(Scene const& scene, std::size_t i) const {
    Patch const& p = mesh_.patch[i];
    Material const& material = material_of(scene, p);
    auto const count = static_cast<Eigen::Index>(neighbours(i)), w = static_cast<Eigen::Index>(nm_.size());
    Values f = Values::Zero(count * count, w);
    Place const place(p, material);
    auto const here = spread_over(mesh_, p, 0);
    // [neighbour * points + q], local: towards where light comes from, and towards where it goes.
    std::vector<Direction> from, to;
    for (std::size_t e = first_[i]; e < first_[i + 1]; ++e) {
        Patch const& other = mesh_.patch[static_cast<std::size_t>(neighbour_[e].patch)];
        auto const a = spread_over(mesh_, other, .3f), b = spread_over(mesh_, other, .7f);
        for (std::size_t q = 0; q < points; ++q) {
            from.push_back(place.local((a[q] - here[q]).normalized().cast<float>()));
            to.push_back(place.local((b[(q + 1) % points] - here[q]).normalized().cast<float>()));
        }
    }
    for (Eigen::Index first = 0; first < w; first += lane_count) {
        Bsdf const bsdf = material.at(place.point, packet_of(nm_, static_cast<std::size_t>(first), scene.grid));
        Eigen::Index const lanes = std::min<Eigen::Index>(lane_count, w - first);
        for (Eigen::Index k = 0; k < count; ++k)
            for (Eigen::Index j = 0; j < count; ++j) {
                BsdfValue sum;
                for (int q = 0; q < points; ++q)
                    sum += bsdf.evaluate(to[static_cast<std::size_t>(j * points + q)],
                                         from[static_cast<std::size_t>(k * points + q)])
                               .value;
                float const scale =
                    pi * neighbour_[first_[i] + static_cast<std::size_t>(k)].factor / static_cast<float>(points);
                for (Eigen::Index lane = 0; lane < lanes; ++lane)
                    f(k * count + j, first + lane) = sum.lane[static_cast<int>(lane)] * scale;
            }
    }
    return f;
}

// Jacobi's iteration: a scattering of all light each. It ends when the largest change is `tolerance` of the largest
// emission.
void DirectionalRadiosity::solve(Scene const& scene, DirectionalSettings const& settings) {
    std::size_t const n = mesh_.patch.size();
    auto const w = static_cast<Eigen::Index>(nm_.size());
    std::vector<Values> f(n);
    auto const in_parallel = [&](auto const& body) { tbb::parallel_for(std::size_t{0}, n, body); };
    in_parallel([&](std::size_t i) { f[i] = scattering(scene, i); });
    Values emitted = Values::Zero(static_cast<Eigen::Index>(neighbour_.size()), w);  // [pair (i, j)]
    for (Eigen::Index first = 0; first < w; first += lane_count) {
        Wavelengths const packet = packet_of(nm_, static_cast<std::size_t>(first), scene.grid);
        for (std::size_t i = 0; i < n; ++i) {
            Patch const& p = mesh_.patch[i];
            int const light = mesh_.shape[static_cast<std::size_t>(p.shape)]->light;
            if (light < 0) continue;
            Place const place(p, material_of(scene, p));
            for (std::size_t e = first_[i]; e < first_[i + 1]; ++e) {
                VectorDouble const& end = mesh_.patch[static_cast<std::size_t>(neighbour_[e].patch)].centre;
                Direction const way = place.above((end - p.centre).normalized().cast<float>());
                Radiance const L = scene.lights.light(light).emitted(place.point, way, packet);
                for (Eigen::Index lane = 0; lane < std::min<Eigen::Index>(lane_count, w - first); ++lane)
                    emitted(static_cast<Eigen::Index>(e), first + lane) = L.lane[static_cast<int>(lane)];
            }
        }
    }
    auto const pair = [](std::size_t e) { return static_cast<Eigen::Index>(e); };
    arriving_ = Values::Zero(emitted.rows(), w);
    float const largest = emitted.size() > 0 ? emitted.maxCoeff() : 0;
    for (int iteration = 0; iteration < settings.stop.iterations; ++iteration) {
        Values next(arriving_.rows(), w);
        in_parallel([&](std::size_t i) {
            std::size_t const count = neighbours(i);
            for (std::size_t j = 0; j < count; ++j) {
                Eigen::Array<float, 1, Eigen::Dynamic> sent = emitted.row(pair(first_[i] + j));
                for (std::size_t k = 0; k < count; ++k)
                    sent += f[i].row(pair(k * count + j)) * arriving_.row(pair(first_[i] + k));
                next.row(pair(neighbour_[first_[i] + j].back)) = sent;
            }
        });
        float const change = next.size() > 0 ? (next - arriving_).abs().maxCoeff() : 0;
        arriving_ = std::move(next);
        if (change <= static_cast<float>(settings.stop.tolerance) * largest) return;
    }
    throw InputError({}, "integrator", "directional-radiosity: what surfaces scatter does not die away");
}

Eigen::ArrayXf DirectionalRadiosity::sent(std::size_t i, std::size_t k) const {
    return arriving_.row(static_cast<Eigen::Index>(neighbour_[first_[i] + k].back)).transpose();
}

Radiance DirectionalRadiosity::radiance(Scene const& scene, PatchHit const& hit, Direction const& to_viewer,
                                        Wavelengths const& wavelengths) const {
    if (hit.patch < 0) return {};
    auto const i = static_cast<std::size_t>(hit.patch);
    Patch const& p = mesh_.patch[i];
    Material const& material = material_of(scene, p);
    Shape const& shape = *mesh_.shape[static_cast<std::size_t>(p.shape)];
    Place const place(p, material);
    Radiance L;
    if (shape.light >= 0) L += scene.lights.light(shape.light).emitted(place.point, to_viewer, wavelengths);
    Bsdf const bsdf = material.at(place.point, wavelengths);
    Direction const wo = place.local(to_viewer);
    WavelengthCells const cells(nm_, wavelengths);
    for (std::size_t e = first_[i]; e < first_[i + 1]; ++e) {
        Patch const& from = mesh_.patch[static_cast<std::size_t>(neighbour_[e].patch)];
        BsdfValue const f =
            bsdf.evaluate(wo, place.local((from.centre - hit.position).normalized().cast<float>())).value;
        for (int lane = 0; lane < lane_count; ++lane)
            L.lane[lane] += f.lane[lane] * pi * neighbour_[e].factor *
                            cells.at(lane, [&](Eigen::Index c) { return arriving_(static_cast<Eigen::Index>(e), c); });
    }
    return L;
}

namespace {

class ShowDirectional final : public Integrator {
  public:
    explicit ShowDirectional(DirectionalRadiosity solution) : solution_(std::move(solution)) {}
    void follow(Scene const& scene, std::span<CameraPath> paths, RayStatistics& statistics) const override {
        statistics.closest_rays += paths.size();
        for (CameraPath& path : paths)
            if (auto const hit = solution_.tracer().closest(path.ray))
                path.radiance += solution_.radiance(scene, *hit, -path.ray.direction, path.wavelengths);
    }

  private:
    DirectionalRadiosity solution_;
};

}  // namespace

std::unique_ptr<Integrator> make_directional_radiosity(Scene const& scene, RenderPlan const& plan,
                                                       IntegratorOptions& options) {
    DirectionalSettings settings;
    settings.patches = options.integer("patches", 1, 100000, settings.patches);
    settings.wavelengths = options.integer("wavelengths", 2, 1000, settings.wavelengths);
    options.finish();
    return std::make_unique<ShowDirectional>(DirectionalRadiosity(scene, plan.wavelengths, settings));
}

}  // namespace iride::radiosity
