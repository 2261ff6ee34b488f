#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Compares baked captures of Gaussians with what splat-transform reads of the same files.

  captures.py BIN_DIR CAPTURE...

Bakes each capture, exports it as PLY, and compares every Gaussian, in the order of the file, with those of splat-transform:
their number, and for each parameter the largest difference. Prints a Markdown row for each capture and parameter. Exits
with 1 if a number differs, or a difference is larger than what a .pro's own steps explain. Needs numpy and plyfile (PyPI), and splat-transform (npm) on PATH or in SPLAT_TRANSFORM.
"""
import os
import subprocess
import sys
import tempfile

import numpy as np
from plyfile import PlyData

from results import splat_transform


def columns(vertex, names):
    return np.stack([np.asarray(vertex[name], np.float64) for name in names], axis=1)


def parameters(path):
    """A dictionary of arrays with a row for each Gaussian: lengths in units of the file, angles in radians."""
    vertex = PlyData.read(path)["vertex"]
    rest = sorted((each.name for each in vertex.properties if each.name.startswith("f_rest_")),
                  key=lambda name: int(name[len("f_rest_"):]))
    found = {"position": columns(vertex, "xyz"),
             "log_deviation": columns(vertex, ["scale_0", "scale_1", "scale_2"]),
             "opacity": 1 / (1 + np.exp(-columns(vertex, ["opacity"]))),
             "harmonic 0": columns(vertex, ["f_dc_0", "f_dc_1", "f_dc_2"])}
    if rest:
        found["harmonics above 0"] = columns(vertex, rest)
    rotation = columns(vertex, ["rot_0", "rot_1", "rot_2", "rot_3"])
    found["rotation"] = rotation / np.linalg.norm(rotation, axis=1, keepdims=True)
    return found


def explained(name, theirs, capture):
    """The largest difference that a .pro explains (format/SPEC.md, Precision). A .pro has 4095 steps between the
    smallest and the largest deviation, 511 between the smallest and the largest colour (half as many for blue), and 127
    up to the largest harmonic; positions are rounded to floats and to 2^-28 of a cube."""
    if name == "rotation":  # the bytes of .splat are read as b / 128 - 1 or as 2 b / 255 - 1, up to 1/128 apart
        return 0.0687 / 180 * np.pi + (2 * np.sqrt(4) / 128 if capture.endswith(".splat") else 0)
    return 1.01 * {"position": 2.0 ** -23,  # of the extent
                   "opacity": 1 / 2046,
                   "log_deviation": np.ptp(theirs) / 4095 / 2,
                   "harmonic 0": np.ptp(theirs) / 511,
                   "harmonics above 0": np.abs(theirs).max() / 254}[name] + 1e-6


def raised(log_deviation):
    return np.maximum(log_deviation, log_deviation.max(axis=1, keepdims=True) - np.log(1024))


def differences(ours, theirs):
    """For each parameter the largest difference of each Gaussian."""
    ours["log_deviation"], theirs["log_deviation"] = raised(ours["log_deviation"]), raised(theirs["log_deviation"])
    for name in ours.keys() & theirs.keys():
        if name == "rotation":  # q and -q are one rotation
            cosine = np.abs((ours[name] * theirs[name]).sum(axis=1)).clip(0, 1)
            yield name, 2 * np.arccos(cosine)
        else:
            scale = np.ptp(theirs[name], axis=0).max() if name == "position" else 1
            yield name, np.abs(ours[name] - theirs[name]).max(axis=1) / scale


def compare(bin_dir, tool, capture, folder):
    """Whether all agree; prints the rows."""
    pro, ours, theirs = (os.path.join(folder, name) for name in ("a.pro", "ours.ply", "theirs.ply"))
    subprocess.run([os.path.join(bin_dir, "pointrt-bake"), "-q", "-f", capture, "-o", pro], check=True)
    subprocess.run([os.path.join(bin_dir, "pointrt-info"), "-q", "-f", pro, "--export", ours], check=True)
    subprocess.run([tool, "-q", "-w", "-g", "cpu", capture, theirs], check=True, stdout=subprocess.DEVNULL)
    mine, other = parameters(ours), parameters(theirs)
    counts = [len(each["position"]) for each in (mine, other)]
    name = os.path.basename(os.path.dirname(capture) if capture.endswith("meta.json") else capture)
    if counts[0] != counts[1]:
        print("| %s | %d | %d | **counts differ** | | |" % (name, *counts))
        return False
    good = True
    for parameter, apart in sorted(differences(mine, other), key=lambda each: each[0]):
        most = explained(parameter, other[parameter], capture)
        good = good and apart.max() <= most
        print("| %s | %d | %d | %s | %.2g | %.2g |" % (name, *counts, parameter, apart.max(), most))
    return good


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    tool = splat_transform()
    print("| capture | Gaussians | splat-transform | parameter | largest difference | explained by .pro |\n|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        good = [compare(sys.argv[1], tool, capture, folder) for capture in sys.argv[2:]]
    sys.exit(0 if all(good) else 1)


main()
