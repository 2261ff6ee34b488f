# SPDX-License-Identifier: Apache-2.0
"""Rays against point scans, with no mesh in between.

>>> import numpy as np, pointrt
>>> path = pointrt.bake(points, output="roof.pro")          # float array [N,3]; or the name of a scan
>>> scene = pointrt.Scene(path)
>>> hits = scene.cast_rays([[500010, 4500020, 300, 0, 0, -1]])
>>> hits["t_hit"], hits["positions"]
>>> picture = scene.render(pointrt.Camera.look_at(eye=[500010, 4499950, 130]), 640, 480, layers=["rgba", "depth"])

Coordinates are the scan's own, float64 where they are large: national grids lose nothing.
"""

from ._bake import bake
from ._camera import Camera
from ._core import NO_HIT, Device, Error, ScanFile
from ._hits import Hits
from ._picture import LAYERS, Picture
from ._scene import Scene

__all__ = ["Camera", "Device", "Error", "Hits", "LAYERS", "NO_HIT", "Picture", "ScanFile", "Scene", "bake"]
