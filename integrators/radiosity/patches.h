// SPDX-License-Identifier: Apache-2.0
// A scene cut into patches: planar triangles and quadrilaterals no longer than a wanted size, without T-junctions: an
// edge that two patches of a surface share is cut alike for both. Curved shapes become facets. A surface whose back
// light may reach gets patches there too. Area, normal and vertices are of the side that the patch stands for.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "scene/scene.h"

namespace iride::radiosity {

struct Patch {
    std::array<int, 4> vertex;  // counter-clockwise as seen from its side
    int corners;                // 3 or 4
    int shape;                  // index into PatchMesh::shape
    bool back;                  // of the shape
    int opposite;               // the patch on its other side, or -1
    VectorDouble centre, normal;
    double area;           // m^2, of what lies open; of a patch that lies against others altogether, its own
    double open = 1;       // share of its own area, exposure.h
    int open_points = -1;  // index into PatchMesh::open_points, where 0 < open < 1
    bool doubtful = true;  // whether `open` is still to be found
    double open_area() const { return open > 0 ? area : 0; }
};

struct PatchMesh {
    std::vector<VectorDouble> position;  // [vertex], m; sides and shapes share none
    std::vector<Patch> patch;
    std::vector<Shape const*> shape;
    std::vector<std::vector<VectorDouble>> open_points;  // uniform over what lies open of a patch
    int slivers = 0;                                     // faces without area, left out

    std::vector<VectorDouble> polygon(Patch const& p) const;
};

// Fronts only, from the shapes' areas: within a factor of two.
double expected_patches(Scene const& scene, double size_m);

// Of all shapes, m^2. Both throw InputError for a scene without surfaces.
double area_of_fronts(Scene const& scene);
PatchMesh make_patches(Scene const& scene, double size_m);

// The middle of a patch as a point of its shape.
SurfacePoint front_point(Patch const& p);

// Normal, centre and area of a patch from its vertices.
void measure(PatchMesh const& mesh, Patch& p);

// Where a ray first meets a patch.
struct PatchHit {
    int patch;       // on the side met; -1: a side that light cannot reach
    int other_side;  // likewise
    VectorDouble position;
};

struct PatchQuery {
    Ray const* ray;
    PatchHit hit = {-1, -1, {}};  // where nothing is met: no patch
};

// Rays among patches. Points lie on patches; what is traced starts `clearance` off the patch, on its side.
class PatchTracer {
  public:
    // Drawn in by half the clearance: where bodies touch, a ray inside of one meets that and not the other's front.
    enum class Fronts { exact, drawn_in };
    explicit PatchTracer(PatchMesh const& mesh, Fronts fronts = Fronts::exact);
    double clearance() const { return clearance_; }  // m
    std::optional<PatchHit> closest(VectorDouble const& from, VectorDouble const& side,
                                    VectorDouble const& direction) const;
    // The same for a ray that starts in the open.
    std::optional<PatchHit> closest(Ray const& ray) const;
    // The same for many.
    void closest(std::span<PatchQuery> queries, Accelerator::Coherence coherence, RayStatistics& statistics) const;
    // Whether nothing stands between points of two patches.
    bool visible(VectorDouble const& from, VectorDouble const& side, VectorDouble const& to,
                 VectorDouble const& other_side) const;

  private:
    PatchHit patch_met(Ray const& ray, Hit const& hit) const;

    std::vector<std::array<int, 2>> sides_;  // [triangle] patch of its front and back
    std::vector<Shape> shapes_;
    std::unique_ptr<Accelerator> accelerator_;
    double clearance_;
};

}  // namespace iride::radiosity
