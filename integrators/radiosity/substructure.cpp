// SPDX-License-Identifier: Apache-2.0
#include "integrators/radiosity/substructure.h"

#include <map>
#include <numeric>

#include "integrators/radiosity/vertex_transfer.h"

namespace iride::radiosity {

namespace {

// Vertices of a patch and what a split adds, by numbers of its own: corner k, middle of the edge from it, centre.
constexpr int middle(int k) { return 4 + k; }
constexpr int centre = 8;
using Part = std::vector<int>;

// The parts of a patch of n corners, some of whose edges are cut.
std::vector<Part> parts_of(int n, std::vector<bool> const& cut, bool flagged) {
    Part outline;
    for (int k = 0; k < n; ++k) {
        outline.push_back(k);
        if (cut[static_cast<std::size_t>(k)]) outline.push_back(middle(k));
    }
    if (static_cast<int>(outline.size()) == n) return {outline};
    std::vector<Part> parts;
    if (flagged && n == 4) {
        for (int k = 0; k < 4; ++k) parts.push_back({k, middle(k), centre, middle((k + 3) % 4)});
    } else if (flagged) {
        for (int k = 0; k < 3; ++k) parts.push_back({k, middle(k), middle((k + 2) % 3)});
        parts.push_back({middle(0), middle(1), middle(2)});
    } else {
        for (std::size_t k = 0; k < outline.size(); ++k)
            parts.push_back({outline[k], outline[(k + 1) % outline.size()], centre});
    }
    return parts;
}

class Splitter {
  public:
    explicit Splitter(Elements const& elements) : from_(elements) {
        to_.mesh.position = from_.mesh.position;
        to_.mesh.shape = from_.mesh.shape;
        to_.mesh.slivers = from_.mesh.slivers;
        to_.mesh.open_points = from_.mesh.open_points;
    }

    Elements split(std::vector<char> const& flagged) {
        auto const& patch = from_.mesh.patch;
        auto const is_flagged = [&](Patch const& p) {
            auto const i = static_cast<std::size_t>(&p - patch.data());
            return flagged[i] || (p.opposite >= 0 && flagged[static_cast<std::size_t>(p.opposite)]);
        };
        for (Patch const& p : patch)
            if (is_flagged(p))
                for (int k = 0; k < p.corners; ++k) middle_of(edge(p, k));
        for (Patch const& p : patch) {
            if (p.back) continue;
            std::vector<bool> cut;
            for (int k = 0; k < p.corners; ++k) cut.push_back(middle_.contains(edge(p, k)));
            add(p, parts_of(p.corners, cut, is_flagged(p)));
        }
        return std::move(to_);
    }

  private:
    using Edge = std::pair<int, int>;
    static Edge edge(Patch const& p, int k) {
        int const a = p.vertex[static_cast<std::size_t>(k)],
                  b = p.vertex[static_cast<std::size_t>((k + 1) % p.corners)];
        return {std::min(a, b), std::max(a, b)};
    }
    int add_vertex(VectorDouble const& at) {
        to_.mesh.position.push_back(at);
        return static_cast<int>(to_.mesh.position.size()) - 1;
    }
    VectorDouble const& at(int vertex) const { return from_.mesh.position[static_cast<std::size_t>(vertex)]; }
    int middle_of(Edge const& e) {
        auto const [place, is_new] = middle_.try_emplace(e, -1);
        if (is_new) place->second = add_vertex((at(e.first) + at(e.second)) / 2);
        return place->second;
    }

    // The vertex numbers of a patch's corners, middles and centre; `other`: of a patch that runs the other way round.
    std::array<int, 9> numbers(Patch const& p, bool other, bool with_centre) {
        std::array<int, 9> n{};
        auto const corner = [&](int k) {
            int const turned = other ? p.corners - 1 - k % p.corners : k % p.corners;
            return p.vertex[static_cast<std::size_t>(turned)];
        };
        for (int k = 0; k < p.corners; ++k) {
            n[static_cast<std::size_t>(k)] = corner(k);
            auto const known = middle_.find({std::min(corner(k), corner(k + 1)), std::max(corner(k), corner(k + 1))});
            n[static_cast<std::size_t>(middle(k))] = known == middle_.end() ? -1 : known->second;
        }
        if (with_centre) n[centre] = add_vertex(p.centre);
        return n;
    }

    void add(Patch const& front, std::vector<Part> const& parts) {
        bool const with_centre =
            std::ranges::any_of(parts, [](Part const& p) { return std::ranges::count(p, centre) > 0; });
        std::array<int, 9> const here = numbers(front, false, with_centre);
        Patch const* const back =
            front.opposite >= 0 ? &from_.mesh.patch[static_cast<std::size_t>(front.opposite)] : nullptr;
        std::array<int, 9> const there = back ? numbers(*back, true, with_centre) : here;
        for (Part const& part : parts) {
            int const first = add_part(front, part, here, false, parts.size() == 1);
            if (!back) continue;
            int const second = add_part(*back, part, there, true, parts.size() == 1);
            to_.mesh.patch[static_cast<std::size_t>(first)].opposite = second;
            to_.mesh.patch[static_cast<std::size_t>(second)].opposite = first;
        }
    }
    int add_part(Patch const& of, Part const& part, std::array<int, 9> const& number, bool turned, bool whole) {
        Patch p = of;
        p.opposite = -1;
        to_.parent.push_back(from_.parent[static_cast<std::size_t>(&of - from_.mesh.patch.data())]);
        if (whole) {
            to_.mesh.patch.push_back(p);
            return static_cast<int>(to_.mesh.patch.size()) - 1;
        }
        p.corners = static_cast<int>(part.size());
        for (std::size_t k = 0; k < 4; ++k)
            p.vertex[k] = number[static_cast<std::size_t>(part[std::min(k, part.size() - 1)])];
        if (turned) std::reverse(p.vertex.begin(), p.vertex.begin() + p.corners);
        p.doubtful = of.open_points >= 0;
        p.open_points = -1;
        if (p.doubtful) p.open = 1;
        measure(to_.mesh, p);
        to_.mesh.patch.push_back(p);
        return static_cast<int>(to_.mesh.patch.size()) - 1;
    }

    Elements const& from_;
    Elements to_;
    std::map<Edge, int> middle_;
};

}  // namespace

Elements whole_patches(PatchMesh const& mesh) {
    Elements elements{mesh, std::vector<int>(mesh.patch.size())};
    std::iota(elements.parent.begin(), elements.parent.end(), 0);
    return elements;
}

Elements split(Elements const& elements, std::vector<char> const& flagged) { return Splitter(elements).split(flagged); }

std::vector<char> varying(Elements const& elements, Spectra const& b, double contrast) {
    Spectra const total = b.rowwise().sum();
    Spectra const at = to_vertices(elements.mesh, total);
    constexpr double dark = 0.05;  // of the scene's mean: below, nobody sees a difference
    double const floor = dark * total.mean();
    std::vector<char> flagged;
    for (std::size_t i = 0; i < elements.mesh.patch.size(); ++i) {
        Patch const& p = elements.mesh.patch[i];
        double low = at(p.vertex[0], 0), high = low;
        for (std::size_t k = 1; k < static_cast<std::size_t>(p.corners); ++k) {
            low = std::min(low, at(p.vertex[k], 0));
            high = std::max(high, at(p.vertex[k], 0));
        }
        flagged.push_back(high - low > contrast * std::max(total(static_cast<Eigen::Index>(i), 0), floor));
    }
    return flagged;
}

FormFactors factors_of_patches(System const& system, Elements const& elements, FormFactors const& of_elements) {
    FormFactors to_patch(system.patches(), of_elements.rows());
    Eigen::ArrayXd area = Eigen::ArrayXd::Zero(system.patches());
    for (std::size_t s = 0; s < elements.parent.size(); ++s)
        area[elements.parent[s]] += elements.mesh.patch[s].open_area();
    std::vector<Eigen::Triplet<double>> shares;
    for (std::size_t s = 0; s < elements.parent.size(); ++s)
        shares.emplace_back(elements.parent[s], static_cast<int>(s),
                            elements.mesh.patch[s].open_area() / std::max(area[elements.parent[s]], 1e-300));
    to_patch.setFromTriplets(shares.begin(), shares.end());
    return to_patch * of_elements;
}

Spectra radiosity_of_elements(System const& system, Elements const& elements, FormFactors const& of_elements,
                              Spectra const& b) {
    Spectra result = (of_elements * b.matrix()).array();
    for (Eigen::Index s = 0; s < result.rows(); ++s) {
        int const i = elements.parent[static_cast<std::size_t>(s)];
        result.row(s) = system.emission.row(i) + system.reflectance.row(i) * result.row(s);
    }
    return result;
}

}  // namespace iride::radiosity
