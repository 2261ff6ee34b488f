#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Scans as LAS and LAZ: exported by pointrt-info, baked, and exported again.
# shellcheck source=lib.sh
. "$(dirname "$0")/lib.sh"

# scan COUNT: prints a sphere in a national grid as PLY, with attributes that LAS has and one that it does not have.
scan() {
    printf 'ply\nformat ascii 1.0\nelement vertex %s\n' "$1"
    printf 'property double x\nproperty double y\nproperty double z\n'
    printf 'property uchar red\nproperty uchar green\nproperty uchar blue\n'
    printf 'property uchar classification\nproperty ushort intensity\nproperty float depth\nend_header\n'
    sphere "$1" | awk '{ printf "%.6f %.6f %s %d 7 9 %d %d %g\n", $1 + 500000, $2 + 4000000, $3, NR % 256, ($3 > 0 ? 2 : 6), NR - 1, NR / 8 }'
}

# hasLaz: whether this build writes LAZ.
hasLaz() {
    scan 10 >ten.ply
    pointrt-bake -q ten.ply -o out/ten.pro --outliers keep
    run pointrt-info out/ten.pro --export out/ten.laz
    [ "$status" != 3 ]
}

# attributesOf FILE.pro: names, types, ranges and histograms of its attributes.
attributesOf() { pointrt-info "$1" --json | awk '/^  "attributes":/ { on = 1 } on; /^  \],/ { on = 0 }'; }

# roundTrip SUFFIX: exports a scan, bakes the export, and repeats that: attributes must not change.
roundTrip() {
    local name
    scan 2000 >scan.ply
    expectDone pointrt-bake -q scan.ply -o out/first.pro --outliers keep
    expectDone pointrt-info out/first.pro --export "out/first.$1"
    expectDone pointrt-bake -q "out/first.$1" -o out/second.pro --outliers keep --stats stats.json
    [ "$(jsonValue stats.json input_points)" = 2000 ] || fail "not all points came out"
    expectDone pointrt-info out/second.pro --export "out/second.$1"
    expectDone pointrt-bake -q "out/second.$1" -o out/third.pro --outliers keep
    attributesOf out/second.pro >second.txt
    attributesOf out/third.pro >third.txt
    cmp second.txt third.txt || fail "attributes have changed"
    for name in depth rgb16 intensity classification; do
        grep -q "\"name\": \"$name\"" second.txt || fail "no $name"
    done
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
    expectError 2 "out/points.xyz: --export " pointrt-info out/scene.pro --export out/points.xyz
}

runCase "$@"
