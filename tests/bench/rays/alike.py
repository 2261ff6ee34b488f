#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Casts the same rays by pointrt-rays, by the Python package and by trace_speed, and compares hits and rates.

    alike.py SCENE.pro --command pointrt-rays --program trace_speed [--rays N] [--runs N]

Needs the packages pointrt and numpy. The rays are those of beside.py. The hits of the command and of Python must be equal
bit for bit. trace_speed takes rays as floats in the scan's cube, so the last bit of a ray may decide differently at rims:
the table has the number of such rays, and the differences of distances to the same splat.
"""
import argparse
import json
import pathlib
import subprocess
import tempfile
import time

import numpy as np

import beside

KINDS = ("camera", "random", "diffuse")
FIELDS = ("t_hit", "splat_ids", "instance_ids")


def so_many(rays, count):
    """count rays, repeated if there are fewer."""
    return rays[np.arange(count) % len(rays)]


def by_command(command, scene, rays, folder):
    """The hits of the command, and its seconds by part."""
    hits, stats = folder / "hits.npz", folder / "stats.json"
    subprocess.run([command, "cast", scene, "--rays", rays, "-o", hits, "--stats", stats, "-q"], check=True)
    return np.load(hits), json.loads(stats.read_text())["seconds"]


def by_python(scene, rays, runs):
    """The hits of the Python package, and the median seconds of a call after a warm-up."""
    seconds = []
    for _ in range(runs + 1):
        began = time.perf_counter()
        hits = scene.cast_rays(rays, fields=FIELDS)
        seconds.append(time.perf_counter() - began)
    return hits, float(np.median(seconds[1:]))


def by_walk(program, scene, rays, folder, runs):
    """The hits of trace_speed, and its rays per second."""
    hits = folder / "walk.npy"
    text = subprocess.run([program, scene, "--rays", rays, "--hits", hits, "--runs", str(runs)], check=True,
                          stdout=subprocess.PIPE).stdout
    return np.load(hits), json.loads(text)["mrays_per_second"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scene")
    parser.add_argument("--command", required=True)
    parser.add_argument("--program", required=True)
    parser.add_argument("--rays", type=int, default=1 << 22)
    parser.add_argument("--runs", type=int, default=5)
    options = parser.parse_args()
    import pointrt
    scene = pointrt.Scene(options.scene)
    print(f"{'rays':8}{'count':>9}{'walk':>8}{'Python':>8}{'share':>7}{'rims':>6}{'t off':>9}   command: seconds by part")
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        beside.make_rays(options.scene, options.rays, folder)
        for kind in KINDS:
            path = folder / f"{kind}.npy"
            rays = so_many(np.load(path), options.rays)
            np.save(path, rays)
            ours, parts = by_command(options.command, options.scene, path, folder)
            theirs, seconds = by_python(scene, rays, options.runs)
            for field in FIELDS:
                np.testing.assert_array_equal(ours[field], theirs[field], err_msg=f"{kind}: {field}")
            walk, rate = by_walk(options.program, options.scene, path, folder, options.runs)
            same = (walk["splat_ids"] == theirs["splat_ids"]) & np.isfinite(theirs["t_hit"])
            off = np.abs(walk["t_hit"][same] - theirs["t_hit"][same]).max(initial=0)
            python_rate = 1e-6 * len(rays) / seconds
            print(f"{kind:8}{len(rays):>9}{rate:>8.2f}{python_rate:>8.2f}{python_rate / rate:>7.2f}"
                  f"{np.count_nonzero(walk['splat_ids'] != theirs['splat_ids']):>6}{off:>9.1e}   "
                  + ", ".join(f"{part} {value:.2f}" for part, value in parts.items()), flush=True)


if __name__ == "__main__":
    main()
