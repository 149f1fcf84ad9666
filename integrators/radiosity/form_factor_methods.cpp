// SPDX-License-Identifier: Apache-2.0
#include "integrators/radiosity/form_factor_methods.h"

#include <tbb/parallel_for.h>

#include <Eigen/SparseCore>
#include <array>

#include "base/warp.h"
#include "integrators/radiosity/polygon_form_factor.h"

namespace iride::radiosity {

namespace {

struct WeightedDirection {
    Vector direction;  // in the patch's frame
    double weight;
};

// Row after row, in parallel; `row(i, sums)` adds to sums[j].
template <class RowOf>
FormFactors assemble(PatchMesh const& mesh, RowOf const& row) {
    std::size_t const n = mesh.patch.size();
    std::vector<std::vector<std::pair<int, double>>> rows(n);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, n, 16), [&](auto const& range) {
        std::vector<double> sums(n, 0.0);
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
            row(i, sums);
            for (std::size_t j = 0; j < n; ++j)
                if (sums[j] != 0) {
                    rows[i].emplace_back(static_cast<int>(j), sums[j]);
                    sums[j] = 0;
                }
        }
    });
    FormFactors F(static_cast<Eigen::Index>(n), static_cast<Eigen::Index>(n));
    std::vector<Eigen::Index> sizes;
    for (auto const& r : rows) sizes.push_back(static_cast<Eigen::Index>(r.size()));
    F.reserve(sizes);
    for (std::size_t i = 0; i < n; ++i)
        for (auto const& [j, value] : rows[i]) F.insert(static_cast<Eigen::Index>(i), j) = value;
    F.makeCompressed();
    return F;
}

VectorDouble point_on(PatchMesh const& mesh, Patch const& p, Sample2 u) {
    auto const v = mesh.polygon(p);
    double const first = p.corners == 3 ? 1 : (v[1] - v[0]).cross(v[2] - v[0]).norm() / 2 / p.area;
    double const x = static_cast<double>(u.x);
    bool const in_first = x < first;
    float const rescaled = static_cast<float>(in_first ? x / first : (x - first) / (1 - first));
    Vector2 const b = to_triangle({rescaled, u.y});
    std::size_t const k = in_first ? 1 : 2;
    return v[0] + static_cast<double>(b.x()) * (v[k] - v[0]) + static_cast<double>(b.y()) * (v[k + 1] - v[0]);
}

FormFactors by_rays(PatchMesh const& mesh, PatchTracer const& tracer, int count) {
    return assemble(mesh, [&](std::size_t i, std::vector<double>& sums) {
        Patch const& p = mesh.patch[i];
        Frame const frame = Frame::around(p.normal.cast<float>());
        for (int k = 0; k < count; ++k) {
            Sampler sampler(SamplerKind::sobol, 0, static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(k));
            VectorDouble const from = point_on(mesh, p, sampler.next2());
            Direction const way = frame.to_world(to_cosine_hemisphere(sampler.next2()));
            auto const hit = tracer.closest(from, p.normal, way.cast<double>());
            if (hit && hit->patch >= 0) sums[static_cast<std::size_t>(hit->patch)] += 1.0 / count;
        }
    });
}

FormFactors from_centres(PatchMesh const& mesh, PatchTracer const& tracer,
                         std::vector<WeightedDirection> const& directions) {
    return assemble(mesh, [&](std::size_t i, std::vector<double>& sums) {
        Patch const& p = mesh.patch[i];
        Frame const frame = Frame::around(p.normal.cast<float>());
        for (WeightedDirection const& w : directions) {
            auto const hit = tracer.closest(p.centre, p.normal, frame.to_world(w.direction).cast<double>());
            if (hit && hit->patch >= 0) sums[static_cast<std::size_t>(hit->patch)] += w.weight;
        }
    });
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

FormFactors by_hemicube(PatchMesh const& mesh, PatchTracer const& tracer, int n) {
    return from_centres(mesh, tracer, hemicube(n));
}
FormFactors by_hemisphere(PatchMesh const& mesh, PatchTracer const& tracer, int n) {
    return from_centres(mesh, tracer, hemisphere(n));
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
    return assemble(mesh, [&](std::size_t i, std::vector<double>& sums) {
        for (std::size_t j = 0; j < n; ++j) {
            std::size_t const a = std::min(i, j), b = std::max(i, j);
            Patch const &p = mesh.patch[a], &q = mesh.patch[b];
            double const exchange = a == b ? 0 : exchange_area(polygons[a], polygons[b]);
            if (exchange <= 0) continue;
            sums[j] = exchange / mesh.patch[i].area *
                      visibility(mesh, tracer, p, q, static_cast<std::uint32_t>(a * n + b), lines);
        }
    });
}

// Between the meetings of a line, two patches face each other: F_ij is the share of the lines that leave i and meet j.
FormFactors by_global_lines(PatchMesh const& mesh, PatchTracer const& tracer, int lines_per_patch) {
    auto const n = static_cast<Eigen::Index>(mesh.patch.size());
    VectorDouble low = mesh.position.front(), high = low;
    for (VectorDouble const& p : mesh.position) low = low.cwiseMin(p), high = high.cwiseMax(p);
    VectorDouble const centre = (low + high) / 2;
    double const radius = (high - low).norm() / 2 * 1.001;  // clear of the corners
    std::vector<Eigen::Triplet<double>> pairs;
    Eigen::ArrayXd leaving = Eigen::ArrayXd::Zero(n);
    auto const total = static_cast<std::uint32_t>(n * lines_per_patch);
    for (std::uint32_t k = 0; k < total; ++k) {
        Sampler sampler(SamplerKind::sobol, 2, 0, k);
        VectorDouble from = centre + radius * to_sphere(sampler.next2()).cast<double>();
        VectorDouble const end = centre + radius * to_sphere(sampler.next2()).cast<double>();
        VectorDouble const way = (end - from).normalized();
        int before = -1;  // the patch that the line leaves
        VectorDouble clear = VectorDouble::Zero();
        for (auto hit = tracer.closest(from, clear, way); hit; hit = tracer.closest(from, clear, way)) {
            if (before >= 0 && hit->patch >= 0) {
                pairs.emplace_back(before, hit->patch, 1.0);
                pairs.emplace_back(hit->patch, before, 1.0);
            }
            if (hit->patch >= 0) ++leaving[hit->patch];
            before = hit->other_side;
            if (before >= 0) ++leaving[before];
            from = hit->position;
            clear = way;
        }
    }
    FormFactors F(n, n);
    F.setFromTriplets(pairs.begin(), pairs.end());
    return (leaving > 0).select(leaving.max(1).inverse(), 0.0).matrix().asDiagonal() * F;
}

constexpr std::array<FormFactorMethod, 5> table{{
    {"rays", "local lines from points spread over each patch", 1024, by_rays},
    {"hemicube", "a ray through every cell of a cube over each centre", 64, by_hemicube},
    {"hemisphere", "equal parts of the disc under each centre's hemisphere", 64, by_hemisphere},
    {"global-lines", "lines through the whole scene, each serving all it meets", 1024, by_global_lines},
    {"analytic", "contour integrals, times the share of free lines", 16, analytic},
}};

}  // namespace

std::span<FormFactorMethod const> form_factor_methods() { return table; }

void make_reciprocal(System& system) {
    Eigen::VectorXd const area = system.area.matrix(), sums = system.form_factors * Eigen::VectorXd::Ones(area.size());
    FormFactors const one_way = area.asDiagonal() * system.form_factors;
    FormFactors power = 0.5 * (one_way + FormFactors(one_way.transpose()));
    Eigen::VectorXd const wanted = area.cwiseProduct(sums);
    constexpr int rounds = 20;  // each shrinks the defect severalfold: below 1e-6 from per cents
    for (int k = 0; k < rounds; ++k) {
        Eigen::VectorXd const found = power * Eigen::VectorXd::Ones(area.size());
        Eigen::VectorXd const scale =
            (found.array() > 0).select((wanted.array() / found.array().max(1e-300)).sqrt(), 1.0);
        power = scale.asDiagonal() * power * scale.asDiagonal();
    }
    system.form_factors = area.cwiseInverse().asDiagonal() * power;
}

}  // namespace iride::radiosity
