#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""How bakes of tile sets scale: bakes millions of lidar-like points to sets, one size after the other.

    bake.py BIN_DIR TILE.laz FOLDER OUT.json --millions 10,100,300 [-- options for pointrt-bake]

Makes the points of each size with make_lidar in FOLDER, bakes them with `--max-memory 4G --clean off` unless the
options differ, and deletes all but what --keep names: points, set. For each size OUT.json has points, seconds, points
per second, the peak memory of the process, and bytes per point of the input, of the peak disk use beside it, and of the
final set.
"""
import argparse
import json
import os
import pathlib
import shutil
import subprocess
import sys
import threading
import time

POLL_SECONDS = 0.5


def disk_bytes(*folders):
    """Bytes allocated below these folders, except for files that disappear meanwhile."""
    total = 0
    for folder in folders:
        for root, _, names in os.walk(folder):
            for name in names:
                try:
                    total += os.lstat(os.path.join(root, name)).st_blocks * 512
                except OSError:
                    pass
    return total


class DiskPeak(threading.Thread):
    """The largest size of the folders while this ran."""

    def __init__(self, *folders):
        super().__init__(daemon=True)
        self.folders, self.peak, self.ended = folders, 0, threading.Event()

    def run(self):
        while not self.ended.wait(POLL_SECONDS):
            self.peak = max(self.peak, disk_bytes(*self.folders))

    def end(self):
        self.ended.set()
        self.join()
        return max(self.peak, disk_bytes(*self.folders))


def make_points(options, million, points):
    command = [options.bin / "make_lidar", options.tile, str(million * 1_000_000), points]
    subprocess.run(command, check=True)


def bake(options, points, output):
    """pointrt-bake's report, seconds, peak memory and peak disk in bytes."""
    work = output.with_name(output.name + ".work")
    defaults = [] if "--max-memory" in options.bake else ["--max-memory", "4G"]
    defaults += [] if "--clean" in options.bake else ["--clean", "off"]
    stats = output.with_suffix(".stats.json")
    command = [options.bin / "pointrt-bake", "-q", points, "-o", output, "--force", "--stats", stats]
    for folder in (output, work):
        shutil.rmtree(folder, ignore_errors=True)  # else an interrupted bake would be continued, in less time
    disk = DiskPeak(output, work)
    disk.start()
    began = time.monotonic()
    process = subprocess.Popen([str(word) for word in command + defaults + options.bake])
    _, status, usage = os.wait4(process.pid, 0)
    seconds = time.monotonic() - began
    if status != 0:
        disk.end()
        sys.exit(f"pointrt-bake ended with {os.waitstatus_to_exitcode(status)}")
    return json.loads(stats.read_text()), seconds, usage.ru_maxrss * 1024, disk.end()


def measure(options, million):
    points, output = options.folder / f"points_{million}", options.folder / f"site_{million}.proset"
    make_points(options, million, points)
    count = million * 1_000_000
    report, seconds, memory, disk = bake(options, points, output)
    row = {"points": count, "seconds": seconds, "points_per_second": count / seconds, "peak_memory_bytes": memory,
           "input_bytes_per_point": disk_bytes(points) / count, "peak_disk_bytes_per_point": disk / count,
           "set_bytes_per_point": disk_bytes(output) / count, "report": report}
    if "points" not in options.keep:
        shutil.rmtree(points)
    if "set" not in options.keep:
        shutil.rmtree(output)
    return row


def show(rows):
    print(f"{'points':>14}{'seconds':>10}{'points/s':>10}{'memory MB':>11}{'input B/pt':>12}{'disk B/pt':>11}{'set B/pt':>10}")
    for row in rows:
        print(f"{row['points']:>14}{row['seconds']:>10.1f}{row['points_per_second']:>10.0f}"
              f"{row['peak_memory_bytes'] / 1e6:>11.0f}{row['input_bytes_per_point']:>12.2f}"
              f"{row['peak_disk_bytes_per_point']:>11.1f}{row['set_bytes_per_point']:>10.1f}", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    for name in ("bin", "tile", "folder", "out"):
        parser.add_argument(name, type=pathlib.Path)
    parser.add_argument("--millions", default="10,100")
    parser.add_argument("--keep", default="", help="points, set, or both with a comma between them")
    words = sys.argv[1:]
    split = words.index("--") if "--" in words else len(words)
    options = parser.parse_args(words[:split])
    options.bake = words[split + 1:]
    options.keep = options.keep.split(",")
    options.folder.mkdir(parents=True, exist_ok=True)
    rows = []
    for million in (int(word) for word in options.millions.split(",")):
        rows.append(measure(options, million))
        options.out.write_text(json.dumps(rows, indent=2) + "\n")
    show(rows)


if __name__ == "__main__":
    main()
