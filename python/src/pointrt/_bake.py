# SPDX-License-Identifier: Apache-2.0
"""Bakes scans to .pro files with pointrt-bake, a separate GPL program that is called and not linked."""

from __future__ import annotations

import os
import shutil
import subprocess
import tempfile

import numpy as np
from numpy.typing import ArrayLike

from ._core import Error


def bake(points: ArrayLike | str | os.PathLike[str], normals: ArrayLike | None = None,
         colors: ArrayLike | None = None, *, output: str | os.PathLike[str], **options) -> str:
    """Bakes points to a ``.pro`` file.

    Args:
        points: float array ``[N, 3]``, or the path of a scan that pointrt-bake reads.
        normals: float array ``[N, 3]``; 0 for points without one. Estimated by default.
        colors: uint8 array ``[N, 3]``, sRGB.
        output: path of the result: ``NAME.pro``, or ``NAME.proset`` for a tile set.
        **options: options of ``pointrt-bake --help`` with ``_`` for ``-``: ``force=True`` is ``--force``,
            ``clean="off"`` is ``--clean off``.

    Returns:
        The path of the result.

    Raises:
        pointrt.Error: pointrt-bake is not installed, or failed; the message is its error line.
        ValueError: an array has the wrong shape.
    """
    tool = os.environ.get("POINTRT_BAKE") or shutil.which("pointrt-bake")
    if tool is None:
        raise Error("pointrt-bake not found: install it, or set POINTRT_BAKE to its path")
    if isinstance(points, (str, os.PathLike)):
        if normals is not None or colors is not None:
            raise ValueError("normals and colors need points as an array: a scan file has its own")
        return _run(tool, points, output, options)
    with tempfile.TemporaryDirectory(prefix="pointrt-") as folder:
        scan = os.path.join(folder, "points.ply")
        _write_ply(scan, points, normals, colors)
        return _run(tool, scan, output, options)


def _run(tool: str, scan: str | os.PathLike[str], output: str | os.PathLike[str], options: dict) -> str:
    command = [tool, "-q", os.fspath(scan), "-o", os.fspath(output)]
    for name, value in options.items():
        option = "--" + name.replace("_", "-")
        if value is True:
            command.append(option)
        elif value is not False and value is not None:
            command += [option, str(value)]
    done = subprocess.run(command, stdin=subprocess.DEVNULL, stderr=subprocess.PIPE, encoding="utf-8",
                          errors="replace")
    if done.returncode != 0:
        lines = done.stderr.strip().splitlines()
        raise Error(lines[-1] if lines else f"pointrt-bake exited with {done.returncode}")
    return os.fspath(output)


def _rows(values: ArrayLike, name: str, count: int | None) -> np.ndarray:
    rows = np.asarray(values)
    if rows.ndim != 2 or rows.shape[1] != 3 or (count is not None and len(rows) != count):
        expected = "[N, 3]" if count is None else f"[{count}, 3]"
        raise ValueError(f"{name} must have the shape {expected}, not {list(rows.shape)}")
    return rows


def _write_ply(path: str, points: ArrayLike, normals: ArrayLike | None, colors: ArrayLike | None) -> None:
    """Writes doubles, which keep the precision of national grids."""
    xyz = _rows(points, "points", None)
    columns = [("x", "<f8", xyz[:, 0]), ("y", "<f8", xyz[:, 1]), ("z", "<f8", xyz[:, 2])]
    if normals is not None:
        rows = _rows(normals, "normals", len(xyz))
        columns += [("n" + axis, "<f4", rows[:, i]) for i, axis in enumerate("xyz")]
    if colors is not None:
        rows = _rows(colors, "colors", len(xyz))
        if rows.dtype != np.uint8:
            raise ValueError(f"colors must be uint8, not {rows.dtype}")
        columns += [(name, "u1", rows[:, i]) for i, name in enumerate(("red", "green", "blue"))]
    table = np.empty(len(xyz), [(name, kind) for name, kind, _ in columns])
    for name, _, values in columns:
        table[name] = values
    kinds = {"<f8": "double", "<f4": "float", "u1": "uchar"}
    header = ["ply", "format binary_little_endian 1.0", f"element vertex {len(xyz)}"]
    header += [f"property {kinds[kind]} {name}" for name, kind, _ in columns] + ["end_header", ""]
    with open(path, "wb") as file:
        file.write("\n".join(header).encode())
        table.tofile(file)
