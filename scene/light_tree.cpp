// SPDX-License-Identifier: Apache-2.0
#include "scene/light_tree.h"

#include <array>
#include <limits>
#include <optional>
#include <tuple>

namespace iride {

namespace {

constexpr int bucket_count = 12;
// Deeper than this, groups are halved by number: lamps in a geometric row would make a list.
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

void LightClusters::set(int place, LightBounds const& b) {
    auto const at = static_cast<std::size_t>(place);
    VectorDouble const middle = iride::centre(b);
    for (int k = 0; k < 3; ++k) {
        centre[static_cast<std::size_t>(k)][at] = static_cast<float>(middle[k]);
        axis[static_cast<std::size_t>(k)][at] = static_cast<float>(b.axis[k]);
    }
    radius2[at] = static_cast<float>(diagonal2(b) / 4);
    cos_normals[at] = static_cast<float>(std::cos(b.normals_rad));
    sin_normals[at] = static_cast<float>(std::sin(b.normals_rad));
    cos_emission[at] = static_cast<float>(std::cos(b.emission_rad));
    intensity[at] = static_cast<float>(b.intensity);
    two_sided[at] = b.two_sided ? 1 : 0;
}

class LightTree::Builder {
  public:
    Builder(LightTree& tree, std::span<LightBounds const> bounds) : tree_(tree) {
        std::vector<Item> items;
        for (std::size_t i = 0; i < bounds.size(); ++i) items.push_back({bounds[i], static_cast<int>(i)});
        binary_.reserve(2 * items.size());
        split(items, 0);
    }
    void build() { gather(0, {}, 0); }

  private:
    struct Item {
        LightBounds bounds;
        int lamp;
    };
    struct Binary {
        LightBounds bounds;
        int lamps;
        int right = -1;  // the left child is the next; -1: a leaf
        int lamp = -1;
    };

    void split(std::span<Item> items, int depth) {
        LightBounds all = items.front().bounds;
        VectorDouble lower = centre(all), upper = lower;
        for (Item const& item : items.subspan(1)) {
            all = united(all, item.bounds);
            lower = lower.cwiseMin(centre(item.bounds));
            upper = upper.cwiseMax(centre(item.bounds));
        }
        std::size_t const node = binary_.size();
        binary_.push_back({all, static_cast<int>(items.size())});
        if (items.size() == 1) {
            binary_[node].lamp = items.front().lamp;
            return;
        }
        std::size_t left = items.size() / 2;
        Cut cut;
        if (depth < deepest_by_cost)
            for (int axis = 0; axis < 3; ++axis)
                if (Cut const c = best_cut(items, lower, upper, axis); c.cost < cut.cost) cut = c;
        if (cut.axis >= 0) {
            auto const middle = std::partition(
                items.begin(), items.end(), [&](Item const& item) { return centre(item.bounds)[cut.axis] < cut.at; });
            auto const below = static_cast<std::size_t>(middle - items.begin());
            if (below > 0 && below < items.size()) left = below;
        }
        split(items.first(left), depth + 1);
        binary_[node].right = static_cast<int>(binary_.size());
        split(items.subspan(left), depth + 1);
    }

    Binary const& at(int node) const { return binary_[static_cast<std::size_t>(node)]; }
    // Of two groups, the one to be opened first; a lamp cannot be.
    bool is_opened_later(int a, int b) const {
        auto const rank = [](Binary const& n) { return std::tuple(n.right >= 0, cost(n.bounds), n.lamps); };
        return rank(at(a)) < rank(at(b));
    }

    // The node of a group of binary nodes, and all below it.
    int gather(int root, Place const& place, int depth) {
        tree_.depth_ = std::max(tree_.depth_, depth);
        std::vector<int> group{root};
        while (group.size() < real_lanes) {
            int& opened = *std::ranges::max_element(group, [&](int a, int b) { return is_opened_later(a, b); });
            int const right = at(opened).right;
            if (right < 0) break;
            ++opened;  // the left child
            group.push_back(right);
        }
        auto const node = static_cast<int>(tree_.nodes_.size());
        tree_.nodes_.emplace_back();
        tree_.place_of_node_.push_back(place);
        for (int slot = 0; slot < static_cast<int>(group.size()); ++slot) {
            int const child = group[static_cast<std::size_t>(slot)];
            tree_.nodes_[static_cast<std::size_t>(node)].clusters.set(slot, at(child).bounds);
            if (at(child).right < 0) tree_.place_of_lamp_[static_cast<std::size_t>(at(child).lamp)] = {node, slot};
            int const below = at(child).right < 0 ? -1 - at(child).lamp : gather(child, {node, slot}, depth + 1);
            tree_.nodes_[static_cast<std::size_t>(node)].child[static_cast<std::size_t>(slot)] = below;
        }
        return node;
    }

    LightTree& tree_;
    std::vector<Binary> binary_;
};

LightTree::LightTree(std::span<LightBounds const> bounds) : place_of_lamp_(bounds.size()) {
    if (!bounds.empty()) Builder(*this, bounds).build();
}

namespace {

float sum_of(Real8 const& x) {
    float sum = 0;
    for (int i = 0; i < real_lanes; ++i) sum += x[i];
    return sum;
}

}  // namespace

LightTree::Choice LightTree::choose(LightReceiver const& receiver, float u) const {
    float probability = 1;
    for (int node = 0; node >= 0;) {
        Node const& here = nodes_[static_cast<std::size_t>(node)];
        Real8 const importance = here.clusters.importance(receiver);
        float const all = sum_of(importance);
        if (!(all > 0)) return {-1, 0};
        u *= all;
        int slot = -1;
        for (int i = 0; i < real_lanes; ++i) {
            if (!(importance[i] > 0)) continue;
            if (slot >= 0) u -= importance[slot];
            slot = i;
            if (u < importance[i]) break;
        }
        float const chosen = importance[slot];
        u = std::clamp(u / chosen, 0.0f, below_one);
        probability *= chosen / all;
        node = here.child[static_cast<std::size_t>(slot)];
        if (node < 0) return {-1 - node, probability};
    }
    return {-1, 0};
}

float LightTree::probability_of(LightReceiver const& receiver, Place const& place) const {
    if (place.node < 0) return 1;
    auto const node = static_cast<std::size_t>(place.node);
    float const before = probability_of(receiver, place_of_node_[node]);
    Real8 const importance = nodes_[node].clusters.importance(receiver);
    float const all = sum_of(importance);
    return all > 0 ? before * (importance[place.slot] / all) : 0;
}

float LightTree::probability(LightReceiver const& receiver, int lamp) const {
    return probability_of(receiver, place_of_lamp_[static_cast<std::size_t>(lamp)]);
}

}  // namespace iride
