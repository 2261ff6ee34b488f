#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Makes corpus/ anew of what the tests write, and of what is listed here: for each target the smallest files, of which
# its program for libFuzzer, where there is one, keeps those that reach what no other does.
#   make_corpus.sh TESTS_BIN [FUZZERS_BIN]      such as build/dev/bin build/fuzz/bin
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../.." && pwd)
tests=$(cd "$1" && pwd)
fuzzers=${2:+$(cd "$2" && pwd)}
largest=8000 # bytes of a file; what is larger is fuzzed too slowly
most=24      # files of a target that no program has chosen

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir "$work/kept" "$work/seeds"
cc -shared -fPIC -O1 -o "$work/keep_files.so" "$here/keep_files.c"

# keepFiles TEST [ARGUMENT...]: what it writes, to kept/; it may fail for want of a device.
keepFiles() {
    (cd "$work" && KEEP_FILES=$work/kept LD_PRELOAD=$work/keep_files.so "$tests/$1" "${@:2}" >"$work/log" 2>&1) ||
        echo "make_corpus.sh: $1 has failed" >&2
}

# seed TARGET NAME: standard input as a seed.
seed() {
    mkdir -p "$work/seeds/$1"
    cat >"$work/seeds/$1/$2"
}

# seedsOf TARGET PATTERN...: of kept/ those whose names match.
seedsOf() {
    local target=$1 pattern file
    shift
    for pattern in "$@"; do
        for file in "$work"/kept/$pattern; do
            if [ -f "$file" ]; then seed "$target" "$(basename "$file")" <"$file"; fi
        done
    done
}

# twoFiles FIRST SECOND: as fuzz_target.h has them.
twoFiles() {
    local size
    size=$(stat -c %s "$1")
    # shellcheck disable=SC2059 # two bytes
    printf "\\x$(printf %02x $((size % 256)))\\x$(printf %02x $((size / 256)))"
    cat "$1" "$2"
}

keepFiles test_input
keepFiles test_scanfile
keepFiles test_points
keepFiles test_set
keepFiles test_camera_lists
keepFiles test_lidar
keepFiles test_sets --gtest_filter='*ToldInALine*'
keepFiles test_rays_command
keepFiles test_runtime_host --gtest_filter='*Image*:*Film*:*Record*:*Env*'

for suffix in ply pcd e57 ptx obj off splat spz conf; do seedsOf "scan_$suffix" "*.$suffix"; done
seedsOf scan_las '*.las' '*.laz'
seedsOf points '*.ply' '*.las' '*.laz'
seedsOf scan_xyz '*.xyz' '*.pts' '*.asc' '*.csv'
seedsOf scan_draco '*.drc'
seedsOf scan '*.gz' '*.stl' '*.zip' '*.gltf'
for target in "$work"/seeds/scan_*; do # one or two of each kind
    for file in $(find "$target" -type f -size "-$((largest))c" | sort | head -2); do seed scan "$(basename "$file")" <"$file"; done
done
seedsOf tile_set '*set.json'
for file in "$work"/kept/*plan.json; do
    # no sample beside it: the hash of nothing
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
for file in "$root"/docs/*.toml "$root"/docs/pictures/*.toml; do seed scene "$(basename "$file")" <"$file"; done
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
