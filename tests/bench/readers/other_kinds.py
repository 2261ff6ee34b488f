# SPDX-License-Identifier: Apache-2.0
"""Reads meshes, grids, tables, PTX scans and Gaussians with other readers, with results like those of others.py."""
import csv
import gzip
import io
import os
import re
import subprocess
import tempfile

import numpy as np

from results import in_own_process, splat_transform, with_extents


def plain(reader, positions, step=0.0):
    """positions: in rows of three; step: the precision of their numbers, relative to their size."""
    theirs = with_extents(reader, np.asarray(positions, np.float64).reshape(-1, 3), {})
    theirs["relative_step"] = step
    return theirs


def used_vertices(mesh):
    return mesh.vertices[np.unique(mesh.faces)] if hasattr(mesh, "faces") and len(mesh.faces) else mesh.vertices


def read_mesh(path):
    """The vertices that faces use, as in our reader; if a scene has several materials, each has vertices of its own."""
    import trimesh
    loaded = trimesh.load(path, process=False, maintain_order=True)
    parts = loaded.dump() if isinstance(loaded, trimesh.Scene) else [loaded]
    theirs = plain("trimesh", np.concatenate([used_vertices(part) for part in parts]))
    theirs["uncounted"] = True  # it splits vertices at seams of texture coordinates, and at materials
    return theirs


def draco_in_this_process(path):
    import DracoPy
    with open(path, "rb") as file:
        decoded = DracoPy.decode(file.read())
    theirs = plain("DracoPy", decoded.points, float(np.finfo(np.float32).eps))
    if decoded.colors is not None and decoded.colors.dtype == np.uint8:  # ours rounds other types
        theirs["colors"] = [float(column.sum()) for column in decoded.colors[:, :3].astype(np.float64).T]
    return theirs


def read_draco(path):
    """DracoPy may damage the heap."""
    return in_own_process(draco_in_this_process, path)


def read_grid(path):
    """An ESRI grid through GDAL's command line: cells without data are left out."""
    text = subprocess.run(["gdal_translate", "-q", "-of", "XYZ", path, "/vsistdout/"], capture_output=True, text=True,
                          check=True).stdout
    cells = np.loadtxt(io.StringIO(text), ndmin=2)
    info = subprocess.run(["gdalinfo", path], capture_output=True, text=True, check=True).stdout
    missing = re.search(r"NoData Value=(\S+)", info)
    return plain("gdal", cells[cells[:, 2] != float(missing.group(1))] if missing else cells)


NAMES = {"x": "x", "easting": "x", "y": "y", "northing": "y", "z": "z", "elevation": "z"}


def read_table(path):
    """Text in columns; x, y and z are the columns of these names, or the first three."""
    import pandas
    with open(path, encoding="utf-8", errors="replace") as file:
        first, second = file.readline(), file.readline()
    words = [word.strip(' "\n').lower() for word in re.split(r"[,\s]", first) if word.strip()]
    named = set(words) & set(NAMES)
    counted = len(words) == 1 and len(second.split()) > 1  # PTS starts with the number of points
    commas = "," in (second.strip() or first) and '",' not in second  # else, quoted numbers may have commas
    table = pandas.read_csv(path, sep="," if commas or '"' in second else r"\s+", skipinitialspace=True, comment="#",
                            index_col=False, header=0 if named else None, skiprows=1 if counted else 0,
                            decimal="." if commas else ",")
    table = table.rename(columns=lambda name: NAMES.get(str(name).strip().lower(), name))
    columns = table[["x", "y", "z"]] if named else table.iloc[:, :3]
    return plain("pandas", columns.apply(pandas.to_numeric).to_numpy())


def read_ptx(path):
    """Scans one after another: columns, rows, ten lines of poses, then points; 0 0 0 means no point."""
    with open(path, encoding="ascii") as file:
        lines = file.read().split("\n")
    at, parts = 0, []
    while at + 10 <= len(lines) and lines[at].strip():
        count = int(lines[at]) * int(lines[at + 1])
        matrix = np.array([[float(word) for word in line.split()] for line in lines[at + 6:at + 10]])
        rows = np.array([[float(word) for word in line.split()[:3]] for line in lines[at + 10:at + 10 + count]])
        rows = rows.reshape(-1, 3)
        parts.append(rows[(rows != 0).any(axis=1)] @ matrix[:3, :3] + matrix[3, :3])
        at += 10 + count
    return plain("NumPy", np.concatenate(parts))


def read_gaussians(path, turned=(1, 1, 1)):
    """Gaussians through splat-transform, times the signs that undo its axes."""
    with tempfile.TemporaryDirectory() as folder:
        table = os.path.join(folder, "all.csv")
        subprocess.run([splat_transform(), "-q", "-g", "cpu", path, table], check=True, capture_output=True, text=True)
        with open(table, encoding="ascii", newline="") as file:
            rows = list(csv.DictReader(file))
    positions = np.array([[float(row[axis]) for axis in "xyz"] for row in rows])
    return plain("splat-transform", positions * turned, float(np.finfo(np.float32).eps))


def read_splat(path):
    """Records of 32 bytes, of which the first 12 are x, y and z as floats: the format of antimatter15's viewer."""
    with open(path, "rb") as file:
        data = file.read()
    return plain("NumPy", np.frombuffer(data, "<f4").reshape(-1, 8)[:, :3])


def read_spz(path):
    """SPZ of versions 2 and 3 after Niantic's description: positions of 24 bits in fixed point."""
    with open(path, "rb") as file:
        data = file.read()
    if data[:2] == b"\x1f\x8b":
        data = gzip.decompress(data)
    if int.from_bytes(data[4:8], "little") > 3:  # sections of its own
        return read_gaussians(path, (1, -1, -1))  # from right, up, back to right, down, front
    count, fraction_bits = int.from_bytes(data[8:12], "little"), data[13]
    packed = np.frombuffer(data[16:16 + 9 * count], np.uint8).reshape(-1, 3).astype(np.int32)
    whole = packed[:, 0] | packed[:, 1] << 8 | packed[:, 2] << 16
    whole = np.where(whole >= 1 << 23, whole - (1 << 24), whole)
    return plain("NumPy", whole.reshape(-1, 3) / float(1 << fraction_bits))
