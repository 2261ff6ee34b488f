#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""How soon a scan that has not been baked yet is displayed.

    scans.py BIN_DIR SCAN... [--runs N]

Of each scan, medians and ranges of seconds by the clock, and of processor seconds of all processes: to the first coarse
picture in a window without a display; to the file of `pointrt-view SCAN -o a.png`, with an empty cache and again. Fails
if the two files differ."""
import argparse
import json
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

# Until there is a picture, a replay draws 30 frames a second: this one ends in the middle of the full bake.
RECORDING = "pointrt-recording 1 window 1280x720 scale 1\n{frames} quit\n"


def run(command, cache):
    """wall seconds, processor seconds"""
    shaders = os.environ.get("XDG_CACHE_HOME", os.path.expanduser("~/.cache"))  # the driver's cache is kept
    variables = dict(os.environ, XDG_CACHE_HOME=str(cache), XDG_STATE_HOME=str(cache), MESA_SHADER_CACHE_DIR=shaders)
    before, began = os.times(), time.monotonic()
    subprocess.run([str(word) for word in command], env=variables, check=True)
    seconds, after = time.monotonic() - began, os.times()
    return seconds, sum(after[2:4]) - sum(before[2:4])


def first_picture(options, scan, work):
    """wall seconds and processor seconds until the coarse picture is shown"""
    stats, tape = work / "stats.json", work / "tape.txt"
    tape.write_text(RECORDING.format(frames=options.frames))
    run([options.bin / "pointrt-view", scan, "--replay", tape, "--offscreen", "--stats", stats], work / "window")
    seconds = json.loads(stats.read_text())["first_picture_seconds"]
    if seconds < 0:
        sys.exit(f"{scan}: no picture within {options.frames} frames; raise --frames")
    return seconds


def files(options, scan, work):
    """wall and processor seconds, first not cached, then cached"""
    pictures = [work / "first.png", work / "again.png"]
    runs = [run([options.bin / "pointrt-view", "-q", scan, "-o", picture], work / "file") for picture in pictures]
    if pictures[0].read_bytes() != pictures[1].read_bytes():
        sys.exit(f"{scan}: the two pictures differ")
    return runs


def spread(values):
    low, middle, high = (f"{each:.1f}" for each in (min(values), statistics.median(values), max(values)))
    return f"{middle} ({low} to {high})" if len(values) > 1 else middle


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bin", type=pathlib.Path)
    parser.add_argument("scans", nargs="+", type=pathlib.Path)
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("--frames", type=int, default=300)
    parser.add_argument("--coarse", action="store_true", help="the window's first picture alone")
    options = parser.parse_args()
    for scan in options.scans:
        coarse, first, again = [], [], []
        for _ in range(options.runs):
            with tempfile.TemporaryDirectory() as work:
                coarse.append(first_picture(options, scan, pathlib.Path(work)))
                if not options.coarse:
                    cold, kept = files(options, scan, pathlib.Path(work))
                    first.append(cold)
                    again.append(kept)
        print(f"{scan.name}: coarse picture {spread(coarse)} s")
        for name, runs in (("not cached", first), ("cached", again)):
            if runs:
                clock, processor = zip(*runs)
                print(f"  file, {name}: {spread(clock)} s, processors {spread(processor)} s")


if __name__ == "__main__":
    main()
