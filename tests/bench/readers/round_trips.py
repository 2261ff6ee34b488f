#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Bakes scans, exports their splats in every format, and reads these files with other programs' libraries.

  round_trips.py BIN_DIR SCAN...

Prints a row for each file: the largest difference of a coordinate to the PLY file's, the attributes that are the same, and
what disagrees. Exits with 1 if anything does. BIN_DIR has pointrt-bake and pointrt-info.
Needs numpy, laspy, lazrs, pye57 and plyfile (PyPI).
"""
import argparse
import os
import subprocess
import sys
import tempfile

import numpy as np

import others

PCD_TYPES = {"F": "f", "I": "i", "U": "u"}


def read_ply(path):
    from plyfile import PlyData
    vertex = PlyData.read(path, mmap=False)["vertex"].data
    return {name: np.asarray(vertex[name]) for name in vertex.dtype.names}


def read_pcd(path):
    with open(path, "rb") as file:
        head, _, body = file.read().partition(b"\nDATA binary\n")
    lines = {line.split()[0]: line.split()[1:] for line in head.decode().splitlines() if line[0] != "#"}
    kind = np.dtype([(name, PCD_TYPES[letter] + size) for name, letter, size in
                     zip(lines["FIELDS"], lines["TYPE"], lines["SIZE"])])
    points = np.frombuffer(body, kind, int(lines["POINTS"][0]))
    columns = {name: points[name] for name in kind.names}
    if "rgb" in columns:
        packed = columns.pop("rgb").view("u4")
        columns.update(red=packed >> 16 & 255, green=packed >> 8 & 255, blue=packed & 255)
    return columns


def read_las(path):
    import laspy
    las = laspy.read(path)
    columns = {name: np.asarray(las[name]) for name in las.point_format.dimension_names}
    for name in [name for name in columns if name + "_2" in columns]:  # exact; the field of LAS has it scaled
        columns[name] = columns.pop(name + "_2")
    for axis in "XYZ":
        columns[axis.lower()] = np.asarray(getattr(las, axis.lower()))
    if "red" in columns:
        rgb16 = [columns.pop(name) for name in ("red", "green", "blue")]
        columns.update({"rgb16_%d" % i: values for i, values in enumerate(rgb16)})
    return columns


def read_e57(path):
    import pye57
    file = pye57.E57(path)
    raw = others.e57_columns(file, 0)
    renamed = {"colorRed": "red", "colorGreen": "green", "colorBlue": "blue"}
    columns = {renamed.get(name, name.rpartition(":")[2]): values for name, values in raw.items()}
    columns["x"], columns["y"], columns["z"] = others.e57_world(file, 0, raw).T
    return columns


READERS = {"ply": read_ply, "pcd": read_pcd, "las": read_las, "laz": read_las, "e57": read_e57}


def far_apart(ours, theirs):
    """The largest difference of a coordinate."""
    return max(np.abs(ours[axis].astype(float) - theirs[axis].astype(float)).max() for axis in "xyz")


def most_apart(truth, path):
    """The difference that rounding explains: LAS keeps the scale of the baked file, the others have floats or doubles."""
    if path.endswith(("las", "laz")):
        import laspy
        with laspy.open(path) as file:
            return 0.51 * max(file.header.scales)
    return max(np.ptp(truth[axis].astype(float)) for axis in "xyz") * 2.0 ** -23


def compare(truth, columns, path):
    """Names of the columns that are the same, and descriptions of what disagrees."""
    if len(columns["x"]) != len(truth["x"]):
        return [], ["%d points, not %d" % (len(columns["x"]), len(truth["x"]))]
    far = far_apart(truth, columns)
    wrong = ["coordinates differ by %g" % far] if far > most_apart(truth, path) else []
    same = []
    for name in sorted(set(truth) & set(columns) - set("xyz")):
        equal = np.array_equal(truth[name].astype(float), columns[name].astype(float))
        (same if equal else wrong).append(name)
    return same, wrong


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("bin_dir")
    parser.add_argument("scans", nargs="+")
    options = parser.parse_args()
    disagree = files = 0
    print("| file | points | largest difference | the same | disagrees |\n|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        for scan in options.scans:
            base = os.path.join(folder, os.path.basename(scan))
            subprocess.run([os.path.join(options.bin_dir, "pointrt-bake"), "-q", scan, "-o", base + ".pro"], check=True)
            truth = None
            for suffix, reader in READERS.items():
                path = base + "." + suffix
                subprocess.run([os.path.join(options.bin_dir, "pointrt-info"), base + ".pro", "--export", path], check=True,
                               stdout=subprocess.DEVNULL)
                columns = reader(path)
                truth = truth or columns
                same, wrong = compare(truth, columns, path)
                files, disagree = files + 1, disagree + bool(wrong)
                print("| %s | %d | %.2g | %s | %s |" % (os.path.basename(path), len(columns["x"]),
                                                      far_apart(truth, columns), " ".join(same),
                                                      "; ".join(wrong) or "-"))
    print("%d files, %d disagree" % (files, disagree))
    return 1 if disagree else 0


if __name__ == "__main__":
    sys.exit(main())
