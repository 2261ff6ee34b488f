#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Checks and times a built tree on this machine's GPU: no network, no compiler, no ctest. Writes OUT.json.
#   tests/gpu/run.sh BUILD_DIR OUT.json SCENE.pro...
# POINTRT_DEVICE chooses the device (as pointrt-view --device); by default the first that is not a CPU.
# Exit status: 1 when a test failed, 3 when there is no GPU.
set -euo pipefail
[ $# -ge 3 ] || {
    sed -n '3,6s/^# //p' "$0" >&2
    exit 2
}
bin=$1/bin out=$2
shift 2

"$bin/pointrt-view" --device list
device_option=()
[ -z "${POINTRT_DEVICE:-}" ] || device_option=(--device "$POINTRT_DEVICE")

# The tests that trace on the device: those of readers and trees tell nothing new here.
failed=0
results=()
for program in "$bin"/test_runtime* "$bin"/test_trace*; do
    [ -x "$program" ] || continue
    status=0
    if ldd "$program" | grep -F 'not found' >&2; then
        echo "SKIPPED: $program lacks the libraries above" >&2
        status=null
    else
        "$program" --gtest_brief=1 || status=$?
        [ "$status" = 0 ] || failed=1
    fi
    results+=("{\"program\": \"$(basename "$program")\", \"exit_status\": $status}")
done
[ ${#results[@]} -gt 0 ] || {
    echo "no test_runtime or test_trace programs in $bin" >&2
    exit 2
}

join() {
    local IFS=,
    echo "$*"
}

scenes=()
for scene in "$@"; do
    for room in matte mirror; do
        figures=$("$bin/pointrt-view" "$scene" "${device_option[@]}" --size 1024x1024 --spp 4 --lights 4 \
            --bounces 10 --room "$room" --bench 10)
        case $figures in
            *llvmpipe*) echo "no GPU here: this ran on the CPU" >&2 && exit 3 ;;
        esac
        scenes+=("{\"scene\": \"$(basename "$scene")\", \"room\": \"$room\", \"bench\": $figures}")
    done
done
printf '{"tests": [%s],\n"scenes": [%s]}\n' "$(join "${results[@]}")" "$(join "${scenes[@]}")" >"$out"
echo "figures: $out"
exit "$failed"
