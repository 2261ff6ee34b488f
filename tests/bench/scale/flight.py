#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A recording of a flight over a site: flight.py [FRAMES] > flight.txt, then

    pointrt-view SITE.proset --eye ... --target ... --memory 2G --replay flight.txt --offscreen --stats flight.json

It holds W down, slowly turns the view to the right and back, and takes five screenshots. flight.json has
percentiles of frame times."""
import sys

LOOK_EVERY = 4  # frames between steps of the pointer by a pixel: so slow that most of the picture remains in view
TURN_AFTER = 120  # frames until the direction changes


def main():
    frames = int(sys.argv[1]) if len(sys.argv) > 1 else 600
    x, y, step = 640, 400, 1
    lines = ["pointrt-recording 1 window 1280x720 scale 1", "0 wait 1", f"1 cursor {x} {y}", "2 key down W",
             "2 button down left"]
    for frame in range(3, frames + 3):
        step = -step if frame % TURN_AFTER == 0 else step
        if frame % LOOK_EVERY == 0:
            x += step
            lines.append(f"{frame} cursor {x} {y}")
        if frame % (frames // 5) == 0:
            lines.append(f"{frame} screenshot flight{frame:04d}")
    lines += [f"{frames + 3} button up left", f"{frames + 3} key up W", f"{frames + 4} wait 1",
              f"{frames + 4} screenshot end", f"{frames + 5} quit"]
    print("\n".join(lines))


main()
