#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Rebuilds corpus/ from files that the tests write and from those listed here: the smallest files for each target, of
# which its libFuzzer program, if built, keeps those that add coverage.
#   make_corpus.sh TESTS_BIN [FUZZERS_BIN]      for example build/dev/bin build/fuzz/bin
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../.." && pwd)
tests=$(cd "$1" && pwd)
fuzzers=${2:+$(cd "$2" && pwd)}
largest=8000 # bytes; larger files fuzz too slowly
most=24      # files of a target without a libFuzzer program

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir "$work/kept" "$work/seeds"
cc -shared -fPIC -O1 -o "$work/keep_files.so" "$here/keep_files.c"

# keepFiles TEST [ARGUMENT...]: collects the files that it writes in kept/; it may fail without a device.
keepFiles() {
    (cd "$work" && KEEP_FILES=$work/kept LD_PRELOAD=$work/keep_files.so "$tests/$1" "${@:2}" >"$work/log" 2>&1) ||
        echo "make_corpus.sh: $1 has failed" >&2
}

# seed TARGET NAME: adds standard input as a seed.
seed() {
    mkdir -p "$work/seeds/$1"
    cat >"$work/seeds/$1/$2"
}

# seedsOf TARGET PATTERN...: adds files of kept/ whose names match.
seedsOf() {
    local target=$1 pattern file
    shift
    for pattern in "$@"; do
        for file in "$work"/kept/$pattern; do
            if [ -f "$file" ]; then seed "$target" "$(basename "$file")" <"$file"; fi
        done
    done
}

# twoFiles FIRST SECOND: combines two files as in fuzz_target.h, the size of the first in front.
twoFiles() {
    local size
    size=$(stat -c %s "$1")
    # shellcheck disable=SC2059 # the format has the bytes as escapes
    printf "\\x$(printf %02x $((size % 256)))\\x$(printf %02x $((size / 256)))"
    cat "$1" "$2"
}

keepFiles test_input
keepFiles test_pointio
keepFiles test_set
keepFiles test_pictures
keepFiles test_studies
keepFiles test_tiles --gtest_filter='*InOneLine*'
keepFiles test_rays_command
keepFiles test_runtime_host --gtest_filter='*Image*:*Film*:*Record*:*Env*'

for suffix in ply pcd e57 ptx obj off stl pnts mcap splat spz sog conf; do seedsOf "scan_$suffix" "*.$suffix"; done
seedsOf scan_las '*.las' '*.laz'
seedsOf points '*.ply' '*.las' '*.laz'
seedsOf scan_xyz '*.xyz' '*.pts' '*.asc' '*.csv'
seedsOf scan_draco '*.drc'
seedsOf scan_gltf '*.gltf' '*.glb'
seedsOf scan_vtk '*.vtk' '*.vtp'
seedsOf scan_rosbag '*.bag'
seedsOf scan_numpy '*.npy' '*.npz'
seedsOf scan_geotiff '*.tif'
seedsOf scan_colmap '*points3D.*'
seedsOf scan '*.gz' '*.stl' '*.zip'
for target in "$work"/seeds/scan_*; do # two of each format
    for file in $(find "$target" -type f -size "-$((largest))c" | sort | head -2); do seed scan "$(basename "$file")" <"$file"; done
done
seedsOf tile_set '*set.json'
for file in "$work"/kept/*plan.json; do
    # without sides.bin: the hash of an empty file
    sed 's/"sides":{[^}]*}/"sides":{"count":0,"xxh3":3244421341483603138}/' "$file" | seed plan "$(basename "$file")"
done
seedsOf picture '*.hdr' '*a.exr' '*sky.exr'
seedsOf film '*film.exr'
seedsOf transforms '*transforms*.json'
seedsOf rays '*rays.npy' '*points.npy' '*rays*.csv' '*rays*.txt'
seedsOf trajectory '*path*.csv' '*trajectory*.csv' '*flight*.csv' '*poses*'
seedsOf beams '*beams*.csv'
seedsOf sensor '*.toml'
for file in "$root"/docs/sensors/*.toml; do seed sensor "$(basename "$file")" <"$file"; done
for file in "$root"/docs/*.toml "$root"/docs/gallery/*.toml; do seed scene "$(basename "$file")" <"$file"; done
for file in "$here"/seeds/*/*; do seed "$(basename "$(dirname "$file")")" "$(basename "$file")" <"$file"; done
for kind in bin txt; do
    for file in "$work"/kept/*images.$kind; do
        for other in "$work"/kept/*cameras.$kind; do
            if [ -f "$file" ] && [ -f "$other" ]; then
                twoFiles "$other" "$file" | seed "$([ $kind = bin ] && echo colmap_binary || echo colmap_text)" "$(basename "$file")"
            fi
        done
    done
done

rm -rf "$here/corpus"
for target in "$work"/seeds/*; do
    name=$(basename "$target")
    find "$target" -type f -size "+$((largest - 1))c" -delete
    mkdir -p "$here/corpus/$name"
    if [ -n "$fuzzers" ] && [ -x "$fuzzers/fuzz_$name" ]; then
        "$fuzzers/fuzz_$name" -merge=1 "$here/corpus/$name" "$target" >"$work/log" 2>&1 || tail -5 "$work/log" >&2
    else
        find "$target" -type f -printf '%s %p\n' | sort -n | head -"$most" | while read -r _ file; do
            cp "$file" "$here/corpus/$name/$(sha1sum "$file" | cut -c1-16)"
        done
    fi
done
du -sb "$here"/corpus/* | sort -n
