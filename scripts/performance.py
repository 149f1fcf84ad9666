#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Print docs/performance.md from what `iride bench --json` and `kernels --benchmark_format=json` have measured:

    scripts/performance.py performance.json kernels.json lanes-1.json lanes-4.json > docs/performance.md

The last two come from builds with other numbers of wavelengths per path.
"""
import json
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent

# Of other renderers, on 2 threads of a 2.8 GHz machine of this class: wall seconds, relMSE against pbrt at 1024 spp,
# thousand paths a second and core. 4 wavelengths a path each.
PEERS = ("pbrt-v4, ZSobol'", "pbrt-v4, independent", "Mitsuba 3.7 scalar_spectral, independent")
PUBLISHED = {
    "cornell": ((19.3, .00212, 113), (12.1, .00354, 179), (6.9, .00271, 313)),
    "cornell-gold": ((20.6, .00659, 108), (12.6, .00883, 177), (9.1, .00624, 234)),
    "metals": ((17.2, .0179, 128), (10.1, .0211, 214), (5.6, .0145, 390)),
    "metals-furnace": ((11.1, .000855, 207), (6.0, .00350, 361), (4.1, .00348, 519)),
    "prism": ((7.6, .0587, 303), (3.5, .0854, 664), None),
    "glass-spheres": ((13.1, .205, 171), (8.0, .223, 264), None),
}


def number(x):
    if x is None:
        return "-"
    if isinstance(x, bool):
        return "yes" if x else "no"
    if isinstance(x, str):
        return x
    return f"{x:.3g}" if abs(x) < 1e5 or isinstance(x, float) else str(x)


def table(heads, rows):
    print("| " + " | ".join(heads) + " |")
    print("|" + "---|" * len(heads))
    for row in rows:
        print("| " + " | ".join(number(x) for x in row) + " |")
    print()


def spread(row, key, least="least", most="most"):
    return f"{row[key]:.3g} ({row[least]:.3g} .. {row[most]:.3g})"


def title(words, text):
    print(f"## {words}\n")
    print(text + "\n")


def peers(rows):
    title("Beside other renderers",
          "256 x 256 pixels, 64 samples each, 2 threads. relMSE as `iride compare` has it; ours against our references, whose own is left out, theirs, "
          "measured elsewhere on 2 threads of a 2.8 GHz machine of this class, against pbrt at 1024 samples: times of two machines "
          "are for orientation. Ours are medians with the least and the most; 8 wavelengths a path, theirs 4.")
    lines = []
    for row in rows:
        published = PUBLISHED.get(row["scene"])
        lines.append([row["scene"], "iride, " + row["integrator"], spread(row, "seconds", "seconds_least", "seconds_most"),
                      spread(row, "relmse", "relmse_least", "relmse_most"), row["kpaths_per_s_core"], row["seconds_times_relmse"],
                      "1"])
        for name, figures in zip(PEERS, published or ()):
            if figures is None:
                lines.append(["", name, "no dispersion", None, None, None, None])
            else:
                product = figures[0] * figures[1]
                lines.append(["", name, *figures, product, product / row["seconds_times_relmse"]])
    table(["scene", "renderer", "s", "relMSE", "k paths/s/core", "s x relMSE", "against iride"], lines)


def errors(rows):
    title("Error against time",
          "256 x 256 pixels; relMSE and mean CIEDE2000 against the mean of two independent long renders, whose own error (bar) is a "
          "quarter of the relMSE and half of the CIEDE2000 between them; it is left out of the relMSE (bench/README.md). Each sample "
          "count is a render of its own; `slope` is fitted to "
          "log relMSE over log time of sampling where relMSE is more than the bar (-1: independent samples). ~: some of the three times is "
          "extrapolated along that slope; -: not within an hour, or not to be told by this reference.")
    print("![relMSE over time, a panel for each scene](performance.png)\n")
    table(["scene", "integrator", "spp", "s", "relMSE", "bar", "CIEDE2000", "bar", "slope", "s to relMSE .01", "s to .001",
           "s to CIEDE2000 1", ""],
          [[r["scene"], r["integrator"], r["spp"], r["seconds"], r["relmse"], r["reference_relmse"], r["delta_e_2000"],
            r["reference_delta_e"], r["slope"], r["s_to_relmse_1e-2"], r["s_to_relmse_1e-3"], r["s_to_delta_e_1"],
            "~" if r["extrapolated"] else ""] for r in rows])


# Unbiased, and all light.
UNBIASED = ("path", "reference_path", "auto", "bidirectional", "bidirectional-power", "caustic-path", "two-pass")
TARGETS = ("s_to_relmse_1e-2", "s_to_relmse_1e-3")


def automatic(rows):
    title("The default integrator: auto",
          "Seconds to relMSE .01 and .001, setup and all, from the table above: `auto`, how many times sooner than `path` that is, and the best other "
          "unbiased integrator with its time over that of `auto`. Only what was measured or lies on the method's own slope.")
    lines = []
    for scene in dict.fromkeys(r["scene"] for r in rows):
        of = {r["integrator"]: r for r in rows if r["scene"] == scene and r["integrator"] in UNBIASED}
        line = [scene]
        for key in TARGETS:
            auto, path = of["auto"][key], of["path"][key]
            others = [(r[key], name) for name, r in of.items() if name != "auto" and r[key] is not None]
            best = min(others, default=(None, "-"))
            line += [auto, path / auto if auto and path else None,
                     f"{best[1]}, {best[0] / auto:.2f}" if auto and best[0] else "-"]
        lines.append(line)
    table(["scene", "s to .01", "sooner than path", "best other", "s to .001", "sooner than path", "best other"], lines)


def adaptive(rows):
    title("Adaptive samples",
          "`path` with `--error de=2`: until 99 % of the pixels are expected to be within CIEDE2000 2. The mean CIEDE2000 is against the reference, and "
          "holds that of the reference itself.")
    table(["scene", "samples", "s", "mean spp", "relMSE", "CIEDE2000", "bar"],
          [[r["scene"], r["samples"], spread(r, "seconds"), r["mean_spp"], r["relmse"], r["mean_delta_e"], r["reference_delta_e"]]
           for r in rows])


def lanes(files):
    title("Wavelengths per path",
          "Builds with `-DIRIDE_LANES=n`, one thread, 64 samples. Noise: relative variance of one sample, mean over pixels, of Y and of "
          "colour (X and Z where Y is known). Wavelengths alone: mean of X, Y and Z on `checker`, "
          "where light varies by nothing else, in the median pixel; predicted from the packets' densities by quadrature.")
    rows = [r for f in files for r in json.loads(pathlib.Path(f).read_text())["lanes"]]
    rows.sort(key=lambda r: (r["scene"], r["lanes"]))
    table(["scene", "lanes", "us per path", "relMSE", "noise of Y", "of colour", "wavelengths alone", "predicted"],
          [[r["scene"], r["lanes"], r["us_per_path"], r["relmse"], r["luminance_noise"], r["colour_noise"], r["packet_noise"],
            r["packet_noise_predicted"]] for r in rows])


def rates(words, text, rows, keys):
    title(words, text)
    table([k.replace("_", " ") for k in keys] + ["paths/s"],
          [[r[k] for k in keys] + [spread(r, "paths_per_second")] for r in rows])


def rays(rows):
    title("Near the limit: bare Embree",
          "One thread; rays per second of the render against a loop that traces the same rays in their order and does nothing else.")
    table(["scene", "rays/s", "bare rays/s", "ratio", "paths/s"],
          [[r["scene"], r["rays_per_second"], r["bare_rays_per_second"], spread(r, "ratio"), r["paths_per_second"]] for r in rows])


def plan(rows):
    title("What the plan saves",
          "One thread, 8 samples: time without a decision over time with it, in turns (1.00: it saves nothing on this scene); the noise "
          "likewise; and how far the pictures are apart (relMSE; 0: bit by bit the same). `--plan-disable NAME` does it.")
    table(["scene", "without", "then", "time", "noise", "apart"],
          [[r["scene"], r["without"], r["instead"], spread(r, "time_ratio"), r["noise_ratio"], r["relmse_apart"]] for r in rows])


def kernels(path):
    title("Kernels", "Google Benchmark, one thread (`bench/kernels.cpp`).")
    found = json.loads(pathlib.Path(path).read_text())
    table(["kernel", "time", "unit"], [[b["name"], b["real_time"], b["time_unit"]] for b in found["benchmarks"]])


def main():
    found = json.loads(pathlib.Path(sys.argv[1]).read_text())
    commit = subprocess.run(["git", "describe", "--always", "--dirty", "--exclude=*"], cwd=ROOT, capture_output=True, text=True,
                            check=True).stdout.strip()
    print("# Performance\n")
    print("Written by `scripts/performance` from `iride bench`; the method is in `bench/README.md`. Medians of "
          f"{found['rounds']} rounds with the least and the most.\n")
    print(f"Processor: {found['processor']}, {found['processors']} threads. Commit: {commit}.\n")
    peers(found["peers"])
    errors(found["error"])
    automatic(found["error"])
    adaptive(found["adaptive"])
    lanes([sys.argv[1], *sys.argv[3:]])
    rays(found["rays"])
    plan(found["plan"])
    rates("Threads", "16 samples a pixel.", found["threads"], ["scene", "threads", "against_one"])
    rates("Samples", "The more of them, the less a pixel's start weighs.", found["spp"], ["scene", "spp"])
    rates("Pixels", "4 samples each.", found["resolution"], ["scene", "width", "height"])
    rates("Triangles", "A wavy ball that fills the picture, all threads; memory of the mesh itself and of Embree's copy and tree.",
          found["triangles"], ["triangles", "rays_per_second", "build_seconds", "mesh_bytes_per_triangle", "embree_bytes_per_triangle"])
    rates("Lamps", "Point lamps above a floor, 16 samples a pixel; `relative error` is that of the picture's variance.",
          found["lamps"], ["lamps", "relative_error", "load_seconds"])
    title("Start", "From the file to the first sample.")
    table(["scene", "s"], [[r["scene"], spread(r, "seconds")] for r in found["start"]])
    kernels(sys.argv[2])
    print((ROOT / "docs" / "performance_trials.md").read_text().rstrip())


if __name__ == "__main__":
    main()
