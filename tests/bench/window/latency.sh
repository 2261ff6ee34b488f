#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# How much longer a moving frame of the window takes where submissions and allocations do: replays an orbit on a pretended
# GPU (tests/gpu/offline) without and with delays, in turn, and prints the medians in milliseconds.
#   tests/bench/window/latency.sh BUILD_DIR SCENE.pro [RUNS]
# 40 us and 150 us are what drivers take. Larger delays, with the same quotient, stand out from the noise of a shared
# machine: by the largest, which no tracing hides, a frame grows by the number of submissions that it waits for.
set -euo pipefail
build=$(cd "${1:?usage: latency.sh BUILD_DIR SCENE.pro [RUNS]}" && pwd)
scene=$(realpath "${2:?usage: latency.sh BUILD_DIR SCENE.pro [RUNS]}")
runs=${3:-5}
submissions_us=(0 40 1000 20000)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

{
    echo "pointrt-recording 1 window 128x96 scale 1"
    echo "0 wait 4"
    echo "1 cursor 30 50"
    echo "2 button down left"
    for step in $(seq 1 120); do echo "$((step + 2)) cursor $((30 + step / 2)) 50"; done
    echo "123 button up left"
} >"$folder/orbit.txt"

# median SUBMISSION_US: prints the median time of moving frames with that delay.
median() {
    VK_LAYER_PATH=$build/tests/trace/layer VK_INSTANCE_LAYERS=VK_LAYER_POINTRT_pretend POINTRT_LAYER_TYPE=discrete \
        POINTRT_LAYER_MEMORY=discrete POINTRT_LAYER_SUBMIT_US=$1 POINTRT_LAYER_ALLOCATE_US=$(($1 * 15 / 4)) \
        "$build/bin/pointrt-view" "$scene" --integrator normal --spp 1 --replay "$folder/orbit.txt" --offscreen -q \
        --stats "$folder/stats.json"
    awk -f "$(dirname "$0")/../../../.ci/json.awk" "$folder/stats.json" |
        awk -F '\t' '$1 == "moving_frame_ms.median" { print $2 }'
}

printf '| run |'
printf ' %s us |' "${submissions_us[@]}"
printf '\n|---|%s\n' "$(printf -- '---|%.0s' "${submissions_us[@]}")"
for run in $(seq "$runs"); do
    printf '| %d |' "$run"
    for delay_us in "${submissions_us[@]}"; do printf ' %s |' "$(median "$delay_us")"; done
    printf '\n'
done
