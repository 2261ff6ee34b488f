# SPDX-License-Identifier: Apache-2.0
"""Rays against point scans, with no mesh in between.

>>> import numpy as np, pointrt
>>> path = pointrt.bake(points, output="roof.pro")          # float array [N,3]; or the name of a scan
>>> scene = pointrt.Scene(path)
>>> hits = scene.cast_rays([[500010, 4500020, 300, 0, 0, -1]])
>>> hits["t_hit"], hits["positions"]

Coordinates are the scan's own, float64 where they are large: national grids lose nothing.
"""

from ._bake import bake
from ._core import NO_HIT, Device, Error, ScanFile
from ._hits import Hits
from ._scene import Scene

__all__ = ["Device", "Error", "Hits", "NO_HIT", "ScanFile", "Scene", "bake"]
