#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Attributes of points, from the scan through the bake to pointrt-info and its exports; options that select points.
# shellcheck source=lib.sh
. "$(dirname "$0")/lib.sh"

# scan COUNT: prints a sphere as PLY, with class 2 in the upper and 6 in the lower half, and the point's index as intensity.
scan() {
    printf 'ply\nformat ascii 1.0\nelement vertex %s\n' "$1"
    printf 'property float x\nproperty float y\nproperty float z\n'
    printf 'property uchar classification\nproperty ushort intensity\nend_header\n'
    sphere "$1" | awk '{ print $0, ($3 > 0 ? 2 : 6), NR - 1 }'
}

# splatsOf FILE.pro: the number of its splats.
splatsOf() {
    pointrt-info "$1" --json >info.json
    jsonValue info.json splats
}

case_are_listed_with_ranges() {
    scan 2000 >scan.ply
    expectDone pointrt-bake -q scan.ply -o out/scene.pro --outliers keep
    pointrt-info out/scene.pro --json >info.json
    [ "$(jsonValue info.json attributes.0.name)" = classification ] || fail "no classification"
    [ "$(jsonValue info.json attributes.0.type)" = uint8 ] || fail "another type"
    [ "$(jsonValue info.json attributes.0.histogram.values.2)" = 1000 ] || fail "not half of the points are of class 2"
    [ "$(jsonValue info.json attributes.1.high)" = 1999 ] || [ "$(jsonValue info.json attributes.1.high)" = 1999.0 ] ||
        fail "another range"
    expectDone pointrt-info out/scene.pro
    grep -Eq '^classification +uint8 +2 ... 6 +2: 50 %, 6: 50 %$' stdout || fail "not in the text"
}

case_come_back_in_input_order() {
    scan 2000 >scan.ply
    expectDone pointrt-bake -q scan.ply -o out/scene.pro --outliers keep
    expectDone pointrt-info out/scene.pro --export out/back.ply
    expectDone pointrt-bake -q out/back.ply -o out/again.pro --outliers keep
    pointrt-info out/again.pro --json >info.json
    [ "$(jsonValue info.json attributes.1.name)" = intensity ] || fail "the export has no intensity"
    [ "$(jsonValue info.json attributes.1.type)" = uint16 ] || fail "another type"
}

case_can_be_chosen() {
    scan 2000 >scan.ply
    expectDone pointrt-bake -q scan.ply -o out/one.pro --attributes intensity
    pointrt-info out/one.pro --json >info.json
    [ "$(jsonValue info.json attributes.0.name)" = intensity ] || fail "not the requested attribute"
    [ -z "$(jsonValue info.json attributes.1.name)" ] || fail "more than the requested attribute"
    expectError 1 "--attributes: .*'intensty'.* 'intensity'.*: classification, intensity" \
        pointrt-bake -q scan.ply -o out/two.pro --attributes intensty
    expectDone pointrt-bake -q scan.ply -o out/none.pro --attributes none
    pointrt-info out/none.pro --json >info.json
    [ -z "$(jsonValue info.json attributes.0.name)" ] || fail "there although none was requested"
    grep -q '"version": "1.4"' info.json || fail "its version is that of its index"
}

case_classes_are_chosen() {
    scan 2000 >scan.ply
    expectDone pointrt-bake -q scan.ply -o out/a.pro --classes 2 --outliers keep --stats a.json
    [ "$(splatsOf out/a.pro)" = 1000 ] || fail "not class 2 alone"
    [ "$(jsonValue a.json points_filtered)" = 1000 ] || fail "the others were not counted"
    expectDone pointrt-bake -q scan.ply -o out/b.pro --drop-classes 0-2,7 --outliers keep
    [ "$(splatsOf out/b.pro)" = 1000 ] || fail "not all but those"
    expectError 2 "--classes: '256' " pointrt-bake scan.ply -o out/c.pro --classes 256
    expectError 2 "--drop-classes: '5-3' " pointrt-bake scan.ply -o out/c.pro --drop-classes 5-3
    expectError 2 "" pointrt-bake scan.ply -o out/c.pro --classes 2 --drop-classes 3
}

case_bounds_thin_and_every() {
    scan 2000 >scan.ply
    expectDone pointrt-bake -q scan.ply -o out/a.pro --bounds -2,-2,0,2,2,2 --outliers keep
    [ "$(splatsOf out/a.pro)" = 1000 ] || fail "not the upper half"
    expectDone pointrt-bake -q scan.ply -o out/b.pro --every 2 --outliers keep
    [ "$(splatsOf out/b.pro)" = 1000 ] || fail "not every second point"
    expectDone pointrt-bake -q scan.ply -o out/c.pro --thin 0.1 --outliers keep
    local thinned
    thinned=$(splatsOf out/c.pro)
    # A unit sphere crosses 1.5 * 4 pi / e^2 = 1885 cells of edge e = 0.1; 2000 points do not lie in all of them.
    [ "$thinned" -gt 900 ] && [ "$thinned" -lt 1885 ] || fail "$thinned points are not one a cell"
    expectError 2 "--bounds: .*6 numbers .*5" pointrt-bake scan.ply -o out/d.pro --bounds 1,2,3,4,5
    expectError 2 "--bounds: in z .*3 .*2" pointrt-bake scan.ply -o out/d.pro --bounds 1,2,3,4,5,2
    expectError 2 "" pointrt-bake scan.ply -o out/d.pro --every 0
    expectError 2 "" pointrt-bake scan.ply -o out/d.pro --thin 0
    expectError 1 "scan.ply: .*2000 .*filters" pointrt-bake -q scan.ply -o out/d.pro --bounds 8,8,8,9,9,9
}

case_transform_moves_and_turns() {
    scan 2000 >scan.ply
    printf '1 0 0 1000\n0 0 -1 2000\n0 1 0 3000\n0 0 0 1\n' >turn.txt
    expectDone pointrt-bake -q scan.ply -o out/a.pro --transform turn.txt --up z --outliers keep
    pointrt-info out/a.pro --json >info.json
    awk -v low="$(jsonValue info.json bounds_min.1)" 'BEGIN { exit !(low > 1998.9 && low < 1999.1) }' || fail "not there"
    [ "$(jsonValue info.json up.2)" = 1 ] || [ "$(jsonValue info.json up.2)" = 1.0 ] || fail "up is not stored"
    printf '1 0 0\n' >short.txt
    expectError 1 "short.txt: .*4x4" pointrt-bake scan.ply -o out/b.pro --transform short.txt
    printf '1 0 0 0 1 0 0 0 0 0 1 0 0 0 0 1\n' >flat.txt
    expectError 1 "flat.txt: .*singular" pointrt-bake scan.ply -o out/b.pro --transform flat.txt
    printf '1 0 0 0 0 1 0 0 0 0 one 0 0 0 0 1\n' >word.txt
    expectError 1 "word.txt:1: .*number" pointrt-bake scan.ply -o out/b.pro --transform word.txt
}

case_up_of_the_command_line() {
    scan 200 >scan.ply
    local up
    for up in x -z; do
        expectDone pointrt-bake -q scan.ply -o "out/up$up.pro" --up "$up"
        expectDone pointrt-info "out/up$up.pro"
        grep -Eq "^up +$up\$" stdout || fail "up is not $up"
    done
    expectError 2 "--up: 'w' " pointrt-bake scan.ply -o out/w.pro --up w
}

case_a_folder_of_tiles() {
    mkdir tiles
    scan 2000 >all.ply
    expectDone pointrt-bake -q all.ply -o out/all.pro --outliers keep
    sphere 2000 | awk 'NR % 2' >tiles/a.xyz
    sphere 2000 | awk 'NR % 2 == 0' >tiles/b.xyz
    echo "who flew this, and when" >tiles/README.txt
    echo nothing >tiles/.hidden.xyz
    expectDone pointrt-bake -v tiles -o out/tiles.pro --outliers keep --stats tiles.json
    [ "$(splatsOf out/tiles.pro)" = 2000 ] || fail "not both tiles"
    [ "$(jsonValue info.json attributes.0.name)" = scan ] || fail "the tiles cannot be distinguished"
    [ "$(jsonValue tiles.json files.1.points)" = 1000 ] || fail "not what was read of each"
    grep -q 'tiles/b.xyz: .*1000 points' stderr || fail "no line for each file"
    mkdir none
    expectError 1 "none: .*folder" pointrt-bake none -o out/none.pro
}

runCase "$@"
