# SPDX-License-Identifier: Apache-2.0
"""Studies of scans: hours of direct sun, sky view and visibility of points."""

from __future__ import annotations

import datetime
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from . import _core

#: Points per block; rays of one direction from all of them are cast together.
_POINTS_AT_ONCE = 1 << 19
#: Rays between two checks for Ctrl-C: about a second on two cores.
_RAYS_AT_ONCE = 1 << 21


class _GivenPoints:
    """Points that the caller gives."""

    def __init__(self, positions: np.ndarray, normals: np.ndarray | None, radii: np.ndarray, shape: tuple[int, ...]):
        self._rows, self.shape = (positions, normals, radii), shape

    def __len__(self) -> int:
        return len(self._rows[0])

    def blocks(self) -> Iterator[tuple[slice, tuple]]:
        """For each block its slice of the results, and its positions, normals, radii and noise."""
        for begin in range(0, len(self), _POINTS_AT_ONCE):
            part = slice(begin, begin + _POINTS_AT_ONCE)
            yield part, (*(None if each is None else each[part] for each in self._rows), None)


class _OwnPoints:
    """The points of the scene, one block in memory at a time."""

    def __init__(self, scene: Studies, count: int):
        self._scene, self.shape = scene, (count,)

    def __len__(self) -> int:
        return self.shape[0]

    def blocks(self) -> Iterator[tuple[slice, tuple]]:
        begin = 0
        for block in self._scene.points(_POINTS_AT_ONCE):
            part = slice(begin, begin + len(block["radii"]))
            yield part, (block["positions"], block["normals"], block["radii"], block.get("noise"))
            begin = part.stop


class Studies:
    """The studies of ``Scene``, which provides ``_scene`` and ``_paths``."""

    _scene: _core.Scene
    _paths: list[str]
    _radius: float | None = None  # median of the scene, computed on first use

    def points(self, most: int = _POINTS_AT_ONCE) -> Iterator[dict[str, np.ndarray]]:
        """Iterates over the points of the scene in blocks of up to ``most``, in the order of results of studies.

        Instances follow each other, in scene coordinates. A ``.pro`` yields all splats in file order; a tile set the
        splats in the cores of its original tiles, tile by tile, so sets can have any size.

        Yields:
            Arrays: ``positions`` float64 ``[N, 3]`` and ``radii`` float32 ``[N]`` in the scene's unit, ``normals``
            float32 ``[N, 3]``, ``noise`` float32 ``[N]``, the standard deviation from the surface, if a scan has noise,
            and ``splat_ids``, ``instance_ids``, ``tile_ids`` uint32 ``[N]`` as in ``cast_rays``.

        Raises:
            ValueError: ``most`` is below 1.
            pointrt.Error: a file cannot be read.
        """
        if most < 1:
            raise ValueError(f"most must be 1 or more, not {most}")
        reader = _core.ScenePointReader(self._paths)
        while (block := reader.next(most)) is not None:
            yield block

    def sun_hours(self, at: tuple[float, float], date: datetime.date | str, to: datetime.date | str | None = None, *,
                  every: float = 15.0, points: ArrayLike | None = None, normals: ArrayLike | None = None,
                  radii: ArrayLike | float | None = None, sides: str = "auto", utc_offset: float | None = None,
                  up: Sequence[float] | None = None, north: Sequence[float] | None = None) -> np.ndarray:
        """Hours of direct sun on each point, summed over all days.

        The position of the sun follows NOAA (accurate to 0.02 degrees from 1900 to 2100), with refraction. The sun
        shines while its centre is above the level horizon and the scene does not occlude it.

        Args:
            at: latitude and longitude in degrees, north and east positive.
            date, to: first and last day (default: the same), ``datetime.date`` or ``"2026-06-21"``.
            every: sampling interval in minutes.
            points: ``[..., 3]`` in the scan's coordinates (default: the points of the scene, in the order of
                ``Scene.points``).
            normals: ``[..., 3]``, any length, of the points' discs. Points without normals are level and two-sided.
            radii: of the points' discs, ``[...]`` or one number, in the scan's unit: hits on parallel discs within 3
                radii above the point's disc are self-intersections (default: the median radius of the scene).
            sides: that receive light: ``"front"``, ``"both"``, or ``"auto"``: front if the scans' normals are oriented.
            utc_offset: hours; days begin at midnight of this offset (default: from the longitude, 15 degrees per hour).
            up, north: directions in the scan's coordinates, 3 numbers (default: up of the file, else +Z; true north from
                the coordinate system of the file, which needs PROJ, else +Y, or -Z if Y is up).

        Returns:
            float64 with the shape of the points; ``[len(scene)]`` for those of the scene.

        Raises:
            ValueError: an array has the wrong shape, or a place, date or number is invalid.
            pointrt.Error: a point is not finite, or PROJ is needed and not installed.
        """
        frame = _core.study_frame(self._paths[0], *_place(at), _vector(up, "up"), _vector(north, "north"))
        first = _date(date)
        last = first if to is None else _date(to)
        lights = _core.sun_lights(*_place(at), first, last, every, utc_offset, frame[0], frame[1])
        return self._sum_lights(self._points(points, normals, radii), lights, sides, frame[0])

    def sky_view(self, *, directions: int = 256, points: ArrayLike | None = None, normals: ArrayLike | None = None,
                 radii: ArrayLike | float | None = None, sides: str = "auto",
                 up: Sequence[float] | None = None) -> np.ndarray:
        """The sky view factor of each point: the unoccluded share of a uniform sky's irradiance on level ground.

        It is 1 in the open. The sky is sampled by ``directions`` (1 to 65536) fixed, cosine-weighted directions. Other
        arguments, shapes and errors are those of ``sun_hours``.
        """
        any_place = (0.0, 0.0)
        if up is None:
            up = _core.scan_up(self._paths[0])
        vector = _vector(up, "up")
        aside = [0.0, 1.0, 0.0] if abs(vector[1]) < 0.9 * np.linalg.norm(vector) else [0.0, 0.0, -1.0]
        frame = _core.study_frame(self._paths[0], *any_place, vector, aside)
        lights = _core.sky_lights(directions, frame[0], frame[1])
        return self._sum_lights(self._points(points, normals, radii), lights, sides, frame[0])

    def visible_from(self, observers: ArrayLike, *, height: float = 0.0, radius: float = np.inf,
                     points: ArrayLike | None = None, normals: ArrayLike | None = None,
                     radii: ArrayLike | float | None = None, sides: str = "auto",
                     up: Sequence[float] | None = None) -> np.ndarray:
        """Tests which points each observer sees.

        Lines of sight end at the observer; one inside a wall sees nothing but the wall.

        Args:
            observers: ``[..., 3]`` in the scan's coordinates.
            height: height of the observers above their positions.
            radius: maximum viewing distance.

        Other arguments and errors are those of ``sun_hours``.

        Returns:
            bool, with the observers' shape followed by the points' shape: ``[N]`` for one observer ``[3]``, ``[M, N]``
            for ``[M, 3]``; ``.sum(axis=0)`` is how many see each point.
        """
        eyes = _array(observers, "observers", np.float64)
        vector = _vector(up, "up") or _core.scan_up(self._paths[0])
        vector = np.asarray(vector) / np.linalg.norm(vector)
        given = self._points(points, normals, radii)
        rules = self._both(sides), list(vector), 0.0
        visible = np.empty((int(np.prod(eyes.shape[:-1])), len(given)), np.uint8)
        for part, rows in given.blocks():
            for row, eye in zip(visible, eyes.reshape(-1, 3) + height * vector):
                _core.find_visible(self._scene, *rows, *rules, list(eye), radius, row[part])
        return visible.view(np.bool_).reshape(eyes.shape[:-1] + given.shape)

    def _both(self, sides: str) -> bool:
        if sides not in ("auto", "front", "both"):
            raise ValueError(f"sides must be 'auto', 'front' or 'both', not {sides!r}")
        return sides == "both" or (sides == "auto" and not _core.are_oriented(self._paths))

    def _sum_lights(self, points: _GivenPoints | _OwnPoints, lights: tuple, sides: str, up: Any) -> np.ndarray:
        directions, weights = lights
        both = self._both(sides)
        sums = np.zeros(len(points))
        for part, rows in points.blocks():
            some = max(1, _RAYS_AT_ONCE // len(rows[0]))
            for begin in range(0, len(weights), some):
                _core.add_lights(self._scene, *rows, both, up, 0.0, directions[begin:begin + some],
                                 weights[begin:begin + some], sums[part])
        return sums.reshape(points.shape)

    def _points(self, points: ArrayLike | None, normals: ArrayLike | None,
                radii: ArrayLike | float | None) -> _GivenPoints | _OwnPoints:
        if points is None:
            if normals is not None or radii is not None:
                raise ValueError("normals and radii need points: the scene has its own")
            return _OwnPoints(self, self._scene.splat_count)
        positions = _array(points, "points", np.float64)
        shape = positions.shape[:-1]
        rows = _array(normals, "normals", np.float32) if normals is not None else None
        if rows is not None and rows.shape != positions.shape:
            raise ValueError(f"normals must have the shape of points, {list(positions.shape)}, not {list(rows.shape)}")
        sizes = np.asarray(self._median_radius() if radii is None else radii, dtype=np.float32)
        if sizes.ndim > 0 and sizes.shape != shape:
            raise ValueError(f"radii must have the shape {list(shape)}, or be one number, not {list(sizes.shape)}")
        return _GivenPoints(np.ascontiguousarray(positions.reshape(-1, 3)),
                            None if rows is None else np.ascontiguousarray(rows.reshape(-1, 3)),
                            np.ascontiguousarray(np.broadcast_to(sizes, shape).reshape(-1)), shape)

    def _median_radius(self) -> float:
        if self._radius is None:
            self._radius = _core.median_radius(self._paths)
        return self._radius


def _array(values: ArrayLike, name: str, kind: type) -> np.ndarray:
    array = np.asarray(values, dtype=kind)
    if array.ndim == 0 or array.shape[-1] != 3:
        raise ValueError(f"{name} must have the shape [..., 3], not {list(array.shape)}")
    return array


def _vector(values: Sequence[float] | None, name: str) -> list[float] | None:
    if values is None:
        return None
    array = np.asarray(values, dtype=np.float64)
    if array.shape != (3,) or not np.isfinite(array).all() or not array.any():
        raise ValueError(f"{name} must be a direction: three finite numbers that are not all 0")
    return array.tolist()


def _place(at: tuple[float, float]) -> tuple[float, float]:
    latitude_deg, longitude_deg = at
    return float(latitude_deg), float(longitude_deg)


def _date(date: datetime.date | str) -> tuple[int, int, int]:
    day = datetime.date.fromisoformat(date) if isinstance(date, str) else date
    return day.year, day.month, day.day
