#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Bakes raw range scans of the Dragon and the Bunny and compares views of three cameras with those of the meshes that
# others made from the same scans.
#   tests/bench/quality/raw.sh BIN_DIR DATA_DIR OUT [--quick] [--only dragon|bunny] [--kept] [--poisson] [--peer M]
# Prints a table: silhouette IoU, normal errors (degrees, mean and 99th percentile), share off in depth, holes per million,
# false surface, floating surface; on the left for all pixels, on the right for those whose truth is within 1 mm of a raw
# point. Then FLIP of the default studio's picture against that of a million points sampled from the mesh.
#   --quick  one camera, 512 pixels a side, no FLIP
#   --kept   keeps the scenes in OUT that are already baked
#   --poisson  also measures screened Poisson reconstruction of the same points with the bake's normals, traced as a mesh,
#            and its seconds (raw/poisson.py; PYTHON names an interpreter that has open3d)
#   --peer M also measures smooth_peers (a target of its own) on the same points: bilateral, mls, jet or wlop; may be
#            repeated
# OUT keeps scenes, pictures and figures (NAME.json); pictures of the meshes are rendered once.
# The environment variable BAKE_OPTIONS is passed to pointrt-bake; FLIP_ENVIRONMENT: see flip.sh (default OUT/flip).
set -euo pipefail
[ $# -ge 3 ] || {
    sed -n '3,18s/^# //p' "$0" >&2
    exit 2
}
here=$(dirname "$(readlink -f "$0")")
bin=$1 data=$2 out=$3
shift 3
only='' size=1024 quick='' kept='' poisson='' peers=()
while [ $# -gt 0 ]; do
    case $1 in
    --quick) quick=1 size=512 ;;
    --only) only=$2 && shift ;;
    --kept) kept=1 ;;
    --poisson) poisson=1 ;;
    --peer) peers+=("$2") && shift ;;
    *) echo "raw.sh: $1: no such option" >&2 && exit 2 ;;
    esac
    shift
done
mkdir -p "$out"
export FLIP_ENVIRONMENT=${FLIP_ENVIRONMENT:-$(readlink -f "$out")/flip}
read -ra bake_options <<<"${BAKE_OPTIONS:-}"

# view SCENE EYE FILE OPTIONS...
view() {
    "$bin/pointrt-view" -q "$1" --eye="$2" --target="$target" --fov 30 --up y --size "${size}x$size" "${@:4}" -o "$3"
}

# flip NAME MESH EYE...: mean over the cameras
flip() {
    local name=$1 mesh=$2 number=0 eye
    shift 2
    [ -e "$out/$name.mesh.pro" ] ||
        "$bin/pointrt-bake" -q "$mesh" --sample 1000000 --force -o "$out/$name.mesh.pro"
    for eye in "$@"; do
        [ -e "$out/$name.mesh.$number.png" ] || view "$out/$name.mesh.pro" "$eye" "$out/$name.mesh.$number.png"
        view "$out/$name.pro" "$eye" "$out/$name.$number.png"
        "$here/flip.sh" "$out/$name.mesh.$number.png" "$out/$name.$number.png"
        number=$((number + 1))
    done | tee "$out/$name.flip.json" |
        awk -F '[:,]' '{ sum += $4 } END { printf "%-24s    FLIP %.4f\n", "", sum / NR }'
}

# asIs NAME SCAN: points and normals without cleaning, so that it does not help the other methods
asIs() {
    local clean=()
    if "$bin/pointrt-bake" --help | grep -- --clean >/dev/null; then clean=(--clean off); fi
    "$bin/pointrt-bake" -q "$2" "${clean[@]}" --force -o "$out/$1.as_is.pro"
    "$bin/dump_splats" "$out/$1.as_is.pro" "$out/$1.as_is.ply"
}

# poisson NAME MESH OPTIONS...
poisson() {
    local name=$1 seconds
    seconds=$("${PYTHON:-python3}" "$here/raw/poisson.py" "$out/$name.as_is.ply" "$out/$name.poisson.ply" | tail -n 1)
    "$bin/compare_raw" "$2" "$out/$name.poisson.ply" "${@:3}" --name "$name poisson $seconds s" \
        --figures "$out/$name.poisson.json"
}

# peer METHOD NAME MESH OPTIONS...: within 2 mm, the optimum of our own projection
peer() {
    local name=$2.$1 clean=() pictures=() seconds eye
    seconds=$("$bin/smooth_peers" "$1" 0.002 "$out/$2.as_is.ply" "$out/$name.ply")
    if "$bin/pointrt-bake" --help | grep -- --clean >/dev/null; then clean=(--clean off); fi
    "$bin/pointrt-bake" -q "$out/$name.ply" "${clean[@]}" --force -o "$out/$name.pro"
    for eye in "${seen_from[@]}"; do
        pictures+=("$out/$name.${#pictures[@]}.exr")
        view "$out/$name.pro" "$eye" "${pictures[-1]}" --spp 1 --integrator normal
    done
    "$bin/compare_raw" "$3" "${pictures[@]}" "${@:4}" --name "$2 $1 $seconds s" --figures "$out/$name.json"
}

# measure NAME SCAN RAW MESH EYE...
measure() {
    local name=$1 scan=$2 raw=$3 mesh=$4 pictures=() eyes=() eye method
    shift 4
    [ -z "$only" ] || [ "$only" = "$name" ] || return 0
    if [ ! -e "$scan" ] || [ ! -e "$mesh" ]; then
        echo "$scan and $mesh: not both there, left out" >&2
        return 0
    fi
    [ -z "$quick" ] || set -- "$1"
    if [ -z "$kept" ] || [ ! -e "$out/$name.pro" ]; then
        "$bin/pointrt-bake" -q "$scan" --force --stats "$out/$name.stats.json" "${bake_options[@]}" -o "$out/$name.pro"
    fi
    for eye in "$@"; do
        pictures+=("$out/$name.${#pictures[@]}.exr")
        eyes+=("--eye=$eye")
        view "$out/$name.pro" "$eye" "${pictures[-1]}" --spp 1 --integrator normal
    done
    # 1.2 mm: 1% of half the meshes' diagonals, 133 and 125 mm, in one number for both
    local judge=("--raw" "$raw" "${eyes[@]}" "--target=$target" --size "$size" --depth-tolerance 0.0012)
    "$bin/compare_raw" "$mesh" "${pictures[@]}" "${judge[@]}" --name "$name" --figures "$out/$name.json"
    seen_from=("$@")
    [ -z "$poisson${peers[*]}" ] || asIs "$name" "$scan"
    [ -z "$poisson" ] || poisson "$name" "$mesh" "${judge[@]}"
    for method in "${peers[@]}"; do peer "$method" "$name" "$mesh" "${judge[@]}"; done
    [ -n "$quick" ] || flip "$name" "$mesh" "$@"
}

target=-0.01,0.12,0
measure dragon "$data/stanford_dragon_raw/dragonStandRight.conf" "$data/stanford_dragon_raw/merged.ply" \
    "$data/stanford_models/dragon_vrip_res2.ply" 0.02,0.20,0.55 0.5,0.25,0.2 -0.4,0.2,0.3
target=-0.02,0.11,0
measure bunny "$data/stanford_bunny_raw/bun.conf" "$data/stanford_bunny_raw/merged.ply" \
    "$data/stanford_bunny_recon/bun_zipper.ply" 0,0.15,0.5 0.35,0.2,0.3 -0.3,0.2,0.35
