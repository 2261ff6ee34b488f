#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# pointrt-bake -o NAME.proset: all at once, in steps, killed and resumed, refused.
# shellcheck source=lib.sh
. "$(dirname "$0")/lib.sh"
# shellcheck source=slurm_here.sh
. "$(dirname "$0")/slurm_here.sh"

# hill COUNT [OFFSET]: prints COUNT points on a smooth hill of 64 x 64, moved by OFFSET along x.
hill() {
    awk -v count="$1" -v offset="${2:-0}" 'BEGIN {
        for (i = 0; i < count; i++) {
            x = 64 * ((i * 0.7548776662466927) % 1); y = 64 * ((i * 0.5698402909980532) % 1)
            printf "%.4f %.4f %.4f\n", offset + x, y, 5 * sin(x / 9) * cos(y / 7)
        }
    }'
}

# bakeHills OUTPUT [OPTION ...]: bakes two hills side by side, in tiles of a thousand points.
bakeHills() {
    local output=$1
    shift
    [ -e a.xyz ] || hill 8000 >a.xyz
    [ -e b.xyz ] || hill 8000 64 >b.xyz
    pointrt-bake -q a.xyz b.xyz -o "$output" --tile-splats 1000 "$@"
}

# sameSet A B: both folders must have the same files with the same bytes.
sameSet() {
    diff -r "$1" "$2" >/dev/null || fail "$1 and $2 differ: $(diff -rq "$1" "$2" | head -3)"
}

# number NAME FILE: an integer of a JSON report.
number() {
    sed -n "s/^ *\"$1\": \([0-9]*\),\{0,1\}$/\1/p" "$2" | head -1
}

case_whole_sets_verify() {
    bakeHills out/site.proset --stats stats.json
    expectDone pointrt-info out/site.proset --verify
    [ "$(number points stats.json)" = 16000 ] || fail "not all points are counted"
    [ "$(number original_tiles stats.json)" -gt 5 ] || fail "there are few tiles"
    [ ! -e out/site.proset.work ] || fail "the work was left"
    grep -q '"done": true' stats.json || fail "the report does not say that it is done"
    # a dense corner gives adjacent tiles of several levels
    hill 12000 | awk '{ print $1 / 6, $2 / 6, $3 }' >corner.xyz
    expectDone pointrt-bake -q a.xyz corner.xyz -o out/corner.proset --tile-splats 1000
    expectDone pointrt-info out/corner.proset --verify
}

case_an_interrupted_bake_says_how_to_resume() {
    hill 60000 >a.xyz
    run timeout -s INT 1 pointrt-bake -q a.xyz -o out/a.proset --tile-splats 1000
    [ "$status" = 124 ] || fail "exit status $status: it was not interrupted"
    grep -q "interrupted; .*resume" stderr || fail "it does not say how to resume"
    [ -e out/a.proset.work ] || fail "what was done is gone"
}

case_threads_and_steps_do_not_matter() {
    local step block blocks
    bakeHills out/whole.proset -j 1
    for step in plan split; do bakeHills out/steps.proset --step $step --stats stats.json; done
    blocks=$(number blocks stats.json)
    [ "$blocks" -gt 1 ] || fail "there is one block only"
    for block in $(seq $((blocks - 1)) -1 0); do bakeHills out/steps.proset --step "block:$block"; done
    bakeHills out/steps.proset --step levels
    for block in $(seq 0 $((blocks - 1))); do bakeHills out/steps.proset --step "tile:$block"; done
    [ ! -e out/steps.proset ] || fail "the set is there before its end"
    bakeHills out/steps.proset --step top -j 4
    sameSet out/whole.proset out/steps.proset
    bakeHills out/kept.proset --keep-work
    [ -e out/kept.proset.work/plan.json ] || fail "the work was not kept"
    sameSet out/whole.proset out/kept.proset
}

# Kills the bake after more and more hundredths of a second, until a run completes.
case_killed_at_any_moment() {
    local kills=0 hundredths=1
    bakeHills out/whole.proset
    while [ ! -e out/killed.proset ] && [ $kills -lt 60 ]; do
        run timeout -s KILL "$(printf '0.%02d' $((hundredths % 100)))" pointrt-bake -q a.xyz b.xyz \
            -o out/killed.proset --tile-splats 1000
        kills=$((kills + 1)) hundredths=$((hundredths < 95 ? hundredths + 3 : 95))
    done
    [ $kills -gt 1 ] || fail "it was never killed"
    [ -e out/killed.proset ] || bakeHills out/killed.proset
    sameSet out/whole.proset out/killed.proset
}

case_a_finished_set_stays() {
    bakeHills out/site.proset
    expectError 4 "site.proset: .*exists; --force " \
        pointrt-bake -q a.xyz b.xyz -o out/site.proset --tile-splats 1000
    bakeHills out/site.proset/ --force --compact
    expectDone pointrt-info out/site.proset --verify
    [ "$(ls out)" = site.proset ] || fail "something was left: $(ls out)"
    mkdir -p out/other.proset
    echo precious >out/other.proset/file
    expectError 4 "other.proset: .*not a tile set" \
        pointrt-bake -q a.xyz -o out/other.proset --tile-splats 1000 --force
}

case_other_options_and_inputs_are_refused() {
    bakeHills out/site.proset --step plan
    expectError 2 "site.proset.work: .*--tile-splats .*1000, not 2000\); --force " \
        pointrt-bake -q a.xyz b.xyz -o out/site.proset --tile-splats 2000
    expectError 1 "site.proset.work: .*2 input files.*1" \
        pointrt-bake -q a.xyz -o out/site.proset --tile-splats 1000
    expectError 1 "step split " \
        pointrt-bake -q a.xyz b.xyz -o out/site.proset --tile-splats 1000 --step block:0
    bakeHills out/site.proset --step split
    expectError 1 "site.proset.work: .*a.xyz.*b.xyz; --force " \
        pointrt-bake -q b.xyz a.xyz -o out/site.proset --tile-splats 1000
    expectError 2 "--step: block 99 .*range" \
        pointrt-bake -q a.xyz b.xyz -o out/site.proset --tile-splats 1000 --step block:99
    echo "1 2 3" >>a.xyz
    rm -r out/site.proset.work
    bakeHills out/site.proset --step plan
    echo "1 2 3" >>a.xyz
    expectError 1 "a.xyz .*changed" \
        pointrt-bake -q a.xyz b.xyz -o out/site.proset --tile-splats 1000
    bakeHills out/site.proset --force
    expectDone pointrt-info out/site.proset --verify
}

# view DETAIL [OPTION ...]: renders out/site.proset, and sets $tiles to the number of tiles loaded.
view() {
    local detail=$1
    shift
    expectDone pointrt-view out/site.proset --detail "$detail" --size 64x48 --spp 1 --stats view.json -o picture.png "$@"
    tiles=$(jsonValue view.json sets.tiles)
}

case_detail_is_how_much_may_be_left_out() {
    local original all
    bakeHills out/site.proset --stats stats.json
    original=$(number original_tiles stats.json)
    view 0
    all=$tiles
    [ "$all" = "$original" ] || fail "$all tiles at the finest, of $original"
    view 2
    [ "$tiles" -gt 1 ] && [ "$tiles" -lt "$all" ] || fail "$tiles tiles at two pixels, of $all"
    view 16384
    [ "$tiles" = 1 ] || fail "$tiles tiles where the root is enough"
    view 0 --memory 2M # half of it is for tiles
    [ "$tiles" -lt "$all" ] || fail "$tiles tiles in a mebibyte"
    [ "$(grep -c "coarser .*--detail 0: $tiles tiles .*1 MiB.* $all " stderr)" = 1 ] ||
        fail "it does not say once what memory left out"
}

case_detail_in_the_window() {
    bakeHills out/site.proset
    printf '%s\n' 'pointrt-recording 1 window 160x120 scale 1' '0 wait 4' '5 key down F12' '5 key up F12' \
        '6 key down Control' '6 key down S' '7 key up S' '7 key up Control' '12 quit' >user.txt
    (cd out && expectDone pointrt-view site.proset --replay ../user.txt --offscreen --detail 0 --spp 4)
    grep -q '^detail = 0' out/site-1.toml || fail "the scene does not keep the detail"
    expectDone pointrt-view out/site-1.toml -o file.png
    cmp out/site-1.png file.png || fail "the window's picture is not the file's"
    expectDone pointrt-view out/site-1.toml --detail 16384 -o coarse.png
    ! cmp -s coarse.png file.png || fail "the root shows as much as all tiles"
}

case_usage_of_detail() {
    local value
    for value in -1 16385 much nan ""; do
        expectError 2 "--detail: " pointrt-view out/site.proset --detail "$value" -o out/a.png
    done
    printf '[[instance]]\nfile = "site.proset"\n[render]\ndetail = -1\n' >site.toml
    expectError 1 'site.toml:4: key "render.detail": ' pointrt-view site.toml -o out/a.png
}

case_usage() {
    hill 2000 >a.xyz
    expectError 2 "--step .*NAME.proset" pointrt-bake -q a.xyz -o out/a.pro --step plan
    expectError 2 "--step: 'sideways' .*plan, split" pointrt-bake -q a.xyz -o out/a.proset --step sideways
    expectError 2 "--step: 'block' .*number" pointrt-bake -q a.xyz -o out/a.proset --step block
    expectError 2 "--max-memory: .*'much'" pointrt-bake -q a.xyz -o out/a.proset --max-memory much
    expectError 2 "--max-memory: .*512M" pointrt-bake -q a.xyz -o out/a.proset --max-memory 100M
    expectError 2 "--tile-splats" pointrt-bake -q a.xyz -o out/a.proset --tile-splats 10
    expectError 2 "-: standard input .*twice" pointrt-bake -q - -o out/a.proset
    expectError 1 "missing.xyz: " pointrt-bake -q missing.xyz -o out/a.proset
    expectError 1 "plan.json: .*--step plan" pointrt-bake -q a.xyz -o out/a.proset --step top
}

# Bakes to a tmpfs of 1 MiB in a mount namespace, which ends with the command.
case_a_disk_that_is_too_small() {
    local namespace=(unshare --mount)
    [ "$(id -u)" = 0 ] || namespace=(unshare --mount --map-root-user)
    hill 50000 >a.xyz
    cat >on_small_disk.sh <<'SH'
mount -t tmpfs -o size=1m none out || exit 77
pointrt-bake -q a.xyz -o out/a.proset --tile-splats 10000
SH
    run "${namespace[@]}" bash on_small_disk.sh
    [ "$status" != 77 ] && [ "$status" != 1 ] || skip "no file system can be mounted here"
    [ "$status" = 4 ] || fail "exit status $status where 4 was expected"
    grep -q "a.proset: .*disk" stderr || fail "it does not report the disk"
}

# Workflow engines: the set has the same bytes, although a worker is killed.
engine=$suite_dir/../../preprocess/engine

# makeKilledOnce: makes a replacement for pointrt-bake that kills the first worker of block 1 amid its tiles.
makeKilledOnce() {
    cat >killed_once <<'SH'
#!/bin/bash
case " $* " in *" --step block:1 "*) ;; *) exec pointrt-bake "$@" ;; esac
mkdir killed 2>/dev/null || exec pointrt-bake "$@"
shopt -s nullglob
before=(out/shared.proset.work/splats/*) now=()
pointrt-bake "$@" &
while [ ${#now[@]} -le ${#before[@]} ] && kill -0 $! 2>/dev/null; do
    sleep 0.002
    now=(out/shared.proset.work/splats/*)
done
kill -KILL $! && wait $!
echo $? >killed/status
exit 137
SH
    chmod +x killed_once
    export POINTRT_BAKE=$PWD/killed_once
}

wasKilled() {
    [ "$(cat killed/status)" = 137 ] || fail "no worker was killed: $(cat killed/status)"
}

case_gnu_parallel() {
    parallel --version 2>/dev/null | grep '^GNU' >/dev/null || skip "GNU parallel is not installed"
    makeKilledOnce
    bakeHills out/whole.proset
    expectDone "$engine/parallel.sh" 2 out/shared.proset a.xyz b.xyz --tile-splats 1000 # retries failed jobs
    wasKilled
    sameSet out/whole.proset out/shared.proset
}

case_snakemake() {
    command -v snakemake >/dev/null || skip "Snakemake is not installed"
    makeKilledOnce
    bakeHills out/whole.proset --max-memory 1024M
    local command=(snakemake -s "$engine/Snakefile" -j 2 -q --config set=out/shared.proset scans="a.xyz b.xyz"
        options="--tile-splats 1000" memory_mb=1024 bake="$POINTRT_BAKE")
    run "${command[@]}"
    wasKilled
    [ "$status" != 0 ] || fail "nobody noticed that a worker was killed"
    grep -q "block:1" stderr || fail "it does not say which job failed"
    expectDone "${command[@]}"
    sameSet out/whole.proset out/shared.proset
    expectDone "${command[@]}"
}

# submitHills: bakes the hills by Slurm, and waits until no job is left.
submitHills() {
    expectDone "$engine/slurm.sh" out/shared.proset a.xyz b.xyz -- --tile-splats 1000
    for _ in $(seq 600); do
        [ -n "$(squeue -h)" ] || return 0
        sleep 0.2
    done
    fail "jobs do not end: $(squeue)"
}

case_slurm() {
    hasSlurm || skip "Slurm is not installed"
    makeKilledOnce
    bakeHills out/whole.proset
    trap 'stopSlurm "$folder/slurm"; cd / && rm -rf "$folder"' EXIT
    chmod a+x . # for munged
    startSlurm "$PWD/slurm" || skip "Slurm does not come up here: $(tail -qn 2 slurm/*.log)"
    submitHills
    wasKilled
    [ ! -e out/shared.proset ] || fail "the set is there without a block"
    submitHills
    sameSet out/whole.proset out/shared.proset
}

runCase "$@"
