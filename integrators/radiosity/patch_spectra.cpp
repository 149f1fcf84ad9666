// SPDX-License-Identifier: Apache-2.0
#include "integrators/radiosity/patch_spectra.h"

#include <fmt/format.h>

#include <array>
#include <map>
#include <tuple>

#include "integrators/radiosity/mirrors.h"

namespace iride::radiosity {

namespace {

// Albedo under even light: the mean of a sample's weight over cosine-distributed directions. Exact for Lambert's law.
Lanes albedo(Material const& material, SurfacePoint point, Wavelengths const& wavelengths, bool back) {
    constexpr std::uint32_t samples = 64;
    point.from_front = !back;
    Lanes sum;
    for (std::uint32_t k = 0; k < samples; ++k) {
        Sampler sampler(SamplerKind::sobol, 3, 0, k);
        Direction wo = to_cosine_hemisphere(sampler.next2());
        if (back && !material.traits.two_sided) wo.z() = -wo.z();
        point.choice = sampler.next();
        auto const sample = material.at(point, wavelengths).sample(wo, {sampler.next(), sampler.next2()});
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

// Albedos of materials that are the same everywhere, found once for a packet.
class Albedos {
  public:
    explicit Albedos(Wavelengths const& wavelengths) : wavelengths_(wavelengths) {}
    Lanes operator()(Material const& material, SurfacePoint const& point, bool back) {
        if (material.traits.textured || material.traits.anisotropic) return albedo(material, point, wavelengths_, back);
        auto const [place, is_new] = known_.try_emplace({&material, back});
        if (is_new) place->second = albedo(material, point, wavelengths_, back);
        return place->second;
    }

  private:
    Wavelengths const& wavelengths_;
    std::map<std::pair<Material const*, bool>, Lanes> known_;
};

}  // namespace

Wavelengths packet_of(std::vector<double> const& wavelengths_nm, std::size_t first, WavelengthGrid const& grid) {
    LaneRegister nm{};
    for (int k = 0; k < lane_count; ++k)
        nm[k] = static_cast<float>(
            wavelengths_nm[std::min(first + static_cast<std::size_t>(k), wavelengths_nm.size() - 1)]);
    return wavelengths_at(nm, grid);
}

System patch_spectra(Scene const& scene, PatchMesh const& mesh, PatchTracer const& tracer,
                     std::vector<double> const& wavelengths_nm, bool mirrors) {
    auto const n = static_cast<Eigen::Index>(mesh.patch.size()), w = static_cast<Eigen::Index>(wavelengths_nm.size());
    System system;
    system.area.resize(n);
    system.reflectance.resize(n, w);
    system.emission = Spectra::Zero(n, w);
    for (Eigen::Index first = 0; first < w; first += lane_count) {
        Eigen::Index const lanes = std::min<Eigen::Index>(lane_count, w - first);
        Wavelengths const packet = packet_of(wavelengths_nm, static_cast<std::size_t>(first), scene.grid);
        Albedos albedos(packet);
        for (Eigen::Index i = 0; i < n; ++i) {
            Patch const& p = mesh.patch[static_cast<std::size_t>(i)];
            Shape const& shape = *mesh.shape[static_cast<std::size_t>(p.shape)];
            SurfacePoint const point = front_point(p);
            system.area[i] = p.area;
            bool const followed = mirrors && is_mirror(scene.materials[static_cast<std::size_t>(shape.material)]);
            Lanes const rho = followed ? Lanes(0) : albedos(scene.material(shape.material), point, p.back);
            Irradiance const arriving = outside_light(scene, tracer, p, packet);
            Radiance emitted;
            if (shape.light >= 0)
                emitted = scene.lights.light(shape.light).emitted(point, p.normal.cast<float>(), packet);
            for (int k = 0; k < lanes; ++k) {
                system.reflectance(i, first + k) = static_cast<double>(rho[k]);
                system.emission(i, first + k) = pi_double * static_cast<double>(emitted[k]) +
                                                static_cast<double>(rho[k]) * static_cast<double>(arriving[k]);
            }
        }
    }
    return system;
}

std::string describe(Scene const& scene, PatchMesh const& mesh, std::size_t patch) {
    Patch const& p = mesh.patch[patch];
    Shape const& shape = *mesh.shape[static_cast<std::size_t>(p.shape)];
    return fmt::format("patch {}{} of shape {} (material '{}')", patch, p.back ? ", a back," : "", p.shape,
                       scene.materials[static_cast<std::size_t>(shape.material)].name);
}

namespace {

void say_material(NamedMaterial const& m, bool mirrors, std::vector<std::string>& remarks) {
    Material const& material = *m.material;
    auto const say = [&](std::string const& what) {
        remarks.push_back(fmt::format("radiosity: material '{}' ({}) {}", m.name, m.type, what));
    };
    bool const exact = m.type == "diffuse" || m.type == "black";
    if (material.body() || m.type == "slab" || m.type == "film")
        say("transmits: that is ignored, it is a wall that reflects diffusely");
    else if (is_mirror(m))
        say(mirrors
                ? "is a mirror: followed by rays, curved ones as facets; light from lamps without extent or from the "
                  "environment is not"
                : "is a mirror: what it sends to other surfaces is taken for diffuse, as of its albedo");
    else if (!exact)
        say("is taken for a diffuse surface of its albedo under even light");
    if (material.traits.textured) say("varies over the surface: looked at in the middle of each patch");
    if (m.relief) say("has bumps: ignored");
    if (m.alpha) say("has holes: ignored, it is opaque");
}

}  // namespace

std::vector<std::string> approximations(Scene const& scene, PatchMesh const& mesh, bool mirrors) {
    std::vector<std::string> remarks;
    std::vector<char> used(scene.materials.size(), 0);
    bool diffuse = false;
    for (Shape const* s : mesh.shape) used[static_cast<std::size_t>(s->material)] = 1;
    for (std::size_t m = 0; m < used.size(); ++m) {
        if (!used[m]) continue;
        say_material(scene.materials[m], mirrors, remarks);
        diffuse |= scene.materials[m].material->traits.has_density;
    }
    if (!diffuse) remarks.emplace_back("radiosity: no surface is diffuse: nothing of this picture is exact");
    if (mesh.slivers > 0)
        remarks.push_back(fmt::format("radiosity: {} degenerate patches without area are left out", mesh.slivers));
    // Fronts with the same middle, area and plane.
    std::map<std::tuple<float, float, float, float>, std::size_t> seen;
    std::size_t duplicates = 0, first = 0, second = 0;
    for (std::size_t i = 0; i < mesh.patch.size(); ++i) {
        Patch const& p = mesh.patch[i];
        if (p.back) continue;
        auto const c = p.centre.cast<float>().eval();
        auto const [place, is_new] = seen.try_emplace({c.x(), c.y(), c.z(), static_cast<float>(p.area)}, i);
        if (is_new || std::abs(p.normal.dot(mesh.patch[place->second].normal)) < .999) continue;
        if (duplicates++ == 0) first = place->second, second = i;
    }
    if (duplicates > 0)
        remarks.push_back(fmt::format(
            "radiosity: {} duplicate patches lie on others, such as {} on {}: which one light meets is undecided",
            duplicates, describe(scene, mesh, second), describe(scene, mesh, first)));
    return remarks;
}

}  // namespace iride::radiosity
