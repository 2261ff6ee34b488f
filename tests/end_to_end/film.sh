#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Frames that end by a time limit, a noise target or a signal, and films that are resumed. That a resumed film equals an
# uninterrupted one is tested in tests/runtime/render/test_film_resume.cpp.
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
    # On the first run the driver may take the whole second to compile the programs, which it caches.
    expectDone "${view[@]}" -q --spp 1 -o out/a.png
    expectDone "${view[@]}" -q --time-limit 1 -o out/a.png --stats stats.json
    [ "$(samplesOf stats.json)" -gt 1 ] || fail "one sample in a second"
    # The bound is wide, as the machine may be busy: without the time limit this frame would take minutes.
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
    grep -q "noise 0\." stderr || fail "the progress does not show the noise"
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
    expectError 1 "a.exr: .*seed .*0 .*1" "${view[@]}" --spp 4 --seed 1 --resume -o out/a.exr
    expectError 1 "a.exr: .*bounces .*4 .*2" "${view[@]}" --spp 4 --bounces 2 --resume -o out/a.exr
    expectError 1 "a.exr: .*camera" "${view[@]}" --spp 4 --eye 1,2,3 --resume -o out/a.exr
    sphere 2999 >sphere.xyz
    pointrt-bake -q -f sphere.xyz -o scene.pro
    expectError 1 "a.exr: .*scene" "${view[@]}" --spp 4 --resume -o out/a.exr
    cmp before.exr out/a.exr
    head -c 500 before.exr >out/a.exr
    expectError 1 "a.exr: " "${view[@]}" --spp 4 --resume -o out/a.exr
}

# untilTracing PID: waits until the viewer, started with -v, has its programs.
untilTracing() {
    until grep -q pipeline stderr; do
        kill -0 "$1" || fail "it ended before it traced: $(tail -n 1 stderr)"
        sleep 0.1
    done
}

# interruptAtWork PICTURE: starts a render of many samples, and ends it by SIGTERM after a few.
interruptAtWork() {
    local pid status=0
    "${view[@]}" -v --spp 65536 -o "$1" --stats stats.json 2>stderr &
    pid=$!
    untilTracing "$pid"
    sleep 3 # pipelines take some tenths of a second
    kill -TERM "$pid"
    wait "$pid" || status=$?
    [ "$status" = 143 ] || fail "exit status $status where 143, of the signal, was expected"
}

case_interrupt_saves_the_film() {
    local samples
    bakeSphere
    interruptAtWork out/a.exr
    grep -q "interrupted at [0-9]* of 65536 samples" stderr || fail "it does not say how far it was"
    samples=$(samplesOf stats.json)
    [ "$samples" -ge 1 ] || fail "no sample was saved"
    expectDone "${view[@]}" -q --spp $((samples + 2)) --resume -o out/a.exr --stats stats.json
    [ "$(samplesOf stats.json)" = $((samples + 2)) ] || fail "the saved film was not resumed"
    [ "$(jsonValue stats.json rays.primary)" = $((32 * 32 * 2)) ] || fail "not two samples in this run"
}

# bakeCrowd: bakes crowd.pro, whose cells list 1700 splats each, 100 times as many as in scans. A sample of 2048x2048
# pixels takes two minutes on two cores.
bakeCrowd() {
    sphere 3000 >crowd.xyz
    pointrt-bake -q --radius-scale 40 crowd.xyz -o crowd.pro
}

# millisecondsSince START: prints the milliseconds since START (in nanoseconds).
millisecondsSince() { printf '%d\n' $((($(date +%s%N) - $1) / 1000000)); }

case_time_limit_of_a_crowded_scene() {
    bakeCrowd
    expectDone pointrt-view crowd.pro -q --size 2048x2048 --spp 1 --time-limit 2 -o out/a.png --stats stats.json
    grep -Eq "a.png: .*time limit.*; [0-9]+ of 2048 rows " stderr ||
        fail "it does not say that rows are missing"
    # 3 s on an idle machine
    awk -v ms="$(jsonValue stats.json frame_ms.max)" 'BEGIN { exit !(ms < 20000) }' || fail "much too late"
}

case_interrupt_of_a_crowded_scene() {
    local pid status=0 start
    bakeCrowd
    pointrt-view crowd.pro -v --size 2048x2048 --spp 4 -o out/a.png 2>stderr &
    pid=$!
    untilTracing "$pid"
    sleep 4
    start=$(date +%s%N)
    kill -TERM "$pid"
    wait "$pid" || status=$?
    [ "$status" = 143 ] || fail "exit status $status where 143, of the signal, was expected"
    [ "$(millisecondsSince "$start")" -lt 20000 ] || fail "much too late"
    grep -Eq "a.png: interrupted at 0 of 4 samples; [0-9]+ of 2048 rows " stderr ||
        fail "it does not say how far it was"
    [ "$(head -c 8 out/a.png | od -An -t x1 | tr -d ' \n')" = 89504e470d0a1a0a ] || fail "no PNG was written"
    [ "$(tail -c 12 out/a.png | head -c 8 | od -An -c | tr -d ' \n')" = '\0\0\0\0IEND' ] || fail "the PNG is not whole"
}

case_interrupt_saves_a_png() {
    bakeSphere
    interruptAtWork out/a.png
    grep -Eq "a.png: interrupted at [0-9]+ of 65536 samples\$" stderr || fail "it does not say how far it was"
    [ "$(samplesOf stats.json)" -ge 1 ] || fail "no sample was saved"
    [ "$(head -c 8 out/a.png | od -An -t x1 | tr -d ' \n')" = 89504e470d0a1a0a ] || fail "no PNG was written"
}

# The denoiser splits a picture of more than 2 million pixels into tiles (filterTileFor).
case_filters_large_pictures() {
    bakeSphere
    expectDone pointrt-view scene.pro -q --size 1700x1300 --spp 1 --denoise on -o out/a.png --stats stats.json
    awk -v ms="$(jsonValue stats.json denoise_ms)" 'BEGIN { exit !(ms > 0) }' || fail "it was not filtered"
}

case_refuses_what_memory_cannot_hold() {
    bakeSphere
    local large=(pointrt-view scene.pro -q --size 16000x16000 --spp 1)
    ulimit -v 2000000
    pointrt-view --version >version || skip "the tool does not start in 2 GB here"
    expectError 3 "a.exr: .* 16000x16000 .* 27\.[0-9] GiB .* 1?[0-9]?\.[0-9] GiB" \
        "${large[@]}" -o out/a.exr
    expectError 3 "a.png: .* 16000x16000 .* 1[78]\.[0-9] GiB" "${large[@]}" --denoise off --time-limit 1 -o out/a.png
    expectError 3 " 16000x16000 .* GiB" "${large[@]}" --turntable 2 -o out/%d.png
    expectDone pointrt-view scene.pro -q --size 1800x1800 --spp 1 -o out/a.png
}

runCase "$@"
