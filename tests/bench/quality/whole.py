#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Compares the surface of a scan baked to one file with tile sets of more and more tiles.

    whole.py BIN_DIR FOLDER SCAN... [--tiles 1,4,16,64] [--set] [--up X,Y,Z] [--from X,Y,Z] [-- options for pointrt-bake]

Bakes the scans to one file and, by choosing --tile-splats, to sets of about these numbers of original tiles. A set of one
tile has another lattice but no seams: its differences are not due to seams. With --set, it is the reference instead of
the file, as only files use the silhouettes of range grids. A row of the table has

- the share of the file's splats without one in the set within a few steps of the coarser lattice, and of the others, the
  shares with a different normal or radius;
- for a million random lines through the bounding sphere, the shares of first hits (pointrt-rays cast) that differ along the
  ray by more than a fraction of the median radius; a hit and a miss differ by infinity;
- FLIP (flip.sh in this folder; FLIP names its command) from one camera in rooms of mirrors and of matte walls, at
  `--detail 0`; and holes: pixels of three parallel projections where the set has no surface, or one more than 4 radii
  behind the file's in all nine pixels around.

Keeps files from earlier runs. Needs numpy, scipy, OpenEXR and Pillow.
"""
import argparse
import json
import pathlib
import shutil
import subprocess
import sys

import numpy as np
from scipy.spatial import cKDTree

HERE = pathlib.Path(__file__).parent
sys.path.insert(0, str(HERE.parent / "light"))
import pictures  # noqa: E402

RAYS = 1_000_000
APART = (0.01, 0.1, 1.0)  # median radii
STEPS = 4  # of the coarser lattice: positions are rounded in both
POSITION_STEPS = 1 << 21
TURNED = np.cos(np.radians(0.2))  # normals have 12 bits per axis: 0.07 degrees
HOLE_RADII = 4
ROOM_PIXELS, HOLE_PIXELS = 512, 1024
VIEWS = {"x": (1, 0, 0), "y": (0, 1, 0), "iso": (1, 1, 1)}


def run(*command):
    return subprocess.run([str(word) for word in command], check=True, capture_output=True, text=True).stdout


def vector(text):
    return np.array([float(word) for word in text.split(",")])


# --- bakes

def bake(options, output, *words):
    if not output.exists():
        run(options.bin / "pointrt-bake", "-q", *options.scans, "-o", output, *options.bake, *words)
    return output


def planned_tiles(options, splats):
    """The number of original tiles that a set would have."""
    work = options.folder / "plan.proset.work"
    run(options.bin / "pointrt-bake", "-q", *options.scans, "-o", work.with_suffix(""), *options.bake, "--tile-splats",
        splats, "--step", "plan")
    tiles = len(json.loads((work / "plan.json").read_text())["tiles"])
    shutil.rmtree(work)
    return tiles


def tile_splats_for(options, tiles, points):
    """The --tile-splats that gives nearest to this number of tiles."""
    low, high = 1000, max(2000, 2 * points)  # many tiles and one
    middle, best = min(high, max(low, points // tiles)), (high, 1)
    while tiles > 1 and high > 1.1 * low:
        found = planned_tiles(options, middle)
        if abs(found - tiles) < abs(best[1] - tiles):
            best = (middle, found)
        if found == tiles:
            break
        low, high = (middle, high) if found > tiles else (low, middle)
        middle = int((low * high) ** 0.5)
    return best[0]


def bake_set(options, tiles, points):
    output = options.folder / f"tiles{tiles}.proset"
    if output.exists():
        return output
    return bake(options, output, "--tile-splats", tile_splats_for(options, tiles, points))


# --- splats

class Splats:
    """Splats of a .pro file: positions [N,3] in input units, normals [N,3], radii [N]; step of the positions."""

    def __init__(self, path):
        head = np.memmap(path, np.uint8, mode="r")
        f4 = lambda at: float(head[at:at + 4].view("<f4")[0])  # noqa: E731
        f8 = lambda at, n=1: head[at:at + 8 * n].view("<f8").astype(float)  # noqa: E731
        radius_max, radius_step, self.scale = f4(68), f4(72), f8(104)[0]
        self.bounds = f8(112, 3), f8(136, 3)
        self.step = self.scale / POSITION_STEPS
        table = head[512:512 + 64 * int(head[32:36].view("<u4")[0])].reshape(-1, 64)
        row = next(row for row in table if bytes(row[:4]) == b"SPLT")
        offset, length = row[16:32].view("<u8")
        words = np.array(head[int(offset):int(offset + length)].view("<u4").reshape(-1, 4))
        x = words[:, 0] & 0x1fffff
        y = words[:, 0] >> 21 | (words[:, 1] & 0x3ff) << 11
        z = words[:, 1] >> 10 & 0x1fffff
        self.positions = f8(80, 3) + (np.stack([x, y, z], axis=1) + 0.5) * self.step
        self.normals = decode_normals(words[:, 2])
        self.radii = self.scale * radius_max * 2.0 ** -((words[:, 3] >> 24) * radius_step)
        self.radius_step = radius_step

    def keep(self, kept):
        self.positions, self.normals, self.radii = self.positions[kept], self.normals[kept], self.radii[kept]


def decode_normals(words):
    a = 2 * (words & 0xfff) / 4095 - 1
    b = 2 * (words >> 12 & 0xfff) / 4095 - 1
    c = 1 - np.abs(a) - np.abs(b)
    fold = np.maximum(-c, 0)
    a, b = (v - np.where(v >= 0, fold, -fold) for v in (a, b))
    n = np.stack([a, b, c], axis=1)
    return n / np.linalg.norm(n, axis=1, keepdims=True)


def core_splats(folder, content):
    """All original splats of a set, each once."""
    parts = []
    for tile in content["tiles"]:
        if tile["error"] > 0:
            continue
        part = Splats(folder / tile["file"])
        edge = content["lattice"]["edge"] * 2.0 ** tile["level"]
        low = np.array(content["lattice"]["origin"]) + edge * np.array(tile["cell"])
        part.keep(np.all((part.positions >= low) & (part.positions < low + edge), axis=1))
        if len(part.radii) != tile["splats"]:
            sys.exit(f"{folder}/{tile['file']}: {len(part.radii)} splats in its core, not {tile['splats']}")
        parts.append(part)
    return parts


def compare_splats(whole, parts):
    positions, normals, radii = (np.concatenate([getattr(part, name) for part in parts])
                                 for name in ("positions", "normals", "radii"))
    step = max(whole.step, *(part.step for part in parts))
    radius_step = max(whole.radius_step, *(part.radius_step for part in parts))
    distances, nearest = cKDTree(positions).query(whole.positions, workers=-1)
    there = distances <= STEPS * step
    nearest = nearest[there]
    cosines = np.abs(np.sum(whole.normals[there] * normals[nearest], axis=1))
    octaves = np.abs(np.log2(whole.radii[there] / radii[nearest]))
    return {"more": len(radii) / len(whole.radii) - 1, "elsewhere": np.mean(~there), "turned": np.mean(cosines < TURNED),
            "wide": np.mean(octaves > 1.01 * radius_step), "octaves": np.mean(octaves)}


# --- rays

def random_lines(middle, radius, count):
    """[count,6] rays in random directions through random points of the sphere's disc, from a diameter in front of it."""
    random = np.random.default_rng(1)
    directions = random.normal(size=(count, 3))
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    through = random.normal(size=(count, 3))
    through -= directions * np.sum(through * directions, axis=1, keepdims=True)
    through *= radius * np.sqrt(random.uniform(size=(count, 1))) / np.linalg.norm(through, axis=1, keepdims=True)
    return np.concatenate([middle + through - 2 * radius * directions, directions], axis=1)


def cast(options, scene, rays):
    output = scene.with_suffix(".hits.npz")
    if not output.exists():
        run(options.bin / "pointrt-rays", "cast", scene, "--rays", rays, "-o", output, "--memory", options.memory)
    return np.load(output)["t_hit"]


def apart(whole, other):
    """Distance between hits along their rays: 0 if both miss, infinity if one does."""
    both = np.isfinite(whole) & np.isfinite(other)
    distances = np.where(np.isfinite(whole) == np.isfinite(other), 0.0, np.inf)
    distances[both] = np.abs(whole[both] - other[both])
    return distances


# --- pictures

def camera_words(bounds, direction, up, ortho):
    low, high = bounds
    middle, size = (low + high) / 2, np.linalg.norm(high - low)
    direction = direction / np.linalg.norm(direction)
    away = size if ortho else 1.1 * size  # for 40 degrees
    as_text = lambda v: ",".join(f"{x:.17g}" for x in v)  # noqa: E731
    words = ["--eye", as_text(middle + away * direction), "--target", as_text(middle), "--up", as_text(up)]
    return words + (["--ortho", f"{size:.17g}"] if ortho else [])


def render(options, scene, name, *words):
    output = options.folder / f"{scene.stem}.{name}"
    if not output.exists():
        detail = ["--detail", 0, "--memory", options.memory] if scene.suffix == ".proset" else []
        run(options.bin / "pointrt-view", "-q", scene, "-o", output, *detail, *words)
    return output


def room_picture(options, scene, room, bounds):
    size = ["--size", f"{ROOM_PIXELS}x{ROOM_PIXELS}", "--spp", 4, "--denoise", "off"]
    words = camera_words(bounds, options.direction, options.up, False)
    return render(options, scene, f"{room}.png", "--room", room, "--lights", 4, "--bounces", 10, *size, *words)


def flip(reference, test):
    return json.loads(run(HERE / "flip.sh", reference, test))[0]["mean"]


def depths(options, scene, view, bounds):
    up = options.up if abs(np.dot(VIEWS[view], options.up)) < 0.9 else np.roll(options.up, 1)
    words = camera_words(bounds, np.array(VIEWS[view], float), up, True)
    size = ["--size", f"{HOLE_PIXELS}x{HOLE_PIXELS}", "--spp", 1, "--integrator", "normal"]
    return pictures.readChannels(render(options, scene, f"{view}.exr", *size, *words), ["Z"])[:, :, 0]


def holes(whole, other, reach):
    """Pixels of other [H,W] deeper by reach than all pixels of whole around them, where that has no holes."""
    deepest = np.lib.stride_tricks.sliding_window_view(np.pad(whole, 1, constant_values=np.inf), (3, 3)).max(axis=(2, 3))
    closed = np.isfinite(deepest)
    return np.count_nonzero(closed & ~(other <= deepest + reach))


def compare_pictures(options, whole, scene, splats):
    flips = [flip(*(room_picture(options, each, room, splats.bounds) for each in (whole, scene)))
             for room in ("matte", "mirror")]
    reach = HOLE_RADII * np.median(splats.radii)
    each = [[depths(options, file, view, splats.bounds) for file in (whole, scene)] for view in VIEWS]
    return flips, sum(holes(*pair, reach) for pair in each), sum(holes(b, a, reach) for a, b in each)


# --- tables

def compare(options, whole, splats, rays, scene):
    content = json.loads((scene / "set.json").read_text())
    originals = [tile for tile in content["tiles"] if tile["error"] == 0]
    levels = len({tile["level"] for tile in originals})
    found = compare_splats(splats, core_splats(scene, content))
    distances = apart(cast(options, whole, rays), cast(options, scene, rays)) / np.median(splats.radii)
    flips, opened, closed = compare_pictures(options, whole, scene, splats)
    print(f"| {len(originals)} on {levels} | {found['more']:+.1e} | {found['elsewhere']:.1e} | {found['turned']:.1e} | "
          f"{found['wide']:.1e} | {found['octaves']:.4f} | "
          + " | ".join(f"{1e6 * np.mean(distances > each):.0f}" for each in APART)
          + f" | {1e6 * np.mean(np.isinf(distances)):.0f} | {flips[0]:.4f}, {flips[1]:.4f} | {opened}, {closed} |",
          flush=True)
    np.save(scene.with_suffix(".apart.npy"), distances)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    for name in ("bin", "folder"):
        parser.add_argument(name, type=pathlib.Path)
    parser.add_argument("scans", nargs="+", type=pathlib.Path)
    parser.add_argument("--tiles", default="1,4,16,64")
    parser.add_argument("--up", type=vector, default="0,0,1")
    parser.add_argument("--from", dest="direction", type=vector, default="0.5,-1,0.5")
    parser.add_argument("--memory", default="8G")
    parser.add_argument("--set", action="store_true")
    words = sys.argv[1:]
    split = words.index("--") if "--" in words else len(words)
    options = parser.parse_args(words[:split])
    options.bake = words[split + 1:]
    options.folder.mkdir(parents=True, exist_ok=True)
    if options.set:
        whole = bake_set(options, 1, 1 << 25)
        splats, = core_splats(whole, json.loads((whole / "set.json").read_text()))
    else:
        whole = bake(options, options.folder / "whole.pro")
        splats = Splats(whole)
    low, high = splats.bounds
    rays = options.folder / "rays.npy"
    np.save(rays, random_lines((low + high) / 2, np.linalg.norm(high - low) / 2, RAYS))
    print(f"{len(splats.radii)} splats, {np.mean(np.isfinite(cast(options, whole, rays))):.1%} of the rays hit\n\n"
          "| tiles, on levels | splats more | elsewhere | turned | another radius | mean octaves |"
          + "".join(f" > {each:g} radii, ppm |" for each in APART)
          + " hit or miss, ppm | FLIP matte, mirror | holes, the file's |\n" + "|---" * 11 + "|", flush=True)
    for tiles in options.tiles.split(","):
        compare(options, whole, splats, rays, bake_set(options, int(tiles), len(splats.radii)))


if __name__ == "__main__":
    main()
