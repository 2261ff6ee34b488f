#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A row of motion.sh's table: compare_motion.py NAME FOLDER. FOLDER/moving and FOLDER/resting have screenshots of the
same frames. Disocclusions are found in the resting pictures: pixels whose colour was nowhere near them in the picture
before."""
import glob
import json
import os
import sys

import flip_evaluator
import numpy
from PIL import Image

# the part of 1280x720 that neither the statistics nor the panel cover
TOP, RIGHT = 140, 975
REACH = 24  # pixels by which the picture moves at most between kept frames of the slow orbit


def load(path):
    return numpy.asarray(Image.open(path).convert("RGB")).astype(numpy.float32)[TOP:, :RIGHT] / 255


def disoccluded(before, now):
    """Pixels with no similar colour (6 of 255 steps) within REACH in the picture before; tests every fourth place."""
    found = numpy.zeros(now.shape[:2], bool)
    for dy in range(-REACH, REACH + 1, 4):
        for dx in range(-REACH, REACH + 1, 4):
            shifted = numpy.roll(before, (dy, dx), (0, 1))
            found |= numpy.abs(shifted - now).max(2) < 6 / 255
    return ~found


def main():
    name, folder = sys.argv[1:3]
    means, worst, new = [], [], []
    before = None
    for path in sorted(glob.glob(f"{folder}/resting/f*.png")):
        now, moving = load(path), load(path.replace("/resting/", "/moving/"))
        error, mean, _ = flip_evaluator.evaluate(now, moving, "LDR", applyMagma=False)
        error = numpy.asarray(error).reshape(now.shape[0], now.shape[1], -1)[..., 0]
        means.append(mean)
        worst.append(numpy.percentile(error, 95))
        if before is not None:
            mask = disoccluded(before, now)
            if mask.any():
                new.append(error[mask].mean())
        before = now
    stats = json.load(open(os.path.join(folder, "moving", "stats.json")))
    times, pixels = stats["moving_frame_ms"], stats["moving_pixels"]
    light = f"{numpy.mean(new):.3f}" if new else ""
    print(f"| {name} | {numpy.mean(means):.4f} | {numpy.mean(worst):.3f} | {light} | {times['median']:.1f} | "
          f"{times['p95']:.1f} | {pixels['median']:.0f} |")


main()
