# SPDX-License-Identifier: Apache-2.0
"""Ray tracing of point scans, without meshing.

>>> import numpy as np, pointrt
>>> path = pointrt.bake(points, output="roof.pro")          # float array [N,3], or a scan file
>>> scene = pointrt.Scene(path)
>>> hits = scene.cast_rays([[500010, 4500020, 300, 0, 0, -1]])
>>> hits["t_hit"], hits["positions"]
>>> picture = scene.render(pointrt.Camera.look_at(eye=[500010, 4499950, 130]), 640, 480, layers=["rgba", "depth"])

Coordinates are the scan's own, in float64, so national grids keep their precision.
"""

from ._bake import bake
from ._camera import Camera
from ._core import NO_HIT, Device, Error, ScanFile
from ._hits import Hits
from ._measures import fit_circle, fit_plane, fit_sphere, measure_path
from ._picture import LAYERS, Picture
from ._scene import Scene

__all__ = ["Camera", "Device", "Error", "Hits", "LAYERS", "NO_HIT", "Picture", "ScanFile", "Scene", "bake",
           "fit_circle", "fit_plane", "fit_sphere", "measure_path"]
