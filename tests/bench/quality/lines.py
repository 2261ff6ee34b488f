#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Bakes scans whose nearest neighbours are in a clump or on a line, and casts rays at them.

    lines.py BIN_DIR FOLDER [NAME...]

Makes profiles of a road (points 5 mm apart, noise of 3 mm; straight down) and frames of a sensor that stands still in a
room (clumps of 3, 10 and 30 points; from the sensor), bakes them with default options, and prints the share of rays that
hit, that within 2 cm of the truth, the median error and that of nine in ten hits, in millimetres: of profiles along the
ray, of rooms from the nearest wall. NAME: only the cases whose names begin so. Needs numpy.
"""
import pathlib
import subprocess
import sys

import numpy as np

RAYS = 20_000
NEAR_M = 0.02
ROOM_LOW_M, ROOM_HIGH_M = np.array([-4, -3, -1.5]), np.array([5, 3.5, 1.6])
HALF_ROAD_M = 4


def road_height(x, y):
    """A road with ruts, a hill, and embankments beyond 3 m."""
    return 0.3 * np.sin(1.3 * x) + 0.1 * np.sin(y) + np.where(np.abs(x) > 3, 2 * (np.abs(x) - 3), 0)


def profiles(random, apart, skew):
    """Twelve profiles at least; skew: metres ahead for each metre across."""
    points = []
    for line in range(int(max(2.4, 12 * apart) / apart) + 1):
        x = np.arange(-HALF_ROAD_M, HALF_ROAD_M, 0.005)
        y = apart * line + skew * x
        points.append(np.column_stack([x, y, road_height(x, y) + random.normal(0, 0.003, len(x))]))
    return np.concatenate(points)


def down(random, points):
    """Rays onto the part of a road that has profiles on both sides at every x; their true lengths."""
    skew = (points[-1, 1] - points[-2, 1]) / (points[-1, 0] - points[-2, 0])
    ahead = abs(skew) * HALF_ROAD_M
    x = random.uniform(-HALF_ROAD_M + 0.1, HALF_ROAD_M - 0.1, RAYS)
    y = random.uniform(points[:, 1].min() + 2 * ahead, points[:, 1].max() - 2 * ahead, RAYS)
    rays = np.column_stack([x, y, np.full(RAYS, 5.0), np.tile([0, 0, -1.0], (RAYS, 1))])
    return rays, lambda lengths: np.abs(lengths - (5 - road_height(x, y)))


def directions(random, count):
    """Of a sensor that sees 36 degrees above and below the horizon."""
    azimuth, z = random.uniform(-np.pi, np.pi, count), random.uniform(-np.sin(0.63), np.sin(0.63), count)
    level = np.sqrt(1 - z * z)
    return np.column_stack([level * np.cos(azimuth), level * np.sin(azimuth), z])


def frames(random, count):
    """Frames of 48 x 240 directions, noise of 1 cm along the ray and of a tenth of a step across."""
    azimuth, elevation = np.meshgrid(np.linspace(-np.pi, np.pi, 240, False), np.linspace(-0.63, 0.63, 48))
    points = []
    for _ in range(count):
        a = azimuth.ravel() + random.normal(0, 0.0026, azimuth.size)
        e = elevation.ravel() + random.normal(0, 0.0026, azimuth.size)
        ahead = np.column_stack([np.cos(e) * np.cos(a), np.cos(e) * np.sin(a), np.sin(e)])
        with np.errstate(divide="ignore"):
            wall = np.where(ahead > 0, ROOM_HIGH_M / ahead, ROOM_LOW_M / ahead).min(1)
        points.append((wall + random.normal(0, 0.01, len(wall)))[:, None] * ahead)
    return np.concatenate(points)


def around(random, _points):
    ahead = directions(random, RAYS)

    def from_walls(lengths):
        places = ahead * np.where(np.isfinite(lengths), lengths, 0)[:, None]
        return np.minimum(np.abs(places - ROOM_LOW_M), np.abs(places - ROOM_HIGH_M)).min(1)

    return np.column_stack([np.zeros((RAYS, 3)), ahead]), from_walls


CASES = {f"profiles {apart} m apart": (lambda random, apart=apart: profiles(random, apart, 0), down)
         for apart in (0.1, 0.25, 0.5, 1.0, 2.0)}
CASES["profiles 1.0 m apart, oblique"] = (lambda random: profiles(random, 1, 0.5), down)
CASES.update({f"frames, {count}": (lambda random, count=count: frames(random, count), around) for count in (3, 10, 30)})


def write_ply(path, points):
    names = "".join(f"property float {axis}\n" for axis in "xyz")
    head = f"ply\nformat binary_little_endian 1.0\nelement vertex {len(points)}\n{names}end_header\n"
    path.write_bytes(head.encode() + points.astype("<f4").tobytes())


def main():
    tools, folder, names = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]), sys.argv[3:]
    folder.mkdir(parents=True, exist_ok=True)
    print("| scan | hit | within 2 cm | error, mm: median | 90% |\n|---|---|---|---|---|")
    for name, (make, aim) in CASES.items():
        if names and not any(name.startswith(each) for each in names):
            continue
        random = np.random.default_rng(5)
        points = make(random)
        write_ply(folder / "scan.ply", points)
        subprocess.run([tools / "pointrt-bake", "-q", "-f", folder / "scan.ply", "-o", folder / "scan.pro"], check=True)
        rays, error_of = aim(random, points)
        np.save(folder / "rays.npy", rays)
        subprocess.run([tools / "pointrt-rays", "cast", "-q", folder / "scan.pro", "--rays", folder / "rays.npy",
                        "-o", folder / "hits.npz"], check=True)
        lengths = np.load(folder / "hits.npz")["t_hit"]
        hit = np.isfinite(lengths)
        errors = error_of(lengths)[hit]
        near = np.count_nonzero(errors < NEAR_M) / RAYS
        print(f"| {name} | {hit.mean():.4f} | {near:.4f} | {1e3 * np.median(errors):.1f} | "
              f"{1e3 * np.percentile(errors, 90):.1f} |", flush=True)


if __name__ == "__main__":
    main()
