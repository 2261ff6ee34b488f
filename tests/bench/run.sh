#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Bakes each scan and times its rendering. Writes figures to OUT.json, an array with an object for each scan.
#   tests/bench/run.sh BIN_DIR OUT.json SCAN...
# The environment variables VIEW_OPTIONS and BAKE_OPTIONS are passed to the tools.
# With --json, speed/run.sh times our tracer against Embree's on standard scenes instead:
#   tests/bench/run.sh --json OUT.json [--sizes "0.25 1 4 16"] [BIN_DIR [DATA_DIR]]
set -euo pipefail
[ "${1:-}" != --json ] || exec "$(dirname "$0")/speed/run.sh" "$@"
[ $# -ge 3 ] || {
    sed -n '3,7s/^# //p' "$0" >&2
    exit 2
}
bin=$1 out=$2
shift 2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# Figures of different machines cannot be compared without this.
processor=$(awk -F ': ' '/^model name/ { print $2; exit }' /proc/cpuinfo)
read -ra view_options <<<"${VIEW_OPTIONS:---size 512x512 --spp 4 --room matte --lights 4}"
read -ra bake_options <<<"${BAKE_OPTIONS:-}"

separator='['
for scan in "$@"; do
    "$bin/pointrt-bake" -q "$scan" --force -o "$folder/scene.pro" --stats "$folder/bake.json" "${bake_options[@]}"
    "$bin/pointrt-view" "$folder/scene.pro" "${view_options[@]}" --bench 5 >"$folder/view.json"
    printf '%s{"scan": "%s", "processor": "%s", "cores": %d, "view_options": "%s",\n"bake": %s,\n"view": %s}' \
        "$separator" "$(basename "$scan")" "$processor" "$(nproc)" "${view_options[*]}" \
        "$(cat "$folder/bake.json")" "$(cat "$folder/view.json")"
    separator=$',\n'
done >"$folder/all.json"
{ cat "$folder/all.json" && echo ']'; } >"$out"
echo "figures: $out"
