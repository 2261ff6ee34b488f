# SPDX-License-Identifier: Apache-2.0
"""Measuring: paths, fitted shapes, volumes, profiles and distances between scans."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from . import _core
from ._studies import Studies


def _rows(points: ArrayLike, name: str) -> np.ndarray:
    array = np.ascontiguousarray(points, dtype=np.float64)
    if array.ndim != 2 or array.shape[1] != 3:
        raise ValueError(f"{name} must have the shape [N, 3], not {list(array.shape)}")
    return array


def _unit(up: Sequence[float]) -> list[float]:
    vector = np.asarray(up, dtype=np.float64)
    if vector.shape != (3,) or not np.isfinite(vector).all() or not vector.any():
        raise ValueError("up must be a direction: three finite numbers that are not all 0")
    return (vector / np.linalg.norm(vector)).tolist()


def measure_path(points: ArrayLike, up: Sequence[float] = (0.0, 0.0, 1.0)) -> dict[str, Any]:
    """Lengths, heights, angles and areas of a path ``[N, 3]`` of two points or more.

    Returns:
        ``length`` and ``horizontal_length`` of all legs; of the last leg ``last_leg`` (its length), ``difference``
        (x y z), ``horizontal``, ``height`` (along ``up``) and ``slope_deg``; from three points on ``angle_deg`` between
        the last two legs (180 if they go straight on), and ``area``, ``plan_area`` (seen along ``up``) and
        ``perimeter`` of the polygon, else None.

    Raises:
        ValueError: fewer points.
    """
    return _core.measure_path(_rows(points, "points"), _unit(up))


def fit_plane(points: ArrayLike) -> dict[str, Any]:
    """The least-squares plane of three points or more: ``center``, unit ``normal``, ``rms`` distance of the points.

    Raises:
        ValueError: fewer points, or points on a line.
    """
    return _core.fit_plane(_rows(points, "points"))


def fit_circle(points: ArrayLike) -> dict[str, Any]:
    """The least-squares circle of three points or more: ``center``, ``normal``, ``radius``, ``rms``. As fit_plane."""
    return _core.fit_circle(_rows(points, "points"))


def fit_sphere(points: ArrayLike) -> dict[str, Any]:
    """The least-squares sphere of four points or more: ``center``, ``radius``, ``rms``.

    Raises:
        ValueError: fewer points, or points in a plane.
    """
    return _core.fit_sphere(_rows(points, "points"))


class Measures(Studies):
    """The measurements of ``Scene``."""

    def snap(self, points: ArrayLike, *, along: Sequence[float] | None = None) -> np.ndarray:
        """The surface point closest to each point, float64 ``[N, 3]``; NaN if no surface is found.

        Args:
            along: a direction such as up: move points along it instead, to the first surface seen from above.
        """
        return _core.snap_to_surface(self._scene, _rows(points, "points"), None if along is None else _unit(along))

    def volume(self, rim: ArrayLike, *, base_height: float | None = None, cell: float = 0.0,
               up: Sequence[float] | None = None) -> dict[str, Any]:
        """The volume between the surface, seen from above, and a base within a rim.

        Args:
            rim: corners of a polygon, ``[N, 3]``.
            base_height: height of a level base (default: the plane fitted to the rim).
            cell: side of the raster's cells, one ray each (default: a thousandth of the rim's longer side).
            up: direction (default: up of the file, else +Z).

        Returns:
            ``cut`` above the base, ``fill`` below it and ``net``, their difference; ``area`` of the rim in plan, and
            ``covered``, the part of it where there is a surface; ``cell``; ``base`` as from ``fit_plane``.

        Raises:
            ValueError: the rim crosses itself or has no area, or a number is invalid.
        """
        return _core.measure_volume(self._scene, _rows(rim, "rim"), self._up(up), base_height, cell)

    def profile(self, line: ArrayLike, *, step: float = 0.0, from_below: bool = False,
                start_height: float | None = None, all_surfaces: bool = False, apart: float | None = None,
                width: float = 0.0, up: Sequence[float] | None = None) -> dict[str, np.ndarray]:
        """The surface along a line, by vertical rays.

        Args:
            line: corners, ``[N, 3]``; heights are ignored.
            step: distance between stations (default: a thousandth of the line).
            from_below: cast rays upwards instead of downwards.
            start_height: where rays start (default: outside of the scene).
            all_surfaces: all surfaces on the rays, not only the first.
            apart: count surfaces on a ray closer together than this as one (default: twice the median radius).
            width: width of a band; heights are then medians across it (default: one ray per station).

        Returns:
            Arrays: ``stations`` (distance along the line in plan), ``positions`` ``[N, 3]``, ``heights``, ``lows`` and
            ``highs`` (across the band), ``layers`` uint32, ``hits`` bool. Heights are NaN where nothing is hit.

        Raises:
            ValueError: the line has no length, or a number is invalid.
        """
        gap = 0.0 if not all_surfaces else 2 * self._median_radius() if apart is None else apart
        found = _core.surface_profile(self._scene, _rows(line, "line"), self._up(up), step, from_below, start_height,
                                      all_surfaces, gap, width)
        found["hits"] = found["hits"].view(np.bool_)
        return found

    def contours(self, interval: float = 0.0, *, cell: float = 0.0, shortest: float = 0.0,
                 up: Sequence[float] | None = None) -> list[dict[str, Any]]:
        """Lines of equal height of the surface seen from above, by a raster of vertical rays.

        Args:
            interval: height difference between lines (default: a round number that gives 10 to 25 heights).
            cell: side of the raster's cells (default: a thousandth of the scene's longer side).
            shortest: length of the shortest line to keep.

        Returns:
            A dict for each line, from the lowest: ``height``, a multiple of the interval; ``positions`` ``[N, 3]``, with
            higher ground on the left; ``closed``; ``index``, true for every fifth height.

        Raises:
            ValueError: a number is invalid, or there are more than 2**26 cells or 10,000 heights.
        """
        return _core.surface_contours(self._scene, self._up(up), interval, cell, shortest)

    def section_lines(self, plane: str | None = None, *, height: float | None = None, step: float | None = None,
                      gap: float | None = None, tolerance: float | None = None, shortest: float = 0.0,
                      up: Sequence[float] | None = None) -> list[dict[str, Any]]:
        """The lines in which a plane cuts the surfaces: a floor plan, or an upright section.

        Args:
            plane: as for ``section``, without a thickness: ``"y=3"``, ``"x=3"``, ``"x0,y0,x1,y1"``, ``"z=1.2"``.
            height: in place of plane: cut across up at this height along it.
            step: between the rays that sweep the plane (default: the median radius of the discs).
            gap: widest gap that lines are joined across (default: 6 steps).
            tolerance: largest distance of lines from where rays met the surface (default: half a step).
            shortest: length of the shortest line to keep.
            up: direction (default: up of the file, else +Z).

        Returns:
            A dict for each line: ``positions`` ``[N, 3]``; ``closed``, true if the last is followed by the first.

        Raises:
            ValueError: the plane or a number is invalid, or both or neither of plane and height are given.
        """
        if (plane is None) == (height is None):
            raise ValueError("give either a plane or a height")
        apart = self._median_radius() if step is None else step
        rules = (self._up(up), apart, 6 * apart if gap is None else gap, apart / 2 if tolerance is None else tolerance,
                 shortest)
        if plane is None:
            return _core.level_section_lines(self._scene, height, *rules)
        return _core.section_lines(self._scene, plane, *rules)

    def distances(self, points: ArrayLike | Measures, normals: ArrayLike | None = None, *,
                  radii: ArrayLike | None = None, max_distance: float | None = None) -> np.ndarray:
        """Signed distances of points from this scene's surface along their normals.

        Positive where the point lies on the side of the surface that its normal points to, as in M3C2.

        Args:
            points: another ``Scene``, whose points come in the order of ``Scene.points``; or ``[N, 3]`` with
                ``normals`` ``[N, 3]`` and optionally ``radii`` ``[N]``.
            max_distance: largest distance to measure (default: 20 median radii of this scene).

        Returns:
            float64 ``[N]``; NaN where there is no surface.

        Raises:
            ValueError: an array has the wrong shape, or ``max_distance`` is not above 0.
        """
        most = 20 * self._median_radius() if max_distance is None else max_distance
        if isinstance(points, Measures):
            blocks = [self._distances_of(b["positions"], b["normals"], b["radii"], most) for b in points.points()]
            return np.concatenate(blocks) if blocks else np.empty(0)
        if normals is None:
            raise ValueError("points need normals to measure along")
        sizes = None if radii is None else np.ascontiguousarray(radii, dtype=np.float32)
        return self._distances_of(_rows(points, "points"), np.ascontiguousarray(normals, dtype=np.float32), sizes, most)

    def _distances_of(self, positions: np.ndarray, normals: np.ndarray, radii: np.ndarray | None,
                      most: float) -> np.ndarray:
        if normals.shape != positions.shape:
            raise ValueError(f"normals must have the shape {list(positions.shape)}, not {list(normals.shape)}")
        distances = np.empty(len(positions))
        _core.surface_distances(self._scene, positions, normals, radii, most, distances)
        return distances

    def _up(self, up: Sequence[float] | None) -> list[float]:
        return list(_core.scan_up(self._paths[0])) if up is None else _unit(up)
