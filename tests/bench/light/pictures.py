# SPDX-License-Identifier: Apache-2.0
"""Reads EXR files and tone maps them."""

import numpy as np
import OpenEXR
from PIL import Image


def readChannels(path, names):
    """(height, width, len(names)) as float64."""
    with OpenEXR.File(str(path), separate_channels=True) as file:
        channels = file.channels()
        missing = [name for name in names if name not in channels]
        if missing:
            raise SystemExit(f"{path}: no channel {', '.join(missing)}; it has {', '.join(channels)}")
        return np.stack([channels[name].pixels.astype(np.float64) for name in names], axis=2)


def hasChannel(path, name):
    with OpenEXR.File(str(path), separate_channels=True) as file:
        return name in file.channels()


def readLight(path, layer=""):
    """Linear RGB, of a layer as "caustic." or of the whole picture."""
    return readChannels(path, [layer + channel for channel in "RGB"])


def encode(linear, exposure):
    """The tone mapping of all comparisons: multiplies by exposure, clips to [0, 1], encodes as sRGB (IEC 61966-2-1)."""
    clipped = np.clip(linear * exposure, 0, 1)
    return np.where(clipped <= 0.0031308, 12.92 * clipped, 1.055 * clipped ** (1 / 2.4) - 0.055)


def writePng(path, encoded):
    """(height, width, 3), already encoded, 0 to 1."""
    Image.fromarray(np.rint(np.clip(encoded, 0, 1) * 255).astype(np.uint8)).save(path)
