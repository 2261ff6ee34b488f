#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Frames that end by time, noise or a signal, and films that are gone on with. That the sum of the parts is the whole
# is tested in tests/runtime/film/test_film_resume.cpp.
# shellcheck source=lib.sh
. "$(dirname "$0")/lib.sh"

bakeSphere() {
    sphere 3000 >sphere.xyz
    pointrt-bake -q sphere.xyz -o scene.pro
}

# view ARGUMENT...: a small path-traced picture.
view=(pointrt-view scene.pro --size 32x32 --integrator path)

samplesOf() { jsonValue "$1" samples; }

case_time_limit() {
    bakeSphere
    # the first time that a driver makes the programs may take the whole second; it keeps them
    expectDone "${view[@]}" -q --spp 1 -o out/a.png
    expectDone "${view[@]}" -q --time-limit 1 -o out/a.png --stats stats.json
    [ "$(samplesOf stats.json)" -gt 1 ] || fail "one sample in a second"
    # how late it may be is the machine's affair: without the limit it would be minutes
    awk -v ms="$(jsonValue stats.json frame_ms.max)" 'BEGIN { exit !(ms > 500 && ms < 20000) }' || fail "not a second"
    expectDone "${view[@]}" -q --time-limit 0.000001 -o out/a.png --stats stats.json
    [ "$(samplesOf stats.json)" = 1 ] || fail "one sample was expected"
    expectDone "${view[@]}" -q --time-limit 100 --spp 3 -o out/a.png --stats stats.json
    [ "$(samplesOf stats.json)" = 3 ] || fail "--spp is not the most"
}

case_noise_target() {
    bakeSphere
    expectDone "${view[@]}" -v --noise 0.1 -o out/a.png --stats stats.json
    awk -v noise="$(jsonValue stats.json noise)" 'BEGIN { exit !(noise > 0.05 && noise <= 0.1) }' || fail "not the noise"
    grep -q "noise 0\." stderr || fail "the progress does not tell the noise"
    expectDone "${view[@]}" -q --noise 0.0001 --spp 9 -o out/a.png --stats stats.json
    [ "$(samplesOf stats.json)" = 9 ] || fail "--spp is not the most"
}

case_resume() {
    bakeSphere
    expectDone "${view[@]}" -q --spp 8 --resume -o out/a.exr --stats stats.json
    [ "$(samplesOf stats.json)" = 8 ] || fail "no new film where there was none"
    expectDone "${view[@]}" -q --spp 24 --resume -o out/a.exr --stats stats.json
    [ "$(samplesOf stats.json)" = 24 ] || fail "not 24 samples in all"
    [ "$(jsonValue stats.json rays.primary)" = $((32 * 32 * 16)) ] || fail "not 16 samples in this run"
    cp out/a.exr before.exr
    expectDone "${view[@]}" --spp 24 --resume -o out/a.exr --stats stats.json
    grep -q "nothing to do" stderr || fail "it does not say that there is nothing to do"
    [ "$(samplesOf stats.json)" = 24 ] || fail "not the samples of the film"
    [ "$(jsonValue stats.json rays.primary)" = 0 ] || fail "rays for nothing"
    cmp before.exr out/a.exr
    expectDone "${view[@]}" -q --noise 0.9 --resume -o out/a.exr
    cmp before.exr out/a.exr
    expectDone "${view[@]}" -q --time-limit 0.000001 --resume -o out/a.exr --stats stats.json
    [ "$(samplesOf stats.json)" = 25 ] || fail "one sample more was expected"
    expectDone "${view[@]}" -q --spp 2 -o out/a.exr --stats stats.json
    [ "$(samplesOf stats.json)" = 2 ] || fail "without --resume a film begins anew"
}

case_resume_refuses_another_film() {
    bakeSphere
    expectDone "${view[@]}" -q --spp 2 -o out/a.exr
    cp out/a.exr before.exr
    expectError 1 "a.exr: .*seed was 0 and is 1" "${view[@]}" --spp 4 --seed 1 --resume -o out/a.exr
    expectError 1 "a.exr: .*bounces was 4 and is 2" "${view[@]}" --spp 4 --bounces 2 --resume -o out/a.exr
    expectError 1 "a.exr: .*camera was" "${view[@]}" --spp 4 --eye 1,2,3 --resume -o out/a.exr
    sphere 2999 >sphere.xyz
    pointrt-bake -q -f sphere.xyz -o scene.pro
    expectError 1 "a.exr: .*scene was" "${view[@]}" --spp 4 --resume -o out/a.exr
    cmp before.exr out/a.exr
    head -c 500 before.exr >out/a.exr
    expectError 1 "a.exr: " "${view[@]}" --spp 4 --resume -o out/a.exr
}

case_interrupt_saves_the_film() {
    local pid status=0 samples
    bakeSphere
    "${view[@]}" -v --spp 65536 -o out/a.exr --stats stats.json 2>stderr &
    pid=$!
    until grep -q pipeline stderr; do sleep 0.1; done
    sleep 3 # pipelines take some tenths of a second
    kill -TERM "$pid"
    wait "$pid" || status=$?
    [ "$status" = 143 ] || fail "exit status $status where 143, of the signal, was expected"
    grep -q "interrupted at [0-9]* of 65536 samples" stderr || fail "it does not say how far it was"
    samples=$(samplesOf stats.json)
    [ "$samples" -ge 1 ] || fail "no sample was saved"
    expectDone "${view[@]}" -q --spp $((samples + 2)) --resume -o out/a.exr --stats stats.json
    [ "$(samplesOf stats.json)" = $((samples + 2)) ] || fail "the film that was saved is not gone on with"
    [ "$(jsonValue stats.json rays.primary)" = $((32 * 32 * 2)) ] || fail "not two samples in this run"
}

runCase "$@"
