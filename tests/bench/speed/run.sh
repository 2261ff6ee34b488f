#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Bakes standard scenes and compares our tracer with Embree's oriented discs by trace_speed: the same rays and cores,
# alternately. Writes figures to OUT.json, an object for each scene and kind of ray, and a table to standard output.
#   tests/bench/speed/run.sh --json OUT.json [--sizes "0.25 1 4 16"] [BIN_DIR [DATA_DIR]]
# The scenes are a mesh sampled at that many million points (the environment variable MESH, or the bunny of Debian's
# glmark2-data, or a sphere), and three scans if DATA_DIR holds the folders named below.
# --sizes "" leaves out the mesh. BIN_DIR is build/release/bin by default.
# The environment variables SPEED_OPTIONS and BAKE_OPTIONS are passed to the tools.
set -euo pipefail
usage() {
    sed -n '5s/^# //p' "$0" >&2
    exit 2
}
out='' sizes='0.25 1 4 16' places=()
while [ $# -gt 0 ]; do
    case $1 in
        --json)
            [ $# -gt 1 ] || usage
            out=$2
            shift
            ;;
        --sizes)
            [ $# -gt 1 ] || usage
            sizes=$2
            shift
            ;;
        -*) usage ;;
        *) places+=("$1") ;;
    esac
    shift
done
if [ -z "$out" ] || [ ${#places[@]} -gt 2 ]; then usage; fi
here=$(dirname "$0")
bin=${places[0]:-$here/../../../build/release/bin} data=${places[1]:-}
for tool in pointrt-bake trace_speed; do
    [ -x "$bin/$tool" ] || {
        echo "$bin/$tool: not there; build it or name BIN_DIR" >&2
        exit 1
    }
done
: >"$out" # a place that cannot be written shows at once
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
read -ra bake_options <<<"${BAKE_OPTIONS:-}"
read -ra speed_options <<<"${SPEED_OPTIONS:-}"
read -ra sizes <<<"$sizes"
mesh=${MESH:-/usr/share/glmark2/models/bunny.obj}
if [ ! -e "$mesh" ]; then
    echo "$mesh: not there, a sphere instead" >&2
    mesh=$folder/sphere.ply
    "$bin/make_shape" sphere "$mesh" >&2
fi

# measure NAME INPUT [OPTION...]: bakes and times one scene, and adds its figures to $folder/all.json.
separator='['
measure() {
    local name=$1 scene=$folder/$1.pro
    shift
    "$bin/pointrt-bake" -q "$@" --force "${bake_options[@]}" -o "$scene"
    "$bin/trace_speed" "$scene" --json "${speed_options[@]}" >"$folder/figures.json"
    rm "$scene"
    # the figures of a scene are a JSON array: drop its brackets to append its entries to the array of all scenes
    { echo "$separator" && sed '1d;$d' "$folder/figures.json"; } >>"$folder/all.json"
    separator=,
    echo "$name" >&2
}

for scan in stanford_dragon_raw/dragonStandRight.conf stanford_happy_raw/happyStandRight.conf pcl/samp11-utm.pcd; do
    [ -n "$data" ] || continue
    if [ -e "$data/$scan" ]; then
        measure "$(basename "${scan%.*}")" "$data/$scan"
    else
        echo "$data/$scan: not there, left out" >&2
    fi
done
for millions in "${sizes[@]}"; do
    samples=$(awk -v m="$millions" 'BEGIN { printf "%.0f", 1e6 * m }')
    name=$(basename "${mesh%.*}")-${millions}M
    measure "$name" "$mesh" --sample "$samples"
done
[ -s "$folder/all.json" ] || {
    echo "no scene to time" >&2
    exit 1
}
{ cat "$folder/all.json" && echo ']'; } >"$out"

python3 - "$out" <<'PYTHON'
import json, sys
figures = json.load(open(sys.argv[1]))
print(figures[0]["device"])
print("%-18s%10s  %-8s%9s%9s%8s%8s%8s%9s%11s%8s%8s" % (
    "scene", "splats", "rays", "Mrays/s", "Embree", "ratio", "min", "max", "blended", "agree %", "B/splat", "Embree"))
for f in figures:
    print("%-18.18s%10d  %-8s%9.2f%9.2f%8.3f%8.3f%8.3f%9.3f%11.4f%8.1f%8.1f" % (
        f["scene"], f["splats"], f["rays"], f["mrays_per_second"], f["embree_mrays_per_second"], f["ratio"],
        f["ratio_min"], f["ratio_max"], f["ratio_blended"], 100 * f["agreement"],
        f["device_bytes_per_splat"], f["embree_bytes_per_splat"]))
PYTHON
echo "figures: $out"
