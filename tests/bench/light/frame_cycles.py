# SPDX-License-Identifier: Apache-2.0
"""Times frames of Blender's Cycles, used as a Python module, with the options and output of frame_mitsuba.py. The mesh and
its BVH stay in memory between frames."""

import argparse
import contextlib
import json
import os
import pathlib
import time

import bpy

import render_reference


@contextlib.contextmanager
def silence():
    """Hides what Blender's C code prints to standard output for each frame."""
    kept, nothing = os.dup(1), os.open(os.devnull, os.O_WRONLY)
    os.dup2(nothing, 1)
    yield
    os.dup2(kept, 1)
    os.close(kept)
    os.close(nothing)


def render(seed, path=None):
    bpy.context.scene.cycles.seed = seed
    if path:
        render_reference.linearExr(path)
    with silence():
        bpy.ops.render.render(write_still=path is not None)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("scene", type=pathlib.Path)
    parser.add_argument("--spp", type=int, required=True)
    parser.add_argument("--frames", type=int, default=0)
    parser.add_argument("--pictures")
    parser.add_argument("--seeds", type=int, default=0)
    options = parser.parse_args()
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = json.loads(options.scene.read_text())
    render_reference.build(scene, options.scene.resolve().parent)
    render_reference.plainPathTracing(scene, options.spp, 0)
    settings = bpy.context.scene.render
    settings.use_persistent_data = True
    settings.threads_mode, settings.threads = "FIXED", len(os.sched_getaffinity(0))
    render(0)
    times = {"ms": [], "cpu_ms": []}
    for frame in range(options.frames):
        wall, cpu = time.perf_counter(), time.process_time()
        render(frame + 1)
        times["ms"].append(1e3 * (time.perf_counter() - wall))
        times["cpu_ms"].append(1e3 * (time.process_time() - cpu))
    for seed in range(options.seeds):
        render(seed, f"{options.pictures}{seed}.exr")
    print(json.dumps(times))


if __name__ == "__main__":
    main()
