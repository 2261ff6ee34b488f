#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Effect of pruning on pictures: bakes SCAN with --prune off and on, renders both alike, and prints their FLIP.
# Means below 0.001 are invisible.
#   tests/bench/quality/prune_flip.sh BIN_DIR SCAN OUT.json
# The environment variable BAKE_OPTIONS is passed to both bakes, FLIP to flip.sh.
set -euo pipefail
[ $# = 3 ] || {
    sed -n '3,6s/^# //p' "$0" >&2
    exit 2
}
bin=$1 scan=$2 out=$3
here=$(dirname "$0")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
export FLIP_ENVIRONMENT=${FLIP_ENVIRONMENT:-$folder/flip} # one for all pictures
read -ra bake_options <<<"${BAKE_OPTIONS:-}"

for prune in off on; do
    "$bin/pointrt-bake" -q "$scan" --prune "$prune" "${bake_options[@]}" -o "$folder/$prune.pro"
done

# A close-up from above and to the side: the camera is a quarter of the longest edge in front of the object, a fifth of the
# default view's distance.
read -r target eye < <("$bin/pointrt-info" --json "$folder/off.pro" | python3 -c '
import json, sys
info = json.load(sys.stdin)
low, high = info["bounds_min"], info["bounds_max"]
middle = [(a + b) / 2 for a, b in zip(low, high)]
half = max(b - a for a, b in zip(low, high)) / 2
target = [middle[0], middle[1] + half / 4, high[2]]
eye = [target[0] + half / 4, target[1] + half / 4, high[2] + half / 2]
print("%s,%s,%s %s,%s,%s" % (*target, *eye))')

separator='['
compare() {
    local name=$1
    shift
    for prune in off on; do
        "$bin/pointrt-view" -q "$folder/$prune.pro" --size 512x512 --spp 4 --seed 1 "$@" -o "$folder/$name.$prune.png"
    done
    printf '%s{"view": "%s", "options": "%s", "flip": %s}' "$separator" "$name" "$*" \
        "$("$here/flip.sh" "$folder/$name.off.png" "$folder/$name.on.png")"
    separator=$',\n'
}
{
    compare matte --room matte --lights 4
    compare mirror --room mirror --bounces 10
    compare close --room matte --lights 4 --eye "$eye" --target "$target"
    echo ']'
} >"$folder/all.json"
printf '{"scan": "%s", "pairs": %s}\n' "$(basename "$scan")" "$(cat "$folder/all.json")" | tee "$out"
