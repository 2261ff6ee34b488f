# SPDX-License-Identifier: Apache-2.0
"""Pictures: layers with the names of this package and of OpenEXR files, and settings as text."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from . import _core


def _exr_name(channels: Sequence[str]) -> str:
    """The layer's name in OpenEXR files: "RGBA", "Z", "N", "direct", "id.splat"."""
    if len(channels) == 1:
        return channels[0]
    return channels[0].rpartition(".")[0] or "".join(channels)


_ROWS = _core.picture_layers()
#: Layers that pictures can have.
LAYERS: tuple[str, ...] = tuple(name for name, _ in _ROWS)
# : OpenEXR's names and ours.
ALIASES = {_exr_name(channels): name for name, channels in _ROWS}


class Picture(dict[str, np.ndarray]):
    """Arrays by layer, rows from the top: [height, width], or [height, width, channels].

    The names in OpenEXR files of ``pointrt-view`` (``RGBA``, ``Z``, ``N``, ``P``, ``id.splat``) work, too.
    """

    def __missing__(self, name: str) -> np.ndarray:
        if ALIASES.get(name, name) == name:
            raise KeyError(name)
        return self[ALIASES[name]]


def setting_text(value: Any) -> str:
    """The value of a setting as on the command line."""
    if isinstance(value, (bool, np.bool_)):
        return "on" if value else "off"
    if isinstance(value, (list, tuple, np.ndarray)):
        return ",".join(setting_text(each) for each in value)
    if isinstance(value, (float, np.floating)):
        return repr(float(value))
    return str(value)
