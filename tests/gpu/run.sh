#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Tests and times a built tree on this machine's GPU. Needs no network, compiler or ctest. Writes OUT.json.
#   tests/gpu/run.sh BUILD_DIR OUT.json SCENE.pro...
# Runs the tests that trace on the device, and for each scene trace_speed, whose hits must equal Embree's, and pointrt-view,
# for frame times. Reports and skips programs whose libraries are missing: libembree3 and libtbb12 may be in a folder named
# by LD_LIBRARY_PATH.
# POINTRT_DEVICE selects the device (as pointrt-view --device; default: the best); the tests always use the best.
# POINTRT_GPU_ALLOW_CPU=1 accepts a CPU device. POINTRT_GPU_FRAMES: number of frames to time (default: 10).
# SPEED_OPTIONS: options for trace_speed.
# Exit status: 1 if a test failed, hits differ or a scene is bad; 3 if there is no GPU; 4 if OUT.json cannot be written.
set -euo pipefail

# Picture sizes: that of most tables in tests/bench/RESULTS.md, and four times its pixels.
sizes=(512 1024)
# Least share of rays with the same hit as Embree's. The others may be at rims of discs or ties, where rounding decides.
least_agreement=0.99

die() {
    echo "$(basename "$0"): $2" >&2
    exit "$1"
}
[ $# -ge 3 ] || {
    sed -n '4s/^# */usage: /p' "$0" >&2
    exit 2
}
bin=$1/bin out=$2
shift 2
view=$bin/pointrt-view
[ -x "$view" ] || die 2 "$view: not there; BUILD_DIR is the folder with bin/"
for scene in "$@"; do
    [ -r "$scene" ] || die 1 "$scene: not there or not readable"
done
device_option=()
[ -z "${POINTRT_DEVICE:-}" ] || device_option=(--device "$POINTRT_DEVICE")

# probe SCENE [OPTION...]: renders a small frame, and prints the name of the device that pointrt-view chose.
probe() {
    local scene=$1 figures
    shift
    figures=$("$view" "$scene" "$@" --size 16x16 --integrator depth --bench 1) || return
    sed -n 's/^ *"device": "\(.*\)",$/\1/p' <<<"$figures"
}

devices=$("$view" --device list)
printf '%s\n' "$devices"
for scene in "$@"; do # all scenes, to find a bad one before the long work
    device=$(probe "$scene" "${device_option[@]}")
done
tests_device=$(probe "$1")
echo "device: $device"
# Lines of the list are N "NAME", TYPE, ...
if grep -qF "\"$device\", CPU, " <<<"$devices" && [ "${POINTRT_GPU_ALLOW_CPU:-0}" != 1 ]; then
    die 3 "no GPU here: $device runs on the CPU; POINTRT_GPU_ALLOW_CPU=1 takes it all the same"
fi
{ : >"$out"; } 2>/dev/null || die 4 "$out: cannot be written"

# driverOf DEVICE: the driver of the device of this name, by nvidia-smi, which comes with the driver, or by vulkaninfo.
driverOf() {
    local found=''
    if command -v nvidia-smi >/dev/null; then
        found=$(nvidia-smi --query-gpu=name,driver_version --format=csv,noheader 2>/dev/null |
            awk -v name="$1" 'index($0, name ", ") == 1 { print "NVIDIA " substr($0, length(name) + 3); exit }') || true
    fi
    if [ -z "$found" ] && command -v vulkaninfo >/dev/null; then
        found=$(vulkaninfo --summary 2>/dev/null | awk -v name="$1" '
            { value = substr($0, index($0, "=") + 2) }
            $1 == "deviceName" { ours = value == name }
            $1 == "driverName" && ours { driver = value }
            $1 == "driverInfo" && ours { print driver " " value; exit }') || true
    fi
    echo "${found:-unknown}"
}

left_out=()
leaveOut() {
    left_out+=("$1")
    echo "LEFT OUT: $1" >&2
}

# starts PROGRAM: whether it and all its libraries are here; reports what is missing.
starts() {
    local name missing
    name=$(basename "$1")
    if [ ! -x "$1" ]; then
        leaveOut "$name: not built"
        return 1
    fi
    missing=$(ldd "$1" 2>&1 | sed -n 's/^[ \t]*\(.*not found\).*/\1/p' | tr '\n' ' ')
    [ -z "$missing" ] || leaveOut "$name: ${missing% }"
    [ -z "$missing" ]
}

failures=()
fail() {
    failures+=("$1")
    echo "FAILED: $1" >&2
}

join() {
    local IFS=,
    echo "$*"
}

jsonString() {
    local text=${1//\\/\\\\}
    printf '"%s"' "${text//\"/\\\"}"
}

jsonStrings() {
    local each strings=()
    for each in "$@"; do strings+=("$(jsonString "$each")"); done
    printf '[%s]' "$(join "${strings[@]}")"
}

# onDevice FIGURES WHAT: fails if WHAT, which selects a device itself, ran on another one.
onDevice() {
    grep -qF "\"device\": \"$device\"" <<<"$1" || die 3 "$2 did not run on $device"
}

driver=$(driverOf "$device")
echo "driver: $driver"

tests=() started=0
for program in "$bin"/test_runtime_host "$bin"/test_trace "$bin"/test_embree "$bin"/test_speed; do
    status=null
    if starts "$program"; then
        started=$((started + 1)) status=0
        "$program" --gtest_brief=1 || status=$?
        [ "$status" = 0 ] || fail "$(basename "$program"), exit status $status"
    fi
    tests+=("{\"program\": \"$(basename "$program")\", \"exit_status\": $status}")
done
[ "$started" -gt 0 ] || fail "no test program starts here"

# checkAgreement < FIGURES: prints a line for each kind of ray; fails if too few hits equal Embree's.
checkAgreement() {
    awk -F '": |,$' -v least="$least_agreement" '
        $1 ~ /"scene$/ { scene = $2 }
        $1 ~ /"rays$/ { kind = $2 }
        $1 ~ /"mrays_per_second$/ { rate = $2 }
        $1 ~ /"agreement$/ {
            printf "%s %s: %.1f Mrays/s, %.4f %% agree with Embree\n", scene, kind, rate, 100 * $2
            kinds++
            wrong += $2 + 0 < least
        }
        END { exit wrong > 0 || kinds == 0 }'
}

rays=()
read -ra speed_options <<<"${SPEED_OPTIONS:-}"
if starts "$bin/trace_speed"; then
    for scene in "$@"; do
        figures=$("$bin/trace_speed" "$scene" "${device_option[@]}" --json "${speed_options[@]}") || {
            fail "trace_speed $scene, exit status $?"
            continue
        }
        onDevice "$figures" trace_speed
        checkAgreement <<<"$figures" || fail "$scene: fewer than $least_agreement of the rays hit what Embree's hit"
        rays+=("$(sed '1d;$d' <<<"$figures")") # the entries of the JSON array, to be joined with those of other scenes
    done
fi

frames=()
for scene in "$@"; do
    for size in "${sizes[@]}"; do
        for room in matte mirror; do
            figures=$("$view" "$scene" "${device_option[@]}" --size "${size}x$size" --spp 4 --lights 4 --bounces 10 \
                --room "$room" --bench "${POINTRT_GPU_FRAMES:-10}") || {
                fail "pointrt-view $scene, $room room, ${size}x$size, exit status $?"
                continue
            }
            onDevice "$figures" pointrt-view
            name=$(jsonString "$(basename "$scene")")
            echo "$name $room ${size}x$size: $(sed -n 's/^ *"frame_ms": {\(.*\)},$/\1/p' <<<"$figures") ms"
            frames+=("{\"scene\": $name, \"room\": \"$room\", \"bench\": $figures}")
        done
    done
done

processor=$(awk -F ': ' '/^model name/ { print $2; exit }' /proc/cpuinfo) # Embree ran on it
{
    printf '{"device": "%s", "driver": %s,\n' "$device" "$(jsonString "$driver")"
    printf '"processor": %s, "cores": %d,\n' "$(jsonString "$processor")" "$(nproc)"
    printf '"tests_device": "%s", "tests": [%s],\n' "$tests_device" "$(join "${tests[@]}")"
    printf '"failures": %s,\n' "$(jsonStrings "${failures[@]}")"
    printf '"left_out": %s,\n' "$(jsonStrings "${left_out[@]}")"
    printf '"least_agreement": %s, "rays": [%s],\n' "$least_agreement" "$(join "${rays[@]}")"
    printf '"frames": [%s]}\n' "$(join "${frames[@]}")"
} >"$out"
for reason in "${left_out[@]}"; do echo "LEFT OUT: $reason" >&2; done
for failure in "${failures[@]}"; do echo "FAILED: $failure" >&2; done
echo "figures: $out"
[ ${#failures[@]} -eq 0 ]
