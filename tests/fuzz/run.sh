#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Fuzzes each target for its share of the time, two targets at once, and continues after findings.
#   run.sh SECONDS [TARGET...]      all targets by default; build first: cmake --preset fuzz && cmake --build --preset fuzz
# FUZZ_BIN is the folder of the programs (default: build/fuzz/bin), FUZZ_WORK that of growing corpora and findings
# (default: build/fuzz/run). Prints for each target: executions, edges covered of all, size of its corpus, findings. Exits
# with 1 if there is a finding.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../.." && pwd)
bin=${FUZZ_BIN:-$root/build/fuzz/bin}
work=${FUZZ_WORK:-$root/build/fuzz/run}
at_once=2
seconds=${1:?run.sh SECONDS [TARGET...]}
shift
[ $# -gt 0 ] || mapfile -t targets < <(cd "$bin" && printf '%s\n' fuzz_* | sed 's/^fuzz_//')
[ $# -eq 0 ] || targets=("$@")
for name in "${targets[@]}"; do
    [ -x "$bin/fuzz_$name" ] || { echo "run.sh: no $bin/fuzz_$name: build first" >&2 && exit 2; }
done
share=$((seconds * at_once / ${#targets[@]}))
[ "$share" -gt 0 ] || share=1

# As in the tests; allocations beyond the readers' own limits may return null.
export ASAN_OPTIONS=allocator_may_return_null=1:detect_leaks=1:symbolize=1
export UBSAN_OPTIONS=print_stacktrace=1

# fuzz TARGET: a finding ends the program, which is restarted for the rest of its time, up to this number of findings (a
# fault in the first inputs would end it at once every time).
most_findings=10
fuzz() {
    local name=$1 options=() folders=() dictionary=$here/dictionaries/$1.dict until=$((SECONDS + share)) left
    mkdir -p "$work/$name/corpus" "$work/$name/findings"
    for folder in "$here/corpus/$name" "$here/findings/$name"; do [ ! -d "$folder" ] || folders+=("$folder"); done
    [ "$name" != pro ] || folders+=("$root/tests/format/golden")
    [ ! -f "$dictionary" ] || options+=("-dict=$dictionary")
    [ "$name" = pro ] && options+=(-max_len=262144) || options+=(-max_len=16384)
    : >"$work/$name/log"
    for ((run = 0; run < most_findings; ++run)); do
        left=$((until - SECONDS))
        [ "$left" -gt 0 ] || break
        "$bin/fuzz_$name" -max_total_time="$left" -timeout=10 -rss_limit_mb=2048 -malloc_limit_mb=1024 \
            -print_final_stats=1 -artifact_prefix="$work/$name/findings/" "${options[@]}" \
            "$work/$name/corpus" "${folders[@]}" >>"$work/$name/log" 2>&1 && break
    done
}

# report TARGET: prints a row of the table.
report() {
    awk -v name="$1" -v findings="$(find "$work/$1/findings" -type f | wc -l)" '
        /INFO: Loaded .* inline 8-bit counters/ { match($0, /\([0-9]+ inline/); all = substr($0, RSTART + 1, RLENGTH - 8) }
        /cov: / { for (i = 1; i < NF; ++i) { if ($i == "cov:") covered = $(i + 1); if ($i == "corp:") corpus = $(i + 1) } }
        /stat::number_of_executed_units/ { executions += $2 }
        /^#[0-9]+/ && !executions { last = substr($1, 2) }
        /past the header:/ { split($0, words, " "); share = ", past the header " words[4] " of " words[6] }
        END { printf "%-14s %12s %7s of %-7s %12s %3d%s\n", name, executions ? executions : last, covered, all, corpus, findings, share }
    ' "$work/$1/log"
}

mkdir -p "$work"
printf '%-14s %12s %7s of %-7s %12s %s\n' target executions edges all corpus findings
for ((i = 0; i < ${#targets[@]}; i += at_once)); do
    some=("${targets[@]:i:at_once}")
    for name in "${some[@]}"; do fuzz "$name" & done
    wait
    for name in "${some[@]}"; do report "$name"; done
done
find "$work" -path '*/findings/*' -type f -print
[ -z "$(find "$work" -path '*/findings/*' -type f)" ]
