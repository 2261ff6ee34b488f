# SPDX-License-Identifier: Apache-2.0
"""Hits of rays, with the names of this package and of Open3D's RaycastingScene."""

from __future__ import annotations

import numpy as np

# : Open3D's names and ours.
ALIASES = {"geometry_ids": "instance_ids", "primitive_ids": "splat_ids", "primitive_normals": "normals"}


class Hits(dict[str, np.ndarray]):
    """Arrays by name, whose shapes start with the shape of the rays.

    Open3D's names ``geometry_ids``, ``primitive_ids`` and ``primitive_normals`` work, too.
    """

    def __missing__(self, name: str) -> np.ndarray:
        if name not in ALIASES:
            raise KeyError(name)
        return self[ALIASES[name]]
