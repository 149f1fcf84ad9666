// SPDX-License-Identifier: Apache-2.0
#include "integrators/radiosity/vertex_transfer.h"

#include <limits>
#include <map>

namespace iride::radiosity {

Spectra to_vertices(PatchMesh const& mesh, Spectra const& of_patches) {
    auto const count = static_cast<Eigen::Index>(mesh.position.size());
    Spectra mean = Spectra::Zero(count, of_patches.cols());
    Eigen::ArrayXd area = Eigen::ArrayXd::Zero(count);
    std::map<std::pair<int, int>, int> users;  // of each edge
    for (std::size_t i = 0; i < mesh.patch.size(); ++i) {
        Patch const& p = mesh.patch[i];
        for (std::size_t k = 0, n = static_cast<std::size_t>(p.corners); k < n; ++k) {
            mean.row(p.vertex[k]) += p.open_area() * of_patches.row(static_cast<Eigen::Index>(i));
            area[p.vertex[k]] += p.open_area();
            ++users[std::minmax(p.vertex[k], p.vertex[(k + 1) % n])];
        }
    }
    mean.colwise() /= (area > 0).select(area, 1.0);
    std::vector<bool> on_border(mesh.position.size(), false);
    for (auto const& [edge, number] : users)
        if (number == 1)
            on_border[static_cast<std::size_t>(edge.first)] = on_border[static_cast<std::size_t>(edge.second)] = true;
    // The nearest inner vertex among those of the patches around.
    std::vector<int> inner(mesh.position.size(), -1);
    std::vector<double> distance(mesh.position.size(), std::numeric_limits<double>::infinity());
    for (Patch const& p : mesh.patch)
        for (std::size_t a = 0; a < static_cast<std::size_t>(p.corners); ++a)
            for (std::size_t b = 0; b < static_cast<std::size_t>(p.corners); ++b) {
                auto const v = static_cast<std::size_t>(p.vertex[a]), n = static_cast<std::size_t>(p.vertex[b]);
                if (!on_border[v] || on_border[n]) continue;
                double const d = (mesh.position[v] - mesh.position[n]).norm();
                if (d < distance[v]) distance[v] = d, inner[v] = p.vertex[b];
            }
    Spectra result = mean;
    for (std::size_t v = 0; v < inner.size(); ++v)
        if (inner[v] >= 0) {
            auto const row = static_cast<Eigen::Index>(v);
            result.row(row) = 2 * mean.row(row) - mean.row(inner[v]);
        }
    return result;
}

}  // namespace iride::radiosity
