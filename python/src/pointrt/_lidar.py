# SPDX-License-Identifier: Apache-2.0
"""Sensors and trajectories of simulated laser scanners, converted for the core."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from . import _core

#: Numbers of a pose in the core: t, x, y, z, qx, qy, qz, qw.
_POSE_NUMBERS = 8


def sensor_of(sensor: str | os.PathLike[str] | Mapping[str, Any]) -> _core.LidarSensorFile:
    """A sensor from a file, or from a dict with the keys of one."""
    if not isinstance(sensor, Mapping):
        return _core.read_lidar_sensor(os.fspath(sensor))
    try:
        return _core.parse_lidar_sensor(_toml_of(sensor), "sensor")
    except _core.Error as error:
        raise ValueError(str(error)) from None


def poses_of(trajectory: str | os.PathLike[str] | ArrayLike) -> np.ndarray:
    """``[N, 8]`` from a trajectory file or array."""
    if isinstance(trajectory, (str, os.PathLike)):
        return _core.read_lidar_trajectory(os.fspath(trajectory))
    rows = np.array(trajectory, dtype=np.float64)
    if rows.ndim != 2 or rows.shape[1] not in (7, _POSE_NUMBERS):
        raise ValueError("a trajectory must have the shape [N, 8], t x y z qx qy qz qw, or [N, 7], t x y z yaw pitch "
                         f"roll, not {list(rows.shape)}")
    if rows.shape[1] == _POSE_NUMBERS:
        return rows
    rotations = [_core.lidar_rotation(*angles) for angles in rows[:, 4:]]
    return np.ascontiguousarray(np.concatenate([rows[:, :4], np.reshape(rotations, (-1, 4))], axis=1))


def pose_of(pose: ArrayLike) -> np.ndarray:
    """``[1, 8]`` from a position, optionally with yaw, pitch and roll in degrees."""
    numbers = np.array(pose, dtype=np.float64)
    if numbers.shape not in ((3,), (6,)):
        raise ValueError(f"a pose must be x y z or x y z yaw pitch roll, not of the shape {list(numbers.shape)}")
    angles = numbers[3:] if numbers.size == 6 else np.zeros(3)
    return np.array([[0.0, *numbers[:3], *_core.lidar_rotation(*angles)]])


def _toml_of(sensor: Mapping[str, Any]) -> str:
    """The text of a sensor file: keys before tables, as TOML requires."""
    lines = [f"{json.dumps(key)} = {_value_of(value)}\n" for key, value in sensor.items()
             if not isinstance(value, Mapping)]
    for name, table in sensor.items():
        if isinstance(table, Mapping):
            lines.append(f"[{json.dumps(name)}]\n")
            lines += [f"{json.dumps(key)} = {_value_of(value)}\n" for key, value in table.items()]
    return "".join(lines)


def _value_of(value: Any) -> str:
    if isinstance(value, (np.ndarray, np.generic)):
        value = value.tolist()
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(_value_of(each) for each in value) + "]"
    if isinstance(value, os.PathLike):
        value = os.fspath(value)
    if isinstance(value, (bool, str)):
        return json.dumps(value, ensure_ascii=False)
    if isinstance(value, (int, float)):
        return repr(value)
    raise TypeError(f"a sensor has numbers, strings, booleans or lists of these, not {type(value).__name__}")
