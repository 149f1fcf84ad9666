// SPDX-License-Identifier: Apache-2.0
#include "integrators/radiosity/exposure.h"

#include <tbb/parallel_for.h>

#include "integrators/radiosity/polygon_form_factor.h"

namespace iride::radiosity {

namespace {

VectorDouble point_on_polygon(PatchMesh const& mesh, Patch const& p, Sample2 u) {
    auto const v = mesh.polygon(p);
    double const whole = vector_area(v).norm();
    double const first = p.corners == 3 ? 1 : (v[1] - v[0]).cross(v[2] - v[0]).norm() / 2 / whole;
    double const x = static_cast<double>(u.x);
    bool const in_first = x < first;
    float const rescaled = static_cast<float>(in_first ? x / first : (x - first) / (1 - first));
    Vector2 const b = to_triangle({rescaled, u.y});
    std::size_t const k = in_first ? 1 : 2;
    return v[0] + static_cast<double>(b.x()) * (v[k] - v[0]) + static_cast<double>(b.y()) * (v[k + 1] - v[0]);
}

// By the majority of three rays.
bool lies_open(PatchTracer const& tracer, Patch const& p, VectorDouble const& at, Sampler& sampler) {
    constexpr int majority = 2;
    for (int dark = 0, light = 0;;) {
        auto const hit = tracer.closest(at, p.normal, way_by_cosine(p.normal, sampler));
        (hit && hit->patch < 0 ? dark : light) += 1;
        if (dark == majority) return false;
        if (light == majority) return true;
    }
}

std::vector<VectorDouble> open_points(PatchMesh const& mesh, PatchTracer const& tracer, std::size_t patch, int tried) {
    std::vector<VectorDouble> open;
    for (int k = 0; k < tried; ++k) {
        Sampler sampler(SamplerKind::sobol, 7, static_cast<std::uint32_t>(patch), static_cast<std::uint32_t>(k));
        VectorDouble const at = point_on_polygon(mesh, mesh.patch[patch], sampler.next2());
        if (lies_open(tracer, mesh.patch[patch], at, sampler)) open.push_back(at);
    }
    return open;
}

VectorDouble nearest(std::vector<VectorDouble> const& points, VectorDouble const& to) {
    return *std::ranges::min_element(points, {}, [&](VectorDouble const& p) { return (p - to).squaredNorm(); });
}

// The point nearest to the mean of all.
VectorDouble middle_of(std::vector<VectorDouble> const& points) {
    VectorDouble mean = VectorDouble::Zero();
    for (VectorDouble const& p : points) mean += p / static_cast<double>(points.size());
    return nearest(points, mean);
}

}  // namespace

void find_open_parts(PatchMesh& mesh) {
    PatchTracer const tracer(mesh, PatchTracer::Fronts::drawn_in);
    constexpr int first_look = 16, second_look = 128, closer_look = 1024;
    std::vector<std::vector<VectorDouble>> found(mesh.patch.size());
    tbb::parallel_for(std::size_t{0}, mesh.patch.size(), [&](std::size_t i) {
        Patch& p = mesh.patch[i];
        if (!std::exchange(p.doubtful, false)) return;
        std::size_t const seen = open_points(mesh, tracer, i, first_look).size();
        if (seen == first_look) return;
        bool const covered = seen == 0 && open_points(mesh, tracer, i, second_look).empty();
        if (!covered) found[i] = open_points(mesh, tracer, i, closer_look);
        p.open = static_cast<double>(found[i].size()) / closer_look;
        if (found[i].empty()) return;
        p.centre = middle_of(found[i]);
        p.area *= p.open;
    });
    for (std::size_t i = 0; i < found.size(); ++i)
        if (!found[i].empty()) {
            mesh.patch[i].open_points = static_cast<int>(mesh.open_points.size());
            mesh.open_points.push_back(std::move(found[i]));
        }
}

VectorDouble point_on(PatchMesh const& mesh, Patch const& p, Sample2 u) {
    if (p.open_points < 0) return point_on_polygon(mesh, p, u);
    auto const& points = mesh.open_points[static_cast<std::size_t>(p.open_points)];
    auto const k = static_cast<std::size_t>(u.x * static_cast<float>(points.size()));
    return points[std::min(k, points.size() - 1)];
}

VectorDouble open_point_by(PatchMesh const& mesh, Patch const& p, VectorDouble const& place) {
    return nearest(mesh.open_points[static_cast<std::size_t>(p.open_points)], place);
}

}  // namespace iride::radiosity
