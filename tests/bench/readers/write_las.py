#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes large LAS, LAZ, PTS and PTX files for benchmarks of readers: copies of a real scan side by side.

  write_las.py SOURCE.laz FOLDER [MILLIONS]   (8; of text a quarter)

  points.las, points.laz      in the source's own point format
  layered.las, layered.laz    in point format 7 of LAS 1.4, which is packed in layers
  points.pts                  x y z intensity r g b
  points.ptx                  one column of a scanner's grid, with a transform

Needs numpy, laspy and lazrs (PyPI).
"""
import os
import sys

import laspy
import numpy as np


def copies(source, count):
    """Repeats the source's records, each copy next to the last one along x. Coordinates are integers, so exact."""
    points = source.points.array
    times = -(-count // len(points))
    array = np.tile(points, times)[:count]
    width = int(points["X"].max()) - int(points["X"].min()) + 1000
    for copy in range(1, times):
        array["X"][copy * len(points):(copy + 1) * len(points)] += np.int32(copy * width)
    return array


def write(path, header, points):
    las = laspy.LasData(header, points)
    las.write(path)
    print("%s: %d points, %d bytes" % (path, len(points), os.path.getsize(path)))


def columns_of(las):
    intensity = np.asarray(las.intensity).astype(np.int64)
    colors = [np.asarray(each) >> 8 for each in (las.red, las.green, las.blue)] if hasattr(las, "red") else \
        [np.zeros(len(intensity), np.int64)] * 3
    return np.asarray(las.x), np.asarray(las.y), np.asarray(las.z), intensity, colors


def write_text(path, las, count):
    x, y, z, intensity, (red, green, blue) = columns_of(las)
    with open(path, "w") as file:
        if path.endswith(".pts"):
            file.write("%d\n" % count)
            lines = ("%.3f %.3f %.3f %d %d %d %d\n" % line for line in
                     zip(x[:count], y[:count], z[:count], intensity - 2048, red, green, blue))
        else:
            file.write("1\n%d\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n%.3f %.3f 0 1\n" %
                       (count, x[0], y[0]))
            lines = ("%.3f %.3f %.3f %.4f %d %d %d\n" % line for line in
                     zip(x[:count] - x[0], y[:count] - y[0], z[:count], intensity / 65535, red, green, blue))
        file.writelines(lines)
    print("%s: %d points, %d bytes" % (path, count, os.path.getsize(path)))


def main():
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__)
    source, folder = laspy.read(sys.argv[1]), sys.argv[2]
    count = int((float(sys.argv[3]) if len(sys.argv) == 4 else 8.0) * 1e6)
    os.makedirs(folder, exist_ok=True)
    array = copies(source, count)
    header = laspy.LasHeader(version=source.header.version, point_format=source.header.point_format)
    header.scales, header.offsets = source.header.scales, source.header.offsets
    record = laspy.ScaleAwarePointRecord(array, source.header.point_format, header.scales, header.offsets)
    plain = laspy.LasData(header, record)
    for name in ("points.las", "points.laz"):
        write(os.path.join(folder, name), header, record)
    layered = laspy.convert(plain, point_format_id=7, file_version="1.4")
    for name in ("layered.las", "layered.laz"):
        write(os.path.join(folder, name), layered.header, layered.points)
    for name in ("points.pts", "points.ptx"):
        write_text(os.path.join(folder, name), plain, count // 4)


if __name__ == "__main__":
    main()
