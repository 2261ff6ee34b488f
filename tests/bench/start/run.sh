#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Time to the first frame of a scene by --bench and for a PNG (preview: with the guides of its filter), compared with an
# empty Vulkan program in turn, and peak memory: medians of RUNS (default 7) as JSON, an object for each scene. A first
# run, which is not counted, puts the file into the page cache.
#   tests/bench/start/run.sh BIN_DIR SCENE.pro...
set -euo pipefail
[ $# -ge 2 ] || {
    sed -n '3,6s/^# //p' "$0" >&2
    exit 2
}
bin=$1
shift
time=$(type -P time) || {
    echo "GNU time is not there (Debian: time)" >&2
    exit 1
}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# run_view SCENE OPTION...: seconds to the end of the first frame, KiB at most.
run_view() {
    "$time" -f %M -o "$folder/kib" \
        "$bin/pointrt-view" -q "$1" --size 512x512 --spp 1 --stats "$folder/stats" "${@:2}" >"$folder/log" 2>&1 ||
        { cat "$folder/log" >&2 && return 1; }
    echo "$(sed -n 's/.*"first_frame_seconds": \([0-9.]*\).*/\1/p' "$folder/stats") $(tail -1 "$folder/kib")"
    rm "$folder/stats"
}
# both SCENE: prints seconds and KiB of the first frame, then of a preview.
both() { echo "$(run_view "$1" --bench 1) $(run_view "$1" -o "$folder/frame.png")"; }

# column K: prints the median of that column.
column() { awk -v k="$1" '{ print $k }' "$folder/runs" | sort -g | awk '{ v[NR] = $1 } END { print v[int((NR + 1) / 2)] }'; }

separator='['
for scene in "$@"; do
    both "$scene" >/dev/null
    : >"$folder/runs"
    for ((run = 0; run < ${RUNS:-7}; run++)); do
        echo "$("$bin/empty_compute") $(both "$scene")" |
            awk '{ print $2, $1, $2 - $1, $4, $5 / 1024 }' >>"$folder/runs"
    done
    printf '%s{"scene": "%s", "file_mib": %.1f, "first_frame_s": %s, "empty_s": %s, "difference_s": %s, "preview_s": %s, "peak_mib": %.1f}\n' \
        "$separator" "$(basename "$scene" .pro)" "$(stat -c %s "$scene" | awk '{ print $1 / 1048576 }')" \
        "$(column 1)" "$(column 2)" "$(column 3)" "$(column 4)" "$(column 5)"
    separator=,
done
echo ']'
