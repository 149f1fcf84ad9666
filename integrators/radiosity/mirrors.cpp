// SPDX-License-Identifier: Apache-2.0
#include "integrators/radiosity/mirrors.h"

#include <tbb/parallel_for.h>

#include "integrators/radiosity/exposure.h"
#include "integrators/radiosity/form_factor_methods.h"
#include "integrators/radiosity/patch_spectra.h"

namespace iride::radiosity {

namespace {

constexpr int cosines = 512;  // cells of a table over 0 .. 1, linear between

using Table = Eigen::Array<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

Table reflectances(Material const& material, std::vector<double> const& nm, WavelengthGrid const& grid) {
    auto const count = static_cast<Eigen::Index>(nm.size());
    Table table(cosines + 1, count);
    for (Eigen::Index first = 0; first < count; first += lane_count) {
        Wavelengths const packet = packet_of(nm, static_cast<std::size_t>(first), grid);
        for (int c = 0; c <= cosines; ++c) {
            Throughput const kept = mirror_reflectance(material, static_cast<double>(c) / cosines, packet);
            for (Eigen::Index k = first; k < std::min<Eigen::Index>(first + lane_count, count); ++k)
                table(c, k) = kept.lane[static_cast<int>(k - first)];
        }
    }
    return table;
}

struct Lost {
    int to;
    Eigen::ArrayXf power;  // A_i times the share of i's light that mirrors keep on the way; [wavelength]
};

// F b, less what mirrors keep.
class MirrorTransport final : public Transport {
  public:
    MirrorTransport(FormFactors factors, std::vector<std::vector<Lost>> lost)
        : factors_(std::move(factors)), lost_(std::move(lost)) {}
    Spectra gather(Spectra const& b) const override {
        Spectra sums = product(factors_, b);
        tbb::parallel_for(Eigen::Index{0}, b.rows(), [&](Eigen::Index i) {
            for (Lost const& l : lost_[static_cast<std::size_t>(i)])
                sums.row(i) -= l.power.transpose().cast<double>() * b.row(l.to);
        });
        return sums;
    }

  private:
    FormFactors factors_;
    std::vector<std::vector<Lost>> lost_;  // [patch], here as factors
};

// [patch][..] what its rays lose, in the order of the patches met.
using Losses = std::vector<std::map<int, Eigen::ArrayXf>>;

FormFactors by_rays(PatchMesh const& mesh, PatchTracer const& tracer, Mirrors const& mirrors, int rays,
                    Eigen::Index wavelengths, Losses& losses) {
    losses.resize(mesh.patch.size());
    return assemble(mesh, mesh.patch.size(), [&](PatchMesh const&, std::size_t i, RowSums& row) {
        Patch const& p = mesh.patch[i];
        // Nothing ends at a mirror, so nothing starts there; its row only closes.
        if (mirrors.is_one(i)) return row.add(static_cast<int>(i), 1);
        if (p.open == 0) return;
        for (int k = 0; k < rays; ++k) {
            Sampler sampler(SamplerKind::sobol, 0, static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(k));
            auto const [from, way] = line_from(mesh, p, sampler);
            Mirrors::Kept kept = Mirrors::Kept::Ones(wavelengths);
            bool by_mirrors = false;
            auto const hit = mirrors.follow(tracer, from, p.normal, way, kept, by_mirrors);
            if (!hit || hit->patch < 0) continue;
            row.add(hit->patch, 1.0 / rays);
            if (!by_mirrors) continue;
            losses[i].try_emplace(hit->patch, Eigen::ArrayXf::Zero(wavelengths)).first->second +=
                static_cast<float>(p.area / rays) * (1.0f - kept);
        }
    });
}

}  // namespace

bool is_mirror(NamedMaterial const& m) {
    return !m.material->traits.has_density && !m.material->body() && m.type != "slab" && m.type != "film" &&
           m.type != "black";
}

Throughput mirror_reflectance(Material const& material, double cosine, Wavelengths const& wavelengths) {
    constexpr double grazing = 1e-6;  // below it there is no meeting
    auto const c = static_cast<float>(std::clamp(cosine, grazing, 1.0));
    auto const sample = material.at(SurfacePoint{{0, 0, 0}, {0, 0, 1}, {0, 0, 1}}, wavelengths)
                            .sample({std::sqrt(1 - c * c), 0, c}, {.5f, {.5f, .5f}});
    return sample ? sample->weight : Throughput(0);
}

Mirrors::Mirrors(Scene const& scene, PatchMesh const& mesh, std::vector<double> const& wavelengths_nm) : mesh_(mesh) {
    for (Shape const* s : mesh.shape) {
        NamedMaterial const& m = scene.materials[static_cast<std::size_t>(s->material)];
        if (is_mirror(m) && !table_.contains(s->material))
            table_.emplace(s->material, reflectances(*m.material, wavelengths_nm, scene.grid));
    }
}

Mirrors::Table const* Mirrors::table_of(int patch) const {
    int const shape = mesh_.patch[static_cast<std::size_t>(patch)].shape;
    auto const found = table_.find(mesh_.shape[static_cast<std::size_t>(shape)]->material);
    return found == table_.end() ? nullptr : &found->second;
}

std::optional<PatchHit> Mirrors::follow(PatchTracer const& tracer, VectorDouble from, VectorDouble side,
                                        VectorDouble way, Kept& kept, bool& by_mirrors) const {
    for (int count = 0; count <= most_mirrors; ++count) {
        auto const hit = tracer.closest(from, side, way);
        if (!hit || hit->patch < 0) return hit;
        Table const* const table = table_of(hit->patch);
        if (!table) return hit;
        VectorDouble const& normal = mesh_.patch[static_cast<std::size_t>(hit->patch)].normal;
        float const place = static_cast<float>(std::clamp(-way.dot(normal), 0.0, 1.0)) * cosines;
        int const cell = std::min(static_cast<int>(place), cosines - 1);
        float const fraction = place - static_cast<float>(cell);
        kept *= ((1 - fraction) * table->row(cell) + fraction * table->row(cell + 1)).transpose();
        by_mirrors = true;
        from = hit->position;
        side = normal;
        way = mirrored(way, normal);
    }
    return std::nullopt;
}

// Of a pair both ways are known by chance: the share lost is that of both together, so that reciprocity holds.
void extend_form_factors(System& system, PatchMesh const& mesh, PatchTracer const& tracer, Mirrors const& mirrors,
                         int rays, std::function<void()> const& found) {
    Losses losses;
    system.form_factors = by_rays(mesh, tracer, mirrors, rays, system.wavelengths(), losses);
    found();
    FormFactors const before = system.form_factors;
    make_reciprocal(system);
    std::vector<std::vector<Lost>> lost(losses.size());
    auto const add = [&](std::size_t i, int j, Eigen::ArrayXf const& power) {
        auto const a = static_cast<Eigen::Index>(i), b = static_cast<Eigen::Index>(j);
        double const both = system.area[a] * before.coeff(a, b) + system.area[b] * before.coeff(b, a);
        lost[i].push_back({j, power * static_cast<float>(system.form_factors.coeff(a, b) / both)});
    };
    for (std::size_t i = 0; i < losses.size(); ++i)
        for (auto const& [j, power] : losses[i]) {
            auto const& other = losses[static_cast<std::size_t>(j)];
            auto const back = other.find(static_cast<int>(i));
            if (j == static_cast<int>(i)) {
                add(i, j, 2 * power);
                continue;
            }
            Eigen::ArrayXf const sum = back == other.end() ? power : Eigen::ArrayXf(power + back->second);
            add(i, j, sum);
            if (back == other.end()) add(static_cast<std::size_t>(j), static_cast<int>(i), sum);
        }
    system.transport = std::make_shared<MirrorTransport>(system.form_factors, std::move(lost));
}

}  // namespace iride::radiosity
