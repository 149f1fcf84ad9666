// SPDX-License-Identifier: Apache-2.0
// Second vertices that the paths of a block of pixels share. They have the same wavelengths; those that come to
// Lambert's surfaces first and second might have found the second from the first of every other. Path i of the block,
// in k_i parts, finds a place with density k_i V_i g_i / pi over area,
//   g_i = cos_i cos'_i / d_i^2,   V_i: 1 if nothing stands between, else 0,
// so by the balance heuristic the radiance L that a part finds to leave its second vertex brings to path i, of
// reflectance rho_i,
//   rho_i V_i g_i / (sum over j of k_j V_j g_j) L.                                              [Bekaert 2002]
// Noise falls by the number of paths that see the same; no share is more than 1 / k_i, so none is brighter than alone.
// Light paths beside: what they weigh against a part after its second vertex depends on the first by one factor,
// `rivals` here, if both surfaces are flat; those of the same share.
#pragma once

#include "base/constants.h"
#include "integrators/path_walk.h"

namespace iride {

// The first vertices of a batch's paths, block by block.
class FirstVertices {
  public:
    struct Vertex {
        SurfacePoint const* point;
        Direction normal, geometric_normal;  // on the path's side
        Throughput reflectance;
        float parts, rivals;
    };
    // A place that a path has found from its first vertex; normals on the path's side.
    struct Place {
        Vector position;
        Direction normal, geometric_normal;
    };
    using Shares = std::array<float, most_in_block>;

    explicit FirstVertices(std::span<CameraPath const> paths) {
        first_.fill(batch_size);
        for (std::size_t i = 0; i < paths.size(); ++i)
            first_[i] = paths[i].block ? static_cast<std::size_t>(paths[i].block - paths.data()) : i;
    }
    // `here`: what is met there, of Lambert's closures; nothing if it is met from behind.
    void add(std::size_t path, SurfacePoint const& point, Interaction const& here, float parts, float rivals) {
        if (!(here.wo.z() > 0)) return;
        Direction const up(0, 0, 1), normal = here.frame.to_world(up);
        Throughput const reflectance(here.bsdf.evaluate(here.wo, up).value.lane * pi);
        add(path, {&point, normal, here.geometric_normal, reflectance, parts, rivals});
    }
    void add(std::size_t path, Vertex const& v) {
        vertex_[path] = v;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            auto const a = static_cast<Eigen::Index>(axis);
            place_[axis][path] = v.point->position[a];
            normal_[axis][path] = v.normal[a];
        }
        parts_[path] = v.parts;
    }
    bool shares(std::size_t path) const { return parts_[path] > 0; }
    Vertex const& at(std::size_t path) const { return vertex_[path]; }
    std::size_t block_of(std::size_t path) const { return first_[path]; }

    // What share each path of its block has of what leaves a place that `path` has found; false if it has none itself.
    bool share(Scene const& scene, std::size_t path, Place const& place, Shares& shares,
               RayStatistics& statistics) const {
        std::size_t const first = first_[path], own = path - first;
        geometry(first, place, shares);
        hide(scene, first, own, place, shares, statistics);
        if (!(shares[own] > 0)) return false;
        float sum = 0;
        for (std::size_t j = 0; j < most_in_block; ++j) sum += shares[j] * parts_[first + j];
        for (float& one : shares) one /= sum;
        return true;
    }

  private:
    // g, 0 for those who do not share.
    void geometry(std::size_t first, Place const& place, Shares& g) const {
        Vector const p = place.position;
        Direction const n = place.geometric_normal;
        for (std::size_t j = 0; j < most_in_block; ++j) {
            std::size_t const i = first + j;
            float const x = p.x() - place_[0][i], y = p.y() - place_[1][i], z = p.z() - place_[2][i];
            float const leaving = x * normal_[0][i] + y * normal_[1][i] + z * normal_[2][i];
            float const arriving = -(x * n.x() + y * n.y() + z * n.z());
            float const per_square = 1 / (x * x + y * y + z * z);
            bool const shares = leaving > 0 && arriving > 0 && parts_[i] > 0 && first_[i] == first;
            g[j] = shares ? leaving * per_square * (arriving * per_square) : 0;
        }
    }
    // Nothing for those who do not see the place, or see it in a light of its own; `own` sees it.
    void hide(Scene const& scene, std::size_t first, std::size_t own, Place const& place, Shares& g,
              RayStatistics& statistics) const {
        std::array<ShadowQuery, most_in_block> queries;
        std::array<std::size_t, most_in_block> of;
        std::size_t count = 0;
        for (std::size_t j = 0; j < most_in_block; ++j) {
            if (!(g[j] > 0)) continue;
            Vertex const& v = vertex_[first + j];
            Vector const way = place.position - v.point->position;
            float const distance = way.norm();
            Direction const wi = way / distance;
            bool const seen_alike = wi.dot(v.geometric_normal) > 0 && v.rivals == vertex_[first + own].rivals &&
                                    bent_to_viewer(place.normal, place.geometric_normal, -wi) == place.normal;
            if (!seen_alike) {
                g[j] = 0;
            } else if (j != own) {
                queries[count].ray = spawn_shadow_ray(*v.point, wi, distance);
                of[count++] = j;
            }
        }
        if (!(g[own] > 0)) return;
        scene.accelerator->occluded(std::span(queries).first(count), statistics);
        statistics.shared_rays += count;
        for (std::size_t k = 0; k < count; ++k)
            if (queries[k].occluded) g[of[k]] = 0;
    }

    static constexpr std::size_t room = batch_size + most_in_block;  // a block is looked at as if it were full
    std::array<Vertex, batch_size> vertex_;
    std::array<std::array<float, room>, 3> place_{}, normal_{};
    std::array<float, room> parts_{};      // 0: shares nothing
    std::array<std::size_t, room> first_;  // of its block
};

// The second vertices of parts that are followed together, and what leaves them.
template <class Walk>
class SharedVertices {
  public:
    SharedVertices(FirstVertices first, Parts<Walk>& parts) : first_(std::move(first)), parts_(parts) {}

    // Those alive have come to their second vertices: from there on they find what leaves these.
    void begin(Scene const& scene, Alive const& alive, RayStatistics& statistics) {
        alive.for_each([&](std::size_t i) {
            Walk& walk = parts_.walks()[i];
            CameraPath& part = parts_.paths()[i];
            std::size_t const whole = parts_.whole(i);
            if (!walk.arrival.density || !first_.shares(whole) || !is_lambertian(scene, walk)) return;
            SurfacePoint const& point = walk.hit.point;
            if (first_.at(whole).rivals != 0 && !is_flat(point)) return;
            Direction const side = walk.side_of(-part.ray.direction);
            bool const behind = side != point.geometric_normal;
            Found& found = found_[count_];
            FirstVertices::Place const place{point.position, behind ? Direction(-point.normal) : point.normal, side};
            if (!first_.share(scene, whole, place, found.shares, statistics)) return;
            ++count_;
            found.part = i;
            found.before = part.radiance;
            found.of_sample = part.part;
            part.radiance = Radiance();
            part.part = 1;
            walk.state.weight = Throughput(1);
        });
    }
    // They have come to their ends: every path of their blocks has its shares.
    void end() {
        for (Found const& found : std::span(found_).first(count_)) {
            CameraPath& part = parts_.paths()[found.part];
            std::size_t const first = first_.block_of(parts_.whole(found.part));
            for (std::size_t j = 0; j < most_in_block; ++j) {
                if (!(found.shares[j] > 0)) continue;
                brought_[first + j] += first_.at(first + j).reflectance * (part.radiance * found.shares[j]);
                given_up_[first + j] |= !part.complete;
            }
            part.radiance = found.before;
            part.part = found.of_sample;
        }
        count_ = 0;
    }
    void bring(std::span<CameraPath> paths) const {
        for (std::size_t i = 0; i < paths.size(); ++i) {
            paths[i].radiance += brought_[i];
            paths[i].complete &= !given_up_[i];
        }
    }

  private:
    struct Found {
        std::size_t part;
        FirstVertices::Shares shares;
        Radiance before;  // its second vertex
        float of_sample;  // CameraPath::part
    };
    FirstVertices first_;
    Parts<Walk>& parts_;
    std::array<Found, batch_size> found_;
    std::size_t count_ = 0;
    std::array<Radiance, batch_size> brought_{};
    std::array<bool, batch_size> given_up_{};
};

}  // namespace iride
