# SPDX-License-Identifier: Apache-2.0
"""minimal.py SCAN.pro X Y Z [PICTURE.npy]

Casts one ray straight down from X Y Z, prints what it hits, and renders a picture of the scan as an array.
"""
import sys

import numpy as np

import pointrt


def main(path, x, y, z, output=None):
    scene = pointrt.Scene(path)  # on the best Vulkan device

    # One ray: its origin and its direction, in the scan's own coordinates. Arrays of shape (..., 6) cast many at once.
    ray = [float(x), float(y), float(z), 0, 0, -1]
    hit = scene.cast_rays(ray)
    if np.isinf(hit["t_hit"]):
        print("no hit")
    else:
        print(f"splat {hit['splat_ids']} at {hit['positions']}, distance {hit['t_hit']:.3f}")

    # A picture of the whole scan, framed automatically: float32 (height, width, 4), linear light, rows from the top.
    picture = scene.render(width=320, height=240, layers=["rgba", "depth"], spp=16)
    linear = np.clip(picture["rgba"][..., :3], 0, 1)
    srgb = np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)
    pixels = np.uint8(255 * srgb + 0.5)
    print(f"picture {pixels.shape} {pixels.dtype}: the scan covers {np.isfinite(picture['depth']).mean():.0%} of it")
    if output:
        np.save(output, pixels)


if __name__ == "__main__":
    if not 5 <= len(sys.argv) <= 6:
        sys.exit(__doc__)
    main(*sys.argv[1:])
