// SPDX-License-Identifier: Apache-2.0
#include "integrators/radiosity/last_gather.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "integrators/radiosity/exposure.h"
#include "integrators/radiosity/memory.h"
#include "integrators/radiosity/substructure.h"
#include "integrators/radiosity/vertex_transfer.h"

namespace iride::radiosity {

namespace {

constexpr int levels = 4;           // an element is split so many times at most
constexpr double tolerance = 0.02;  // of all that is reflected there, by what an element's middle may be off ...
constexpr double few_pixels = 4;    // ... that fills so many; more, the fewer it fills
constexpr double dark = 0.02;       // of the scene's mean: below, nobody sees a difference
constexpr double parts = 5;         // that a split adds, with those of neighbours that are cut

using Values = RadiosityField::AtVertex;
using Value = LampLight::Spectrum;

struct Corner {
    std::size_t element;
    int number;
};

// Each vertex's corners of elements that lie open, and how many pixels it fills.
struct VertexUse {
    std::vector<Corner> corners;
    double pixels = 0;
};
std::vector<VertexUse> uses_of_vertices(PatchMesh const& mesh, std::vector<int> const& seen) {
    std::vector<VertexUse> uses(mesh.position.size());
    for (std::size_t i = 0; i < mesh.patch.size(); ++i) {
        Patch const& p = mesh.patch[i];
        for (int k = 0; p.open > 0 && k < p.corners; ++k) {
            VertexUse& use = uses[static_cast<std::size_t>(p.vertex[static_cast<std::size_t>(k)])];
            use.corners.push_back({i, k});
            use.pixels += static_cast<double>(seen[i]) / p.corners;
        }
    }
    return uses;
}

// A little inside of the element: at an edge it would be chance whether a ray meets what stands there.
VectorDouble place_of(PatchMesh const& mesh, Corner const& c) {
    constexpr double inwards = 0.01;
    Patch const& p = mesh.patch[c.element];
    VectorDouble const& corner = mesh.position[static_cast<std::size_t>(p.vertex[static_cast<std::size_t>(c.number)])];
    return p.open_points < 0 ? VectorDouble(corner + inwards * (p.centre - corner)) : open_point_by(mesh, p, corner);
}

class Gathering {
  public:
    Gathering(Solved const& solved, LampLight const& lamps, LastGather const& settings)
        : tracer_(solved.tracer),
          lamps_(lamps),
          settings_(settings),
          reflectance_(solved.reflectance.cast<float>()),
          reflected_(solved.reflected.cast<float>()),
          indirect_(solved.indirect.cast<float>()),
          dark_(dark * solved.indirect.rowwise().sum().mean()),
          elements_(whole_patches(solved.mesh)),
          at_vertex_(to_vertices(solved.mesh, solved.indirect).max(0.0).cast<float>()) {
        for (Patch const& p : solved.mesh.patch) {
            width_.push_back(p.open > 0 ? std::sqrt(p.area / p.open) : 0);
            normal_.push_back(p.normal);
        }
    }

    void refine(Seen const& seen_in, std::vector<std::string>& remarks) {
        // Vertices below these numbers have their values; elements with only such vertices were found to be fine.
        std::size_t known = 0, fine = 0;
        for (int level = 0;; ++level) {
            PatchMesh const& mesh = elements_.mesh;
            std::vector<int> const seen =
                level == 0 ? seen_in(tracer_, mesh.patch.size()) : seen_in(PatchTracer(mesh), mesh.patch.size());
            gather_at_vertices(seen, known);
            if (level == levels) return;
            std::vector<char> const flagged = not_linear(seen, fine);
            auto const splits = std::ranges::count(flagged, true);
            if (splits == 0) return;
            if (would_take(static_cast<double>(seen.size()) + parts * static_cast<double>(splits)) >
                settings_.memory_bytes) {
                remarks.push_back(
                    fmt::format("radiosity: the last gather ends with {} elements, as many more would take more memory "
                                "than {:.2g} GB: {} of them are coarser than they should be",
                                seen.size(), settings_.memory_bytes * 1e-9, splits));
                return;
            }
            fine = known = mesh.position.size();
            elements_ = split(elements_, flagged);
            find_open_parts(elements_.mesh);
        }
    }

    std::shared_ptr<RadiosityField const> finish(std::vector<double> const& wavelengths_nm) {
        return std::make_shared<RadiosityField>(std::move(elements_.mesh), wavelengths_nm, std::move(at_vertex_));
    }

  private:
    Patch const& element(std::size_t i) const { return elements_.mesh.patch[i]; }

    // Of a vertex, about as many as elements, the spectrum; the rest of the solution is no more.
    double would_take(double elements) const {
        return memory_needed(elements, 0, nullptr, 0) +
               elements * static_cast<double>(reflected_.cols()) * sizeof(float);
    }

    // What is sent on from a place of an element, by rays [first, last) of a series.
    Value sent_on_from(std::size_t i, VectorDouble const& place, std::uint32_t series, int first, int last) const {
        Value arriving = Value::Zero(reflected_.cols()), from_lamp(reflected_.cols());
        VectorDouble const& normal = element(i).normal;
        for (int k = first; k < last; ++k) {
            Sampler sampler(SamplerKind::sobol, 8, series, static_cast<std::uint32_t>(k));
            auto const hit = tracer_.closest(place, normal, way_by_cosine(normal, sampler));
            if (hit && hit->patch >= 0) add_what_is_met(place, *hit, sampler, arriving, from_lamp);
        }
        return reflectance_.row(elements_.parent[i]) * arriving / static_cast<float>(last - first);
    }

    void add_what_is_met(VectorDouble const& from, PatchHit const& hit, Sampler& sampler, Value& arriving,
                         Value& from_lamp) const {
        auto const met = static_cast<std::size_t>(hit.patch);
        if ((hit.position - from).norm() > width_[met]) {
            arriving += reflected_.row(hit.patch);
            return;
        }
        arriving += indirect_.row(hit.patch);
        float const which = sampler.next();
        if (lamps_.ask(hit.position, normal_[met], which, sampler.next2(), from_lamp))
            arriving += reflectance_.row(hit.patch) * from_lamp;
    }

    // A vertex's noise counts as often as pixels see it: the sum is least for a given number of rays if each has them
    // by the root of its pixels.
    int rays_for(double pixels) const {
        constexpr double most_doublings = 1, fewest = -3;
        double const doublings = std::round(std::log2(std::max(pixels, 1e-3) / few_pixels) / 2);
        return std::max(1, static_cast<int>(settings_.rays * std::exp2(std::clamp(doublings, fewest, most_doublings))));
    }

    // At those from `known` on; of whole patches, where somebody looks.
    void gather_at_vertices(std::vector<int> const& seen, std::size_t known) {
        std::vector<VertexUse> const uses = uses_of_vertices(elements_.mesh, seen);
        Eigen::Index const before = at_vertex_.rows(), after = static_cast<Eigen::Index>(uses.size());
        at_vertex_.conservativeResize(after, Eigen::NoChange);
        at_vertex_.bottomRows(after - before).setZero();
        tbb::parallel_for(known, uses.size(), [&](std::size_t v) {
            auto const& [corners, pixels] = uses[v];
            if (corners.empty() || (known == 0 && pixels == 0)) return;
            Value sum = Value::Zero(reflected_.cols());
            auto const count = static_cast<int>(corners.size());
            int const share = std::max(1, rays_for(pixels) / count);
            for (int k = 0; k < count; ++k) {
                Corner const& c = corners[static_cast<std::size_t>(k)];
                sum += sent_on_from(c.element, place_of(elements_.mesh, c), static_cast<std::uint32_t>(v), k * share,
                                    (k + 1) * share);
            }
            at_vertex_.row(static_cast<Eigen::Index>(v)) = sum / static_cast<float>(count);
        });
    }

    // Elements whose middle is off; with fewer rays and more tolerance where they fill few pixels.
    std::vector<char> not_linear(std::vector<int> const& seen, std::size_t fine) const {
        std::vector<char> flagged(seen.size(), false);
        tbb::parallel_for(std::size_t{0}, seen.size(), [&](std::size_t i) {
            Patch const& p = element(i);
            auto const corners = std::span(p.vertex).first(static_cast<std::size_t>(p.corners));
            auto const is_fine = [&](int v) { return static_cast<std::size_t>(v) < fine; };
            if (p.open == 0 || seen[i] == 0 || std::ranges::all_of(corners, is_fine)) return;
            double const share = std::min(1.0, seen[i] / few_pixels);
            auto const series = static_cast<std::uint32_t>(elements_.mesh.position.size() + i);
            Value off = sent_on_from(i, p.centre, series, 0, static_cast<int>(std::ceil(settings_.rays * share / 2)));
            double const reflected =
                static_cast<double>(std::max(off.sum(), reflected_.row(elements_.parent[i]).sum()));
            for (int v : corners) off -= at_vertex_.row(v) / static_cast<float>(p.corners);
            flagged[i] = std::abs(static_cast<double>(off.sum())) > tolerance / share * std::max(reflected, dark_);
        });
        return flagged;
    }

    PatchTracer const& tracer_;
    LampLight const& lamps_;
    LastGather settings_;
    Values const reflectance_, reflected_, indirect_;  // [patch][wavelength]
    std::vector<double> width_;                        // [patch] m
    std::vector<VectorDouble> normal_;                 // likewise
    double dark_;                                      // W m^-2 nm^-1, summed over wavelengths
    Elements elements_;
    Values at_vertex_;
};

}  // namespace

std::shared_ptr<RadiosityField const> gathered_where_seen(Solved const& solved, LampLight const& lamps,
                                                          Seen const& seen_in, LastGather const& settings,
                                                          std::vector<std::string>& remarks) {
    Gathering gathering(solved, lamps, settings);
    gathering.refine(seen_in, remarks);
    return gathering.finish(solved.wavelengths_nm);
}

}  // namespace iride::radiosity
