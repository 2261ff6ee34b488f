#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Compares ray casts of pointrt's Python package with Open3D's RaycastingScene, which gets each disc as a hexagon.

    beside.py SCENE.pro [--rays N] [--runs N] [--program trace_speed]

Needs the packages pointrt, open3d and numpy. Each engine runs in its own process, so that its memory can be measured. Both
read the same rays from files, and return t_hit and ids. A hexagon has the area of its disc, so rims differ by a tenth of a
radius: results agree if both miss, or hit within a radius of each other. --program also prints trace_speed's table of the
same file (only the traversal, and Embree with the true discs) in the same run.
"""
import argparse
import json
import pathlib
import resource
import subprocess
import sys
import tempfile
import time

import numpy as np

KINDS = ("camera", "random", "shadow", "diffuse")
#: Of a regular hexagon with the area of the unit disc: 3 sqrt(3) / 2 R^2 = pi.
HEXAGON_RADIUS = np.sqrt(2 * np.pi / (3 * np.sqrt(3)))


def resident_bytes():
    fields = pathlib.Path("/proc/self/statm").read_text().split()
    return int(fields[1]) * resource.getpagesize()


def frames(normals):
    """Two unit vectors [N,3] each, upright on normals [N,3] and on each other."""
    other = np.where(np.abs(normals[:, :1]) > 0.5, [[0.0, 1.0, 0.0]], [[1.0, 0.0, 0.0]])
    u = np.cross(normals, other)
    u /= np.linalg.norm(u, axis=1, keepdims=True)
    return u, np.cross(normals, u)


class Pointrt:
    def __init__(self, path):
        import pointrt
        self.scene = pointrt.Scene(path)

    def cast(self, rays):
        hits = self.scene.cast_rays(rays, fields=("t_hit", "splat_ids", "instance_ids"))
        return hits["t_hit"], hits["splat_ids"]

    def occluded(self, rays):
        return self.scene.test_occlusions(rays)


class Open3D:
    """Hexagons of four triangles, around the first splat, as its coordinates are floats."""

    def __init__(self, path):
        import open3d
        import pointrt
        self.tensor = open3d.core.Tensor
        splats = pointrt.ScanFile(path).decode()
        centres = splats["positions"] - origin_of(path)
        u, v = frames(splats["normals"].astype(np.float64))
        reach = HEXAGON_RADIUS * splats["radii"][:, None]
        corners = [centres + reach * (np.cos(angle) * u + np.sin(angle) * v) for angle in np.arange(6) * np.pi / 3]
        vertices = np.stack(corners, axis=1).reshape(-1, 3).astype(np.float32)
        fan = np.array([[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 5]], np.uint32)
        triangles = (np.arange(len(centres), dtype=np.uint32)[:, None, None] * 6 + fan).reshape(-1, 3)
        self.scene = open3d.t.geometry.RaycastingScene()
        self.scene.add_triangles(self.tensor(vertices), self.tensor(triangles))
        self.cast(np.array([[0, 0, 0, 0, 0, 1.0]]))  # builds

    def cast(self, rays):
        hits = self.scene.cast_rays(self.tensor(rays.astype(np.float32)))
        return hits["t_hit"].numpy().astype(np.float64), hits["primitive_ids"].numpy() // 4

    def occluded(self, rays):
        return self.scene.test_occlusions(self.tensor(rays.astype(np.float32))).numpy()


def origin_of(path):
    import pointrt
    return np.asarray(pointrt.ScanFile(path).bounds[0])


def median_seconds(runs, work):
    work()  # warms up
    seconds = []
    for _ in range(runs):
        began = time.perf_counter()
        work()
        seconds.append(time.perf_counter() - began)
    return float(np.median(seconds)), float(np.ptp(seconds))


def measure(engine, path, folder, runs):
    """In a process of its own: prints its figures as JSON, leaves its hits in folder."""
    before, began = resident_bytes(), time.perf_counter()
    scene = {"pointrt": Pointrt, "open3d": Open3D}[engine](path)
    report = {"build_s": time.perf_counter() - began, "kinds": {}}
    report["resident_bytes"] = resident_bytes() - before
    # pointrt takes the scan's coordinates, Open3D's floats need a near origin
    shift = np.concatenate([origin_of(path), np.zeros(3)]) if engine == "open3d" else np.zeros(6)
    for kind in KINDS:
        rays = np.load(folder / f"{kind}.npy") - shift
        if kind == "shadow":
            seconds, spread = median_seconds(runs, lambda: scene.occluded(rays))
            np.savez(folder / f"{kind}_{engine}.npz", hit=scene.occluded(rays))
        else:
            seconds, spread = median_seconds(runs, lambda: scene.cast(rays))
            t, ids = scene.cast(rays)
            np.savez(folder / f"{kind}_{engine}.npz", t=t, ids=ids)
        report["kinds"][kind] = {"mrays_per_s": 1e-6 * len(rays) / seconds, "spread": spread / seconds}
    report["peak_bytes"] = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024
    print(json.dumps(report))


def camera_rays(low, high, count):
    """From above and in front of the box, a square picture that it fills."""
    middle, size = (low + high) / 2, np.linalg.norm(high - low)
    eye = middle + size * np.array([0.6, -0.6, 0.6])
    forward = (middle - eye) / np.linalg.norm(middle - eye)
    right, up = (axis[0] for axis in frames(forward[None]))
    side = int(np.sqrt(count))
    x, y = np.meshgrid((np.arange(side) + 0.5) / side - 0.5, (np.arange(side) + 0.5) / side - 0.5)
    directions = forward + x.reshape(-1, 1) * right + y.reshape(-1, 1) * up
    return np.hstack([np.broadcast_to(eye, directions.shape), directions])


def random_rays(low, high, count, generator):
    """Between two points of the box each."""
    ends = generator.uniform(low, high, (2, count, 3))
    return np.hstack([ends[0], ends[1] - ends[0]])


def rays_from_hits(path, camera, generator):
    """Diffuse bounces where camera rays hit, and shadow rays to a lamp above the box."""
    import pointrt
    radii = pointrt.ScanFile(path).decode()["radii"]
    low, high = np.asarray(pointrt.ScanFile(path).bounds)
    hits = pointrt.Scene(path).cast_rays(camera)
    met = np.isfinite(hits["t_hit"])
    normals = hits["normals"][met].astype(np.float64)
    origins = hits["positions"][met] + 3 * radii[hits["splat_ids"][met]][:, None] * normals
    around = generator.normal(size=normals.shape)
    diffuse = normals + around / np.linalg.norm(around, axis=1, keepdims=True)
    lamp = (low + high) / 2 + np.array([0.3, 0.2, 1.0]) * np.linalg.norm(high - low)
    return np.hstack([origins, diffuse]), np.hstack([origins, lamp - origins])


def make_rays(path, count, folder):
    import pointrt
    low, high = np.asarray(pointrt.ScanFile(path).bounds)
    generator = np.random.default_rng(1)
    camera = camera_rays(low, high, count)
    diffuse, shadow = rays_from_hits(path, camera, generator)
    rays = {"camera": camera, "random": random_rays(low, high, count, generator), "diffuse": diffuse, "shadow": shadow}
    for kind in KINDS:
        np.save(folder / f"{kind}.npy", rays[kind])


def agreement(path, folder, kind):
    """Share of the rays that both engines answer alike."""
    import pointrt
    ours, theirs = (np.load(folder / f"{kind}_{engine}.npz") for engine in ("pointrt", "open3d"))
    if kind == "shadow":
        return float(np.mean(ours["hit"] == theirs["hit"]))
    radii = pointrt.ScanFile(path).decode()["radii"]
    lengths = np.linalg.norm(np.load(folder / f"{kind}.npy")[:, 3:], axis=1)
    hit = np.isfinite(ours["t"]) & np.isfinite(theirs["t"])
    alike = np.isinf(ours["t"]) & np.isinf(theirs["t"])
    apart = np.abs(ours["t"][hit] - theirs["t"][hit]) * lengths[hit]
    alike[hit] = apart <= radii[ours["ids"][hit]]
    return float(np.mean(alike))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scene")
    parser.add_argument("--rays", type=int, default=1 << 20)
    parser.add_argument("--runs", type=int, default=5)
    parser.add_argument("--program", help="trace_speed, to be run on the same file")
    parser.add_argument("--engine", help=argparse.SUPPRESS)
    parser.add_argument("--folder", type=pathlib.Path, help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.engine:
        return measure(options.engine, options.scene, options.folder, options.runs)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        make_rays(options.scene, options.rays, folder)
        reports = {}
        for engine in ("pointrt", "open3d"):
            command = [sys.executable, __file__, options.scene, "--engine", engine, "--folder", name,
                       "--runs", str(options.runs)]
            reports[engine] = json.loads(subprocess.run(command, check=True, stdout=subprocess.PIPE).stdout)
        for engine, report in reports.items():
            print(f"{engine:8} ready in {report['build_s']:.2f} s, {report['resident_bytes'] / 1e6:.0f} MB then, "
                  f"{report['peak_bytes'] / 1e6:.0f} MB at most")
        print(f"{'rays':8}{'pointrt':>12}{'open3d':>12}{'ratio':>8}{'agree %':>10}   (millions a second)")
        for kind in KINDS:
            ours, theirs = (reports[engine]["kinds"][kind]["mrays_per_s"] for engine in ("pointrt", "open3d"))
            print(f"{kind:8}{ours:>12.2f}{theirs:>12.2f}{ours / theirs:>8.2f}"
                  f"{100 * agreement(options.scene, folder, kind):>10.3f}", flush=True)
    if options.program:
        subprocess.run([options.program, options.scene], check=True)


if __name__ == "__main__":
    main()
