#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Compares the coarser levels of a tile set with its finest tiles.

    levels.py BIN_DIR SITE.proset FOLDER [--view front|top|...] [--shadows]

Each level is rendered in parallel projection at the scale where the error of its merged tiles is one pixel. Prints FLIP
(flip.sh in this folder; FLIP names its command) of pictures in the studio, and the share of pixels with a different
silhouette: hit in one picture and not in the other, over the pixels hit with the finest tiles.

--shadows: renders all levels from one place above instead, with the sun at 45 degrees in the east, and prints the share of
ground in shadow over the pixels that show ground in both. Ground is at most 1/400 of the picture's width higher than the
lowest point within 1/40 of it.

Keeps pictures in FOLDER and prints a table. Needs numpy, OpenEXR and Pillow.
"""
import argparse
import json
import os
import pathlib
import subprocess
import sys

import numpy as np

HERE = pathlib.Path(__file__).parent
sys.path.insert(0, str(HERE.parent / "light"))
import pictures  # noqa: E402

SHADOW_PIXELS = 1024
FINE_ENOUGH = 1.001  # so that rounding does not select a finer level
SOFT = 0.5  # share of the sun's light from which a pixel counts as lit


def left_out(tiles):
    """Largest error of the merged tiles of each level from 1 on, in input units."""
    most = {}
    for tile in tiles:
        if tile["error"] > 0:
            most[tile["level"]] = max(most.get(tile["level"], 0), tile["error"], tile["spacing"])
    return dict(sorted(most.items()))


class Viewer:
    def __init__(self, options):
        self.options = options
        self.tiles = 0

    def render(self, scene, output, *words):
        stats = self.options.folder / "stats.json"
        command = [self.options.bin / "pointrt-view", "-q", scene, "-o", output, "--stats", stats, *words]
        subprocess.run([str(word) for word in command], check=True)
        self.tiles = json.loads(stats.read_text())["sets"]["tiles"]
        return output


def flip(reference, test):
    text = subprocess.run([HERE / "flip.sh", reference, test], check=True, capture_output=True, text=True).stdout
    return json.loads(text)[0]["mean"]


def hits(path):
    return np.isfinite(pictures.readChannels(path, ["Z"])[:, :, 0])


def compare_level(viewer, level, pixel, height):
    options = viewer.options
    size = max(16, int(height / pixel))
    camera = ["--view", options.view, "--ortho", f"{size * pixel * FINE_ENOUGH:.9g}", "--size", f"{size}x{size}"]
    png, exr, tiles = [], [], []
    for detail in (0, 1):
        name = options.folder / f"level{level}.detail{detail}"
        words = camera + ["--detail", detail]
        png.append(viewer.render(options.set, f"{name}.png", *words, "--spp", 16, "--denoise", "off"))
        exr.append(viewer.render(options.set, f"{name}.exr", *words, "--spp", 1, "--integrator", "normal"))
        tiles.append(viewer.tiles)
    fine, coarse = map(hits, exr)
    outline = np.count_nonzero(fine != coarse) / np.count_nonzero(fine)
    area = np.count_nonzero(coarse) / np.count_nonzero(fine) - 1
    print(f"| {level} | {pixel:.3g} | {size} | {tiles[0]}, {tiles[1]} | {flip(*png):.4f} | {outline:.2%} | {area:+.2%} |",
          flush=True)


def compare_levels(viewer, tiles, bounds):
    height = np.linalg.norm(np.subtract(bounds["max"], bounds["min"]))
    print("| level | pixel | picture | tiles: finest, chosen | FLIP | outline | area |\n|---|---|---|---|---|---|---|")
    for level, pixel in left_out(tiles).items():
        compare_level(viewer, level, pixel, height)


def sunny_scene(options, bounds, shadows):
    low, high = np.array(bounds["min"]), np.array(bounds["max"])
    middle, height = (low + high) / 2, max(high[:2] - low[:2])
    eye = [middle[0], middle[1], high[2] + height]
    path = options.folder / f"sun.{shadows}.toml"
    path.write_text(f"""up = [0, 0, 1]
[camera]
eye = {[float(x) for x in eye]}
target = {[float(x) for x in middle]}
up = [0, 1, 0]
ortho = {float(height)}
[render]
shadows = {shadows}
size = [{SHADOW_PIXELS}, {SHADOW_PIXELS}]
spp = 4
[[light]]
type = "sun"
towards = [1, 0, 1]
irradiance = 3
[[instance]]
file = "{os.path.relpath(options.set, options.folder)}"
""")
    return path, height / SHADOW_PIXELS


def lowest_around(heights, reach):
    """The minimum within squares of 2 reach + 1 pixels."""
    for axis in (0, 1):
        padded = np.pad(heights, [(reach, reach) if a == axis else (0, 0) for a in (0, 1)], constant_values=np.inf)
        windows = np.lib.stride_tricks.sliding_window_view(padded, 2 * reach + 1, axis=axis)
        heights = windows.min(axis=-1)
    return heights


def sunlit(viewer, scenes, name, detail):
    """Heights, and the share of the sun's light that reaches them."""
    light = []
    for scene, word in zip(scenes, ("shadowed", "open")):
        path = viewer.render(scene, viewer.options.folder / f"{name}.{word}.exr", "--detail", detail)
        light.append(pictures.readLight(path, "direct.").sum(axis=2))
    heights = pictures.readChannels(path, ["P.Z"])[:, :, 0]
    return heights, np.divide(light[0], light[1], out=np.ones_like(light[0]), where=light[1] > 0)


def compare_shadows(viewer, tiles, bounds):
    made = [sunny_scene(viewer.options, bounds, word) for word in ("true", "false")]
    scenes, pixel = [scene for scene, _ in made], made[0][1]
    print("| level | tiles | ground in shadow, finest | level | change |\n|---|---|---|---|---|")
    details = {0: 0} | {level: most / pixel * FINE_ENOUGH for level, most in left_out(tiles).items()}
    fine = None
    for level, detail in details.items():
        heights, share = sunlit(viewer, scenes, f"shadow{level}", min(detail, 16384))
        heights = np.where(np.isfinite(heights), heights, np.inf)
        with np.errstate(invalid="ignore"):
            above = heights - lowest_around(heights, SHADOW_PIXELS // 80)
        ground = np.isfinite(heights) & (above <= pixel * SHADOW_PIXELS / 400)
        pictures.writePng(viewer.options.folder / f"shadow{level}.png",
                          np.stack([share, share, np.where(ground, share, 1)], axis=2))
        fine = fine or (ground, share)
        both = ground & fine[0]
        shares = [np.count_nonzero(each[both] < SOFT) / np.count_nonzero(both) for each in (fine[1], share)]
        print(f"| {level} | {viewer.tiles} | {shares[0]:.2%} | {shares[1]:.2%} | {shares[1] / shares[0] - 1:+.1%} |",
              flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bin", type=pathlib.Path)
    parser.add_argument("set", type=pathlib.Path)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--view", default="front")
    parser.add_argument("--shadows", action="store_true")
    options = parser.parse_args()
    options.folder.mkdir(parents=True, exist_ok=True)
    content = json.loads((options.set / "set.json").read_text())
    compare = compare_shadows if options.shadows else compare_levels
    compare(Viewer(options), content["tiles"], content["bounds"])


if __name__ == "__main__":
    main()
