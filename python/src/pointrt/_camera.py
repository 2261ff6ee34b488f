# SPDX-License-Identifier: Apache-2.0
"""Where pictures are taken from."""

from __future__ import annotations

import dataclasses
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

#: What turns a camera's axes into those of OpenCV: x to the right, y down, z where it looks.
_OPENCV_FROM = {"opencv": (1.0, 1.0, 1.0), "opengl": (1.0, -1.0, -1.0)}


@dataclasses.dataclass(frozen=True)
class Camera:
    """A camera for ``Scene.render``: made by ``look_at`` or ``from_intrinsics``."""

    _method: str
    _arguments: tuple[Any, ...]

    @classmethod
    def look_at(cls, eye: ArrayLike | None = None, target: ArrayLike | None = None, up: ArrayLike | None = None,
                fov_deg: float | None = None) -> Camera:
        """A camera as ``pointrt-view`` takes it. What is left out is framed as there.

        Args:
            eye, target: float [3], where it stands and what it looks at, in the scan's coordinates. Without both, all
                of the scene is seen from the side that shows most of it.
            up: float [3], what is up in the picture; by default what is in the scene.
            fov_deg: vertical field of view in degrees, 0.001 up to below 180; by default 40.

        Raises:
            ValueError: arrays of another shape.
        """
        return cls("render_look_at", (_vector("eye", eye), _vector("target", target), _vector("up", up),
                                      None if fov_deg is None else float(fov_deg)))

    @classmethod
    def from_intrinsics(cls, fx: float, fy: float, cx: float, cy: float, world_from_camera: ArrayLike,
                        convention: str = "opencv") -> Camera:
        """A pinhole camera with intrinsics and a pose, as calibrations, COLMAP and nerfstudio have them.

        Args:
            fx, fy: focal lengths in pixels, above 0.
            cx, cy: principal point in pixels, anywhere; the top left pixel's centre is at (0.5, 0.5).
            world_from_camera: float [4,4] or [3,4], a rotation and the camera's place in the scan's coordinates.
            convention: axes of the camera: ``"opencv"``, x to the right, y down, z where it looks (COLMAP's are those
                of the inverse), or ``"opengl"``, x to the right, y up, z behind it (nerfstudio, Blender).

        Raises:
            ValueError: another shape or convention. What is no rotation, or no focal length, ``Scene.render`` says.
        """
        pose = np.array(world_from_camera, dtype=np.float64)
        if pose.shape == (3, 4):
            pose = np.vstack([pose, [0.0, 0.0, 0.0, 1.0]])
        if pose.shape != (4, 4):
            raise ValueError(f"world_from_camera must have the shape [4, 4] or [3, 4], not {list(pose.shape)}")
        if convention not in _OPENCV_FROM:
            raise ValueError(f"convention must be one of {', '.join(_OPENCV_FROM)}, not {convention!r}")
        pose[:3, :3] *= _OPENCV_FROM[convention]
        return cls("render_pinhole", ([float(fx), float(fy), float(cx), float(cy)], pose.ravel().tolist()))


def _vector(name: str, numbers: ArrayLike | None) -> list[float] | None:
    if numbers is None:
        return None
    vector = np.asarray(numbers, dtype=np.float64)
    if vector.shape != (3,):
        raise ValueError(f"{name} must have the shape [3], not {list(vector.shape)}")
    return vector.tolist()
