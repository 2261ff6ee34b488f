#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Bakes points sampled from known surfaces, without their normals, and compares the splats with the surfaces:
# four shapes of 200,000 samples, four scanned meshes of a million. Writes figures to OUT.json, one object per surface.
#   tests/bench/quality/run.sh BIN_DIR DATA_DIR OUT.json
# DATA_DIR holds stanford_models/ and stanford_bunny_recon/; missing meshes are skipped with a message.
# The environment variable BAKE_OPTIONS is passed to pointrt-bake.
set -euo pipefail
[ $# = 3 ] || {
    sed -n '3,7s/^# //p' "$0" >&2
    exit 2
}
bin=$1 data=$2 out=$3
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
read -ra bake_options <<<"${BAKE_OPTIONS:-}"

separator='{'
measure() {
    local name=$1 mesh=$2 samples=$3
    "$bin/pointrt-bake" -q "$mesh" --force --sample "$samples" --normals estimate "${bake_options[@]}" \
        -o "$folder/scene.pro"
    printf '%s"%s": %s' "$separator" "$name" "$("$bin/compare_truth" --json "$folder/scene.pro" "$mesh")"
    separator=$',\n'
    echo "$name" >&2
}
{
    for shape in sphere torus plate cube; do
        "$bin/make_shape" "$shape" "$folder/$shape.ply" >&2
        measure "$shape" "$folder/$shape.ply" 200000
    done
    for mesh in stanford_models/{dragon_vrip_res2.ply,nefertiti.obj,Lucy100k.ply} stanford_bunny_recon/bun_zipper.ply; do
        if [ -e "$data/$mesh" ]; then
            measure "$(basename "${mesh%.*}")" "$data/$mesh" 1000000
        else
            echo "$data/$mesh: not there, left out" >&2
        fi
    done
    echo '}'
} >"$folder/all.json"
cp "$folder/all.json" "$out"

python3 - "$out" <<'PYTHON'
import json, sys
columns = [("normal mean", "normal_degrees/mean"), ("p99", "normal_degrees/p99"),
           ("smooth mean", "normal_to_smooth_degrees/mean"), (">30 %", "normal_above_30_degrees_share"),
           ("flipped %", "flipped_share"), ("outline r", "views/silhouette_excess_radii"),
           ("holes /M", "views/holes_per_million"), ("bridges /M", "views/bridges_per_million"),
           ("depth r", "views/inside_depth_radii/mean"), ("depth p99", "views/inside_depth_radii/p99")]
print("%-18s" % "surface" + "".join("%12s" % title for title, _ in columns))
for name, figures in json.load(open(sys.argv[1])).items():
    row = "%-18s" % name
    for title, path in columns:
        value = figures
        for key in path.split("/"):
            value = value[key]
        row += "%12.4g" % (100 * value if title.endswith("%") else value)
    print(row)
PYTHON
echo "figures: $out"
