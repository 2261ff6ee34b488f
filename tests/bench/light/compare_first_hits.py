# SPDX-License-Identifier: Apache-2.0
"""Checks that two renderers have the same camera and surfaces: compare_first_hits.py SCENE.json REFERENCE.exr TEST.exr

Both files have the channels Z, N.X, N.Y and N.Z for rays through pixel centres. --instance N (from 0): TEST shows only
that instance. Prints JSON: the number of pixels whose depth is more than 1% off (they show another surface), how many of
these are not within a pixel of a jump in the reference's depth, and for the others the errors of the depth, in pixel
widths, and of the normal, in degrees: median, 99% and maximum. Exit code 1 if a pixel away from silhouettes is wrong.
"""

import argparse
import json
import math
import pathlib
import sys

import numpy as np

import pictures

SAME_DEPTH = 0.01


def nextTo(mask):
    """The mask and its eight neighbours."""
    padded = np.pad(mask, 1)
    height, width = mask.shape
    return np.any([padded[j:j + height, i:i + width] for j in range(3) for i in range(3)], axis=0)


def differs(depth, other):
    both = np.isfinite(depth) & np.isfinite(other)
    with np.errstate(invalid="ignore"):
        return np.where(both, ~(np.abs(depth - other) <= SAME_DEPTH * depth), np.isfinite(depth) != np.isfinite(other))


def nearOutline(depth):
    """Pixels within one of a jump in depth."""
    jump = np.zeros(depth.shape, bool)
    jump[:, 1:] |= differs(depth[:, 1:], depth[:, :-1])
    jump[:, :-1] |= differs(depth[:, :-1], depth[:, 1:])
    jump[1:] |= differs(depth[1:], depth[:-1])
    jump[:-1] |= differs(depth[:-1], depth[1:])
    return nextTo(jump)


def spread(values):
    return {"median": float(np.median(values)), "99%": float(np.quantile(values, 0.99)), "most": float(values.max())}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scene", type=pathlib.Path)
    parser.add_argument("reference")
    parser.add_argument("test")
    parser.add_argument("--instance", type=int)
    options = parser.parse_args()
    scene = json.loads(options.scene.read_text())
    reference = pictures.readChannels(options.reference, ("Z", "N.X", "N.Y", "N.Z", "ID"))
    test = pictures.readChannels(options.test, ("Z", "N.X", "N.Y", "N.Z"))
    depth = reference[..., 0]
    if options.instance is not None:
        depth = np.where(reference[..., 4] == options.instance + 1, depth, np.inf)
    wrong = differs(depth, test[..., 0])
    same = ~wrong & np.isfinite(depth)
    if not same.any():
        raise SystemExit(f"{options.test}: no pixel shows what the reference shows")
    pixel = 2 * math.tan(math.radians(scene["camera"]["fov"]) / 2) / scene["size"]
    cosine = np.clip(np.sum(reference[same, 1:4] * test[same, 1:], axis=1), -1, 1)
    off_outlines = int(np.count_nonzero(wrong & ~nearOutline(depth)))
    print(json.dumps({
        "pixels": int(np.isfinite(depth).sum()),
        "wrong": int(wrong.sum()),
        "wrong_off_outlines": off_outlines,
        "depth_error_px": spread(np.abs(test[same, 0] - depth[same]) / (depth[same] * pixel)),
        "normal_error_deg": spread(np.degrees(np.arccos(cosine))),
    }, indent=1))
    sys.exit(1 if off_outlines else 0)


if __name__ == "__main__":
    main()
