#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Renders the README's pictures: docs/pictures.sh DATA [NAME...], NAME one of dragon, buddha, bust, room, window. DATA holds the
# Stanford range scans of the Dragon (stanford_dragon_raw/dragonStandRight.conf) and the Happy Buddha
# (stanford_happy_raw/happyStandRight.conf), a bust (stanford_models/nefertiti.obj) and a room (pcl/room_scan1.pcd).
# About 5 minutes on two cores.
set -euo pipefail
data=$(cd "${1:?usage: docs/pictures.sh DATA [NAME...]}" && pwd)
shift
cd "$(dirname "$0")/.."
bin=${POINTRT_BIN:-build/release/bin}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cp docs/pictures/*.toml docs/pictures/*.txt "$work"

bake() { "$bin/pointrt-bake" "$data/$1" -o "$work/$2.pro" "${@:3}"; }
view() { "$bin/pointrt-view" "$work/$1" -o "docs/${1%.*}.png" "${@:2}"; }

[ $# -gt 0 ] || set -- dragon buddha bust room window
for picture in "$@"; do
    case $picture in
    dragon)
        bake stanford_dragon_raw/dragonStandRight.conf dragon
        view dragon.toml --spp 96 --denoise off
        ;;
    buddha)
        bake stanford_happy_raw/happyStandRight.conf buddha
        view buddha.pro --room mirror --bounces 10 --lights 4
        ;;
    bust)
        bake stanford_models/nefertiti.obj bust --sample 600000
        view bust.toml --spp 64
        ;;
    room)
        bake pcl/room_scan1.pcd room --neighbors 24
        view room.toml --spp 16
        ;;
    window)
        bake stanford_dragon_raw/dragonStandRight.conf dragon
        (bin=$(realpath "$bin") && cd "$work" && "$bin/pointrt-view" dragon.pro --replay window.txt --offscreen)
        mv "$work/window.png" docs/
        ;;
    *)
        echo "no picture named $picture" >&2
        exit 2
        ;;
    esac
done
