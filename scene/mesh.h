// SPDX-License-Identifier: Apache-2.0
// A triangle mesh in memory, and the two file formats it may come from.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "base/vector.h"

namespace iride {

struct Mesh {
    std::vector<Vector> position;  // [vertex], in the file's unit
    std::vector<Vector> normal;    // [vertex] unit, or empty
    std::vector<Vector2> uv;       // [vertex], or empty
    std::vector<std::array<std::uint32_t, 3>>
        triangle;  // [triangle] vertex numbers, counter-clockwise seen from the front
};

inline Eigen::AlignedBox3f box_about(std::span<Vector const> points) {
    Eigen::AlignedBox3f box;
    for (Vector const& p : points) box.extend(p);
    return box;
}

// `origin`: the place in the file from which positions count here, taken off before they become floats.
// Read .ply (ascii or binary, either byte order) or .obj; polygons are split into fans, OBJ's separate normal and
// texture indices are joined into vertices. Throws InputError (file, line or byte, what was found) for: a missing,
// empty or truncated file, an unknown extension, NaN or infinite coordinates, indices out of range, no triangle at all,
// more elements announced than the file can hold.
Mesh read_mesh(std::filesystem::path const& path, VectorDouble const& origin = VectorDouble::Zero());

// The same checks on a mesh that came from elsewhere: finite positions, indices in range, at least one triangle.
void check_mesh(Mesh const& mesh, std::filesystem::path const& path);

}  // namespace iride
