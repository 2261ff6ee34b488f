#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Bakes scans whose nearest neighbours are in a clump or on a line, and casts rays at them.

    lines.py BIN_DIR FOLDER [NAME...]

Makes profiles of a road (points 5 mm apart, noise of 3 mm; straight down) and frames of sensors that stand still or
move slowly in a room (clumps of 3 to 30 points; from the sensor), bakes them with default options, and prints the share
of rays that hit, that within 2 cm of the truth, the median error and that of nine in ten hits, in millimetres: of
profiles along the ray, of rooms from the nearest wall. NAME: only the cases whose names begin so. Needs numpy.
"""
import pathlib
import subprocess
import sys
import typing

import numpy as np

RAYS = 20_000
NEAR_M = 0.02
ROOM_LOW_M, ROOM_HIGH_M = np.array([-4, -3, -1.5]), np.array([5, 3.5, 1.6])
HALF_ROAD_M = 4


def road_height(x, y):
    """A road with ruts, a hill, and embankments beyond 3 m."""
    return 0.3 * np.sin(1.3 * x) + 0.1 * np.sin(y) + np.where(np.abs(x) > 3, 2 * (np.abs(x) - 3), 0)


def profiles(random, apart, skew):
    """At least twelve profiles; skew: metres along the road for each metre across."""
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


def directions(azimuth, elevation):
    level = np.cos(elevation)
    return np.column_stack([level * np.cos(azimuth), level * np.sin(azimuth), np.sin(elevation)])


def to_wall(origin, ahead):
    """Distance to the wall of the room that each ray meets."""
    with np.errstate(divide="ignore"):
        return np.where(ahead > 0, (ROOM_HIGH_M - origin) / ahead, (ROOM_LOW_M - origin) / ahead).min(1)


class Sensor(typing.NamedTuple):
    """Columns and rows of directions between these angles. Frames differ in direction by a tenth of a row's step."""
    columns: int
    rows: int
    half_azimuth: float
    half_elevation: float
    noise_of: typing.Callable  # standard deviation by range

    def frames(self, random, count, step_m):
        """From the origin ahead, slightly aside and upwards; the noise is along the ray."""
        full_turn = self.half_azimuth == np.pi
        azimuths = np.linspace(-self.half_azimuth, self.half_azimuth, self.columns, endpoint=not full_turn)
        grid = np.meshgrid(azimuths, np.linspace(-self.half_elevation, self.half_elevation, self.rows))
        spread = 0.2 * self.half_elevation / (self.rows - 1)
        points = []
        for frame in range(count):
            origin = frame * step_m * np.array([0.96, 0.27, 0.05])
            ahead = directions(*(angles.ravel() + random.normal(0, spread, angles.size) for angles in grid))
            ranges = to_wall(origin, ahead)
            points.append(origin + (ranges + random.normal(0, 1, len(ranges)) * self.noise_of(ranges))[:, None] * ahead)
        return np.concatenate(points)

    def rays(self, random, _points):
        """From the origin, within the sensor's field."""
        top = np.sin(self.half_elevation)
        ahead = directions(random.uniform(-self.half_azimuth, self.half_azimuth, RAYS),
                           np.arcsin(random.uniform(-top, top, RAYS)))

        def from_walls(lengths):
            places = ahead * np.where(np.isfinite(lengths), lengths, 0)[:, None]
            return np.minimum(np.abs(places - ROOM_LOW_M), np.abs(places - ROOM_HIGH_M)).min(1)

        return np.column_stack([np.zeros((RAYS, 3)), ahead]), from_walls


SENSORS = {
    "scanner": Sensor(240, 48, np.pi, 0.63, lambda _: 0.01),
    "16 lines": Sensor(900, 16, np.pi, np.radians(15), lambda _: 0.01),
    # Standard deviation by range as for the Kinect of 2010 (devices/devices.h); steps of 2.6 cm at 4 m.
    "depth camera": Sensor(160, 120, 0.52, 0.39, lambda ranges: 1.4e-3 * ranges**2),
}
FRAMES = {"scanner": [(3, 0), (10, 0), (30, 0), (10, 0.003), (10, 0.01)],
          "16 lines": [(1, 0), (10, 0), (10, 0.02), (30, 0.02)],
          "depth camera": [(3, 0), (10, 0), (30, 0), (10, 0.01)]}

CASES = {f"profiles {apart} m apart": (lambda random, apart=apart: profiles(random, apart, 0), down)
         for apart in (0.04, 0.1, 0.25, 0.33, 0.5, 1.0, 2.0)}
CASES["profiles 1.0 m apart, oblique"] = (lambda random: profiles(random, 1, 0.5), down)
for title, frames in FRAMES.items():
    for count, step_m in frames:
        sensor = SENSORS[title]
        CASES[f"{title}, {count} frames" + (f", {1000 * step_m:g} mm apart" if step_m else "")] = (
            lambda random, sensor=sensor, count=count, step_m=step_m: sensor.frames(random, count, step_m), sensor.rays)


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
