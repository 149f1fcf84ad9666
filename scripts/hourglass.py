#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Write data/scenes/meshes/hourglass.ply: the surface of revolution about y with the profile

    radius = sin t (.9 |cos t| + .1),  height = cos t,  0 <= t <= pi

after [Picardello 2022, ch. 19], with normals across the profile's tangent. The neck at t = pi/2 is a crease: its circle
is there twice, with the normal of either half. 96 steps along, 96 around; binary little-endian PLY of floats.
"""
import math
import pathlib
import struct

STEPS = 96


def profile(t, half):
    """(radius, height) and the outward normal (radial, axial) of one half: +1 above the neck, -1 below."""
    s, c = math.sin(t), math.cos(t)
    factor = 0.9 * half * c + 0.1
    slope = c * factor - 0.9 * half * s * s  # d radius / dt; d height / dt = -s
    length = math.hypot(s, slope)
    return (s * factor, c), (s / length, slope / length)


def mesh():
    vertices, triangles = [], []
    for half in (1, -1):
        first = 0 if half == 1 else STEPS // 2
        begin = len(vertices)
        for i in range(STEPS // 2 + 1):
            t = math.pi * (first + i) / STEPS
            (radius, height), (radial, axial) = profile(t, half)
            for j in range(STEPS):
                phi = 2 * math.pi * j / STEPS
                c, s = math.cos(phi), math.sin(phi)
                vertices.append((radius * c, height, radius * s, radial * c, axial, radial * s))
        for i in range(STEPS // 2):
            for j in range(STEPS):
                a, b = begin + i * STEPS + j, begin + i * STEPS + (j + 1) % STEPS
                if first + i > 0:  # no triangle of two equal corners at the poles
                    triangles.append((a, b, b + STEPS))
                if first + i < STEPS - 1:
                    triangles.append((a, b + STEPS, a + STEPS))
    return vertices, triangles


def main():
    vertices, triangles = mesh()
    header = ["ply", "format binary_little_endian 1.0", "comment SPDX-License-Identifier: Apache-2.0",
              "comment written by scripts/hourglass.py", f"element vertex {len(vertices)}"]
    header += [f"property float {name}" for name in ("x", "y", "z", "nx", "ny", "nz")]
    header += [f"element face {len(triangles)}", "property list uchar int vertex_indices", "end_header", ""]
    path = pathlib.Path(__file__).resolve().parent.parent / "data" / "scenes" / "meshes" / "hourglass.ply"
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes("\n".join(header).encode() + b"".join(struct.pack("<6f", *v) for v in vertices) +
                     b"".join(struct.pack("<B3i", 3, *t) for t in triangles))
    print(f"{path.name}: {len(vertices)} vertices, {len(triangles)} triangles")


if __name__ == "__main__":
    main()
