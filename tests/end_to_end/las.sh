#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Scans as LAS and LAZ: out of pointrt-info, through the bake, and out again.
# shellcheck source=lib.sh
. "$(dirname "$0")/lib.sh"

# A sphere in a national grid, with attributes that LAS knows and one that it does not.
scan() {
    printf 'ply\nformat ascii 1.0\nelement vertex %s\n' "$1"
    printf 'property double x\nproperty double y\nproperty double z\n'
    printf 'property uchar red\nproperty uchar green\nproperty uchar blue\n'
    printf 'property uchar classification\nproperty ushort intensity\nproperty float depth\nend_header\n'
    sphere "$1" | awk '{ print $1 + 500000, $2 + 4000000, $3, NR % 256, 7, 9, ($3 > 0 ? 2 : 6), NR - 1, NR / 8 }'
}

# hasLaz: whether this build packs points.
hasLaz() {
    scan 10 >ten.ply
    pointrt-bake -q ten.ply -o out/ten.pro --outliers keep
    run pointrt-info out/ten.pro --export out/ten.laz
    [ "$status" != 3 ]
}

# roundTrip SUFFIX: what comes out of a bake of what came out is the same to the bit.
roundTrip() {
    scan 2000 >scan.ply
    expectDone pointrt-bake -q scan.ply -o out/first.pro --outliers keep
    expectDone pointrt-info out/first.pro --export "out/first.$1"
    expectDone pointrt-bake -q "out/first.$1" -o out/second.pro --outliers keep --stats stats.json
    [ "$(jsonValue stats.json input_points)" = 2000 ] || fail "not all points came out"
    expectDone pointrt-info out/second.pro --export "out/second.$1"
    cmp "out/first.$1" "out/second.$1" || fail "the second export is another file"
    pointrt-info out/second.pro --json >info.json
    grep -q '"name": "depth"' info.json || fail "an attribute that LAS does not know is gone"
    grep -q '"name": "rgb16"' info.json || fail "no colours"
}

case_las_there_and_back() { roundTrip las; }

case_laz_there_and_back() {
    hasLaz || skip "this build has no LAZ"
    roundTrip laz
}

case_overwrites_only_with_force() {
    scan 500 >scan.ply
    pointrt-bake -q scan.ply -o out/scene.pro
    echo precious >out/points.las
    expectError 4 "out/points.las: " pointrt-info out/scene.pro --export out/points.las
    [ "$(cat out/points.las)" = precious ] || fail "the file was overwritten"
    expectDone pointrt-info out/scene.pro --export out/points.las --force
    expectError 2 "must end in .ply, .las or .laz" pointrt-info out/scene.pro --export out/points.e57
}

runCase "$@"
