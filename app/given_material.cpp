// SPDX-License-Identifier: Apache-2.0
#include "app/given_material.h"

#include <fmt/format.h>

#include "base/constants.h"
#include "base/diagnostics.h"
#include "spectral/catalogue.h"

namespace iride {

namespace {

// Of a directional albedo: Sobol' points per packet, and the flattest direction: at 90 degrees there is no projected
// area.
constexpr std::uint32_t albedo_samples = 1024;
constexpr double flattest_deg = 89.99;

// Defined everywhere, by its end values: only colours are asked for beyond the ends.
ComplexIndex held(ComplexIndex const& index) {
    return {index.n.with_outside(Outside::hold), index.k.with_outside(Outside::hold)};
}

PlaneStack held(PlaneStack const& stack) {
    PlaneStack all{.outside = held(stack.outside), .layers = stack.layers, .inside = held(stack.inside)};
    for (CoatingLayer& l : all.layers) l.index = held(l.index);
    return all;
}

double cosine_of(double angle_deg) { return angle_deg == 90 ? 0 : std::cos(radians(angle_deg)); }

GivenMaterial of_scene(std::shared_ptr<Scene const> const& scene, NamedMaterial const& m, std::string const& file) {
    PlaneStack const* const plane = m.material->plane();
    GivenMaterial given{m.name, fmt::format("{}: {}", file, m.type), scene->wavelengths};
    if (plane) given.plane = held(*plane);
    given.scene = scene;
    given.material = m.material.get();
    return given;
}

std::vector<GivenMaterial> of_scene_file(std::string const& file, std::string const& wanted) {
    std::shared_ptr<Scene const> const scene = load_scene(file);
    std::vector<GivenMaterial> all;
    std::vector<std::string> names;
    for (NamedMaterial const& m : scene->materials) {
        if (wanted.empty() || wanted == m.name) all.push_back(of_scene(scene, m, file));
        names.push_back(m.name);
    }
    if (names.empty()) throw InputError({file}, "materials", "the scene has no material");
    if (all.empty())
        throw InputError({file}, "materials", fmt::format("no material '{}'{}", wanted, suggestion(wanted, names)));
    return all;
}

// All lanes at the given wavelengths; lanes beyond their number repeat the last.
Wavelengths packet_of(std::span<double const> nm, WavelengthGrid const& grid) {
    Wavelengths w;
    w.density = Sampled<dim::per_nanometre>(1.0f / static_cast<float>(grid.count - 1));
    for (int i = 0; i < lane_count; ++i) {
        double const x = nm[std::min(static_cast<std::size_t>(i), nm.size() - 1)];
        int const cell = std::clamp(static_cast<int>(x - grid.first_nm), 0, grid.count - 2);
        w.nm[i] = static_cast<float>(x);
        w.cell[i] = cell;
        w.fraction[i] = static_cast<float>(x - grid.first_nm - cell);
    }
    return w;
}

// The share of light from `angle_deg` that goes back to the same side, per lane; by reciprocity, of light that goes
// there under a uniform sky.
Lanes albedo(Material const& material, double angle_deg, Wavelengths const& w) {
    double const angle = radians(std::min(angle_deg, flattest_deg));
    Direction const wo(static_cast<float>(std::sin(angle)), 0, static_cast<float>(std::cos(angle)));
    Bsdf const bsdf = material.at({Vector(0, 0, 0), Direction(0, 0, 1), Direction(0, 0, 1)}, w);
    std::array<double, lane_count> sum{};
    for (std::uint32_t i = 0; i < albedo_samples; ++i) {
        Sampler s(SamplerKind::sobol, 0, 0, i);
        auto const lobe = s.next();
        auto const sample = bsdf.sample(wo, {lobe, s.next2()});
        if (!sample || sample->wi.z() <= 0) continue;
        for (int lane = 0; lane < lane_count; ++lane) sum[static_cast<std::size_t>(lane)] += sample->weight[lane];
    }
    Lanes mean;
    for (int lane = 0; lane < lane_count; ++lane)
        mean.set(lane, static_cast<float>(sum[static_cast<std::size_t>(lane)] / albedo_samples));
    return mean;
}

}  // namespace

std::vector<GivenMaterial> given_materials(std::string const& name) {
    if (!in_catalogue(name)) {
        std::error_code ignored;
        auto const end = name.rfind(".json:");
        if (name.ends_with(".json")) return of_scene_file(name, "");
        if (end != std::string::npos && !std::filesystem::exists(name, ignored))
            return of_scene_file(name.substr(0, end + 5), name.substr(end + 6));
    }
    PlaneStack const plane{.inside = load_complex_index(name)};
    WavelengthRange const own = plane.defined_on();
    constexpr double least_n = 1e-3, most = 1000;
    double const n = plane.inside.n.smallest(own), k = plane.inside.k.smallest(own);
    double const largest = std::max(plane.inside.n.largest(own), plane.inside.k.largest(own));
    if (!(n >= least_n && k >= 0 && largest <= most))
        throw InputError({}, name,
                         fmt::format("n down to {:g}, k down to {:g}, one of them up to {:g}; allowed: n {} .. "
                                     "{}, k 0 .. {}",
                                     n, k, largest, least_n, most, most));
    return {{name, index_source(name), own, held(plane)}};
}

MaterialReflectance reflectance_of(GivenMaterial const& m, double angle_deg, double nm) {
    MaterialReflectance r{};
    if (m.plane) {
        std::complex<double> const index = index_at(m.plane->inside, nm);
        r.n = index.real();
        r.k = index.imag();
    }
    if (!m.smooth()) {
        r.R = static_cast<double>(albedo(*m.material, angle_deg, packet_of(std::array{nm}, m.scene->grid))[0]);
        return r;
    }
    auto const R = m.plane->power(nm, cosine_of(angle_deg)).R;
    r.Rs = R.s;
    r.Rp = R.p;
    r.R = R.unpolarised();
    return r;
}

std::vector<double> reflectances(GivenMaterial const& m, double angle_deg, std::vector<double> const& nm) {
    std::vector<double> at, all;
    for (double x : nm) at.push_back(std::clamp(x, m.defined_on.min_nm, m.defined_on.max_nm));
    if (m.smooth()) {
        for (double x : at) all.push_back(m.plane->power(x, cosine_of(angle_deg)).R.unpolarised());
        return all;
    }
    // A lane that cannot follow the hero has no weight in a sample: where wavelengths part, each is its own hero.
    std::size_t const step = m.material->traits.dispersive ? 1 : lane_count;
    for (std::size_t i = 0; i < at.size(); i += step) {
        std::size_t const count = std::min(step, at.size() - i);
        Lanes const R = albedo(*m.material, angle_deg, packet_of(std::span(at).subspan(i, count), m.scene->grid));
        for (std::size_t j = 0; j < count; ++j) all.push_back(static_cast<double>(R[static_cast<int>(j)]));
    }
    return all;
}

}  // namespace iride
