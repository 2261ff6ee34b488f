#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Renders the pictures of README and docs/GALLERY.md: docs/gallery/render.sh DATA [NAME...]. DATA holds, from public sources:
#   dragon/dragonStandRight.conf, happy/happyStandRight.conf   range scans, Stanford 3D Scanning Repository
#   autzen.laz         airborne lidar, 3.8 M points, PDAL/data (entwine/data/binary), CC BY 4.0
#   lion.ply           stone lion, potree/potree (pointclouds/lion_takanawa)
#   nefertiti.obj      bust, alecjacobson/common-3d-test-models (data)
#   indoor.laz         building from within, visgl/loaders.gl (modules/las/test/data)
#   stadium.laz        Autzen Stadium, a crop of the same scan as autzen.laz
#   pc_tree.txt        tree, rTLS (inst/extdata)
#   playbot            Gaussian capture by Stephane Agullo as a SOG folder, CC BY 4.0
# POINTRT_BIN: the tools (default: build/release/bin). Needs cwebp. 40 minutes on two cores.
set -euo pipefail
data=$(cd "${1:?usage: docs/gallery/render.sh DATA [NAME...]}" && pwd)
shift
cd "$(dirname "$0")"
bin=$(realpath "${POINTRT_BIN:-../../build/release/bin}")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cp ./*.toml window.txt "$work"

# bake SCAN NAME [OPTION...]: once, also for several pictures
bake() { [ -e "$work/$2.pro" ] || "$bin/pointrt-bake" "$data/$1" -o "$work/$2.pro" "${@:3}"; }
# view NAME SOURCE [OPTION...]: pointrt-view SOURCE to NAME.webp
view() {
    "$bin/pointrt-view" "$work/$2" -o "$work/$1.png" "${@:3}"
    keep "$1"
}
keep() { cwebp -quiet -m 6 -q 88 "$work/$1.png" -o "$1.webp"; }

[ $# -gt 0 ] || set -- dragon buddha statue evening lion garden tree building hall sun normals window
for picture in "$@"; do
    case $picture in
    dragon)
        bake dragon/dragonStandRight.conf dragon
        view dragon dragon.toml --size 1600x1000 --spp 64
        ;;
    buddha)
        bake happy/happyStandRight.conf buddha
        view buddha buddha.pro --room mirror --bounces 10 --lights 4 --spp 16 --size 1600x1600
        ;;
    statue)
        bake nefertiti.obj nefertiti --sample 1200000
        view statue statue.toml --size 1600x1000 --spp 48
        ;;
    evening)
        bake autzen.laz autzen
        view evening evening.toml --size 1600x1000 --spp 32
        ;;
    lion)
        bake lion.ply lion
        view lion lion.toml --size 1600x1000 --spp 32
        ;;
    garden)
        bake playbot playbot
        view garden garden.toml --size 1600x1000 --spp 16
        ;;
    tree)
        bake pc_tree.txt tree
        view tree tree.toml --size 1600x1000 --spp 32
        ;;
    building)
        bake indoor.laz indoor
        view building building.toml --size 1600x1000 --spp 16
        ;;
    hall)
        bake indoor.laz indoor
        view hall hall.toml --size 1600x1000 --spp 16
        ;;
    sun)
        bake stadium.laz stadium --up z
        "$bin/pointrt-rays" sun "$work/stadium.pro" --at 44.058,-123.068 --date 2026-12-21 --every 30 -o "$work/winter.pro"
        view sun winter.pro --view iso --size 1600x1000 --color-by sun_hours --color-map inferno --legend on
        ;;
    normals)
        bake lion.ply lion
        view normals lion.pro --integrator normal --size 1600x1000
        ;;
    window)
        bake lion.ply lion
        (cd "$work" && "$bin/pointrt-view" lion.toml --replay window.txt --offscreen)
        keep window
        ;;
    *)
        echo "no picture named $picture" >&2
        exit 2
        ;;
    esac
done
