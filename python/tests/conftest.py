# SPDX-License-Identifier: Apache-2.0
import os
import shutil
import signal

import numpy as np
import pytest

import pointrt

# A shell ignores Ctrl-C in what it runs in the background, and Python keeps to that.
signal.signal(signal.SIGINT, signal.default_int_handler)

#: Coordinates in a UTM zone, where floats have a resolution of half a metre.
GRID = np.array([500000.0, 4500000.0, 100.0])


def plane_points(side=100, size=20.0):
    """A level field 10 m above GRID, points 0.2 m apart."""
    steps = (np.arange(side) + 0.5) * size / side
    x, y = np.meshgrid(steps, steps)
    return GRID + np.stack([x.ravel(), y.ravel(), np.full(x.size, 10.0)], axis=1)


@pytest.fixture(scope="session")
def field(tmp_path_factory):
    """The field, baked to a .pro."""
    if not (os.environ.get("POINTRT_BAKE") or shutil.which("pointrt-bake")):
        pytest.skip("pointrt-bake is not installed")
    points = plane_points()
    normals = np.tile([0.0, 0.0, 1.0], (len(points), 1))
    colors = np.tile(np.uint8([255, 0, 0]), (len(points), 1))
    return pointrt.bake(points, normals, colors, output=tmp_path_factory.mktemp("scans") / "field.pro")


@pytest.fixture(scope="session")
def scene(field):
    return pointrt.Scene(field)


def baked_hills(output, **options):
    if not (os.environ.get("POINTRT_BAKE") or shutil.which("pointrt-bake")):
        pytest.skip("pointrt-bake is not installed")
    x, y = np.meshgrid(np.arange(250) * 0.4, np.arange(250) * 0.4)
    points = GRID + np.stack([x.ravel(), y.ravel(), (5 * np.sin(x / 8) * np.cos(y / 9)).ravel()], axis=1)
    return pointrt.bake(points, output=output, clean="off", **options)


@pytest.fixture(scope="session")
def hills(tmp_path_factory):
    """Hills, baked to a .pro."""
    return baked_hills(tmp_path_factory.mktemp("scans") / "hills.pro")


@pytest.fixture(scope="session")
def hills_in_tiles(tmp_path_factory):
    """The hills as a tile set of several tiles."""
    return baked_hills(tmp_path_factory.mktemp("sets") / "hills.proset", tile_splats=8000)
