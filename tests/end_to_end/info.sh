#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# pointrt-info on good files and on broken ones.
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

# Bytes are overwritten one at a time across the file; a changed checksum or a broken structure, each is a finding.
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

case_export_overwrites_only_with_force() {
    bakeSphere
    echo precious >out/splats.ply
    expectError 4 "out/splats.ply: " pointrt-info out/scene.pro --export out/splats.ply
    [ "$(cat out/splats.ply)" = precious ] || fail "the file was overwritten"
    expectDone pointrt-info out/scene.pro --export out/splats.ply --force
}

runCase "$@"
