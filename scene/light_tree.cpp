// SPDX-License-Identifier: Apache-2.0
#include "scene/light_tree.h"

#include <array>
#include <limits>
#include <optional>

namespace iride {

namespace {

constexpr int bucket_count = 12;
// Deeper than this, groups are halved by number: lamps in a geometric row would make a list, and a trail has 64 bits.
constexpr int deepest_by_cost = 32;
constexpr float below_one = 0x1.fffffep-1f;

double diagonal2(LightBounds const& b) { return (b.upper - b.lower).squaredNorm(); }

// Solid angle of emission, weighted by the cosine beyond the cone of normals. [Conty 2018, eq. 1]
double orientation_measure(LightBounds const& b) {
    double const o = b.normals_rad, w = std::min(o + b.emission_rad, pi_double);
    return 2 * pi_double * (1 - std::cos(o)) +
           pi_double / 2 * (2 * w * std::sin(o) - std::cos(o - 2 * w) - 2 * o * std::sin(o) + std::cos(o));
}
double cost(LightBounds const& b) { return b.intensity * orientation_measure(b) * diagonal2(b); }

VectorDouble centre(LightBounds const& b) { return (b.lower + b.upper) / 2; }

struct Cut {
    double cost = std::numeric_limits<double>::infinity();
    int axis = -1;
    double at = 0;  // centres below go left
};

// The best of eleven planes along an axis.
template <class Items>
Cut best_cut(Items const& items, VectorDouble const& lower, VectorDouble const& upper, int axis) {
    double const width = upper[axis] - lower[axis];
    Cut best;
    if (!(width > 0)) return best;
    std::array<std::optional<LightBounds>, bucket_count> bucket;
    for (auto const& item : items) {
        double const place = (centre(item.bounds)[axis] - lower[axis]) / width * bucket_count;
        auto& b = bucket[static_cast<std::size_t>(std::clamp(static_cast<int>(place), 0, bucket_count - 1))];
        b = b ? united(*b, item.bounds) : item.bounds;
    }
    double const elongation = (upper - lower).maxCoeff() / width;
    std::array<double, bucket_count> from_left{};
    std::optional<LightBounds> group;
    for (std::size_t i = 0; i + 1 < bucket_count; ++i) {
        if (bucket[i]) group = group ? united(*group, *bucket[i]) : *bucket[i];
        from_left[i] = group ? cost(*group) : 0;
    }
    group.reset();
    for (std::size_t i = bucket_count - 1; i > 0; --i) {
        if (bucket[i]) group = group ? united(*group, *bucket[i]) : *bucket[i];
        double const total = elongation * (from_left[i - 1] + (group ? cost(*group) : 0));
        if (total < best.cost) best = {total, axis, lower[axis] + width * static_cast<double>(i) / bucket_count};
    }
    return best;
}

}  // namespace

LightBounds united(LightBounds const& a, LightBounds const& b) {
    LightBounds u = a.normals_rad >= b.normals_rad ? a : b;
    LightBounds const& narrow = a.normals_rad >= b.normals_rad ? b : a;
    double const between = std::atan2(u.axis.cross(narrow.axis).norm(), u.axis.dot(narrow.axis));
    if (std::min(between + narrow.normals_rad, pi_double) > u.normals_rad) {
        double const half = (u.normals_rad + between + narrow.normals_rad) / 2;
        VectorDouble const across = narrow.axis - u.axis.dot(narrow.axis) * u.axis;
        if (half >= pi_double || across.norm() < 1e-12) {  // the whole sphere; or opposite, and any way is as far
            u.normals_rad = pi_double;
        } else {
            double const turn = half - u.normals_rad;
            u.axis = (std::cos(turn) * u.axis + std::sin(turn) * across.normalized()).normalized();
            u.normals_rad = half;
        }
    }
    u.lower = a.lower.cwiseMin(b.lower);
    u.upper = a.upper.cwiseMax(b.upper);
    u.emission_rad = std::max(a.emission_rad, b.emission_rad);
    u.two_sided = a.two_sided || b.two_sided;
    u.intensity = a.intensity + b.intensity;
    return u;
}

LightCluster::LightCluster(LightBounds const& b)
    : centre(iride::centre(b).cast<float>()),
      axis(b.axis.cast<float>()),
      radius2(static_cast<float>(diagonal2(b) / 4)),
      cos_normals(static_cast<float>(std::cos(b.normals_rad))),
      sin_normals(static_cast<float>(std::sin(b.normals_rad))),
      cos_emission(static_cast<float>(std::cos(b.emission_rad))),
      intensity(static_cast<float>(b.intensity)),
      two_sided(b.two_sided) {}

LightTree::LightTree(std::span<LightBounds const> bounds) : trail_(bounds.size()) {
    std::vector<Item> items;
    for (std::size_t i = 0; i < bounds.size(); ++i) items.push_back({bounds[i], static_cast<int>(i)});
    nodes_.reserve(2 * items.size());
    if (!items.empty()) build(items, 0, 0);
}

void LightTree::build(std::span<Item> items, int depth, std::uint64_t trail) {
    depth_ = std::max(depth_, depth);
    LightBounds all = items.front().bounds;
    VectorDouble lower = centre(all), upper = lower;
    for (Item const& item : items.subspan(1)) {
        all = united(all, item.bounds);
        lower = lower.cwiseMin(centre(item.bounds));
        upper = upper.cwiseMax(centre(item.bounds));
    }
    std::size_t const node = nodes_.size();
    nodes_.push_back({LightCluster(all)});
    if (items.size() == 1) {
        nodes_[node].lamp = items.front().lamp;
        trail_[static_cast<std::size_t>(items.front().lamp)] = trail;
        return;
    }
    std::size_t left = items.size() / 2;
    Cut cut;
    if (depth < deepest_by_cost)
        for (int axis = 0; axis < 3; ++axis)
            if (Cut const c = best_cut(items, lower, upper, axis); c.cost < cut.cost) cut = c;
    if (cut.axis >= 0) {
        auto const middle = std::partition(items.begin(), items.end(),
                                           [&](Item const& item) { return centre(item.bounds)[cut.axis] < cut.at; });
        auto const below = static_cast<std::size_t>(middle - items.begin());
        if (below > 0 && below < items.size()) left = below;
    }
    build(items.first(left), depth + 1, trail);
    nodes_[node].right = static_cast<int>(nodes_.size());
    build(items.subspan(left), depth + 1, trail | (std::uint64_t{1} << depth));
}

// Negative where neither child can be seen.
float LightTree::share_of_left(LightReceiver const& receiver, std::size_t node) const {
    float const left = nodes_[node + 1].cluster.importance(receiver);
    float const right = nodes_[static_cast<std::size_t>(nodes_[node].right)].cluster.importance(receiver);
    return left + right > 0 ? left / (left + right) : -1;
}

LightTree::Choice LightTree::choose(LightReceiver const& receiver, float u) const {
    std::size_t node = 0;
    float probability = 1;
    while (nodes_[node].right >= 0) {
        float const share = share_of_left(receiver, node);
        if (share < 0) return {-1, 0};
        if (u < share) {
            u = std::min(u / share, below_one);
            probability *= share;
            ++node;
        } else {
            u = std::min((u - share) / (1 - share), below_one);
            probability *= 1 - share;
            node = static_cast<std::size_t>(nodes_[node].right);
        }
    }
    return {nodes_[node].lamp, probability};
}

float LightTree::probability(LightReceiver const& receiver, int lamp) const {
    std::uint64_t trail = trail_[static_cast<std::size_t>(lamp)];
    std::size_t node = 0;
    float probability = 1;
    for (; nodes_[node].right >= 0; trail >>= 1) {
        float const share = share_of_left(receiver, node);
        if (share < 0) return 0;
        bool const right = (trail & 1) != 0;
        probability *= right ? 1 - share : share;
        node = right ? static_cast<std::size_t>(nodes_[node].right) : node + 1;
    }
    return probability;
}

}  // namespace iride
