#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# References, sizes and effects of pruning for six scans, baked with --prune off and on: compares first hits with each
# other and with Embree's, and pictures by FLIP. Writes figures to OUT.json, an object for each scan.
#   tests/bench/octree.sh BIN_DIR DATA_DIR OUT.json
# DATA_DIR holds folders of scans as named below; missing ones are skipped with a message.
# Environment variables: RAYS (random ones, and as many grazing ones; default 1000000), BAKE_OPTIONS for pointrt-bake,
# SCANS (paths of other scans in DATA_DIR), FLIP for quality/flip.sh.
set -euo pipefail
[ $# = 3 ] || {
    sed -n '3,8s/^# //p' "$0" >&2
    exit 2
}
bin=$1 data=$2 out=$3
: >"$out" # a place that cannot be written shows at once
here=$(dirname "$0")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
export FLIP_ENVIRONMENT=${FLIP_ENVIRONMENT:-$folder/flip} # one for all pictures
rays=${RAYS:-1000000}
read -ra bake_options <<<"${BAKE_OPTIONS:-}"
scans=(stanford_dragon_raw/dragonStandRight.conf stanford_happy_raw/happyStandRight.conf stanford_bunny_raw/bun.conf
    lion_takanawa/lion_takanawa_normals.ply pcl/samp11-utm.pcd pcl/table_scene_mug_stereo_textured.pcd)
[ -z "${SCANS:-}" ] || read -ra scans <<<"$SCANS"

measure() {
    local scan=$1 prune
    for prune in off on; do
        "$bin/pointrt-bake" -q "$scan" --compact --force --prune "$prune" "${bake_options[@]}" -o "$folder/$prune.pro" \
            --stats "$folder/$prune.json"
    done
    "$bin/count_references" --json "$folder/off.pro" >"$folder/counts.json"
    "$bin/compare_pruning" --json --rays "$rays" "$folder/off.pro" "$folder/on.pro" >"$folder/pruning.json"
    # exit status 1: some differences are unexplained; the figures have their number
    "$bin/compare_embree" --json --rays "$rays" "$folder/off.pro" >"$folder/embree.json" || [ $? = 1 ]
    "$here/quality/prune_flip.sh" "$bin" "$scan" "$folder/flip.json" >/dev/null
    printf '{"bake_full": %s,\n"bake_pruned": %s,\n"counts": %s,\n"pruning": %s,\n"embree": %s,\n"flip": %s}' \
        "$(cat "$folder/off.json")" "$(cat "$folder/on.json")" "$(cat "$folder/counts.json")" \
        "$(cat "$folder/pruning.json")" "$(cat "$folder/embree.json")" "$(cat "$folder/flip.json")"
}

separator='{'
for scan in "${scans[@]}"; do
    if [ ! -e "$data/$scan" ]; then
        echo "$data/$scan: not there, left out" >&2
        continue
    fi
    printf '%s"%s": ' "$separator" "$(basename "${scan%.*}")"
    measure "$data/$scan"
    separator=$',\n'
    echo "$scan" >&2
done >"$folder/all.json"
[ -s "$folder/all.json" ] || {
    echo "$data: none of the scans is there" >&2
    exit 1
}
{ cat "$folder/all.json" && echo '}'; } >"$out"

python3 - "$out" <<'PYTHON'
import json, sys

def at(figures, path):
    for key in path.split("/"):
        figures = figures[key]
    return figures

def table(title, columns, scans):
    print("\n%-22s" % title + "".join("%12s" % name for name, _, _ in columns))
    for scan, figures in scans.items():
        print("%-22.22s" % scan + "".join("%12s" % (form % value(figures)) for _, form, value in columns))

scans = json.load(open(sys.argv[1]))
per_splat = lambda bake, key: lambda f: f[bake][key] / f[bake]["splats"]
column = lambda name, form, path, factor=1: (name, form, lambda f: factor * at(f, path))
table("references a splat", [column("splats", "%d", "counts/splats")] + [
    column(name, "%.2f", "counts/%s/per_splat" % key)
    for name, key in [("disc's box", "disc_box"), ("slab's box", "slab_box"), ("disc", "disc"), ("slab", "slab")]] + [
    ("pruned", "%.2f", per_splat("bake_pruned", "references")),
    ("bytes, full", "%.1f", per_splat("bake_full", "bytes")), ("pruned", "%.1f", per_splat("bake_pruned", "bytes"))],
    scans)
for rays in "random", "grazing":
    table("pruned, " + rays, [column(name, "%.5f", "pruning/%s/%s" % (rays, key), factor) for name, key, factor in [
        ("flat moved %", "flat/moved_along_ray_share", 100), ("blended %", "blended/moved_along_ray_share", 100),
        ("by normal %", "blended/moved_along_normal_share", 100), ("lost %", "hit_to_miss_share", 100),
        ("gained %", "miss_to_hit_share", 100), ("deg p99.9", "blended/normal_p999_deg", 1)]], scans)
table("Embree", [column(name, form, "embree/" + key, factor) for name, form, key, factor in [
    ("random %", "%.5f", "random/agree_share", 100), ("unexplained", "%d", "random/unexplained", 1),
    ("grazing %", "%.5f", "grazing/agree_share", 100), ("unexplained", "%d", "grazing/unexplained", 1)]], scans)
mean = lambda view: lambda f: next(p for p in f["flip"]["pairs"] if p["view"] == view)["flip"][0]["mean"]
table("FLIP mean", [(view, "%.6f", mean(view)) for view in ("matte", "mirror", "close")], scans)
PYTHON
echo "figures: $out"
