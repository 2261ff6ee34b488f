#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A recording of a motion: motion.py slow|fast|lamp moving|resting. If resting, each screenshot waits for its samples.
Screenshots are named by frame."""
import sys

FRAMES, EVERY, SAMPLES = 40, 8, 4
# where the pointer starts, and its step per frame: orbits of 0.25 and 5 degrees, and the x coordinate of a room's first
# lamp
MOTIONS = {"slow": (500, 300, 1), "fast": (500, 300, 20), "lamp": (1032, 218, 3)}


def main():
    x, y, step = MOTIONS[sys.argv[1]]
    rests = sys.argv[2] == "resting"
    lines = ["pointrt-recording 1 window 1280x720 scale 1", f"0 wait {SAMPLES}", f"1 cursor {x} {y}",
             "2 button down left"]
    for i in range(1, FRAMES + 1):
        frame = i + 2
        lines.append(f"{frame} cursor {x + i * step} {y}")
        if i % EVERY == 0:
            lines += [f"{frame} wait {SAMPLES}"] * rests + [f"{frame} screenshot f{i:03d}"]
    lines += [f"{FRAMES + 3} button up left", f"{FRAMES + 4} wait {SAMPLES}", f"{FRAMES + 4} screenshot end",
              f"{FRAMES + 5} quit"]
    print("\n".join(lines))


main()
