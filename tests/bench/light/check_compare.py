# SPDX-License-Identifier: Apache-2.0
"""Checks compare.py with pairs of pictures whose differences are known. run.sh runs it first."""

import numpy as np

import compare
import pictures

SIZE = 128  # several times as wide as FLIP's filters


def flat(color):
    return np.broadcast_to(np.array(color, float), (SIZE, SIZE, 3))


def bump(right, down):
    across, along = np.meshgrid(np.arange(SIZE) - SIZE / 2 - right, np.arange(SIZE) - SIZE / 2 - down)
    return np.exp(-(across**2 + along**2) / SIZE)[..., None] * np.ones(3)


def expect(what, value, known, tolerance):
    if not np.all(np.abs(np.array(value) - known) <= tolerance):
        raise SystemExit(f"check_compare.py: {what} is {value}, not {known}")


noise = np.random.default_rng(0).random((SIZE, SIZE, 3))
expect("FLIP of equal pictures", compare.flip(noise, noise).max(), 0, 0)
# The pair that the metric's colour distance is normalized by.
expect("FLIP of blue and green", compare.flip(flat((0, 0, 1)), flat((0, 1, 0))).mean(), 1, 1e-3)
expect("shift of a moved bump", compare.shift(bump(0, 0), bump(0.3, -0.2)), (0.3, -0.2), 0.01)
# IEC 61966-2-1: linear 0.5 is 188 of 255, and 0.002 lies on the straight piece.
expect("encoded 0.25 at exposure 2", 255 * pictures.encode(flat((0.25,) * 3), 2).mean(), 188, 0.5)
expect("encoded 0.002", pictures.encode(flat((0.002,) * 3), 1).mean(), 0.02584, 1e-6)
twice = compare.measure(flat((0.2,) * 3), flat((0.4,) * 3), 1)[0]
expect("light of twice as much", twice["light"], 2, 1e-6)
print("check_compare.py: the comparison gives the known answers")
