#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Files without a tracing index: it is built once and cached.
# shellcheck source=lib.sh
. "$(dirname "$0")/lib.sh"

# bakeTwice COUNT NAME: bakes NAME.pro with an index, and NAME_compact.pro without.
bakeTwice() {
    sphere "$1" >"$2.xyz"
    pointrt-bake -q "$2.xyz" -o "$2.pro"
    pointrt-bake -q "$2.xyz" -o "$2_compact.pro" --compact
}

# expectPicture FILE PICTURE SOURCE COUNT: renders FILE; the log must say COUNT times "tracing index SOURCE".
expectPicture() {
    expectDone pointrt-view -v "$1" -o "out/$2.png" --integrator normal --size 96x64 --spp 1 --detail 0
    [ "$(grep -c "tracing index $3" stderr)" = "$4" ] || fail "$1: not $4 times an index $3"
}

samePictures() {
    local each
    for each in "${@:2}"; do cmp "out/$1.png" "out/$each.png" || fail "$each is not the picture of $1"; done
}

case_a_file_is_indexed_once() {
    useCache index
    bakeTwice 5000 ball
    expectPicture ball.pro shipped "from the file" 1
    [ ! -e "$kept" ] || fail "something was kept of a file with an index"
    expectPicture ball_compact.pro built built 1
    [ "$(find "$kept" -type f | wc -l)" = 1 ] || fail "not one file is kept"
    cp ball_compact.pro moved.pro
    expectPicture moved.pro kept cached 1
    samePictures shipped built kept
    expectDone pointrt-info "$(find "$kept" -type f)" --verify
}

case_rays_meet_the_same() {
    local file
    useCache index
    bakeTwice 5000 ball
    awk 'BEGIN { for (i = 0; i < 2000; i++) print 3, i % 40 / 20 - 1, i / 1000 - 1, -1, 0.1, 0.05 }' >rays.txt
    cp ball_compact.pro again.pro
    for file in ball ball_compact again; do
        expectDone pointrt-rays cast "$file.pro" --rays rays.txt -o "out/$file.csv"
    done
    cmp out/ball.csv out/ball_compact.csv || fail "other hits with an index that was built"
    cmp out/ball.csv out/again.csv || fail "other hits with an index that was kept"
    [ "$(find "$kept" -type f | wc -l)" = 1 ] || fail "not one file is kept"
}

# bakeSets TILE_SPLATS: bakes shipped.proset with indices, and compact.proset without.
bakeSets() {
    sphere 20000 >ball.xyz
    pointrt-bake -q ball.xyz -o shipped.proset --tile-splats "$1"
    pointrt-bake -q ball.xyz -o compact.proset --tile-splats "$1" --compact
}

case_a_set_is_indexed_once() {
    local tiles
    useCache index
    bakeSets 2000
    expectDone pointrt-view -v shipped.proset -o out/shipped.png --integrator normal --size 96x64 --spp 1 --detail 0
    tiles=$(grep -c "tracing index from the file" stderr)
    [ "$tiles" -gt 4 ] || fail "there are few tiles"
    expectPicture compact.proset built built "$tiles"
    expectPicture compact.proset kept cached "$tiles"
    ! grep -q "tracing index built" stderr || fail "something was built again"
    samePictures shipped built kept
}

# Only half of such a small memory limit is for tiles. It holds the tiles' files, but not the indices built for them.
case_memory_counts_what_is_built() {
    local each
    useCache index
    bakeSets 5000
    [ "$(du -sb compact.proset | cut -f 1)" -lt 1000000 ] || fail "that does not fit"
    for each in shipped compact; do
        expectDone pointrt-view "$each.proset" -o "out/$each.png" --integrator normal --size 96x64 --spp 1 --detail 0 --memory 2M
        grep -q "$each.proset: coarser .*--detail 0: .* 1 MiB" stderr || fail "$each: it fits"
    done
    expectDone pointrt-view compact.proset -o out/all.png --integrator normal --size 96x64 --spp 1 --detail 0 --memory 40M
    ! grep -q coarser stderr || fail "it does not fit"
}

case_damaged_ones_are_built_again() {
    local file size
    useCache index
    bakeTwice 5000 ball
    expectPicture ball_compact.pro built built 1
    file=$(find "$kept" -type f)
    size=$(stat -c %s "$file")
    printf '\377\377\377\377' | dd of="$file" bs=1 seek=$((size * 6 / 10)) conv=notrunc status=none
    expectPicture ball_compact.pro damaged built 1
    expectPicture ball_compact.pro mended cached 1
    truncate -s $((size / 2)) "$file"
    expectPicture ball_compact.pro short built 1
    cp ball_compact.pro "$file"
    expectPicture ball_compact.pro bare built 1
    expectPicture ball_compact.pro again cached 1
    samePictures built damaged mended short bare again
}

case_no_cache_does_no_harm() {
    local folder
    useCache index
    bakeTwice 5000 ball
    for folder in /dev/null "$PWD/ball.xyz"; do
        XDG_CACHE_HOME=$folder expectPicture ball_compact.pro built built 1
        grep -q "index was not cached: " stderr || fail "$folder: it does not say that nothing is kept"
    done
    POINTRT_INDEX_CACHE=off expectPicture ball_compact.pro off built 1
    POINTRT_INDEX_CACHE=1K expectPicture ball_compact.pro small built 1
    [ -z "$(find cache -type f)" ] || fail "something was kept"
    samePictures built off small
    export POINTRT_INDEX_CACHE=much
    expectError 2 'POINTRT_INDEX_CACHE: "much" ' pointrt-view ball_compact.pro -o out/a.png --size 8x8
}

case_a_disk_that_is_full() {
    local -a namespace=(unshare --user --map-root-user --mount)
    useCache index
    bakeTwice 5000 ball
    mkdir cache
    "${namespace[@]}" true 2>/dev/null || skip "no mounts of one's own here"
    cat >on_small_disk.sh <<'SH'
mount -t tmpfs -o size=256k none cache || exit 77
pointrt-view -v ball_compact.pro -o out/a.png --integrator normal --size 96x64 --spp 1 || exit
[ -z "$(find cache -type f)" ]
SH
    run "${namespace[@]}" bash on_small_disk.sh
    [ "$status" != 77 ] || skip "no file system can be mounted here"
    [ "$status" = 0 ] || fail "exit status $status where 0 was expected"
    grep -q "index was not cached: " stderr || fail "it does not say that nothing is kept"
}

# Cached indices are used even if the cache is read-only.
case_a_cache_that_is_read_only() {
    local -a namespace=(unshare --user --map-root-user --mount)
    useCache index
    bakeTwice 5000 ball
    bakeTwice 5100 other
    mkdir cache
    "${namespace[@]}" true 2>/dev/null || skip "no mounts of one's own here"
    cat >on_read_only_disk.sh <<'SH'
mount -t tmpfs none cache || exit 77
pointrt-view -q ball_compact.pro -o out/a.png --integrator normal --size 96x64 --spp 1 || exit
mount -o remount,ro cache || exit 77
pointrt-view -v ball_compact.pro -o out/b.png --integrator normal --size 96x64 --spp 1 || exit
pointrt-view -v other_compact.pro -o out/c.png --integrator normal --size 96x64 --spp 1
SH
    run "${namespace[@]}" bash on_read_only_disk.sh
    [ "$status" != 77 ] || skip "no file system can be mounted here"
    [ "$status" = 0 ] || fail "exit status $status where 0 was expected"
    grep -q "ball_compact.pro: .*, tracing index cached" stderr || fail "what was kept was not found"
    grep -q "other_compact.pro: .*, tracing index built" stderr || fail "what was not kept was not built"
    grep -q "index was not cached: .*Read-only" stderr || fail "it does not say that nothing is kept"
}

# The cache has room for two of three files.
case_the_longest_unused_goes() {
    local size
    useCache index
    bakeTwice 8000 a
    bakeTwice 8100 b
    bakeTwice 8200 c
    expectPicture a_compact.pro a built 1
    size=$(stat -c %s "$(find "$kept" -type f)")
    export POINTRT_INDEX_CACHE=$((size * 5 / 2))
    expectPicture b_compact.pro b built 1
    expectPicture a_compact.pro a cached 1
    expectPicture c_compact.pro c built 1
    expectPicture a_compact.pro a cached 1
    expectPicture b_compact.pro b built 1
    [ "$(du -sb "$kept" | cut -f 1)" -lt "$POINTRT_INDEX_CACHE" ] || fail "more is kept than may be"
}

case_several_at_once() {
    local each
    local -a running=()
    useCache index
    bakeTwice 20000 ball
    for each in 1 2 3 4; do
        pointrt-view -q ball_compact.pro -o "out/$each.png" --integrator normal --size 96x64 --spp 1 &
        running+=($!)
    done
    for each in "${running[@]}"; do wait "$each" || fail "one of them failed"; done
    samePictures 1 2 3 4
    [ "$(find "$kept" -type f | wc -l)" = 1 ] || fail "not one file is kept"
    expectPicture ball_compact.pro kept cached 1
}

runCase "$@"
