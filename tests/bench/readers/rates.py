#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""How fast scans are read, beside laspy with lazrs and pye57: a table in Markdown.

  rates.py BIN_DIR FILE... [--runs N] [--cores 1,2] [--json OUT.json]

Each reader reads each file N times (5), the readers in turn, each time in a process of its own that is held to so many
cores; medians are printed, in millions of points a second. read_scan of BIN_DIR goes from the file to the points and
attributes that a bake starts with. The others are timed as far as they unpack the file into arrays, in which
coordinates are whole numbers still (laspy) or not yet turned by the pose (pye57); loading Python does not count.
"over" is the most memory that read_scan had beyond the points kept and the file, which is mapped.
Needs numpy, laspy, lazrs and pye57 (PyPI), and taskset.
"""
import argparse
import json
import os
import statistics
import subprocess
import sys
import time


def time_laspy(path):
    import laspy
    import lazrs  # noqa: F401, loaded before the clock starts
    start = time.perf_counter()
    las = laspy.read(path)
    return len(las.points), time.perf_counter() - start


def time_pye57(path):
    import others
    import pye57
    start = time.perf_counter()
    file = pye57.E57(path)
    points = 0
    for scan in range(file.scan_count):
        arrays = others.e57_columns(file, scan)
        points += len(next(iter(arrays.values())))
    return points, time.perf_counter() - start


OTHERS = {".las": ("laspy", time_laspy), ".laz": ("laspy", time_laspy), ".e57": ("pye57", time_pye57)}


def held(cores, command):
    """What a command prints, run on the first so many of the cores that there are."""
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
               "seconds": [each["seconds"] for each in mine],
               "over_bytes": max(each["peak_bytes"] - each["cloud_bytes"] - each["file_bytes"] for each in mine)}
    if other:
        figures["other"], figures["other_seconds"] = other[0], [each["seconds"] for each in yours]
        if yours[0]["points"] != figures["points"]:
            sys.exit("%s: %d points, %s has %d" % (path, figures["points"], other[0], yours[0]["points"]))
    return figures


def processor():
    with open("/proc/cpuinfo") as file:
        for line in file:
            if line.startswith("model name"):
                return line.split(":", 1)[1].strip()
    return "unknown processor"


def print_table(all_figures):
    print("%s, %d cores, medians of %d runs\n" %
          (processor(), os.cpu_count(), len(all_figures[0]["seconds"])))
    print("| file | million points | MB | cores | ours, M points/s | MB/s | other | other, M points/s | times | over, MB |")
    print("|---|---|---|---|---|---|---|---|---|---|")
    for figures in all_figures:
        seconds, points = statistics.median(figures["seconds"]), figures["points"]
        row = [os.path.basename(figures["file"]), "%.2f" % (points / 1e6), "%.0f" % (figures["file_bytes"] / 1e6),
               str(figures["cores"]), "%.2f" % (points / 1e6 / seconds),
               "%.0f" % (figures["file_bytes"] / 1e6 / seconds)]
        if "other" in figures:
            theirs_median = statistics.median(figures["other_seconds"])
            row += [figures["other"], "%.2f" % (points / 1e6 / theirs_median), "%.2f" % (theirs_median / seconds)]
        else:
            row += ["", "", ""]
        row.append("%.0f" % (figures["over_bytes"] / 1e6))
        print("| " + " | ".join(row) + " |")


def main():
    if len(sys.argv) == 3 and sys.argv[1] == "--one":
        points, seconds = OTHERS[os.path.splitext(sys.argv[2])[1].lower()][1](sys.argv[2])
        print(json.dumps({"points": points, "seconds": seconds}))
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
