#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""How fast a tile set without an index opens, compared with the same set with an index.

    open.py BIN_DIR WITH_INDEX.proset COMPACT.proset [--runs N] [-- options for pointrt-view]

Opens each set in a window without a display, in turn: the one with an index; the compact one without an index cache
("off"), with an empty cache ("cold"), and again ("kept"). Prints medians and ranges of the seconds to the first picture
and to a sample with all tiles of the cut, of the peak memory, and the bytes in the cache."""
import argparse
import json
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

RECORDING = "pointrt-recording 1 window 1280x720 scale 1\n0 wait 1\n1 quit\n"


def folder_bytes(folder):
    return sum(path.stat().st_size for path in pathlib.Path(folder).rglob("*") if path.is_file())


def open_set(options, path, cache, work, size):
    """first picture, all tiles (seconds), peak memory (bytes)"""
    stats, tape = work / "stats.json", work / "tape.txt"
    tape.write_text(RECORDING)
    shaders = os.environ.get("XDG_CACHE_HOME", os.path.expanduser("~/.cache"))  # the driver's cache is kept
    variables = dict(os.environ, XDG_CACHE_HOME=str(cache), MESA_SHADER_CACHE_DIR=shaders)
    variables["POINTRT_INDEX_CACHE"] = size
    command = [options.bin / "pointrt-view", path, "--replay", tape, "--offscreen", "--stats", stats, *options.view]
    began = time.monotonic()
    process = subprocess.Popen([str(word) for word in command], env=variables)
    _, status, usage = os.wait4(process.pid, 0)
    seconds = time.monotonic() - began
    if status != 0:
        sys.exit(f"pointrt-view ended with {os.waitstatus_to_exitcode(status)}")
    return json.loads(stats.read_text())["first_picture_seconds"], seconds, usage.ru_maxrss


def spread(values, scale=1.0, digits=2):
    low, middle, high = (f"{scale * each:.{digits}f}" for each in (min(values), statistics.median(values), max(values)))
    return f"{middle} ({low} to {high})"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    for name in ("bin", "shipped", "compact"):
        parser.add_argument(name, type=pathlib.Path)
    parser.add_argument("--runs", type=int, default=5)
    words = sys.argv[1:]
    split = words.index("--") if "--" in words else len(words)
    options = parser.parse_args(words[:split])
    options.view = words[split + 1:]
    rows = {"with index": [], "off": [], "cold": [], "kept": []}
    kept_bytes = 0
    for _ in range(options.runs):
        with tempfile.TemporaryDirectory() as work:
            work = pathlib.Path(work)
            for row, runs in rows.items():
                path = options.shipped if row == "with index" else options.compact
                runs.append(open_set(options, path, work / "cache", work, "off" if row == "off" else "8G"))
            kept_bytes = folder_bytes(work / "cache")
    print(f"{'':12}{'first picture, s':>24}{'all tiles, s':>24}{'peak memory, MB':>20}")
    for row, runs in rows.items():
        first, whole, memory = zip(*runs)
        print(f"{row:12}{spread(first):>24}{spread(whole):>24}{spread(memory, 1e-3, 0):>20}")
    print(f"kept: {kept_bytes} bytes; on disk: with index {folder_bytes(options.shipped)}, compact {folder_bytes(options.compact)}")


if __name__ == "__main__":
    main()
