# SPDX-License-Identifier: Apache-2.0
"""Times frames of Mitsuba: frame_mitsuba.py SCENE.json --spp N [--frames N] [--pictures PREFIX --seeds N]

Prints JSON: wall and CPU milliseconds of each frame. A warm-up frame, in which Mitsuba compiles its kernels, is not
counted. --pictures writes a picture for each seed: PREFIX0.exr, PREFIX1.exr ...
"""

import argparse
import json
import os
import pathlib
import time

import drjit as dr
import mitsuba as mi
import numpy as np

import render_mitsuba

FIRST_ROULETTE = 4  # path edges before Russian roulette, as in pointrt-view


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scene", type=pathlib.Path)
    parser.add_argument("--spp", type=int, required=True)
    parser.add_argument("--frames", type=int, default=0)
    parser.add_argument("--pictures")
    parser.add_argument("--seeds", type=int, default=0)
    options = parser.parse_args()
    dr.set_thread_count(len(os.sched_getaffinity(0)))
    scene = json.loads(options.scene.read_text())
    world = render_mitsuba.load(scene, options.scene.parent)
    paths = mi.load_dict({"type": "path", "max_depth": scene["bounces"] + 2, "rr_depth": FIRST_ROULETTE})

    def render(seed):
        return np.array(mi.render(world, integrator=paths, spp=options.spp, seed=seed))

    render(0)
    times = {"ms": [], "cpu_ms": []}
    for frame in range(options.frames):
        wall, cpu = time.perf_counter(), time.process_time()
        render(frame + 1)
        times["ms"].append(1e3 * (time.perf_counter() - wall))
        times["cpu_ms"].append(1e3 * (time.process_time() - cpu))
    for seed in range(options.seeds):
        mi.Bitmap(render(seed).astype(np.float32)).write(f"{options.pictures}{seed}.exr")
    print(json.dumps(times))


if __name__ == "__main__":
    main()
