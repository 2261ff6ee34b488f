# SPDX-License-Identifier: Apache-2.0
"""Scenes: casting rays and rendering pictures."""

from __future__ import annotations

import functools
import operator
import os
import threading
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from . import _core, _lidar
from ._camera import Camera
from ._hits import ALIASES, Hits
from ._measures import Measures
from ._picture import ALIASES as LAYER_ALIASES
from ._picture import Picture, setting_text

#: Fields of hits in the order of the results, with their type and the shape after that of the rays.
_LAYOUT = {
    "t_hit": (np.float64, ()),
    "splat_ids": (np.uint32, ()),
    "instance_ids": (np.uint32, ()),
    "normals": (np.float32, (3,)),
    "positions": (np.float64, (3,)),
    "tile_ids": (np.uint32, ()),
}
FIELDS = tuple(_LAYOUT)

#: Rays between two checks for Ctrl-C: about a second on two cores.
_RAYS_AT_ONCE = 1 << 21

#: Indexed by PRO_TYPE_* - 1.
_TYPES = (np.int8, np.uint8, np.int16, np.uint16, np.int32, np.uint32, np.int64, np.uint64, np.float32, np.float64)


@functools.cache
def _default_device() -> _core.Device:
    return _core.Device()


class Scene(Measures):
    """Scans on a device. Thread-safe.

    Args:
        paths: a ``.pro`` file, a tile set (``.proset``) or a scene file (``.toml``), or several of them. Each file and
            set is an instance; a scene file adds its instances, and its rays are in scene coordinates. Rays hit shapes
            of scene files with ``instance_ids`` 255 and ``splat_ids`` ``NO_HIT``, except backdrops and shapes hidden
            from cameras. Materials and lights do not affect rays.
        device: a ``pointrt.Device`` (default: the best one of this machine, opened once for all scenes).
        memory: memory limit for tiles in bytes (default 2 GiB). A smaller limit reloads tiles as rays need them and
            serializes calls; hits are the same.
        clip: a box ``[6]``, minimum x y z and maximum x y z, or several ``[N, 6]``, in the coordinates of the scene.
            Rays and pictures show only what is inside all of them, and inside the clips of a scene file; shapes and
            lights stay whole (default: everything). At most five boxes.
        only: a filter by attribute, such as ``"class=2,6"`` or the range ``"height=10:25"``, or several: rays and
            pictures show only points that match all of them (default: everything). Scans without the attribute stay
            whole.

    Raises:
        pointrt.Error: a file cannot be read or has the wrong format, or there is no device.
        ValueError: no paths are given, a tile needs more than ``memory``, or a box or filter is invalid.
    """

    def __init__(self, paths: str | os.PathLike[str] | Iterable[str | os.PathLike[str]],
                 device: _core.Device | None = None, *, memory: int = _core.DEFAULT_MEMORY,
                 clip: ArrayLike | None = None, only: str | Iterable[str] = ()):
        several = [paths] if isinstance(paths, (str, os.PathLike)) else list(paths)
        self._device = device or _default_device()
        self._paths = [os.fspath(path) for path in several]
        self._memory = memory
        self._clip = _boxes_of(clip)
        self._only = [only] if isinstance(only, str) else list(only)
        self._scene = _core.Scene(self._device, self._paths, memory, self._clip.tolist(), self._only)
        self._renderer: tuple[dict[str, str], _core.Renderer] | None = None  # renderer of the last settings
        self._renderer_lock = threading.Lock()

    def __len__(self) -> int:
        """Number of splats of all instances."""
        return self._scene.splat_count

    @property
    def clip(self) -> np.ndarray:
        """The boxes that cut the scene, float64 ``[N, 6]``: minimum x y z and maximum x y z."""
        return self._clip.copy()

    @property
    def device_bytes(self) -> int:
        """Device memory of the scene, in bytes."""
        return self._scene.device_bytes

    @property
    def instance_count(self) -> int:
        """Number of instances: files, sets and instances of scene files."""
        return self._scene.instance_count

    @property
    def has_tiles(self) -> bool:
        """Whether any instance is a tile set."""
        return self._scene.has_tiles

    @property
    def tile_loads(self) -> int:
        """Number of tile uploads to the device since the scene was opened."""
        return self._scene.tile_loads

    @property
    def attributes(self) -> tuple[str, ...]:
        """Names of the attributes that all files have for their points."""
        return tuple(name for name, *_ in self._scene.attributes())

    def cast_rays(self, rays: ArrayLike, *, t_min: float = 0.0, t_max: float = np.inf,
                  fields: Sequence[str] | None = None, attributes: Sequence[str] = ()) -> Hits:
        """Finds the first hit of each ray.

        Args:
            rays: ``[..., 6]`` float32 or float64, origin and direction in the scan's coordinates; directions may have
                any length but 0. Accepts any CPU array with ``__dlpack__``.
            t_min, t_max: range of hits, t_min <= t < t_max, in lengths of the direction.
            fields: results to compute; fewer are faster (default: all, ``tile_ids`` only with tile sets).
            attributes: names from ``Scene.attributes`` to add to the results.

        Returns:
            Arrays whose shapes start with that of the rays: ``t_hit`` float64, in lengths of the direction, inf for a
            miss;
            ``splat_ids`` and ``instance_ids`` uint32, 4294967295 for a miss; ``normals`` float32 ``[..., 3]``, unit
            length, towards the origin, 0 for a miss; ``positions`` float64 ``[..., 3]``, NaN for a miss; ``tile_ids``
            uint32, indices into ``tiles`` of ``set.json``, whose files ``splat_ids`` refer to, 4294967295 for hits
            outside tile sets and misses. Attributes with the types of the scan, 0 or NaN for a miss.

        Raises:
            ValueError: rays have the wrong shape; a ray is not finite or has no direction (the message gives its
                index); limits are invalid; a field or attribute is unknown.
            TypeError: rays are neither float32 nor float64.
        """
        rows, shape = _rows_of(rays)
        if fields is None:
            fields = [name for name in FIELDS if name != "tile_ids" or self.has_tiles]
        names = {_field(name) for name in fields}
        kinds = [self._kind_of(name) for name in attributes]
        needed = names | ({"splat_ids", "instance_ids", "tile_ids"} if kinds else set())
        found = {name: np.empty((len(rows), *_LAYOUT[name][1]), _LAYOUT[name][0]) for name in FIELDS if name in needed}
        for part in _parts(len(rows)):
            arrays = [found[name][part] if name in found else None for name in FIELDS]
            self._scene.cast_rays(rows[part], t_min, t_max, part.start, *arrays)
        hits = Hits({name: found[name].reshape(shape + _LAYOUT[name][1]) for name in FIELDS if name in names})
        for name, dtype, components, size in kinds:
            values = self._attribute_at(name, size, found["splat_ids"], found["instance_ids"], found["tile_ids"])
            hits[name] = values.view(dtype).reshape(shape + ((components,) if components > 1 else ()))
        return hits

    def test_occlusions(self, rays: ArrayLike, *, t_min: float = 0.0, t_max: float = np.inf) -> np.ndarray:
        """Tests whether each ray hits anything: bool, with the shape of the rays. Faster than ``cast_rays``.

        Arguments and errors are those of ``cast_rays``.
        """
        rows, shape = _rows_of(rays)
        occluded = np.empty(len(rows), np.uint8)
        for part in _parts(len(rows)):
            self._scene.test_occlusions(rows[part], t_min, t_max, part.start, occluded[part])
        return occluded.view(np.bool_).reshape(shape)

    def simulate_lidar(self, sensor: str | os.PathLike[str] | Mapping[str, Any],
                       trajectory: str | os.PathLike[str] | ArrayLike | None = None, *, pose: ArrayLike | None = None,
                       start: float | None = None, duration: float | None = None, seed: int = 0,
                       metres_per_unit: float = 0.0, attributes: Sequence[str] = ()) -> dict[str, np.ndarray]:
        """Simulates a laser scanner, as ``pointrt-rays lidar`` does.

        Args:
            sensor: a sensor file (TOML, docs/RAYS.md), or a dict with its keys; lengths in metres.
            trajectory: poses over time: a file, or ``[N, 8]`` with t (seconds, increasing) x y z (scan coordinates)
                qx qy qz qw (x forward, y left, z up), or ``[N, 7]`` with t x y z yaw pitch roll (degrees). Defaults to
                that of the sensor file.
            pose: pose of a fixed scanner instead: ``[3]`` x y z, or ``[6]`` with yaw, pitch and roll.
            start, duration: seconds (default: the whole trajectory; for a fixed scanner one rotation, frame or sweep).
            seed: random seed. Equal arguments give equal points.
            metres_per_unit: of the scan's coordinates (default 0: the scan's own, else 1).
            attributes: names from ``Scene.attributes`` to add to the results.

        Returns:
            Arrays of the N returns, sorted by pulse and range: ``positions`` float64 ``[N, 3]``; ``times`` float64, s;
            ``ranges`` float64, in units of the scan; ``intensities`` uint16; ``powers`` float32, 1 for a white surface
            at the reference range; ``incidences_deg`` float32; ``scan_angles_deg`` float32, of an oscillating mirror;
            ``return_numbers`` and ``numbers_of_returns`` uint8; ``rings`` uint16; ``pulses`` uint64; ``splat_ids`` and
            ``instance_ids`` uint32 of the hit, and ``tile_ids`` with tile sets, as in ``cast_rays``.

        Raises:
            pointrt.Error: a file cannot be read or is malformed.
            ValueError: the dict, poses or times are invalid, or an attribute is unknown.
        """
        file = _lidar.sensor_of(sensor)
        if trajectory is not None and pose is not None:
            raise ValueError("trajectory and pose cannot be combined")
        poses = (_lidar.pose_of(pose) if pose is not None else
                 _lidar.poses_of(trajectory) if trajectory is not None else file.poses)
        kinds = [self._kind_of(name) for name in attributes]
        points = _core.simulate_lidar(self._scene, file, poses, start, duration, seed, metres_per_unit)
        for name, dtype, components, size in kinds:
            if name in points:
                raise ValueError(f"{name!r} is already among the results")
            values = self._attribute_at(name, size, points["splat_ids"], points["instance_ids"], points.get("tile_ids"))
            points[name] = values.view(dtype).reshape((-1, components) if components > 1 else (-1,))
        return points

    def _attribute_at(self, name: str, size: int, splat_ids: np.ndarray, instance_ids: np.ndarray,
                      tile_ids: np.ndarray | None) -> np.ndarray:
        values = np.empty(len(splat_ids) * size, np.uint8)
        self._scene.read_attribute(name, splat_ids, instance_ids, tile_ids, values)
        return values

    def render(self, camera: Camera | None = None, width: int = 512, height: int = 512, *,
               layers: Sequence[str] = ("rgba",), **settings: Any) -> Picture:
        """Renders a picture, bit-identical to the OpenEXR file of ``pointrt-view``.

        The first picture, and the first with other settings, uploads the scene once more with lights, materials and
        programs. Further pictures with the same settings start at once.

        Args:
            camera: from ``Camera.look_at`` or ``Camera.from_intrinsics`` (default: a view of the whole scene).
            width, height: pixels, 1 to 16384 each.
            layers: names from ``pointrt.LAYERS``, or those of OpenEXR (``"Z"``, ``"id.splat"``).
            settings: options that ``pointrt-view --help`` lists under "Image" and "Light and surfaces", with ``_`` for
                ``-``: ``integrator`` ("phong", "whitted", "path", "normal", "depth", "ambient"), ``spp``, ``seed``, ``bounces``,
                ``lights``, ``room``, ``shadows``, ``color_by`` and others; ``up``; ``memory``, the limit for tiles
                (default: the scene's); ``staged_for``, the eye that default lights are placed for (default: that of
                the default camera); ``sun``, as ``--sun``. Other lights come from scene files.

        Returns:
            Arrays by layer, float32, or uint32 for IDs, rows from the top. ``rgba`` [height,width,4]: linear light, and
            the coverage of the pixel by the scene; ``depth`` [height,width]: distance from the eye along the ray
            through the pixel's centre, in the scan's unit, inf for a miss; ``normal`` and ``position`` [height,width,3];
            ``direct``, ``indirect``, ``caustic``, ``albedo`` [height,width,3]; ``splat_id``, ``tile_id``,
            ``instance_id``, ``material_id`` [height,width], 4294967295 for a miss; ``samples``, ``variance``.

        Raises:
            ValueError: the camera, size, a layer or a setting is invalid.
            pointrt.Error: the device or the memory is too small.
            KeyboardInterrupt: soon after Ctrl-C.
        """
        view = camera or Camera.look_at()
        names = [LAYER_ALIASES.get(name, name) for name in ([layers] if isinstance(layers, str) else layers)]
        scene = {"memory": self._memory, **({"clip": _text_of(self._clip)} if len(self._clip) else {}),
                 **({"only": " ".join(self._only)} if self._only else {})}
        renderer = self._renderer_for({name: setting_text(value) for name, value in {**scene, **settings}.items()})
        arrays = getattr(renderer, view._method)(*view._arguments, _side(width), _side(height), names)
        return Picture({name: arrays[name] for name in names})

    def section(self, section: str, width: int = 512, height: int = 512, *, layers: Sequence[str] = ("rgba",),
                **settings: Any) -> Picture:
        """Renders a section or a floor plan in true scale: the scene cut open, in parallel projection.

        Args:
            section: as for ``pointrt-view --section``: ``"z=1.2"`` is a plan of what is below that height, ``"y=3"`` and
                ``"x=3"`` are upright sections, ``"x0,y0,x1,y1"`` is one through two points of the plan;
                ``":0.5"`` at the end keeps a slice of that thickness.
            width, height, layers, settings: as for ``render``. The setting ``ortho`` is the picture's height in the
                units of the scan (default: everything that remains fits).

        Returns:
            As ``render``.

        Raises:
            As ``render``; ValueError also if the section is invalid.
        """
        return self.render(None, width, height, layers=layers, section=section, **settings)

    def _renderer_for(self, settings: dict[str, str]) -> _core.Renderer:
        with self._renderer_lock:
            if self._renderer is None or self._renderer[0] != settings:
                self._renderer = None  # frees its device memory before the next renderer allocates
                self._renderer = settings, _core.Renderer(self._device, self._paths, settings)
            return self._renderer[1]

    def _kind_of(self, name: str) -> tuple[str, Any, int, int]:
        for known, kind, components, size in self._scene.attributes():
            if known == name:
                return name, _TYPES[kind - 1], components, size
        raise ValueError(f"the scene has no attribute {name!r}: it has {', '.join(self.attributes) or 'none'}")


def _boxes_of(clip: ArrayLike | None) -> np.ndarray:
    """Clip boxes as [N, 6]; the core checks the numbers."""
    boxes = np.array([] if clip is None else clip, dtype=np.float64)
    if boxes.size and boxes.shape[-1:] != (6,) or boxes.ndim > 2:
        raise ValueError(f"clip must have the shape [6] or [N, 6], not {list(boxes.shape)}")
    return boxes.reshape(-1, 6)


def _text_of(boxes: np.ndarray) -> str:
    """Boxes as values of --clip, separated by spaces."""
    return " ".join(",".join(repr(float(number)) for number in box) for box in boxes)


def _side(pixels: int) -> int:
    """A picture's width or height as uint32; the core checks the limits."""
    return min(max(operator.index(pixels), 0), 2**32 - 1)


def _field(name: str) -> str:
    ours = ALIASES.get(name, name)
    if ours not in FIELDS:
        raise ValueError(f"hits have no field {name!r}: they have {', '.join(FIELDS)}")
    return ours


def _rows_of(rays: ArrayLike) -> tuple[np.ndarray, tuple[int, ...]]:
    """Rays as contiguous rows, and the shape of their results."""
    if hasattr(rays, "dtype") and not isinstance(rays, np.ndarray) and hasattr(rays, "__dlpack__"):
        array = np.from_dlpack(rays)
    elif isinstance(rays, np.ndarray):
        array = rays
    else:
        array = np.asarray(rays, dtype=np.float64)
    if array.dtype not in (np.float32, np.float64):
        raise TypeError(f"rays must be float32 or float64, not {array.dtype}")
    if array.ndim == 0 or array.shape[-1] != 6:
        raise ValueError(f"rays must have the shape [..., 6], not {list(array.shape)}")
    return np.ascontiguousarray(array.reshape(-1, 6)), array.shape[:-1]


def _parts(count: int) -> Iterator[slice]:
    """Slices of the rays, at least one, between which Python handles signals."""
    for begin in range(0, max(count, 1), _RAYS_AT_ONCE):
        yield slice(begin, min(begin + _RAYS_AT_ONCE, count))
