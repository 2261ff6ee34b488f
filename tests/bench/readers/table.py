#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Reads every file of a folder of scans, and compares the results with truth.json and with other readers.

  table.py BIN_DIR DATA_DIR [--json OUT.json]

Prints a Markdown row for each file: points kept and read, attributes, or the error; what was compared, and what
disagrees. Exits with 1 if anything disagrees or a program crashed. Compares points, extents, colours, normals and faces
with DATA_DIR/truth.json; points, extents to the precision of our floats, and minimum, maximum and sum of each attribute
with laspy and lazrs (LAS, LAZ), pye57 (E57), plyfile (PLY) and open3d (PCD); points and extents with trimesh (meshes and
Cyberware's PLY), DracoPy (colours as well), gdal (ESRI grids), pandas (text), splat-transform and NumPy (Gaussians).
Needs numpy, laspy, lazrs, pye57, plyfile, open3d, trimesh, DracoPy and pandas (PyPI), gdal-bin, and splat-transform (npm)
on PATH or in SPLAT_TRANSFORM.
"""
import argparse
import json
import math
import os
import re
import subprocess
import sys

import others

SKIPPED = re.compile(r"(README.*|MANIFEST\.md|truth\.json)$")

# Files that the reader behind truth.json, or another one, reads differently from their format's definition.
KNOWN = {
    "reports/B20_las14_legacy_count_only.las": "counts its points only where LAS 1.4 keeps the count of older versions; "
                                               "laspy reads the other count, which is 0",
    "reports/B12_id_first.txt": "its first column numbers the points, which pandas takes as x",
    "reports/B15_nodata_9999.xyz": "has 360 points without data, z = -9999, which we leave out",
    "draco/cube_pc.drc": "has normals, which truth.json's reader of Draco point clouds leaves out",
    "ply_odd/pdal_simple_binary.obj": "its normals belong to no vertex",
    "text_formats/bunny16k.pts": "is an Expe point set, no text",
}


def run_ours(bin_dir, path):
    """The JSON of read_scan, or its error."""
    done = subprocess.run([os.path.join(bin_dir, "read_scan"), "--content", path], capture_output=True, text=True,
                          errors="replace", timeout=300)
    if done.returncode == 0:
        return json.loads(done.stdout), None
    line = done.stderr.strip()
    if done.returncode not in (1, 3) or "\n" in line or not line:
        return None, "CRASHED with %d: %s" % (done.returncode, line[:200])
    return None, line.replace("read_scan: error: ", "").replace(path + ": ", "").replace(path, "")


def near(a, b, step):
    return abs(a - b) <= step


def extents_of(text):
    return [tuple(float(end) for end in word.split("..")) for word in text.split() if ".." in word]


def against_truth(ours, truth, theirs):
    """Descriptions of what disagrees."""
    wrong = []
    number = re.match(r"\d+", str(truth["points"]))
    counted = number and "lines" not in str(truth["points"])
    if counted and int(number.group()) != ours["points"]:
        wrong.append("%d points, truth has %s" % (ours["points"], truth["points"]))
    black = "rgb max 0" in truth.get("note", "")  # our reader treats black as no colour
    if truth["col"] is not None and (truth["col"] and not black) != (ours["colors"] is not None):
        wrong.append("colours %s, truth says %s" % (ours["colors"] is not None, truth["col"]))
    # meshes without normals get them from their faces; normals that are all zero are none
    if truth["norm"] is not None and truth["norm"] != ours["normals"] and not (ours["normals"] and ours["faces"]) and \
            not (theirs or {}).get("zero_normals"):
        wrong.append("normals %s, truth says %s" % (ours["normals"], truth["norm"]))
    if counted and (truth["faces"] > 0) != (ours["faces"] > 0):
        wrong.append("%d faces, truth has %s" % (ours["faces"], truth["faces"]))
    extents = extents_of(truth["ext"]) if isinstance(truth["ext"], str) else []
    if len(extents) == 3 and ours["unused"] == 0 and not (theirs or {}).get("gaussians"):
        for axis, (least, most) in zip(range(3), extents):
            mine = ours["positions"][axis]
            # pts has six digits, and float positions seven relative to the cloud's size
            step = 6e-6 * max(abs(least), abs(most), most - least, 1e-12)
            if "min" not in mine or not near(mine["min"], least, step) or not near(mine["max"], most, step):
                wrong.append("%s %s, truth has %g..%g" % ("xyz"[axis], mine, least, most))
    return wrong


def refused_rightly(truth, theirs):
    """Whether the error needs no explanation."""
    if truth is None:
        return theirs is None or not theirs.get("points")
    text = str(truth["points"])
    return text.startswith(("unreadable", "0", "-")) or ("lines" not in text and not extents_of(str(truth["ext"])))


def attribute_differs(mine, yours):
    for key in ("min", "max"):
        if key in yours and not near(mine.get(key, float("nan")), yours[key], 1e-12 * abs(yours[key])):
            return "%s %r, not %r" % (key, mine.get(key), yours[key])
    # sums are of doubles in another order
    if yours.get("sum") is not None and math.isfinite(yours["sum"]) and not near(mine["sum"], yours["sum"], 1e-9 * max(abs(yours["sum"]), yours["size"])):
        return "sum %r, not %r" % (mine["sum"], yours["sum"])
    return None


def against_other(ours, theirs):
    wrong = []
    if theirs.get("gaussians"):
        return wrong  # we leave out nearly transparent splats
    if theirs["points"] != ours["kept"] + ours["unused"] and not theirs.get("uncounted"):
        wrong.append("%d points kept, %s has %d" % (ours["kept"], theirs["reader"], theirs["points"]))
    if ours["unused"] == 0 and theirs["points"] > 0:
        for axis in range(3):
            mine, (least, most) = ours["positions"][axis], theirs["extents"][axis]
            # the 24 bits of floats from the cloud's origin, which is a point of it, and the last bits of doubles
            size = max(abs(each[1] - each[0]) for each in theirs["extents"]) + 1
            step = size * 2.0 ** -23 + theirs.get("relative_step", 1e-15) * max(abs(least), abs(most))
            if not near(mine["min"], least, step) or not near(mine["max"], most, step):
                wrong.append("%s %.9g..%.9g, %s has %.9g..%.9g" % ("xyz"[axis], mine["min"], mine["max"],
                                                                   theirs["reader"], least, most))
    if "colors" in theirs and theirs["colors"] != [channel["sum"] for channel in ours["colors"]]:
        wrong.append("sums of colours %s, %s has %s" % (ours["colors"], theirs["reader"], theirs["colors"]))
    have = {each["name"]: each for each in ours["attributes"]}
    for name, yours in theirs["attributes"].items():
        if name not in have:
            # flags that are 0 in all points, and waveforms, are left out
            if yours["size"] != 0 and name not in others.LAS_WAVEFORM:
                wrong.append("no attribute " + name)
        elif ours["unused"] == 0 and (difference := attribute_differs(have[name], yours)):
            wrong.append("%s: %s" % (name, difference))
    return wrong


def check(bin_dir, data, name, truth):
    path = os.path.join(data, name)
    ours, refusal = run_ours(bin_dir, path)
    theirs, why_not = others.read(path)
    row = {"file": name, "wrong": [], "compared": [], "ours": ours, "refusal": refusal, "other_refusal": why_not}
    if ours is None:
        if refusal.startswith("CRASHED"):
            row["wrong"].append(refusal)
        elif not refused_rightly(truth, theirs) and name not in KNOWN:
            row["wrong"].append("refused, but truth.json or another reader has points")
        return row
    if truth is not None:
        row["compared"].append("truth")
        row["wrong"] += against_truth(ours, truth, theirs)
    if theirs is not None:
        row["compared"].append(theirs["reader"])
        row["wrong"] += against_other(ours, theirs)
    if name in KNOWN and row["wrong"]:
        row["compared"].append("known: " + KNOWN[name])
        row["wrong"] = []
    return row


def print_row(row):
    ours = row["ours"]
    if ours is None:
        print("| %s | refused | | %s | %s | %s |" % (row["file"], row["refusal"].replace("|", "\\|"),
                                                   ", ".join(row["compared"]), "; ".join(row["wrong"]) or "-"))
        return
    attributes = " ".join(each["name"] for each in ours["attributes"])
    kept = str(ours["kept"]) if ours["kept"] == ours["points"] else "%d of %d" % (ours["kept"], ours["points"])
    scans = " in %d scans" % len(ours["scans"]) if len(ours["scans"]) > 1 else ""
    print("| %s | %s | %s%s | %s | %s | %s |" % (row["file"], ours["format"], kept, scans, attributes,
                                               ", ".join(row["compared"]), "; ".join(row["wrong"]) or "-"))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bin_dir")
    parser.add_argument("data_dir")
    parser.add_argument("--json")
    arguments = parser.parse_args()
    with open(os.path.join(arguments.data_dir, "truth.json")) as file:
        truth = json.load(file)
    names = sorted(os.path.relpath(os.path.join(folder, each), arguments.data_dir)
                   for folder, _, files in os.walk(arguments.data_dir) for each in files if not SKIPPED.match(each))
    print("| file | format | points | attributes, or why not | compared with | disagrees |\n|---|---|---|---|---|---|")
    rows = []
    for name in names:
        rows.append(check(arguments.bin_dir, arguments.data_dir, name, truth.get(name)))
        print_row(rows[-1])
    if arguments.json:
        with open(arguments.json, "w") as file:
            json.dump(rows, file, indent=1)
    wrong = [row["file"] for row in rows if row["wrong"]]
    read = sum(row["ours"] is not None for row in rows)
    print("\n%d files, %d read, %d refused, %d disagree%s" %
          (len(rows), read, len(rows) - read, len(wrong), ": " + ", ".join(wrong) if wrong else ""))
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
