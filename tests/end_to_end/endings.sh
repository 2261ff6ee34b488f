#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# How the tools end if the system refuses: streams that cannot be written, limits, signals, files changed by others.
# shellcheck source=lib.sh
. "$(dirname "$0")/lib.sh"

# expectScene FILE: FILE must be a complete .pro.
expectScene() { pointrt-info "$1" --verify >verified || fail "$1: $(cat verified)"; }

# endsWith CODE COMMAND: the shell runs COMMAND, which may redirect streams, and must exit with CODE.
endsWith() {
    local code=$1 status=0
    printf '$ %s\n' "$2"
    bash -c "$2" || status=$?
    [ "$status" = "$code" ] || fail "exit status $status where $code was expected"
}

# untilReady PID: waits until the tool handles SIGTERM, which it does once it has parsed its command line, and a bit longer.
untilReady() {
    local caught
    for _ in $(seq 200); do
        caught=$(awk '/^SigCgt/ { print $2 }' "/proc/$1/status" 2>/dev/null) || true
        [ $((0x${caught:-0} & 0x4000)) = 0 ] || break
        sleep 0.05
    done
    sleep 0.5
}

case_reports_that_nobody_can_read() {
    local option
    sphere 3000 >sphere.xyz
    for option in "" -v "--progress lines"; do
        endsWith 0 "pointrt-bake sphere.xyz $option -f -o out/full.pro 2>/dev/full"
        endsWith 0 "pointrt-bake sphere.xyz $option -f -o out/closed.pro 2>&-"
        endsWith 0 "pointrt-bake sphere.xyz $option -f -o out/none.pro <&- >&- 2>&-"
        cmp out/full.pro out/closed.pro
        cmp out/full.pro out/none.pro
    done
    expectScene out/full.pro
    endsWith 0 "pointrt-view -v out/full.pro --size 32x24 -o out/a.png 2>/dev/full"
    endsWith 0 "pointrt-view -v out/full.pro --size 32x24 -o out/b.png 2>&-"
    cmp out/a.png out/b.png
}

# The tools finish their work even if nobody reads their reports from a pipe.
case_reports_into_a_broken_pipe() {
    sphere 3000 >sphere.xyz
    { sleep 0.2; pointrt-bake -v sphere.xyz -o out/a.pro; echo "$?" >code; } 2>&1 | true
    [ "$(cat code)" = 0 ] || fail "exit status $(cat code)"
    expectScene out/a.pro
}

case_standard_output_that_cannot_be_written() {
    sphere 3000 >sphere.xyz
    endsWith 4 "pointrt-bake -q sphere.xyz -o out/a.pro --stats - >/dev/full"
    expectScene out/a.pro
    endsWith 4 "pointrt-bake -q sphere.xyz -o out/b.pro --stats - >&-"
    endsWith 4 "pointrt-info out/a.pro >/dev/full"
    endsWith 4 "pointrt-info out/a.pro >&-"
    endsWith 4 "pointrt-view -q out/a.pro --size 32x24 -o out/a.png --stats - >/dev/full"
    [ -s out/a.png ] || fail "no picture"
    endsWith 1 "pointrt-bake -q - --input-format xyz -o out/c.pro <&- 2>stderr"
    grep -q "standard input: " stderr || fail "does not say that there is no standard input"
}

case_file_size_limit() {
    sphere 3000 >sphere.xyz
    pointrt-bake -q sphere.xyz -o scene.pro
    expectError 4 "out/a.pro: .*too large" bash -c "ulimit -f 8; exec pointrt-bake -q sphere.xyz -o out/a.pro"
    # Mesa 25 keeps the device's memory in a file, and dies of SIGBUS where that is cut off, whatever it renders to
    run bash -c "ulimit -f 8; exec pointrt-view -q scene.pro --size 8x8 -o -"
    [ "$status" = 135 ] ||
        expectError 4 "out/a.exr: .*too large" bash -c "ulimit -f 8; exec pointrt-view -q scene.pro --size 64x64 -o out/a.exr"
    expectError 4 "out/a.ply: .*too large" bash -c "ulimit -f 8; exec pointrt-info scene.pro --export out/a.ply"
}

# With address space from too little for the tool to enough, it succeeds or prints one line, or the driver crashes: Mesa
# does not check all of its allocations.
case_address_space_limit() {
    local limit
    sphere 3000 >sphere.xyz
    pointrt-bake -q sphere.xyz -o scene.pro
    bash -c "ulimit -v 700000; exec pointrt-view --version" >version || skip "the tool does not start in so little here"
    for limit in 60000 120000 250000 400000 500000 600000 700000; do
        run bash -c "ulimit -v $limit; exec pointrt-view -q scene.pro --size 32x32 -o out/a.png"
        grep -q "cannot allocate memory for thread-local data" stderr && status=3 # the C library exits with 127
        case "$status" in
        0 | 3) [ "$(wc -l <stderr)" = $((status / 3)) ] || fail "stderr is not one line" ;;
        134 | 139) ! grep -q "pointrt-view: error: " stderr || fail "a crash is reported as an error" ;; # SIGABRT, SIGSEGV
        *) fail "exit status $status" ;;
        esac
        [ "$status" = 0 ] || [ -z "$(ls -A out)" ] || fail "left behind: $(ls -A out)"
        rm -f out/*
    done
}

# If another process creates the output while the scan is read, its file stays.
case_a_file_that_appears_during_the_bake() {
    local child
    mkfifo scan.xyz
    pointrt-bake -q scan.xyz --input-format xyz -o out/a.pro 2>stderr &
    child=$!
    untilReady "$child"
    echo theirs >out/a.pro
    sphere 1000 >scan.xyz
    status=0
    wait "$child" || status=$?
    cat stderr
    [ "$status" = 4 ] || fail "exit status $status"
    grep -q "out/a.pro: already exists" stderr || fail "does not say why"
    [ "$(cat out/a.pro)" = theirs ] || fail "replaced it"
    [ "$(ls -A out)" = a.pro ] || fail "left behind: $(ls -A out)"
}

case_two_bakes_to_one_output() {
    local first second statuses=""
    mkfifo a.xyz b.xyz
    pointrt-bake -q a.xyz --input-format xyz -o out/a.pro &
    first=$!
    pointrt-bake -q b.xyz --input-format xyz -o out/a.pro &
    second=$!
    untilReady "$first"
    untilReady "$second"
    sphere 1000 >a.xyz
    sphere 2000 >b.xyz
    for child in $first $second; do
        status=0
        wait "$child" || status=$?
        statuses+="$status "
    done
    [ "$statuses" = "0 4 " ] || [ "$statuses" = "4 0 " ] || fail "exit statuses $statuses"
    expectScene out/a.pro
}

case_links_and_permissions_stay() {
    sphere 1000 >sphere.xyz
    mkdir there
    echo old >there/target.pro
    chmod 0600 there/target.pro
    ln -s ../there/target.pro out/link.pro
    expectDone pointrt-bake -q -f sphere.xyz -o out/link.pro
    [ "$(readlink out/link.pro)" = ../there/target.pro ] || fail "the link is gone"
    expectScene there/target.pro
    [ "$(stat -c %a there/target.pro)" = 600 ] || fail "permissions are $(stat -c %a there/target.pro)"
    ln -s new.pro out/dangling.pro
    expectDone pointrt-bake -q sphere.xyz -o out/dangling.pro
    expectScene out/new.pro
    [ -L out/dangling.pro ] || fail "the link is gone"
    ln -s loop.pro out/loop.pro
    expectError 4 "out/loop.pro: " pointrt-bake -q -f sphere.xyz -o out/loop.pro
    chmod 0640 there/target.pro
    expectDone pointrt-view -q out/new.pro --size 32x24 -o out/a.png
    chmod 0600 out/a.png
    expectDone pointrt-view -q out/new.pro --size 32x24 -o out/a.png
    [ "$(stat -c %a out/a.png)" = 600 ] || fail "the picture's permissions are $(stat -c %a out/a.png)"
}

# On file systems without unnamed files (O_TMPFILE), the output has a temporary name. Kills the bake while it has.
case_killed_without_nameless_files() {
    local preload=(env LD_PRELOAD="$POINTRT_NO_TMPFILE" ASAN_OPTIONS=verify_asan_link_order=0)
    sphere 1000 >sphere.xyz
    run "${preload[@]}" KILL_AT_SYNC=1 pointrt-bake -q sphere.xyz -o out/a.pro
    [ "$status" = 137 ] || fail "was not killed"
    [ "$(ls -A out | wc -l)" = 1 ] || fail "the test is wrong: $(ls -A out)"
    : >out/a.pro.tmp-inusenow
    : >out/a.pro.tmp-notours
    exec 9<out/a.pro.tmp-inusenow
    flock 9
    expectDone "${preload[@]}" pointrt-bake -q sphere.xyz -o out/a.pro
    expectScene out/a.pro
    [ "$(ls -A out | tr '\n' ' ')" = "a.pro a.pro.tmp-inusenow a.pro.tmp-notours " ] || fail "in out/: $(ls -A out)"
    expectError 4 "already exists" "${preload[@]}" pointrt-bake -q sphere.xyz -o out/a.pro
}

case_signals_end_a_bake() {
    local signal child
    mkfifo scan.xyz
    for signal in INT TERM HUP XCPU; do
        env --default-signal=INT pointrt-bake -q scan.xyz --input-format xyz -o out/a.pro 2>stderr &
        child=$!
        untilReady "$child"
        kill "-$signal" "$child"
        status=0
        wait "$child" || status=$?
        [ "$status" = $((128 + $(kill -l "$signal"))) ] || fail "SIG$signal: exit status $status"
        grep -qx "pointrt-bake: interrupted, nothing.*" stderr || fail "SIG$signal: $(cat stderr)"
        [ -z "$(ls -A out)" ] || fail "left behind: $(ls -A out)"
    done
}

# Text from files is shown without control characters: no escape sequences, no extra lines.
case_text_of_files_does_nothing_to_a_terminal() {
    printf 'ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty \033[31mred y\nend_header\n1\n' >a.ply
    expectError 1 "a.ply" pointrt-bake -q a.ply -o out/a.pro
    printf '1 2 \033]0;owned\007\n' >$'two\nlines.xyz'
    expectError 1 'two.nlines.xyz' pointrt-bake -q $'two\nlines.xyz' -o out/a.pro
    ! LC_ALL=C grep -q $'[\001-\010\013-\037\177]' stderr || fail "a control character in the message"
    sphere 1000 >sphere.xyz
    pointrt-bake -q sphere.xyz -o scene.pro
    printf '[[instance]]\nfile = "\\u001b[31m\\u202e.pro"\n' >a.toml
    expectError 1 "a.toml:2: " pointrt-view -q a.toml -o out/a.png
    ! LC_ALL=C grep -q $'[\001-\010\013-\037\177\200-\377]' stderr || fail "a control character in the message"
    printf 'pointrt-recording 1 window 64x48 scale 1\n1 \033[31mjump\n' >a.rec
    expectError 1 "a.rec:2: " pointrt-view scene.pro --replay a.rec --offscreen
    ! LC_ALL=C grep -q $'[\001-\010\013-\037\177]' stderr || fail "a control character in the message"
}

runCase "$@"
