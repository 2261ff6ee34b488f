#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""How fast scans are read, compared with laspy (with lazrs) and pye57: a table in Markdown.

  rates.py BIN_DIR FILE... [--runs N] [--cores 1,2] [--json OUT.json]

Each reader reads each file N times (5), alternating with the others, each time in a new process limited to that many
cores.
Prints medians, in millions of points per second, and per second of a core, which other work on the machine hardly
affects. BIN_DIR's read_scan is timed from the file to the points and attributes that a bake starts with. The others are
timed to arrays with coordinates that are integers (laspy) or without the pose (pye57), and "in place" to coordinates in
the file's frame; loading Python does not count. "over" is the peak memory of read_scan minus the points kept, including
the program and the resident part of the mapped file.
Needs numpy, laspy, lazrs and pye57 (PyPI), and taskset.
"""
import argparse
import json
import os
import statistics
import subprocess
import sys
import time


class Clock:
    """Wall time and processor time since its creation."""

    def __init__(self):
        self.wall, self.cpu = time.perf_counter(), time.process_time()

    def since(self):
        return {"seconds": time.perf_counter() - self.wall, "cpu_seconds": time.process_time() - self.cpu}


def time_laspy(path):
    import laspy
    import lazrs  # noqa: F401, loaded before the clock starts
    start = Clock()
    las = laspy.read(path)
    unpacked = start.since()
    las.xyz
    return {"points": len(las.points), **unpacked, "whole_seconds": start.since()["seconds"]}


def time_pye57(path):
    import others
    import pye57
    start = Clock()
    file = pye57.E57(path)
    raws = [others.e57_columns(file, scan) for scan in range(file.scan_count)]
    unpacked = start.since()
    for scan, raw in enumerate(raws):
        others.e57_world(file, scan, raw)
    points = sum(len(next(iter(raw.values()))) for raw in raws)
    return {"points": points, **unpacked, "whole_seconds": start.since()["seconds"]}


OTHERS = {".las": ("laspy", time_laspy), ".laz": ("laspy", time_laspy), ".e57": ("pye57", time_pye57)}


def held(cores, command):
    """The output of a command that runs on the first cores of the machine, that many."""
    which = ",".join(str(core) for core in sorted(os.sched_getaffinity(0))[:cores])
    return json.loads(subprocess.run(["taskset", "-c", which] + command, check=True, capture_output=True).stdout)


def ours(bin_dir, path, cores):
    return held(cores, [os.path.join(bin_dir, "read_scan"), path])


def theirs(path, cores):
    return held(cores, [sys.executable, os.path.abspath(__file__), "--one", path])


def measure(bin_dir, path, cores, runs):
    other = OTHERS.get(os.path.splitext(path)[1].lower())
    mine, yours = [], []
    for _ in range(runs):
        mine.append(ours(bin_dir, path, cores))
        if other:
            yours.append(theirs(path, cores))
    figures = {"file": path, "cores": cores, "points": mine[0]["points"], "file_bytes": mine[0]["file_bytes"],
               "runs": mine, "over_bytes": max(each["peak_bytes"] - each["cloud_bytes"] for each in mine)}
    if other:
        figures["other"], figures["other_runs"] = other[0], yours
        if yours[0]["points"] != figures["points"]:
            sys.exit("%s: %d points, %s has %d" % (path, figures["points"], other[0], yours[0]["points"]))
    return figures


def rate(figures, runs, which):
    """Million points per second of the median run."""
    return figures["points"] / 1e6 / statistics.median(run[which] for run in figures[runs])


def processor():
    with open("/proc/cpuinfo") as file:
        for line in file:
            if line.startswith("model name"):
                return line.split(":", 1)[1].strip()
    return "unknown processor"


def print_table(all_figures):
    print("%s, %d cores, medians of %d runs\n" % (processor(), os.cpu_count(), len(all_figures[0]["runs"])))
    head = ["file", "million points", "MB", "cores", "ours", "a core-second", "MB/s", "other", "other's",
            "a core-second", "in place", "times", "over, MB"]
    print("| " + " | ".join(head) + " |\n" + "|---" * len(head) + "|")
    for figures in all_figures:
        mine = rate(figures, "runs", "seconds")
        row = [os.path.basename(figures["file"]), "%.2f" % (figures["points"] / 1e6),
               "%.0f" % (figures["file_bytes"] / 1e6), str(figures["cores"]), "%.2f" % mine,
               "%.2f" % rate(figures, "runs", "cpu_seconds"),
               "%.0f" % (figures["file_bytes"] / figures["points"] * mine)]
        if "other" in figures:
            yours = rate(figures, "other_runs", "seconds")
            in_place = rate(figures, "other_runs", "whole_seconds")
            row += [figures["other"], "%.2f" % yours, "%.2f" % rate(figures, "other_runs", "cpu_seconds"),
                    "%.2f" % in_place, "%.2f / %.2f" % (mine / yours, mine / in_place)]
        else:
            row += [""] * 5
        row.append("%.0f" % (figures["over_bytes"] / 1e6))
        print("| " + " | ".join(row) + " |")


def main():
    if len(sys.argv) == 3 and sys.argv[1] == "--one":
        print(json.dumps(OTHERS[os.path.splitext(sys.argv[2])[1].lower()][1](sys.argv[2])))
        return
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bin_dir")
    parser.add_argument("files", nargs="+")
    parser.add_argument("--runs", type=int, default=5)
    parser.add_argument("--cores", default="1,2")
    parser.add_argument("--json")
    arguments = parser.parse_args()
    all_figures = [measure(arguments.bin_dir, path, int(cores), arguments.runs)
                   for path in arguments.files for cores in arguments.cores.split(",")]
    print_table(all_figures)
    if arguments.json:
        with open(arguments.json, "w") as file:
            json.dump(all_figures, file, indent=1)


if __name__ == "__main__":
    main()
