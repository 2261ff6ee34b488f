# SPDX-License-Identifier: Apache-2.0
"""Pictures: layers by the names of this package and by those of OpenEXR files, and settings as words."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from . import _core


def _exr_name(channels: Sequence[str]) -> str:
    """What OpenEXR's users call the layer: "RGBA", "Z", "N", "direct", "id.splat"."""
    if len(channels) == 1:
        return channels[0]
    return channels[0].rpartition(".")[0] or "".join(channels)


_ROWS = _core.picture_layers()
#: All layers that pictures can have.
LAYERS: tuple[str, ...] = tuple(name for name, _ in _ROWS)
#: OpenEXR's name to ours.
ALIASES = {_exr_name(channels): name for name, channels in _ROWS}


class Picture(dict[str, np.ndarray]):
    """Arrays by layer, rows from the top: [height, width], or [height, width, channels].

    What OpenEXR files of ``pointrt-view`` call them (``RGBA``, ``Z``, ``N``, ``P``, ``id.splat``) is found as well.
    """

    def __missing__(self, name: str) -> np.ndarray:
        if ALIASES.get(name, name) == name:
            raise KeyError(name)
        return self[ALIASES[name]]


def setting_text(value: Any) -> str:
    """A setting's value as the command line spells it."""
    if isinstance(value, (bool, np.bool_)):
        return "on" if value else "off"
    if isinstance(value, (list, tuple, np.ndarray)):
        return ",".join(setting_text(each) for each in value)
    if isinstance(value, (float, np.floating)):
        return repr(float(value))
    return str(value)
