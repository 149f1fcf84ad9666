// SPDX-License-Identifier: Apache-2.0
#include "integrators/radiosity/link_refiner.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <array>
#include <atomic>

#include "integrators/radiosity/closed_forms.h"
#include "integrators/radiosity/exposure.h"

namespace iride::radiosity {

namespace {

constexpr int points = 4;              // of each node at which the kernel is looked at
constexpr double missed_share = 0.05;  // of the smaller area, as exchange of nodes that may touch

}  // namespace

// The estimate of b: what a patch emits, and its reflectance times the irradiance of a scene whose light is even,
// Phi = P / (A (1 - mean rho)). Light is summed over the wavelengths.
LinkRefiner::LinkRefiner(PatchMesh const& mesh, PatchTracer const& tracer, PatchTree const& tree, System const& system,
                         HierarchyLimits const& limits)
    : mesh_(mesh), tracer_(tracer), tree_(tree), limits_(limits) {
    double const total_area = system.area.sum();
    Eigen::Array<double, 1, Eigen::Dynamic> const power = (system.emission.colwise() * system.area).colwise().sum(),
                                                  mean = (system.reflectance.colwise() * system.area).colwise().sum() /
                                                         total_area;
    Eigen::Array<double, 1, Eigen::Dynamic> const ambient = power / (total_area * (1 - mean));
    allowed_ = limits.tolerance * power.sum();
    Eigen::ArrayXd const sends = (system.emission + system.reflectance.rowwise() * ambient).rowwise().sum();
    double const all_ambient = std::max(ambient.sum(), 1e-300);
    Eigen::ArrayXd const takes = (system.reflectance.rowwise() * ambient).rowwise().sum() / all_ambient;
    sends_.assign(tree.node.size(), 0);
    takes_.assign(tree.node.size(), 0);
    for (std::size_t n = tree.node.size(); n-- > 0;) {
        PatchNode const& node = tree.node[n];
        if (node.is_leaf()) {
            auto const i = static_cast<Eigen::Index>(tree.order[static_cast<std::size_t>(node.first)]);
            sends_[n] = sends[i];
            takes_[n] = takes[i];
            continue;
        }
        auto const l = static_cast<std::size_t>(node.left), r = static_cast<std::size_t>(node.right);
        double const share = tree.node[l].area / node.area;
        sends_[n] = share * sends_[l] + (1 - share) * sends_[r];
        takes_[n] = share * takes_[l] + (1 - share) * takes_[r];
    }
}

Patch const& LinkRefiner::patch(PatchNode const& n, int k, int of) const {
    auto const place = static_cast<std::size_t>(n.first + static_cast<int>((2L * k + 1) * n.count / (2L * of)));
    return mesh_.patch[static_cast<std::size_t>(tree_.order[place])];
}

// Flat nodes: one lies behind the other's plane, or both in one plane.
bool LinkRefiner::never_face(PatchNode const& a, PatchNode const& b) const {
    auto const behind = [](PatchNode const& plane, PatchNode const& n) {
        if (!plane.flat) return false;
        double highest = 0;
        if (n.flat && std::abs(plane.normal.dot(n.normal)) > 1 - 1e-9) {
            highest = plane.normal.dot(n.centre - plane.centre);
        } else {
            for (int k = 0; k < 3; ++k)
                highest += plane.normal[k] * ((plane.normal[k] > 0 ? n.high[k] : n.low[k]) - plane.centre[k]);
        }
        constexpr double rounding = 1e-6;  // of the sizes: scenes are in single precision
        return highest <= rounding * (plane.radius + n.radius);
    };
    return behind(a, b) || behind(b, a);
}

// Kernel at pairs of points of both; where points come closer than the parts they stand for, as if those were discs.
double LinkRefiner::exchange(PatchNode const& r, PatchNode const& s) const {
    int const of_r = std::min(points, r.count), of_s = std::min(points, s.count);
    double const disc = std::max(r.area / of_r, s.area / of_s) / pi_double;
    double sum = 0;
    for (int i = 0; i < of_r; ++i) {
        Patch const& p = patch(r, i, of_r);
        for (int j = 0; j < of_s; ++j) {
            Patch const& q = patch(s, j, of_s);
            VectorDouble const way = q.centre - p.centre;
            double const out = p.normal.dot(way), in = -q.normal.dot(way), d2 = way.squaredNorm();
            if (out > 0 && in > 0) sum += out * in / (d2 * (d2 + disc));
        }
    }
    return std::min({r.area * s.area * sum / (pi_double * of_r * of_s), r.area, s.area});
}

// Two patches: the contour sum of the larger from places of the smaller; where something may stand between (seen < 1),
// from places of chance with a line of sight each, since an open strip may be narrow.
double LinkRefiner::near_exchange(int r, int s, double seen) const {
    PatchNode const &a = tree_.node[static_cast<std::size_t>(r)], &b = tree_.node[static_cast<std::size_t>(s)];
    Patch const &to = patch(a.area < b.area ? b : a, 0, 1), &from = patch(a.area < b.area ? a : b, 0, 1);
    auto const polygon = mesh_.polygon(to);
    constexpr int grid = 4;
    double sum = 0;
    for (int k = 0; k < grid * grid; ++k) {
        std::uint64_t const bits =
            hash_words(static_cast<std::uint64_t>(r), static_cast<std::uint64_t>(s), static_cast<std::uint64_t>(k));
        auto const number = [&](int shift) { return static_cast<float>((bits >> shift) & 0xffff) * 0x1p-16f; };
        bool const open = seen == 1;
        Sample2 const u{(static_cast<float>(k % grid) + (open ? .5f : number(0))) / grid,
                        (static_cast<float>(k / grid) + (open ? .5f : number(16))) / grid};
        VectorDouble const at = point_on(mesh_, from, u);
        if (to.normal.dot(at - to.centre) <= 0) continue;
        if (!open) {
            VectorDouble const end = point_on(mesh_, to, {number(32), number(48)});
            if (from.normal.dot(end - at) <= 0 || !tracer_.visible(at, from.normal, end, to.normal)) continue;
        }
        sum += to.open * std::abs(patch_to_polygon(at, from.normal, polygon));
    }
    return std::min(sum / (grid * grid) * from.area, to.area);
}

// Share of `lines` free lines. Different `series`: independent lines.
double LinkRefiner::visibility(int r, int s, int lines, int series) const {
    PatchNode const &a = tree_.node[static_cast<std::size_t>(r)], &b = tree_.node[static_cast<std::size_t>(s)];
    int free = 0, facing = 0;
    for (int k = 0; k < lines; ++k) {
        std::uint64_t const bits = hash_words(static_cast<std::uint64_t>(r), static_cast<std::uint64_t>(s),
                                              static_cast<std::uint64_t>(k), static_cast<std::uint64_t>(series));
        auto const number = [&](int shift) { return static_cast<float>((bits >> shift) & 0xffff) * 0x1p-16f; };
        Patch const &p = patch(a, k, lines), &q = patch(b, (k * 3 + 1) % lines, lines);
        VectorDouble const from = point_on(mesh_, p, {number(0), number(16)}),
                           to = point_on(mesh_, q, {number(32), number(48)});
        if (p.normal.dot(to - from) <= 0 || q.normal.dot(from - to) <= 0) continue;
        ++facing;
        free += tracer_.visible(from, p.normal, to, q.normal);
    }
    return facing > 0 ? static_cast<double>(free) / facing : 1;
}

template <class OnLink, class OnPair>
void LinkRefiner::refine(Pair pair, OnLink const& link, OnPair const& go_on) const {
    PatchNode const &r = tree_.node[static_cast<std::size_t>(pair.r)],
                    &s = tree_.node[static_cast<std::size_t>(pair.s)];
    if (pair.r == pair.s) {
        if (r.flat || r.is_leaf()) return;
        go_on({r.left, r.left});
        go_on({r.left, r.right});
        go_on({r.right, r.right});
        return;
    }
    if (never_face(r, s)) return;
    bool const both_leaves = r.is_leaf() && s.is_leaf();
    double const distance = (s.centre - r.centre).norm(), size = r.radius + s.radius;
    bool const near = distance < 2 * size;
    double const G = exchange(r, s);
    auto const a = static_cast<std::size_t>(pair.r), b = static_cast<std::size_t>(pair.s);
    double const strength = std::max(takes_[a] * sends_[b], takes_[b] * sends_[a]);
    bool const splittable = !both_leaves;
    auto const split = [&] {
        // The one that is not flat, else the larger.
        bool const first = s.is_leaf() || (!r.is_leaf() && (r.flat != s.flat ? !r.flat : r.radius >= s.radius));
        if (first) {
            go_on({r.left, pair.s});
            go_on({r.right, pair.s});
        } else {
            go_on({pair.r, s.left});
            go_on({pair.r, s.right});
        }
    };
    bool const rough = (!r.flat && !r.is_leaf()) || (!s.flat && !s.is_leaf());
    if (splittable && rough) {
        // What the points of a curved node say may be far off: the most that can go over is what counts.
        double const gap = std::max(0.0, distance - size), spread = pi_double * gap * gap;
        double const from_r = r.area * sends_[a] * takes_[b] * (s.area < spread ? s.area / spread : 1),
                     from_s = s.area * sends_[b] * takes_[a] * (r.area < spread ? r.area / spread : 1);
        if (std::max(from_r, from_s) > allowed_) return split();
    } else if (splittable) {
        // Where nodes may touch, a few points can miss all that goes over.
        double const missed = distance < size ? missed_share * std::min(r.area, s.area) : 0;
        if (std::max(G, missed) * strength * std::min(1.0, size / distance) > allowed_) return split();
    }
    if (G <= 0 && !(both_leaves && near)) return;
    // Lines that decide must not be those that count: what is split as they come out mixed and taken as it is where
    // they all come out alike would be seen too often fully or, where little is free, not at all.
    double const looked = visibility(pair.r, pair.s, limits_.lines, 0);
    bool const shadow_edge = looked > 0 && looked < 1;
    if (splittable && shadow_edge && G * strength > allowed_) return split();
    constexpr double most = 8;  // times as many lines where nothing can be split and much depends on them
    double const weight = both_leaves ? std::clamp(std::sqrt(G * strength / allowed_), 1.0, most) : 1;
    double const seen = visibility(pair.r, pair.s, static_cast<int>(limits_.lines * weight), 1);
    double const through = both_leaves && near ? near_exchange(pair.r, pair.s, std::min(looked, seen)) : G * seen;
    if (through > 0) link(Link{pair.r, pair.s, static_cast<float>(through)});
}

std::vector<std::vector<LinkRefiner::Link>> LinkRefiner::links() const {
    constexpr std::size_t tasks = 4096;
    // Broad first, until there are pairs enough to share out.
    std::vector<std::vector<Link>> parts(1);
    std::vector<Pair> open{{0, 0}};
    while (!open.empty() && open.size() < tasks) {
        std::vector<Pair> next;
        for (Pair const& p : open)
            refine(
                p, [&](Link const& l) { parts[0].push_back(l); }, [&](Pair const& q) { next.push_back(q); });
        open = std::move(next);
    }
    parts.resize(1 + open.size());
    // Links while they are made, and twice again as rows.
    double const most = limits_.memory_bytes / (sizeof(Link) + 2 * 8.0);
    std::atomic<std::size_t> count{parts[0].size()};
    tbb::parallel_for(std::size_t{0}, open.size(), [&](std::size_t t) {
        std::vector<Pair> stack{open[t]};
        std::vector<Link>& part = parts[t + 1];
        while (!stack.empty() && static_cast<double>(count) + static_cast<double>(part.size()) < most) {
            Pair const p = stack.back();
            stack.pop_back();
            refine(
                p, [&](Link const& l) { part.push_back(l); }, [&](Pair const& q) { stack.push_back(q); });
        }
        count += part.size();
    });
    if (static_cast<double>(count) >= most)
        throw InputError({}, "--memory",
                         fmt::format("found more than {:.3g} links, which fill {:.2g} GB; allowed: a larger --size, "
                                     "--link-tolerance or --memory",
                                     most, limits_.memory_bytes * 1e-9));
    return parts;
}

}  // namespace iride::radiosity
