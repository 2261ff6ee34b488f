# SPDX-License-Identifier: Apache-2.0
"""Results of other readers in the form of those of read_scan, and programs and processes that they need."""
import concurrent.futures
import os
import shutil

import numpy as np


def summary(array):
    """Statistics of the finite numbers."""
    array = np.asarray(array).reshape(-1)
    finite = array[np.isfinite(array)].astype(np.float64) if array.dtype.kind == "f" else array.astype(np.float64)
    if len(finite) == 0:
        return {"size": 0.0}
    return {"min": float(finite.min()), "max": float(finite.max()), "sum": float(finite.sum()),
            "size": float(np.abs(finite).sum())}


def with_extents(reader, positions, attributes):
    """positions: three columns of doubles; rows that are not finite do not count."""
    good = np.isfinite(positions).all(axis=1)
    positions = positions[good]
    extents = [(float(column.min()), float(column.max())) for column in positions.T] if len(positions) else []
    return {"reader": reader, "points": int(good.sum()), "extents": extents,
            "attributes": {name: summary(array[good]) for name, array in attributes.items()}}


def in_own_process(function, path):
    """Calls function(path) in a separate process: some libraries end theirs, or corrupt its heap."""
    with concurrent.futures.ProcessPoolExecutor(1) as pool:
        return pool.submit(function, path).result()


def splat_transform():
    """The command of splat-transform (npm, @playcanvas/splat-transform)."""
    tool = os.environ.get("SPLAT_TRANSFORM") or shutil.which("splat-transform")
    if tool is None:
        raise FileNotFoundError("no splat-transform on PATH or in SPLAT_TRANSFORM")
    return tool
