#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Render docs/materials/NAME.png for every entry of scripts/material_pictures.json: a sphere of that material on a chequered
floor under a D65 lamp and sky; and the page of gold by angle. An entry is NAME: MATERIAL, as a scene file has it, or NAME: {"material": ..., "shapes":
[...], "materials": {...}, "sphere": {...}} to add to the scene or to change the sphere.

    scripts/material_pictures.py [PROGRAM] [NAME ...]     all of them, or those named; PROGRAM is build/release/iride
"""
import json
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
FOLDER = ROOT / "docs" / "materials"
SIZE, SAMPLES = 160, 256
TILES, TILE = 5, 1.0  # squares to each side of the middle, and their side


def floor():
    quads = []
    for i in range(-TILES, TILES):
        for j in range(-TILES, TILES):
            x, z = i * TILE, j * TILE
            quads.append({"type": "quad", "material": "light tile" if (i + j) % 2 else "dark tile",
                          "corners": [[x, 0, z], [x, 0, z + TILE], [x + TILE, 0, z + TILE], [x + TILE, 0, z]]})
    return quads


def scene(entry):
    if "material" not in entry:
        entry = {"material": entry}
    lamp = {"type": "quad", "material": "lamp", "corners": [[2.5, 5, -2], [2.5, 5, 0], [0.5, 5, 0], [0.5, 5, -2]],
            "emission": {"radiance": {"data": "D65", "luminance_weighted": 9}}}
    sphere = {"type": "sphere", "material": "shown", "centre": [0, 1, 0], "radius": 1, **entry.get("sphere", {})}
    return {
        "camera": {"eye": [0, 2.3, -5.2], "target": [0, 0.92, 0], "up": [0, 1, 0], "field_deg": 29},
        "film": {"size": [SIZE, SIZE], "filter": "gaussian"},
        "materials": {"light tile": {"type": "diffuse", "reflectance": 0.5}, "dark tile": {"type": "diffuse", "reflectance": 0.12},
                      "lamp": {"type": "black"}, "shown": entry["material"], **entry.get("materials", {})},
        "shapes": [*floor(), lamp, sphere, *entry.get("shapes", [])],
        "lights": [{"type": "environment", "radiance": {"data": "D65", "luminance_weighted": 0.6}}],
    }


def main():
    arguments = sys.argv[1:]
    program = ROOT / "build" / "release" / "iride"
    if arguments and pathlib.Path(arguments[0]).is_file():
        program = pathlib.Path(arguments.pop(0))
    entries = json.loads((ROOT / "scripts" / "material_pictures.json").read_text())
    for name in arguments:
        if name not in entries:
            sys.exit(f"no entry '{name}'; there are: {', '.join(entries)}")
    FOLDER.mkdir(exist_ok=True)
    for name in arguments or entries:
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "scene.json"
            path.write_text(json.dumps(scene(entries[name])))
            subprocess.run([program, "render", path, "-o", pathlib.Path(folder) / "out.exr", "--preview",
                            FOLDER / f"{name}.png", "--spp", str(SAMPLES), "--quiet"], check=True)
        print(name)
    if not arguments:
        subprocess.run([program, "material", "Au", "--plot", FOLDER / "gold-by-angle.png"], check=True, stdout=subprocess.DEVNULL)


if __name__ == "__main__":
    main()
