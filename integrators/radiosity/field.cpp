// SPDX-License-Identifier: Apache-2.0
#include "integrators/radiosity/field.h"

#include <Eigen/Geometry>

#include "integrators/radiosity/vertex_transfer.h"

namespace iride::radiosity {

RadiosityField::RadiosityField(PatchMesh mesh, std::vector<double> wavelengths_nm, AtVertex at_vertex)
    : mesh_(std::move(mesh)), tracer_(mesh_), nm_(std::move(wavelengths_nm)), at_vertex_(std::move(at_vertex)) {}

WavelengthCells::WavelengthCells(std::vector<double> const& nm, Wavelengths const& wavelengths)
    : last_(static_cast<Eigen::Index>(nm.size()) - 1) {
    float const first_nm = static_cast<float>(nm.front()), last = std::max(0.0f, static_cast<float>(nm.size()) - 2),
                per_nm = nm.size() < 2 ? 0 : 1 / static_cast<float>(nm[1] - nm[0]);
    for (int lane = 0; lane < lane_count; ++lane) {
        float const place = (wavelengths.nm[lane] - first_nm) * per_nm,
                    cell = std::clamp(std::floor(place), 0.0f, last);
        cell_[static_cast<std::size_t>(lane)] = static_cast<Eigen::Index>(cell);
        fraction_[static_cast<std::size_t>(lane)] = place - cell;
    }
}

// Wachspress coordinates: barycentric in a triangle, bilinear in a rectangle, smooth and linear along edges in between.
Radiance RadiosityField::radiance(PatchHit const& hit, Wavelengths const& wavelengths) const {
    Radiance L;
    if (hit.patch < 0) return L;
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
    if (!(total > 0)) return L;
    WavelengthCells const cells(nm_, wavelengths);
    for (std::size_t k = 0; k < n; ++k) {
        float const* const of_vertex = at_vertex_.row(p.vertex[k]).data();
        auto const share = static_cast<float>(weight[k] / total);
        for (int lane = 0; lane < lane_count; ++lane)
            L.lane[lane] += share * cells.at(lane, [&](Eigen::Index column) { return of_vertex[column]; });
    }
    return max(Radiance(), L) * inverse_pi;
}

std::shared_ptr<RadiosityField const> field_of_patches(PatchMesh mesh, std::vector<double> wavelengths_nm,
                                                       Spectra const& of_patches) {
    RadiosityField::AtVertex at_vertex = to_vertices(mesh, of_patches).max(0.0).cast<float>();
    return std::make_shared<RadiosityField>(std::move(mesh), std::move(wavelengths_nm), std::move(at_vertex));
}

}  // namespace iride::radiosity
