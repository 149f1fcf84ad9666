#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Write the pictures of data/scenes/textures, all periodic:

    mosaic.png   128 x 128, sRGB: stones of random colours with dark joints (Voronoi cells of 40 points)
    stones.png   128 x 128, grey: their height, a dome on each
    studs.png    64 x 64, normals (2 rgb - 1, +y up): a round stud
    grains.png   128 x 128, grey: smooth noise, for roughness and weights
    lattice.png  64 x 64, grey: bars with holes between, smooth at their edges
"""
import math
import pathlib
import random
import struct
import zlib

FOLDER = pathlib.Path(__file__).resolve().parent.parent / "data" / "scenes" / "textures"


def write_png(name, size, channels, texel):
    """texel(x, y): one number, or three, of 0 .. 1; row 0 is the top."""
    rows = bytearray()
    for y in range(size):
        rows.append(0)
        for x in range(size):
            value = texel(x, y)
            for v in value if channels == 3 else (value,):
                rows.append(max(0, min(255, round(255 * v))))

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    head = struct.pack(">IIBBBBB", size, size, 8, 2 if channels == 3 else 0, 0, 0, 0)
    data = chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(bytes(rows), 9)) + chunk(b"IEND", b"")
    (FOLDER / name).write_bytes(b"\x89PNG\r\n\x1a\n" + data)


def stones(size, count, chance):
    """Per texel (stone, distance to the joint); points of a jittered periodic grid."""
    points = [(chance.random() * size, chance.random() * size) for _ in range(count)]
    field = {}
    for y in range(size):
        for x in range(size):
            near = sorted(
                (min(abs(x - px), size - abs(x - px)) ** 2 + min(abs(y - py), size - abs(y - py)) ** 2, i)
                for i, (px, py) in enumerate(points))[:2]
            field[x, y] = near[0][1], math.sqrt(near[1][0]) - math.sqrt(near[0][0])
    return field


def smooth_noise(size, cells, chance):
    """Random values at cells x cells places, cosines between; periodic."""
    value = [[chance.random() for _ in range(cells)] for _ in range(cells)]

    def at(x, y):
        u, v = x * cells / size, y * cells / size
        i, j = int(u), int(v)
        s, t = (1 - math.cos(math.pi * (u - i))) / 2, (1 - math.cos(math.pi * (v - j))) / 2
        i1, j1 = (i + 1) % cells, (j + 1) % cells
        return ((value[j][i] * (1 - s) + value[j][i1] * s) * (1 - t) + (value[j1][i] * (1 - s) + value[j1][i1] * s) * t)

    return at


def main():
    FOLDER.mkdir(exist_ok=True)
    chance = random.Random(4)
    field = stones(128, 40, chance)
    palette = [(.78, .35, .22), (.86, .72, .42), (.25, .42, .55), (.55, .62, .35), (.72, .66, .6), (.35, .25, .3)]
    colours = [tuple(min(1, c * chance.uniform(.85, 1.15)) for c in chance.choice(palette)) for _ in range(40)]

    def joint(x, y):
        return max(0, min(1, (field[x, y][1] - 1) / 3))

    write_png("mosaic.png", 128, 3, lambda x, y: tuple(.18 + (c - .18) * joint(x, y) for c in colours[field[x, y][0]]))
    write_png("stones.png", 128, 1, lambda x, y: 1 - (1 - min(1, field[x, y][1] / 10)) ** 2)

    def stud(x, y):
        u, v = (x + .5) / 32 - 1, 1 - (y + .5) / 32
        r = math.hypot(u, v)
        slope = -1.2 * math.sin(math.pi * r / .8) if r < .8 else 0
        nx, ny = (-slope * u / r, -slope * v / r) if r > 0 else (0, 0)
        length = math.sqrt(nx * nx + ny * ny + 1)
        return (nx / length + 1) / 2, (ny / length + 1) / 2, (1 / length + 1) / 2

    write_png("studs.png", 64, 3, stud)
    coarse, fine = smooth_noise(128, 6, chance), smooth_noise(128, 24, chance)
    write_png("grains.png", 128, 1, lambda x, y: max(0, min(1, 1.5 * (.7 * coarse(x, y) + .3 * fine(x, y)) - .25)))

    def lattice(x, y):
        nearest = min(min(x + .5, 63.5 - x), min(y + .5, 63.5 - y), abs(x - y) / math.sqrt(2))
        return max(0, min(1, (7 - nearest) / 2 + .5))

    write_png("lattice.png", 64, 1, lattice)


if __name__ == "__main__":
    main()
