# SPDX-License-Identifier: Apache-2.0
"""What rays have hit, by the names of this package and by those of Open3D's RaycastingScene."""

from __future__ import annotations

import numpy as np

#: Open3D's name to ours.
ALIASES = {"geometry_ids": "instance_ids", "primitive_ids": "splat_ids", "primitive_normals": "normals"}


class Hits(dict[str, np.ndarray]):
    """Arrays by name, each with the rays' own shape in front.

    ``geometry_ids``, ``primitive_ids`` and ``primitive_normals``, as Open3D calls them, are found as well.
    """

    def __missing__(self, name: str) -> np.ndarray:
        if name not in ALIASES:
            raise KeyError(name)
        return self[ALIASES[name]]
