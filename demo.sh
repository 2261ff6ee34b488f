#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# From a scan to a ray-traced picture. Installs what is missing (Debian 12 or 13, root or sudo), builds, bakes, renders.
#   ./demo.sh              the Stanford bunny that Debian ships
#   ./demo.sh SCAN...      your scans, merged into one scene
# The results are in demo/: NAME.pro, NAME.png and the figures as JSON.
set -euo pipefail
case ${1:-} in
    -*)
        sed -n '3,6s/^# //p' "$0"
        [ "$1" = --help ] || [ "$1" = -h ] || exit 2
        exit 0
        ;;
esac
scans=()
for scan in "$@"; do
    case $scan in
        /*) scans+=("$scan") ;;
        *) scans+=("$PWD/$scan") ;;
    esac
done
cd "$(dirname "$0")"
. .ci/common.sh

installPackages build bake view demo
buildPreset release --target pointrt-bake pointrt-view
bin=build/release/bin

bake_options=()
if [ ${#scans[@]} = 0 ]; then
    scans=(/usr/share/glmark2/models/bunny.obj)
    bake_options=(--sample 1000000)
fi
name=$(basename "${scans[0]}")
name=${name%.*}
base=demo/$name
mkdir -p demo

say "baking ${scans[*]}"
"$bin/pointrt-bake" "${scans[@]}" "${bake_options[@]}" --force -o "$base.pro" --stats "$base.bake.json"
say "rendering"
scene=("$base.pro" --size 512x512 --spp 4 --room matte --lights 4)
"$bin/pointrt-view" "${scene[@]}" -o "$base.png"
say "timing"
"$bin/pointrt-view" "${scene[@]}" --bench 3 >"$base.bench.json"

for part in bake bench; do
    awk -f .ci/json.awk "$base.$part.json" | sed "s/^/$part./"
done | awk -f .ci/figures.awk
say "picture: $PWD/$base.png"
