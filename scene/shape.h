// SPDX-License-Identifier: Apache-2.0
// Shapes as the scene describes them, in world coordinates (or those of their object) and metres.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <variant>

#include "materials/relief.h"
#include "scene/mesh.h"

namespace iride {

struct Sphere {
    Vector centre;
    float radius;
};

// Four corners of a plane in order; two triangles (0 1 2) (0 2 3). Front: where they run counter-clockwise.
struct Quad {
    std::array<Vector, 4> corner;
    Direction normal;

    static Quad through(std::array<Vector, 4> const& c) { return {c, (c[2] - c[0]).cross(c[3] - c[1]).normalized()}; }
    float area() const { return 0.5f * (corner[2] - corner[0]).cross(corner[3] - corner[1]).norm(); }
    // Sides at right angles, opposite ones equal, to a part in 1e5: what the solid-angle sampling of rectangles wants.
    bool is_rectangle() const;
};

struct Disc {
    Vector centre;
    Direction normal;
    float radius;
};

// A cone's frustum without lids (discs make those), outward normals; equal radii make a cylinder.
struct Frustum {
    Vector from, to;
    float radius, top_radius;
    float length() const { return (to - from).norm(); }
    float area() const;  // of the side
};

struct MeshShape {
    std::shared_ptr<Mesh const> mesh;
    bool smooth;
};

using ShapeGeometry = std::variant<Sphere, Quad, Disc, Frustum, MeshShape>;

struct Shape {
    ShapeGeometry geometry;
    int material = 0;      // index into Scene::materials
    int light = -1;        // index into Scene::lights, or -1
    bool flipped = false;  // front and back exchanged

    // What its material asks of the intersector; owned by the scene.
    bool parametrised = false;         // uv, derivatives and tangent
    Relief const* relief = nullptr;    // turns the shading normal
    ScalarMap const* alpha = nullptr;  // the share of rays that meet the surface, the others pass

    std::string name = {};  // the scene file's; empty: none
};

}  // namespace iride
