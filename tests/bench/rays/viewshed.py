#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Compares pointrt-rays viewshed for a lidar tile with GRASS r.viewshed for a raster of it, point by point.

    viewshed.py SCENE.pro --rays pointrt-rays -o FOLDER [--cell SIZE] [--height H] [--observer X,Y ...]

Needs numpy and GRASS GIS 8 (Debian: grass-core). The raster has the height of the highest point of each cell, by default
as wide as the point spacing; cells without points repeatedly get the mean height of their neighbours. Both programs get
the same observers, H above the raster, without earth curvature. A raster is seen from above only, so points are visible
from the front only (--sides front): from both sides, roofs would be visible from below through unscanned walls. A point is
on top if it is at most a cell's width below the highest point of its cell; a raster does not know the others. The table
has the number of points that each program sees, and where they differ. FOLDER/observer_N.png shows the points from above:
grey seen by both, dark by neither, orange by pointrt only, blue by GRASS only; red: the observer.
"""
import argparse
import pathlib
import struct
import subprocess
import zlib

import numpy as np

COLORS = {(False, False): (40, 40, 40), (True, True): (190, 190, 190), (True, False): (255, 140, 0),
          (False, True): (40, 110, 255)}
EYE = (230, 0, 0)


def read_ply(path):
    """Columns of a binary PLY of pointrt's by their names."""
    data = path.read_bytes()
    end = data.index(b"end_header\n") + len(b"end_header\n")
    kinds = {"double": "<f8", "float": "<f4", "uchar": "u1", "char": "i1", "ushort": "<u2", "short": "<i2",
             "uint": "<u4", "int": "<i4"}
    words = [line.split() for line in data[:end].decode().splitlines()]
    return np.frombuffer(data, np.dtype([(w[2], kinds[w[1]]) for w in words if w[:1] == ["property"]]), offset=end)


def write_png(path, pixels):
    height, width = pixels.shape[:2]
    rows = np.concatenate([np.zeros((height, 1), np.uint8), pixels.reshape(height, -1)], axis=1)

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)) +
                     chunk(b"IDAT", zlib.compress(rows.tobytes(), 9)) + chunk(b"IEND", b""))


class Raster:
    """Heights [rows from the north, columns] of square cells."""

    def __init__(self, points, cell):
        self.cell = cell
        self.west, self.north = np.floor(points[:, 0].min()), np.ceil(points[:, 1].max())
        columns, rows = self.cells(points[:, 0], points[:, 1])
        self.heights = np.full((rows.max() + 1, columns.max() + 1), -np.inf)
        np.maximum.at(self.heights, (rows, columns), points[:, 2])
        self.filled = float(np.isinf(self.heights).mean())
        while np.isinf(self.heights).any():
            wide = np.pad(self.heights, 1, constant_values=-np.inf)
            around = np.stack([wide[1 + dy:wide.shape[0] - 1 + dy, 1 + dx:wide.shape[1] - 1 + dx]
                               for dy in (-1, 0, 1) for dx in (-1, 0, 1)])
            known = np.isfinite(around)
            mean = np.where(known, around, 0).sum(axis=0) / np.maximum(known.sum(axis=0), 1)
            self.heights = np.where(np.isinf(self.heights) & known.any(axis=0), mean, self.heights)

    def cells(self, x, y):
        return (np.floor((x - self.west) / self.cell).astype(int), np.floor((self.north - y) / self.cell).astype(int))

    def at(self, x, y):
        column, row = self.cells(np.float64(x), np.float64(y))
        return self.heights[row, column]

    def middle(self, x, y):
        column, row = self.cells(np.float64(x), np.float64(y))
        return self.west + (column + 0.5) * self.cell, self.north - (row + 0.5) * self.cell

    def text(self):
        rows, columns = self.heights.shape
        head = (f"north: {self.north}\nsouth: {self.north - rows * self.cell}\nwest: {self.west}\n"
                f"east: {self.west + columns * self.cell}\nrows: {rows}\ncols: {columns}\n")
        return head + "\n".join(" ".join(f"{z:.3f}" for z in row) for row in self.heights) + "\n"


def grass_viewsheds(raster, eyes, height, folder):
    """What GRASS sees from each eye: bool [rows, columns]."""
    (folder / "dsm.txt").write_text(raster.text())
    lines = [f"r.in.ascii input={folder}/dsm.txt output=dsm type=DCELL --q", "g.region raster=dsm"]
    for k, (x, y) in enumerate(eyes):
        lines += [f"r.viewshed -b input=dsm output=seen{k} coordinates={x},{y} observer_elevation={height} "
                  "target_elevation=0 memory=2000 --q",
                  f"r.out.ascii -h input=seen{k} output={folder}/seen{k}.txt --q --o"]
    (folder / "grass.sh").write_text("set -e\n" + "\n".join(lines) + "\n")
    done = subprocess.run(["grass", "--tmp-location", "XY", "--exec", "sh", str(folder / "grass.sh")], text=True,
                          capture_output=True)
    if done.returncode != 0:
        raise SystemExit(done.stderr)
    return [np.loadtxt(folder / f"seen{k}.txt", dtype=str) == "1" for k in range(len(eyes))]


def point_viewsheds(options, raster, eyes, folder):
    """The points with a column for each eye."""
    words = [options.rays, "viewshed", options.scene, "-q", "--sides", options.sides, "--height", str(options.height),
             "-o", str(folder / "seen.ply")]
    for x, y in eyes:
        words += ["--from", f"{x},{y},{raster.at(x, y)}"]
    subprocess.run(words, check=True)
    return read_ply(folder / "seen.ply")


def row_of(name, ours, theirs):
    both = np.array([(ours & theirs).mean(), (ours & ~theirs).mean(), (~ours & theirs).mean()]) * 100
    return (f"| {name} | {len(ours)} | {100 * ours.mean():.1f} | {100 * theirs.mean():.1f} | "
            f"{100 * (ours == theirs).mean():.1f} | {both[1]:.1f} | {both[2]:.1f} |")


def draw(path, raster, cells, ours, theirs, top, eye):
    pixels = np.full((*raster.heights.shape, 3), 255, np.uint8)
    for (we, they), color in COLORS.items():
        chosen = top & (ours == we) & (theirs == they)
        pixels[cells[1][chosen], cells[0][chosen]] = color
    column, row = raster.cells(np.float64(eye[0]), np.float64(eye[1]))
    pixels[max(0, row - 4):row + 5, max(0, column - 4):column + 5] = EYE
    write_png(path, pixels)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("scene")
    parser.add_argument("--rays", default="pointrt-rays", help="the program")
    parser.add_argument("-o", "--output", required=True, type=pathlib.Path)
    parser.add_argument("--cell", type=float, help="by default as wide as points lie apart")
    parser.add_argument("--height", type=float, default=6.0, help="of the eyes over the raster")
    parser.add_argument("--sides", default="front", help="of points that count, as pointrt-rays has it")
    parser.add_argument("--observer", action="append", default=[], help="X,Y; by default three over the tile")
    options = parser.parse_args()
    options.output.mkdir(parents=True, exist_ok=True)
    first = options.output / "points.ply"
    subprocess.run([options.rays, "viewshed", options.scene, "-q", "--from", "0,0,0", "--radius", "1e-9",
                    "-o", str(first)], check=True)
    points = np.stack([read_ply(first)[axis] for axis in "xyz"], axis=1)
    low, high = points.min(axis=0), points.max(axis=0)
    cell = options.cell or round(float(np.sqrt(np.prod((high - low)[:2]) / len(points))), 1)
    raster = Raster(points, cell)
    wanted = ([tuple(map(float, each.split(","))) for each in options.observer] or
              [tuple(low[:2] + share * (high - low)[:2]) for share in ([0.5, 0.5], [0.2, 0.25], [0.8, 0.7])])
    eyes = [raster.middle(x, y) for x, y in wanted]
    seen = point_viewsheds(options, raster, eyes, options.output)
    grass = grass_viewsheds(raster, eyes, options.height, options.output)
    cells = raster.cells(seen["x"], seen["y"])
    top = seen["z"] >= raster.heights[cells[1], cells[0]] - cell
    print(f"{len(points)} points, cells of {cell}, {100 * raster.filled:.1f}% of them without points; "
          f"{100 * top.mean():.1f}% of the points are on top; eyes {options.height} over the raster\n")
    print("| eye | points | pointrt sees % | GRASS sees % | agree % | pointrt alone % | GRASS alone % |")
    print("|---|---|---|---|---|---|---|")
    for k, eye in enumerate(eyes):
        ours, theirs = seen[f"observer_{k}"] == 1, grass[k][cells[1], cells[0]]
        place = f"{eye[0]:.1f}, {eye[1]:.1f}"
        print(row_of(f"{place}: on top", ours[top], theirs[top]))
        print(row_of(f"{place}: all", ours, theirs))
        draw(options.output / f"observer_{k}.png", raster, cells, ours, theirs, top, eye)


if __name__ == "__main__":
    main()
