#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# pointrt-info with valid and with damaged files.
# shellcheck source=lib.sh
. "$(dirname "$0")/lib.sh"

bakeSphere() {
    sphere 3000 >sphere.xyz
    pointrt-bake -q sphere.xyz -o out/scene.pro --stats stats.json
}

case_help_and_wrong_usage() {
    expectDone pointrt-info --help
    expectError 2 "" pointrt-info
    expectError 2 "frobnicate" pointrt-info out/scene.pro --frobnicate
    expectError 1 "missing.pro: " pointrt-info missing.pro
}

case_summary_and_json() {
    bakeSphere
    expectDone pointrt-info out/scene.pro
    [ -s stdout ] || fail "it says nothing"
    expectDone pointrt-info out/scene.pro --json
    [ -n "$(awk -f "$suite_dir/../../.ci/json.awk" stdout)" ] || fail "no JSON"
}

# Overwrites two bytes in turn at several places of the file: each is a finding, of a checksum or of the structure.
case_verify_finds_every_changed_byte() {
    local size place
    bakeSphere
    size=$(stat -c %s out/scene.pro)
    expectDone pointrt-info out/scene.pro --verify
    for place in 0 9 24 70 $((size / 3)) $((size / 2)) $((size - 1)); do
        cp out/scene.pro broken.pro
        printf '\132\245' | dd of=broken.pro bs=1 seek="$place" conv=notrunc status=none
        cmp -s out/scene.pro broken.pro && continue
        run pointrt-info broken.pro --verify
        [ "$status" = 1 ] || fail "byte $place: exit status $status where 1 was expected"
        grep -Eq 'finding [0-9]{4}' stdout stderr || fail "byte $place: no numbered finding"
    done
}

case_export_has_every_splat_once() {
    local splats
    bakeSphere
    splats=$(jsonValue stats.json splats)
    expectDone pointrt-info out/scene.pro --export out/splats.ply
    head -c 2000 out/splats.ply >header.txt # grep -q on a pipe would end its writer by SIGPIPE
    grep -aq "^element vertex $splats\$" header.txt || fail "not $splats vertices"
    grep -aq "radius" header.txt || fail "no radius"
    expectDone pointrt-bake -q out/splats.ply -o out/again.pro --stats again.json
    [ "$(jsonValue again.json input_points)" = "$splats" ] || fail "the export does not read back"
}

# lattice: a PLY of 3D Gaussian splatting with 15 x 15 x 15 Gaussians at whole numbers.
lattice() {
    printf 'ply\nformat ascii 1.0\nelement vertex 3375\n'
    printf 'property float %s\n' x y z f_dc_0 f_dc_1 f_dc_2 opacity scale_0 scale_1 scale_2 rot_0 rot_1 rot_2 rot_3
    printf 'end_header\n'
    awk 'BEGIN { for (i = 0; i < 3375; i++) print i % 15, int(i / 15) % 15, int(i / 225), 0.1, 0.2, 0.3, 1, -2, -2, -2, 1, 0, 0, 0 }'
}

case_sets_export_each_gaussian_once() {
    lattice >lattice.ply
    pointrt-bake -q lattice.ply -o out/lattice.proset --tile-splats 1000
    expectDone pointrt-info out/lattice.proset --export out/back.ply
    # after the header rows of 17 floats, the mean first
    tail -c $((3375 * 68)) out/back.ply | od -An -v -t f4 -w68 |
        awk '{ printf "%.0f %.0f %.0f\n", $1, $2, $3 }' | sed 's/-0/0/g' | sort -u >means.txt
    [ "$(wc -l <means.txt)" = 3375 ] || fail "$(wc -l <means.txt) different means of 3375"
    head -3 out/back.ply | grep -x 'element vertex 3375' >/dev/null || fail "$(head -3 out/back.ply) does not announce 3375"
    expectDone pointrt-info out/lattice.proset --export out/back.spz
    pointrt-bake -q out/back.spz -o again.pro --stats again.json
    [ "$(jsonValue again.json input_points)" = 3375 ] || fail "the SPZ does not read back"
}

case_export_overwrites_only_with_force() {
    bakeSphere
    echo precious >out/splats.ply
    expectError 4 "out/splats.ply: " pointrt-info out/scene.pro --export out/splats.ply
    [ "$(cat out/splats.ply)" = precious ] || fail "the file was overwritten"
    expectDone pointrt-info out/scene.pro --export out/splats.ply --force
}

bakeSet() {
    sphere 4000 >sphere.xyz
    pointrt-bake -q sphere.xyz -o out/site.proset --tile-splats 1000
}

# breakSet COMMAND ...: copies the set to broken.proset and runs COMMAND in that folder.
breakSet() {
    rm -rf broken.proset
    cp -r out/site.proset broken.proset
    (cd broken.proset && "$@")
}

swapTiles() {
    local tiles=(tiles/0-*.pro)
    mv "${tiles[0]}" x && mv "${tiles[1]}" "${tiles[0]}" && mv x "${tiles[1]}"
}

case_sets_are_summarised_and_exported() {
    local splats
    bakeSet
    expectDone pointrt-info out/site.proset
    grep -q "tile set version 1" stdout || fail "the summary does not say that it is a set"
    expectDone pointrt-info out/site.proset --json
    cp stdout set.json
    splats=$(jsonValue set.json splats)
    expectDone pointrt-info out/site.proset --export out/splats.ply
    head -c 2000 out/splats.ply >header.txt
    grep -aq "^element vertex $splats\$" header.txt || fail "not $splats vertices"
    expectDone pointrt-bake -q out/splats.ply -o out/again.pro --stats again.json
    [ "$(jsonValue again.json input_points)" = "$splats" ] || fail "the export does not read back"
}

case_broken_tiles_of_sets_are_found() {
    bakeSet
    breakSet swapTiles
    run pointrt-info broken.proset --verify
    [ "$status" = 1 ] || fail "exit status $status of swapped tiles"
    [ "$(grep -c "0-.*\.pro: finding: .*set.json.*(" stdout)" = 2 ] || fail "$(cat stdout)"
    breakSet sh -c 'truncate -s 5000 tiles/1-*.pro'
    run pointrt-info broken.proset --verify
    [ "$status" = 1 ] || fail "exit status $status of truncated tiles"
    grep -q "1-.*\.pro: finding: .*(5000 bytes" stdout || fail "$(cat stdout)"
    breakSet sh -c 'rm tiles/0-*'
    expectError 1 "No such file" pointrt-info broken.proset --export lost.ply
    [ ! -e lost.ply ] || fail "a part was exported"
    # without its root, the set has no tile to replace missing ones
    breakSet rm "$(grep -o 'tiles/[^"]*\.pro' out/site.proset/set.json | sed -n 1p)"
    expectError 1 "broken.proset/tiles/" pointrt-view broken.proset -o lost.png
}

case_broken_set_files_are_one_line() {
    local line="broken.proset/set.json: line "
    bakeSet
    breakSet truncate -s 700 set.json
    expectError 1 "$line" pointrt-info broken.proset
    expectError 1 "$line" pointrt-info broken.proset --verify
    expectError 1 "$line" pointrt-info broken.proset --export lost.ply
    expectError 1 "$line" pointrt-view broken.proset -o lost.png
    breakSet truncate -s 1G set.json
    expectError 1 "broken.proset/set.json: .*1073741824 bytes" pointrt-info broken.proset
    breakSet sh -c 'head -c 5000000 /dev/zero | tr "\\0" "[" >set.json'
    expectError 1 "broken.proset/set.json: " pointrt-view broken.proset -o lost.png
    breakSet rm set.json
    expectError 1 "broken.proset/set.json: No such file" pointrt-info broken.proset
}

runCase "$@"
