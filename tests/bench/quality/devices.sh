#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Bakes scans of meshes and synthetic scenes by simulated devices (devices/devices.h, devices/cases.cpp), and compares the
# results with what was scanned. Half of the subjects are held out: do not look at them while tuning.
#   tests/bench/quality/devices.sh BIN_DIR DATA_DIR OUT.json [--only DEVICE] [--tuning] [--scans FOLDER]
#   --only DEVICE   triangulation, depth_camera, terrestrial, airborne, spinning or photogrammetry
#   --tuning        without the subjects held out
#   --scans FOLDER  keeps scans, scenes and pictures there, and reuses scans
# Figures are means of two cameras: silhouette IoU; mean normal error of the part scanned, and of its walls, in degrees;
# shares off in depth, without a surface, 3 spacings nearer than the truth, and floating that far from any surface; FLIP of
# lit pictures (NAME.lit.png, NAME.truth.png); share of sightlines that pass through tree crowns, and the true share.
# The environment variable BAKE_OPTIONS is passed to pointrt-bake; FLIP_ENVIRONMENT: see flip.sh.
set -euo pipefail
[ $# -ge 3 ] || {
    sed -n '3,13s/^# //p' "$0" >&2
    exit 2
}
here=$(dirname "$(readlink -f "$0")")
bin=$1 data=$2 out=$3
shift 3
only='' tuning='' scans=''
while [ $# -gt 0 ]; do
    case $1 in
    --only) only=$2 && shift ;;
    --tuning) tuning=1 ;;
    --scans) scans=$2 && shift ;;
    *) echo "devices.sh: $1: no such option" >&2 && exit 2 ;;
    esac
    shift
done
if [ -z "$scans" ]; then
    scans=$(mktemp -d)
    trap 'rm -rf "$scans"' EXIT
fi
mkdir -p "$scans"
scans=$(readlink -f "$scans")
export FLIP_ENVIRONMENT=${FLIP_ENVIRONMENT:-$scans/flip}
read -ra bake_options <<<"${BAKE_OPTIONS:-}"

# measure CASE: leaves CASE/figures.json and CASE/flip.json
measure() {
    local name=$1 folder=$scans/$1 pictures=() eye target up fov size
    mkdir -p "$folder"
    [ -s "$folder/made" ] || "$bin/device_bench" make "$name" "$data" "$folder" >"$folder/made"
    "$bin/pointrt-bake" -q "$(cat "$folder/made")" --force --stats "$folder/stats.json" "${bake_options[@]}" \
        -o "$folder/scene.pro"
    while read -r eye target up fov size; do
        pictures+=("$folder/${#pictures[@]}.exr")
        "$bin/pointrt-view" -q "$folder/scene.pro" --eye="$eye" --target="$target" --up="$up" --fov "$fov" \
            --size "${size}x$size" --spp 1 --integrator normal -o "${pictures[-1]}" </dev/null
    done < <("$bin/device_bench" cameras "$name")
    "$bin/device_bench" judge "$name" "$data" "$(cat "$folder/made")" "${pictures[@]}" >"$folder/figures.json"
    "$here/flip.sh" "${pictures[0]}.truth.png" "${pictures[0]}.lit.png" >"$folder/flip.json" 2>/dev/null ||
        echo "$name: no FLIP here" >&2
}

folders=()
for name in $("$bin/device_bench" list "$only" "$tuning"); do
    measure "$name"
    folders+=("$scans/$name")
done

python3 - "$out" "${folders[@]}" <<'PYTHON'
import json, os, sys

def load(path):
    return json.load(open(path)) if os.path.getsize(path) else None

def mean(views, *path):
    values = []
    for view in views:
        for key in path:
            view = view.get(key) if view is not None else None
        if view is not None:
            values.append(view)
    return sum(values) / len(values) if values else None

report = []
for folder in sys.argv[2:]:
    figures, flip, stats = (load("%s/%s.json" % (folder, name)) for name in ("figures", "flip", "stats"))
    figures.update(flip=flip[0]["mean"] if flip else None, points=stats["input_points"],
                   bake_seconds=stats["seconds"]["total"])
    report.append(figures)
json.dump(report, open(sys.argv[1], "w"), indent=1)

COLUMNS = [("IoU", 1, ("all", "outline_iou")), ("normal", 1, ("seen", "normal_mean")),
           ("walls", 1, ("wall_normal_mean",)), ("depth%", 100, ("seen", "depth_off")),
           ("holes%", 1e-4, ("seen", "holes_per_million")), ("false%", 100, ("all", "false_surface")),
           ("float%", 100, ("all", "floating")), ("gap%", 100, ("gap",)), ("truth%", 100, ("gap_truth",))]
print("%-28s%9s" % ("device_subject", "points") + "".join("%8s" % title for title, _, _ in COLUMNS) + "    FLIP  bake s")
for row in report:
    line = "%-28s%9d" % (row["device"] + "_" + row["subject"] + (" held out" if row["held_out"] else ""), row["points"])
    for _, factor, path in COLUMNS:
        value = mean(row["views"], *path)
        line += "%8s" % "-" if value is None else "%8.3f" % (factor * value)
    print(line + ("%8.4f" % row["flip"] if row["flip"] is not None else "%8s" % "-") + "%8.1f" % row["bake_seconds"])
PYTHON
echo "figures: $out"
