// SPDX-License-Identifier: Apache-2.0
#include "integrators/radiosity/hierarchy.h"

#include <tbb/parallel_for.h>

#include "integrators/radiosity/exposure.h"
#include "integrators/radiosity/link_refiner.h"

namespace iride::radiosity {

Hierarchy::Hierarchy(PatchMesh const& mesh, PatchTracer const& tracer, System const& system,
                     HierarchyLimits const& limits)
    : tree_(mesh), scale_(Eigen::ArrayXf::Ones(system.patches())) {
    store(LinkRefiner(mesh, tracer, tree_, system, limits).links());
    close(mesh, tracer);
}

// Every link in the rows of both its nodes, in the order of the links.
void Hierarchy::store(std::vector<std::vector<Link>> const& parts) {
    first_.assign(tree_.node.size() + 1, 0);
    for (auto const& part : parts)
        for (Link const& l : part) {
            ++first_[static_cast<std::size_t>(l.r) + 1];
            ++first_[static_cast<std::size_t>(l.s) + 1];
        }
    for (std::size_t n = 0; n + 1 < first_.size(); ++n) first_[n + 1] += first_[n];
    entries_.resize(first_.back());
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    auto const area = [&](int n) { return static_cast<float>(tree_.node[static_cast<std::size_t>(n)].area); };
    for (auto const& part : parts)
        for (Link const& l : part) {
            entries_[next[static_cast<std::size_t>(l.r)]++] = {l.s, l.exchange / area(l.r)};
            entries_[next[static_cast<std::size_t>(l.s)]++] = {l.r, l.exchange / area(l.s)};
        }
}

// Means up the tree, over the links, and what arrives at a node down to its patches.
Spectra Hierarchy::gather(Spectra const& b) const {
    auto const nodes = static_cast<Eigen::Index>(tree_.node.size());
    Rows mean(nodes, b.cols()), arrived(nodes, b.cols());
    auto const node = [&](Eigen::Index n) -> PatchNode const& { return tree_.node[static_cast<std::size_t>(n)]; };
    auto const patch = [&](PatchNode const& n) { return tree_.order[static_cast<std::size_t>(n.first)]; };
    // Each of few columns by itself, whose rows then follow each other closely in memory.
    auto const in_columns = [&](auto const& body) {
        constexpr Eigen::Index together = 16;
        tbb::parallel_for(Eigen::Index{0}, b.cols(), together, [&](Eigen::Index first) {
            body([first, count = std::min(together, b.cols() - first)](auto& rows, Eigen::Index row) {
                return rows.row(row).segment(first, count);
            });
        });
    };
    in_columns([&](auto const& of) {
        for (Eigen::Index n = nodes; n-- > 0;) {
            if (node(n).is_leaf()) {
                of(mean, n) = of(b, patch(node(n))).template cast<float>() * scale_[patch(node(n))];
            } else {
                auto const share = static_cast<float>(node(node(n).left).area / node(n).area);
                of(mean, n) = share * of(mean, node(n).left) + (1 - share) * of(mean, node(n).right);
            }
        }
    });
    tbb::parallel_for(tbb::blocked_range<Eigen::Index>(0, nodes, 256), [&](auto const& range) {
        for (Eigen::Index n = range.begin(); n < range.end(); ++n) {
            arrived.row(n).setZero();
            for (std::size_t k = first_[static_cast<std::size_t>(n)]; k < first_[static_cast<std::size_t>(n) + 1]; ++k)
                arrived.row(n) += entries_[k].factor * mean.row(entries_[k].from);
        }
    });
    Spectra sums = Spectra::Zero(b.rows(), b.cols());
    in_columns([&](auto const& of) {
        for (Eigen::Index n = 0; n < nodes; ++n) {
            if (node(n).is_leaf()) {
                of(sums, patch(node(n))) = (of(arrived, n) * scale_[patch(node(n))]).template cast<double>();
            } else {
                of(arrived, node(n).left) += of(arrived, n);
                of(arrived, node(n).right) += of(arrived, n);
            }
        }
    });
    return sums;
}

namespace {

// Share of `rays` rays from a patch that meet another.
double share_that_stays(PatchMesh const& mesh, PatchTracer const& tracer, std::size_t patch, int first, int rays) {
    Patch const& p = mesh.patch[patch];
    if (p.open == 0) return 0;
    int stay = 0;
    for (int k = first; k < first + rays; ++k) {
        Sampler sampler(SamplerKind::sobol, 5, static_cast<std::uint32_t>(patch), static_cast<std::uint32_t>(k));
        auto const [from, way] = line_from(mesh, p, sampler);
        auto const hit = tracer.closest(from, p.normal, way);
        stay += hit && hit->patch >= 0;
    }
    return static_cast<double>(stay) / rays;
}

}  // namespace

// F_ij <- d_i F_ij d_j, which keeps reciprocity, until the rows sum to the share of the light that stays in the scene:
// 1 on the sides of shapes of whose rays none is lost, by rays from each patch on the others.
void Hierarchy::close(PatchMesh const& mesh, PatchTracer const& tracer) {
    constexpr int rays_a_side = 512, rays_a_patch = 32, rays_where_mixed = 256;
    std::size_t const sides = 2 * mesh.shape.size();
    std::vector<std::vector<std::size_t>> of_side(sides);
    for (std::size_t i = 0; i < mesh.patch.size(); ++i)
        of_side[2 * static_cast<std::size_t>(mesh.patch[i].shape) + mesh.patch[i].back].push_back(i);
    Eigen::ArrayXd wanted = Eigen::ArrayXd::Ones(scale_.size());
    tbb::parallel_for(std::size_t{0}, sides, [&](std::size_t side) {
        auto const& own = of_side[side];
        bool closed = true;
        for (std::size_t k = 0; k < rays_a_side && closed && !own.empty(); ++k)
            closed = share_that_stays(mesh, tracer, own[k * own.size() / rays_a_side], static_cast<int>(k), 1) == 1;
        if (!closed)
            tbb::parallel_for(std::size_t{0}, own.size(), [&](std::size_t k) {
                double share = share_that_stays(mesh, tracer, own[k], 0, rays_a_patch);
                if (share > 0 && share < 1) share = share_that_stays(mesh, tracer, own[k], 0, rays_where_mixed);
                wanted[static_cast<Eigen::Index>(own[k])] = share;
            });
    });
    auto const row_sums = [&] { return gather(Spectra::Ones(scale_.size(), 1)).col(0).eval(); };
    closure_defect_ = (wanted - row_sums()).abs().maxCoeff();
    constexpr int rounds = 8;        // each shrinks the defect severalfold
    constexpr float widest = 1.25f;  // beyond, a row is not inexact: links that should be there are missing
    for (int k = 0; k < rounds; ++k) {
        Eigen::ArrayXd const found = row_sums();
        scale_ *= (found > 0).select((wanted / found.max(1e-300)).sqrt(), 1.0).cast<float>();
        scale_ = scale_.min(widest);
    }
    // Never more than there is: the solvers rely on it.
    Eigen::ArrayXd const found = row_sums();
    scale_ *= (found > wanted).select(wanted / found.max(1e-300), 1.0).cast<float>();
}

}  // namespace iride::radiosity
