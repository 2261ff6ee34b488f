# SPDX-License-Identifier: Apache-2.0
"""Cameras for pictures."""

from __future__ import annotations

import dataclasses
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

#: Signs that convert camera axes to OpenCV's: x right, y down, z forward.
_OPENCV_FROM = {"opencv": (1.0, 1.0, 1.0), "opengl": (1.0, -1.0, -1.0)}


@dataclasses.dataclass(frozen=True)
class Camera:
    """A camera for ``Scene.render``, from ``look_at`` or ``from_intrinsics``."""

    _method: str
    _arguments: tuple[Any, ...]

    @classmethod
    def look_at(cls, eye: ArrayLike | None = None, target: ArrayLike | None = None, up: ArrayLike | None = None,
                fov_deg: float | None = None) -> Camera:
        """A camera with a position and a target, as in ``pointrt-view``. Omitted arguments are framed automatically.

        Args:
            eye, target: float [3], position and target in the scan's coordinates. Without both, the whole scene is
                seen from the side that shows most of it.
            up: float [3], up in the picture (default: up in the scene).
            fov_deg: vertical field of view in degrees, from 0.001 to below 180 (default 40).

        Raises:
            ValueError: an array has the wrong shape.
        """
        return cls("render_look_at", (_vector("eye", eye), _vector("target", target), _vector("up", up),
                                      None if fov_deg is None else float(fov_deg)))

    @classmethod
    def from_intrinsics(cls, fx: float, fy: float, cx: float, cy: float, world_from_camera: ArrayLike,
                        convention: str = "opencv") -> Camera:
        """A pinhole camera with intrinsics and a pose, as in camera calibrations, COLMAP and nerfstudio.

        Args:
            fx, fy: focal lengths in pixels, above 0.
            cx, cy: principal point in pixels, not necessarily in the picture; the centre of the top left pixel is
                (0.5, 0.5).
            world_from_camera: float [4,4] or [3,4], rotation and position of the camera in the scan's coordinates.
            convention: axes of the camera: ``"opencv"``, x right, y down, z forward (COLMAP stores the inverse pose),
                or ``"opengl"``, x right, y up, z backward (nerfstudio, Blender).

        Raises:
            ValueError: an array has the wrong shape, or the convention is unknown. ``Scene.render`` validates rotation
                and focal lengths.
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
