#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Frame times of the window: plays tour.txt and prints frame times of each run in milliseconds.
#   tests/bench/window/run.sh BIN SCENE.pro [RUNS]     BIN: the folder of pointrt-view
# Uses $DISPLAY, or no window if that is not set. The screenshots of the last run remain in window-tour/.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
bin=$(cd "${1:?usage: run.sh BIN SCENE.pro [RUNS]}" && pwd)
scene=$(realpath "${2:?usage: run.sh BIN SCENE.pro [RUNS]}")
runs=${3:-5}
shown=()
[ -n "${DISPLAY:-}${WAYLAND_DISPLAY:-}" ] || shown=(--offscreen)

echo "| run | moving: median | 95% | 99% | pixels | refining, between looks at input: median | 95% | first picture, s | 4 samples, s |"
echo "|---|---|---|---|---|---|---|---|---|"
for run in $(seq "$runs"); do
    rm -rf window-tour
    mkdir window-tour
    (cd window-tour && "$bin/pointrt-view" "$scene" --replay "$here/tour.txt" "${shown[@]}" --stats tour.json)
    awk -f "$here/../../../.ci/json.awk" window-tour/tour.json | awk -F '\t' -v run="$run" '
        { value[$1] = $2 }
        END {
            printf "| %d | %s | %s | %s | %d | %s | %s | %s | %s |\n", run, value["moving_frame_ms.median"],
                value["moving_frame_ms.p95"], value["moving_frame_ms.p99"], value["moving_pixels.median"],
                value["refining_frame_ms.median"], value["refining_frame_ms.p95"], value["first_picture_seconds"],
                value["clean_picture_seconds"]
        }'
done
