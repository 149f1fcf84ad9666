// SPDX-License-Identifier: Apache-2.0
#include "integrators/radiosity/form_factor_methods.h"

#include <tbb/parallel_for.h>

#include <Eigen/SparseCore>
#include <array>

#include "base/warp.h"
#include "integrators/radiosity/exposure.h"
#include "integrators/radiosity/global_lines.h"
#include "integrators/radiosity/polygon_form_factor.h"

namespace iride::radiosity {

FormFactors assemble(PatchMesh const& receivers, std::size_t columns, RowOfFactors const& row) {
    std::size_t const n = receivers.patch.size();
    using Entry = std::pair<int, double>;
    std::vector<std::vector<Entry>> rows(n);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, n, 64), [&](auto const& range) {
        RowSums sums(columns);
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
            row(receivers, i, sums);
            rows[i].reserve(sums.size());
            sums.take([&](int j, double value) { rows[i].emplace_back(j, value); });
        }
    });
    FormFactors F(static_cast<Eigen::Index>(n), static_cast<Eigen::Index>(columns));
    std::vector<Eigen::Index> sizes;
    for (auto const& r : rows) sizes.push_back(static_cast<Eigen::Index>(r.size()));
    F.reserve(sizes);
    for (std::size_t i = 0; i < n; ++i) {
        for (auto const& [j, value] : rows[i]) F.insert(static_cast<Eigen::Index>(i), j) = value;
        std::vector<Entry>().swap(rows[i]);
    }
    F.makeCompressed();
    return F;
}

namespace {

struct WeightedDirection {
    Vector direction;  // in the patch's frame
    double weight;
};

RowOfFactors rays(PatchTracer const& tracer, int count) {
    return [&tracer, count](PatchMesh const& mesh, std::size_t i, RowSums& row) {
        Patch const& p = mesh.patch[i];
        if (p.open == 0) return;
        for (int k = 0; k < count; ++k) {
            Sampler sampler(SamplerKind::sobol, 0, static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(k));
            auto const [from, way] = line_from(mesh, p, sampler);
            auto const hit = tracer.closest(from, p.normal, way);
            if (hit && hit->patch >= 0) row.add(hit->patch, 1.0 / count);
        }
    };
}

RowOfFactors from_centres(PatchTracer const& tracer, std::vector<WeightedDirection> directions) {
    return [&tracer, directions = std::move(directions)](PatchMesh const& mesh, std::size_t i, RowSums& row) {
        Patch const& p = mesh.patch[i];
        if (p.open == 0) return;
        Frame const frame = Frame::around(p.normal.cast<float>());
        for (WeightedDirection const& w : directions) {
            auto const hit = tracer.closest(p.centre, p.normal, frame.to_world(w.direction).cast<double>());
            if (hit && hit->patch >= 0) row.add(hit->patch, w.weight);
        }
    };
}

std::vector<WeightedDirection> hemicube(int n) {
    std::vector<WeightedDirection> cells;
    double const width = 2.0 / n, area = width * width;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            double const x = -1 + (i + .5) * width, y = -1 + (j + .5) * width;
            cells.push_back(
                {VectorDouble(x, y, 1).normalized().cast<float>(), area / (pi_double * square(1 + x * x + y * y))});
            if (j >= n / 2) continue;
            double const z = (j + .5) * width, weight = z * area / (pi_double * square(1 + x * x + z * z));
            for (VectorDouble const& side :
                 {VectorDouble(1, x, z), VectorDouble(-1, x, z), VectorDouble(x, 1, z), VectorDouble(x, -1, z)})
                cells.push_back({side.normalized().cast<float>(), weight});
        }
    return cells;
}

std::vector<WeightedDirection> hemisphere(int n) {
    std::vector<WeightedDirection> parts;
    auto const middle = [&](int i) { return (static_cast<float>(i) + 0.5f) / static_cast<float>(n); };
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) parts.push_back({to_cosine_hemisphere({middle(i), middle(j)}), 1.0 / (n * n)});
    return parts;
}

RowOfFactors hemicube_rows(PatchTracer const& tracer, int n) { return from_centres(tracer, hemicube(n)); }
RowOfFactors hemisphere_rows(PatchTracer const& tracer, int n) { return from_centres(tracer, hemisphere(n)); }

template <RowOfFactors (*rows)(PatchTracer const&, int)>
FormFactors by_rows(PatchMesh const& mesh, PatchTracer const& tracer, int fineness) {
    return assemble(mesh, mesh.patch.size(), rows(tracer, fineness));
}

// Share of unoccluded lines between points of two patches.
double visibility(PatchMesh const& mesh, PatchTracer const& tracer, Patch const& p, Patch const& q, std::uint32_t pair,
                  int lines) {
    int free = 0, facing = 0;
    for (int k = 0; k < lines; ++k) {
        Sampler sampler(SamplerKind::sobol, 1, pair, static_cast<std::uint32_t>(k));
        VectorDouble const a = point_on(mesh, p, sampler.next2()), b = point_on(mesh, q, sampler.next2());
        if (p.normal.dot(b - a) <= 0 || q.normal.dot(a - b) <= 0) continue;
        ++facing;
        free += tracer.visible(a, p.normal, b, q.normal);
    }
    return facing > 0 ? static_cast<double>(free) / facing : 0;
}

FormFactors analytic(PatchMesh const& mesh, PatchTracer const& tracer, int lines) {
    std::size_t const n = mesh.patch.size();
    std::vector<std::vector<VectorDouble>> polygons;
    for (Patch const& p : mesh.patch) polygons.push_back(mesh.polygon(p));
    // A pair is worked out once, in the order of its patches, so that reciprocity is exact.
    return assemble(mesh, n, [&](PatchMesh const&, std::size_t i, RowSums& row) {
        for (std::size_t j = 0; j < n; ++j) {
            std::size_t const a = std::min(i, j), b = std::max(i, j);
            Patch const &p = mesh.patch[a], &q = mesh.patch[b];
            double const exchange = a == b ? 0 : p.open * q.open * exchange_area(polygons[a], polygons[b]);
            if (exchange <= 0) continue;
            row.add(static_cast<int>(j),
                    exchange / mesh.patch[i].area *
                        visibility(mesh, tracer, p, q, static_cast<std::uint32_t>(a * n + b), lines));
        }
    });
}

// F_ij is the share of the lines that leave i and meet j.
FormFactors by_global_lines(PatchMesh const& mesh, PatchTracer const& tracer, int lines_per_patch) {
    auto const n = static_cast<Eigen::Index>(mesh.patch.size());
    GlobalLines const lines(mesh, tracer);
    std::vector<Eigen::Triplet<double>> pairs;
    Eigen::ArrayXd leaving = Eigen::ArrayXd::Zero(n);
    auto const total = static_cast<std::uint32_t>(n * lines_per_patch);
    for (std::uint32_t k = 0; k < total; ++k)
        lines.follow(
            0, k, [&](int i) { ++leaving[i]; },
            [&](int i, int j) {
                pairs.emplace_back(i, j, 1.0);
                pairs.emplace_back(j, i, 1.0);
            });
    FormFactors F(n, n);
    F.setFromTriplets(pairs.begin(), pairs.end());
    return (leaving > 0).select(leaving.max(1).inverse(), 0.0).matrix().asDiagonal() * F;
}

double all_patches(double patches, int) { return patches; }
double a_ray_each(double patches, int rays) { return std::min<double>(patches, rays); }
double a_cell_each(double patches, int n) { return std::min(patches, 3.0 * n * n); }

constexpr std::array<FormFactorMethod, 6> table{{
    {"rays", "local lines from points spread over each patch", 1024, a_ray_each, rays, by_rows<rays>},
    {"hemicube", "a ray through every cell of a cube over each centre", 64, a_cell_each, hemicube_rows,
     by_rows<hemicube_rows>},
    {"hemisphere", "equal parts of the disc under each centre's hemisphere", 64, a_cell_each, hemisphere_rows,
     by_rows<hemisphere_rows>},
    {"global-lines", "lines through the whole scene, each serving all it meets", 1024, all_patches, nullptr,
     by_global_lines},
    {"analytic", "contour integrals, times the share of free lines", 16, all_patches, nullptr, analytic},
    {"hierarchical", "links between groups of patches, refined by the power they carry: for many patches", 4, nullptr,
     nullptr, nullptr},
}};

}  // namespace

std::span<FormFactorMethod const> form_factor_methods() { return table; }

void make_reciprocal(System& system) {
    Eigen::VectorXd const area = system.area.matrix(), sums = system.form_factors * Eigen::VectorXd::Ones(area.size());
    FormFactors power = area.asDiagonal() * system.form_factors;
    system.form_factors = FormFactors();
    {
        FormFactors const other_way = power.transpose();
        power = FormFactors(0.5 * (power + other_way));
    }
    Eigen::VectorXd const wanted = area.cwiseProduct(sums);
    Eigen::VectorXd scale = Eigen::VectorXd::Ones(area.size());
    constexpr int rounds = 20;  // each shrinks the defect severalfold: below 1e-6 from per cents
    for (int k = 0; k < rounds; ++k) {
        Eigen::ArrayXd const found = scale.array() * (power * scale).array();
        scale.array() *= (found > 0).select((wanted.array() / found.max(1e-300)).sqrt(), 1.0);
    }
    for (Eigen::Index i = 0; i < power.outerSize(); ++i)
        for (FormFactors::InnerIterator G(power, i); G; ++G)
            G.valueRef() = scale[i] / area[i] * G.value() * scale[G.col()];
    system.form_factors = std::move(power);
}

}  // namespace iride::radiosity
