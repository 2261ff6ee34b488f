#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# How bakes scale: 1, 4 and 16 million points of one mesh in random order, without and with normals; medians of 3 bakes,
# for 16 million points of one. Writes figures to OUT.json, an object for each size and kind.
#   tests/bench/bake_rate.sh BIN_DIR MESH OUT.json
# 16 million points without normals take about 4 GB of memory, and 1 GB in TMPDIR. Environment variables: MILLIONS
# (default "1 4 16"), and BAKE_OPTIONS for pointrt-bake.
set -euo pipefail
[ $# = 3 ] || {
    sed -n '3,7s/^# //p' "$0" >&2
    exit 2
}
bin=$1 mesh=$2 out=$3
: >"$out" # fails at once if it cannot be written
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
read -ra millions <<<"${MILLIONS:-1 4 16}"
read -ra bake_options <<<"${BAKE_OPTIONS:-}"

# bakes COUNT: bakes the points COUNT times and prints the reports.
bakes() {
    local count=$1 run
    for ((run = 0; run < count; ++run)); do
        "$bin/pointrt-bake" -q "$folder/points.ply" --force "${bake_options[@]}" -o "$folder/scene.pro" --stats -
    done
}

for million in "${millions[@]}"; do
    for kind in bare normals; do
        options=()
        [ "$kind" = bare ] || options=(--normals)
        "$bin/make_points" "$mesh" $((million * 1000000)) "$folder/points.ply" "${options[@]}"
        runs=3
        [ "$million" -lt 16 ] || runs=1
        echo "$million million, $kind" >&2
        bakes "$runs" >"$folder/$million.$kind.json"
    done
done

python3 - "$folder" "$out" "${millions[@]}" <<'PYTHON'
import json, statistics, sys

def reports(path):
    text, decoder = open(path).read().strip(), json.JSONDecoder()
    while text:
        report, end = decoder.raw_decode(text)
        text = text[end:].lstrip()
        yield report

def summary(bakes):
    points = bakes[0]["input_points"]
    seconds = {stage: statistics.median(b["seconds"][stage] for b in bakes) for stage in bakes[0]["seconds"]}
    return {"points": points, "bakes": len(bakes), "points_per_second": points / seconds["total"],
            "seconds": seconds, "peak_bytes_per_point": max(b["peak_rss_bytes"] for b in bakes) / points,
            "reports": bakes}

folder, out, *millions = sys.argv[1:]
figures = {"%s M %s" % (million, kind): summary(list(reports("%s/%s.%s.json" % (folder, million, kind))))
           for million in millions for kind in ("bare", "normals")}
with open(out, "w") as file:
    json.dump(figures, file, indent=2)
stages = list(dict.fromkeys(stage for f in figures.values() for stage in f["seconds"]))
print("%-14s%10s%10s" % ("points", "points/s", "bytes/pt") + "".join("%11s" % stage[:10] for stage in stages))
for name, f in figures.items():
    print("%-14s%10.0f%10.0f" % (name, f["points_per_second"], f["peak_bytes_per_point"])
          + "".join("%11.2f" % f["seconds"].get(stage, 0) for stage in stages))
PYTHON
echo "figures: $out"
