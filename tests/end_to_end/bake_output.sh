#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The outputs of pointrt-bake: usage, files and leftovers, statistics, reproducible bytes.
# shellcheck source=lib.sh
. "$(dirname "$0")/lib.sh"

case_help_names_every_option() {
    local option
    expectDone pointrt-bake --help
    for option in -o --output -f --force -j --threads --normals --neighbors --orient --radius-scale --max-leaf-splats \
        --max-depth --prune --probe-rays --sample --seed --stats --progress --input-format -q -v --bounds --classes \
        --drop-classes --thin --every --level --skim --transform --up --attributes --max-memory --tile-splats --step \
        --keep-work; do
        grep -Eq -e "(^|[ ,])$option([ ,=]|\$)" stdout || fail "--help does not name $option"
    done
}

case_wrong_usage() {
    sphere 100 >sphere.xyz
    expectError 2 "" pointrt-bake
    expectError 2 "" pointrt-bake sphere.xyz
    expectError 2 "" pointrt-bake -o out/scene.pro
    expectError 2 "frobnicate" pointrt-bake sphere.xyz -o out/scene.pro --frobnicate
    expectError 2 "" pointrt-bake sphere.xyz -o out/scene.pro --neighbors many
    expectError 2 "" pointrt-bake sphere.xyz -o out/scene.pro --orient sideways
    expectError 2 "" pointrt-bake sphere.xyz -o out/scene.pro --radius-scale -1
    expectError 2 "--prune-harm .*--prune on" pointrt-bake sphere.xyz -o out/scene.pro --prune off --prune-harm 1e-6
    expectError 2 "sphere.xyz: .*no faces" pointrt-bake sphere.xyz -o out/site.proset --sample 1000
}

case_wrong_suffix() {
    sphere 100 >sphere.xyz
    expectError 2 "out/scene.png: " pointrt-bake -q sphere.xyz -o out/scene.png
}

case_output_exists() {
    sphere 1000 >sphere.xyz
    echo precious >out/scene.pro
    expectError 4 "out/scene.pro: .*exist" pointrt-bake -q sphere.xyz -o out/scene.pro
    [ "$(cat out/scene.pro)" = precious ] || fail "the file was overwritten"
    expectDone pointrt-bake -q sphere.xyz -o out/scene.pro --force
    expectDone pointrt-info out/scene.pro --verify
}

case_a_failed_force_keeps_the_old_file() {
    : >empty.ply
    echo precious >out/scene.pro
    expectError 1 "empty.ply" pointrt-bake -q --force empty.ply -o out/scene.pro
    [ "$(cat out/scene.pro)" = precious ] || fail "the file was overwritten"
}

case_output_folder_missing() {
    sphere 1000 >sphere.xyz
    expectError 4 "out/none/scene.pro: " pointrt-bake -q sphere.xyz -o out/none/scene.pro
}

# Bakes to a tmpfs of 64 KiB in a mount namespace, which ends with the command.
case_full_disk() {
    local namespace=(unshare --mount)
    [ "$(id -u)" = 0 ] || namespace=(unshare --mount --map-root-user)
    sphere 20000 >sphere.xyz
    cat >on_small_disk.sh <<'SH'
mount -t tmpfs -o size=64k none out || exit 77
status=0
"$@" || status=$?
ls -A out >left
exit $status
SH
    "${namespace[@]}" bash on_small_disk.sh true || skip "no mount namespace for a small disk here"
    expectError 4 "out/scene.pro: " "${namespace[@]}" bash on_small_disk.sh pointrt-bake -q sphere.xyz -o out/scene.pro
    [ ! -s left ] || fail "left on the full disk: $(cat left)"
}

# Interrupts the bake at several moments. Background jobs of a shell ignore SIGINT: env restores the default.
case_interrupt_leaves_nothing() {
    local moment interrupted=0 child
    sphere 300000 >sphere.xyz
    for moment in 0.05 0.3 1 2; do
        env --default-signal=INT pointrt-bake -q sphere.xyz -o out/scene.pro 2>stderr &
        child=$!
        sleep "$moment"
        kill -INT "$child" 2>/dev/null || true
        status=0
        wait "$child" || status=$?
        printf 'after %s s: exit status %s\n' "$moment" "$status"
        if [ "$status" != 0 ]; then
            interrupted=$((interrupted + 1))
            [ -z "$(ls -A out)" ] || fail "left behind: $(ls -A out)"
        fi
        rm -f out/scene.pro
    done
    [ "$interrupted" -gt 0 ] || fail "no run was interrupted"
}

# Interrupts the bake when its output is complete, but it still waits for a reader of the statistics: it finishes normally.
case_an_interrupt_behind_the_output_comes_too_late() {
    local child
    sphere 1000 >sphere.xyz
    mkfifo stats
    env --default-signal=INT pointrt-bake -q sphere.xyz -o out/scene.pro --stats stats 2>stderr &
    child=$!
    for _ in {1..200}; do
        [ ! -e out/scene.pro ] || break
        sleep 0.05
    done
    kill -INT "$child"
    sleep 0.2
    timeout 60 cat stats >stats.json || fail "no statistics: $(cat stderr)"
    status=0
    wait "$child" || status=$?
    [ "$status" = 0 ] || fail "exit status $status, though out/ has $(ls -A out): $(cat stderr)"
    [ ! -s stderr ] || fail "it says: $(cat stderr)"
    [ "$(jsonValue stats.json input_points)" = 1000 ] || fail "the statistics are not whole"
}

# Every line must be "progress SHARE STAGE RATE". The share never decreases, and the stages are in order.
case_progress_lines() {
    sphere 30000 >sphere.xyz
    expectDone pointrt-bake -q sphere.xyz -o out/scene.pro --progress lines
    grep -Evq '^progress [01]\.[0-9]{4} [a-z]+ [0-9]+$' stderr && fail "not a progress line"
    cut -d ' ' -f 2 stderr | sort -c || fail "the share goes back"
    [ "$(cut -d ' ' -f 3 stderr | uniq | tr '\n' ' ')" = \
        "read neighbors normals orientation radii quantize octree prune index write " ] || fail "other stages"
    expectError 2 "json" pointrt-bake sphere.xyz -o out/other.pro --progress json
}

case_stats() {
    sphere 3000 >sphere.xyz
    expectDone pointrt-bake -q sphere.xyz -o out/scene.pro --stats stats.json
    expectKeys stats.json input_points splats nodes filled_leaves empty_leaves max_depth references_unpruned \
        references radii.seen_through bytes peak_rss_bytes seconds.total
    [ "$(jsonValue stats.json input_points)" = 3000 ] || fail "input_points is not 3000"
    [ "$(jsonValue stats.json bytes)" = "$(stat -c %s out/scene.pro)" ] || fail "bytes is not the size of the file"
    [ "$(jsonValue stats.json references)" -le "$(jsonValue stats.json references_unpruned)" ] || fail "pruning added"
    [ "$(jsonValue stats.json references)" -ge "$(jsonValue stats.json splats)" ] || fail "a splat has no leaf"
}

case_stats_on_standard_output() {
    sphere 1000 >sphere.xyz
    expectDone pointrt-bake -q sphere.xyz -o out/scene.pro --stats -
    [ "$(jsonValue stdout input_points)" = 1000 ] || fail "no JSON on standard output"
}

case_quiet_and_progress() {
    sphere 1000 >sphere.xyz
    expectDone pointrt-bake -q sphere.xyz -o out/quiet.pro
    [ ! -s stderr ] || fail "-q is not quiet"
    expectDone pointrt-bake sphere.xyz -o out/plain.pro
    [ "$(wc -l <stderr)" = 3 ] || fail "not three lines: what was read, what was done with it, the result"
    expectDone pointrt-bake -v sphere.xyz -o out/detailed.pro
    grep -q '^octree: .* s$' stderr || fail "-v has no line per stage"
    ! grep -q $'[\r\033]' stderr || fail "a redrawn line where there is no terminal"
}

case_same_bytes_for_any_thread_count() {
    local threads
    sphere 60000 >sphere.xyz
    expectDone pointrt-bake -q sphere.xyz -o out/1.pro -j 1
    for threads in 2 3 0; do
        expectDone pointrt-bake -q sphere.xyz -o "out/$threads.pro" -j "$threads"
        cmp out/1.pro "out/$threads.pro"
    done
}

# Without the index, the octree's sections are the same bytes.
case_compact() {
    local end
    sphere 20000 >sphere.xyz
    expectDone pointrt-bake -q sphere.xyz -o out/whole.pro --stats stats.json
    expectKeys stats.json seconds.index
    expectDone pointrt-bake -q sphere.xyz -o out/compact.pro --compact --stats stats.json
    [ -z "$(jsonValue stats.json seconds.index)" ] || fail "an index was built for nothing"
    [ "$(jsonValue stats.json bytes)" = "$(stat -c %s out/compact.pro)" ] || fail "bytes is not the size of the file"
    [ "$(stat -c %s out/whole.pro)" -gt $((3 * $(stat -c %s out/compact.pro))) ] || fail "not much smaller"
    end=$(stat -c %s out/compact.pro)
    cmp <(tail -c +4097 out/compact.pro) <(head -c "$end" out/whole.pro | tail -c +4097)
    expectDone pointrt-info out/whole.pro --verify
    expectDone pointrt-info out/compact.pro --verify
    expectDone pointrt-info out/whole.pro --json
    [ "$(jsonValue stdout version)" = 1.4 ] || fail "not version 1.4"
    expectDone pointrt-info out/compact.pro --json
    [ "$(jsonValue stdout version)" = 1.2 ] || fail "not version 1.2, the first with an up"
}

runCase "$@"
