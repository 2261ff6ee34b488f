#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes E57 files of known contents for benchmarks of readers.

  write_e57.py FOLDER [MILLIONS]   (5)

  cartesian.e57  double coordinates, intensity and colours of 8 bits
  scans.e57      four scans of float coordinates with poses: colours of 12 bits by their limits, row, column, returns,
                 time, some points marked invalid
  spherical.e57  two scans of float spherical coordinates with poses, some of their ranges marked invalid
  scaled.e57     coordinates as whole numbers of a tenth of a millimetre, nothing else

The points are on the walls of a room, as scanners in it see them; every run writes the same points. For each FILE.e57,
FILE.json has the number of points, the number of valid ones, and the range of each of their coordinates.
Needs numpy and pye57 (PyPI).
"""
import json
import os
import sys

import numpy as np
import pye57
from pye57 import libe57

ROOM = np.array([8.0, 5.0, 3.0])  # metres, half the edges
CHUNK = 1 << 20


def quaternion(angle):
    """A rotation about z, w first."""
    return np.array([np.cos(angle / 2), 0, 0, np.sin(angle / 2)])


def rotation(q):
    w, x, y, z = q
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                     [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                     [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])


def walls(count, sensor, seed):
    """Directions of a scanner's grid in its own frame, and how far the walls are along them; nothing is turned."""
    columns = int(np.sqrt(2 * count))
    rows = -(-count // columns)
    index = np.arange(count)
    row, column = index % rows, index // rows
    azimuth = (column + 0.5) / columns * 2 * np.pi - np.pi
    elevation = (row + 0.5) / rows * 2.6 - 1.3
    direction = np.stack([np.cos(elevation) * np.cos(azimuth), np.cos(elevation) * np.sin(azimuth),
                          np.sin(elevation)], axis=1)
    with np.errstate(divide="ignore"):
        distance = np.min((np.copysign(ROOM, direction) - sensor) / direction, axis=1)
    noise = np.random.default_rng(seed).normal(0, 0.001, count)
    return azimuth, elevation, distance + noise, row, column


class Writer:
    """A file and the limits of its valid values, in its own frame."""

    def __init__(self, path):
        self.path = path
        self.file = libe57.ImageFile(path, "w")
        self.file.extensionsAdd("", libe57.E57_V1_0_URI)
        root = self.root = self.file.root()
        self.string(root, "formatName", "ASTM E57 3D Imaging Data File")
        self.string(root, "guid", "{%s}" % os.path.basename(path))
        root.set("versionMajor", libe57.IntegerNode(self.file, 1))
        root.set("versionMinor", libe57.IntegerNode(self.file, 0))
        self.string(root, "coordinateMetadata", "")
        self.scans = libe57.VectorNode(self.file, True)
        root.set("data3D", self.scans)
        self.points = self.valid = 0
        self.least, self.most = np.full(3, np.inf), np.full(3, -np.inf)

    def string(self, node, name, text):
        node.set(name, libe57.StringNode(self.file, text))

    def reals(self, node, name, names, values):
        inner = libe57.StructureNode(self.file)
        node.set(name, inner)
        for each, value in zip(names, values):
            inner.set(each, libe57.FloatNode(self.file, float(value)))

    def wholes(self, node, name, values):
        inner = libe57.StructureNode(self.file)
        node.set(name, inner)
        for each, value in values.items():
            inner.set(each, libe57.IntegerNode(self.file, value, 0, max(value, 1)))

    def scan(self, name, columns, positions, valid, q=None, translation=None, limits=()):
        """columns: name -> (node of its type, values); limits: pairs (structure, dictionary) of whole numbers."""
        scan = libe57.StructureNode(self.file)
        self.scans.append(scan)
        self.string(scan, "guid", "{%s %s}" % (os.path.basename(self.path), name))
        self.string(scan, "name", name)
        if q is not None:
            pose = libe57.StructureNode(self.file)
            scan.set("pose", pose)
            self.reals(pose, "rotation", "wxyz", q)
            self.reals(pose, "translation", "xyz", translation)
            positions = positions @ rotation(q).T + translation
        for structure, values in limits:
            self.wholes(scan, structure, values)
        prototype = libe57.StructureNode(self.file)
        for column, (node, _) in columns.items():
            prototype.set(column, node)
        points = libe57.CompressedVectorNode(self.file, prototype, libe57.VectorNode(self.file, True))
        scan.set("points", points)
        self.write(points, {column: values for column, (_, values) in columns.items()})
        self.points += len(positions)
        self.valid += int(valid.sum())
        self.least = np.minimum(self.least, positions[valid].min(axis=0))
        self.most = np.maximum(self.most, positions[valid].max(axis=0))

    def write(self, points, values):
        kinds = {"f": "d", "i": "q", "u": "q"}  # numpy treats "l" as the same type, but pye57 reads it as 32 bits
        values = {name: np.ascontiguousarray(array, dtype=kinds[array.dtype.kind]) for name, array in values.items()}
        count = len(next(iter(values.values())))
        size = min(count, CHUNK)
        buffers, room = libe57.VectorSourceDestBuffer(), {}
        for name, array in values.items():
            room[name] = np.zeros(size, array.dtype)
            buffers.append(libe57.SourceDestBuffer(self.file, name, room[name], size, True, True))
        writer = points.writer(buffers)
        for first in range(0, count, size):
            part = min(size, count - first)
            for name, array in values.items():
                room[name][:part] = array[first:first + part]
            writer.write(part)
        writer.close()

    def close(self):
        self.file.close()
        facts = {"points": self.points, "valid": self.valid, "min": list(self.least), "max": list(self.most)}
        with open(os.path.splitext(self.path)[0] + ".json", "w") as file:
            json.dump(facts, file, indent=1)
        print("%s: %d points, %d valid, %d bytes" % (self.path, self.points, self.valid, os.path.getsize(self.path)))


def real(writer, array, precision):
    kind = libe57.E57_DOUBLE if precision == "double" else libe57.E57_SINGLE
    return libe57.FloatNode(writer.file, float(array.min()), kind, float(array.min()), float(array.max())), array


def whole(writer, array, most, least=0):
    return libe57.IntegerNode(writer.file, least, least, most), array


def cartesian(writer, count):
    _, _, _, positions, row, column = scene(count, np.zeros(3), 1)
    columns = {"cartesian" + axis.upper(): real(writer, positions[:, i], "double") for i, axis in enumerate("xyz")}
    columns["intensity"] = whole(writer, (row * 7 + column) % 2048, 2047)
    for i, color in enumerate(("Red", "Green", "Blue")):
        columns["color" + color] = whole(writer, (row // (i + 1) + column) % 256, 255)
    limits = {"color%s%s" % (color, end): value for color in ("Red", "Green", "Blue")
              for end, value in (("Minimum", 0), ("Maximum", 255))}
    writer.scan("hall", columns, positions, np.ones(count, bool), limits=[("colorLimits", limits)])


def scene(count, sensor, seed):
    azimuth, elevation, distance, row, column = walls(count, sensor, seed)
    flat = distance * np.cos(elevation)
    positions = np.stack([flat * np.cos(azimuth), flat * np.sin(azimuth), distance * np.sin(elevation)], axis=1)
    return azimuth, elevation, distance, positions, row, column


def scans(writer, count):
    """In each scan's frame the scanner is at the origin and looks along x; the pose rotates and translates it."""
    for number in range(4):
        q = quaternion(number * np.pi / 2)
        sensor = np.array([2.0 * number - 3, 1.5 - number, 0.25])
        # the room as seen by the rotated scanner: the walls stay where they were
        _, _, _, positions, row, column = scene(count // 4, sensor, number)
        positions = positions @ rotation(q)
        positions = positions.astype(np.float32).astype(np.float64)
        invalid = np.where(np.arange(len(row)) % 97 == 0, 1 + row % 2, 0)
        columns = {"cartesian" + axis.upper(): real(writer, positions[:, i], "single") for i, axis in enumerate("xyz")}
        columns["cartesianInvalidState"] = whole(writer, invalid, 2)
        columns["intensity"] = real(writer, ((row + column) % 1000) / 1000, "single")
        for i, color in enumerate(("Red", "Green", "Blue")):
            columns["color" + color] = whole(writer, (row * (i + 1) + column) % 4096, 4095)
        columns["rowIndex"] = whole(writer, row, int(row.max()))
        columns["columnIndex"] = whole(writer, column, int(column.max()))
        columns["returnIndex"] = whole(writer, row % 2, 1)
        columns["returnCount"] = whole(writer, np.full(len(row), 2), 4)
        columns["timeStamp"] = real(writer, np.arange(len(row)) * 1e-5, "double")
        limits = {"color%s%s" % (color, end): value for color in ("Red", "Green", "Blue")
                  for end, value in (("Minimum", 0), ("Maximum", 4095))}
        writer.scan("station %d" % (number + 1), columns, positions, invalid == 0, q, sensor,
                    [("colorLimits", limits)])


def spherical(writer, count):
    for number in range(2):
        q, sensor = quaternion(0.3 + number), np.array([number - 1.0, 0.5, 0])
        azimuth, elevation, distance, _, row, column = scene(count // 2, np.zeros(3), number)
        values = [each.astype(np.float32).astype(np.float64) for each in (distance, azimuth, elevation)]
        distance, azimuth, elevation = values
        flat = distance * np.cos(elevation)
        positions = np.stack([flat * np.cos(azimuth), flat * np.sin(azimuth), distance * np.sin(elevation)], axis=1)
        invalid = np.where(np.arange(len(row)) % 53 == 0, 1, 0)
        columns = {"sphericalRange": real(writer, distance, "single"),
                   "sphericalAzimuth": real(writer, azimuth, "single"),
                   "sphericalElevation": real(writer, elevation, "single"),
                   "sphericalInvalidState": whole(writer, invalid, 2),
                   "intensity": whole(writer, (row + column) % 65536, 65535)}
        writer.scan("turn %d" % (number + 1), columns, positions, invalid == 0, q, sensor)


def scaled(writer, count):
    _, _, _, positions, _, _ = scene(count, np.zeros(3), 1)
    steps = np.rint(positions / 1e-4).astype(np.int64)
    columns = {}
    for i, axis in enumerate("XYZ"):
        node = libe57.ScaledIntegerNode(writer.file, int(steps[0, i]), int(steps[:, i].min()), int(steps[:, i].max()),
                                        1e-4, 0.0)
        columns["cartesian" + axis] = (node, steps[:, i] * 1e-4)
    writer.scan("steps", columns, steps * 1e-4, np.ones(count, bool))


def main():
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    folder, millions = sys.argv[1], float(sys.argv[2]) if len(sys.argv) == 3 else 5.0
    os.makedirs(folder, exist_ok=True)
    for kind in (cartesian, scans, spherical, scaled):
        writer = Writer(os.path.join(folder, kind.__name__ + ".e57"))
        kind(writer, int(millions * 1e6))
        writer.close()


if __name__ == "__main__":
    main()
