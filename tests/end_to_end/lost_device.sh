#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Devices that are lost, as after a hang: a Vulkan layer (tests/gpu/offline/layer.cpp) fails submissions.
# shellcheck source=lib.sh
. "$(dirname "$0")/lib.sh"

# lose DEVICES SUBMISSION: the first devices of a process are lost at that submission.
lose() {
    [ -d "${POINTRT_LAYER_FOLDER:-}" ] || skip "the layer is not built"
    export VK_ADD_LAYER_PATH=$POINTRT_LAYER_FOLDER VK_INSTANCE_LAYERS=VK_LAYER_POINTRT_pretend
    export POINTRT_LAYER_LOST_DEVICES=$1 POINTRT_LAYER_LOST_AT=$2
}

bakeBall() {
    sphere 3000 >ball.xyz
    pointrt-bake -q ball.xyz -o ball.pro
}

case_pictures_are_rendered_again() {
    bakeBall
    expectDone pointrt-view ball.pro -o whole.png --size 64x48 --spp 6
    lose 1 4
    expectDone pointrt-view ball.pro -o again.png --size 64x48 --spp 6
    grep -q "warning: .*VK_ERROR_DEVICE_LOST.* again" stderr || fail "nothing says that the device was lost"
    cmp whole.png again.png || fail "another picture"
}

case_a_device_lost_twice_is_an_error() {
    bakeBall
    lose 2 4
    run pointrt-view ball.pro -o out/picture.png --size 64x48 --spp 6
    [ "$status" = 3 ] || fail "exit status $status"
    tail -n 1 stderr | grep "error: .*VK_ERROR_DEVICE_LOST" >/dev/null || fail "no error"
    [ -z "$(ls -A out)" ] || fail "a picture nevertheless"
}

# If the device is lost at any point of a replay before the picture is saved, the window reopens with the scene, its
# edits and its view, and renders the same picture. The drag lies within one frame, because a device loss in the middle
# of a drag would end it, and starts below the notice about the loss, which would catch it.
case_windows_go_on_with_the_scene() {
    local submits
    bakeBall
    { echo "pointrt-recording 1 window 480x360 scale 1" && printf '%s\n' "0 wait 1" "1 cursor 240 300" "1 button down left" \
        "1 cursor 280 310" "1 button up left" "4 wait 2" "5 key down V" "5 key up V" "40 wait 2" "41 key down F12" "41 key up F12" \
        "45 quit"; } >user.txt
    lose 1 0
    POINTRT_LAYER_COUNTS=counts.json expectDone pointrt-view ball.pro --replay user.txt --offscreen --spp 2
    ! grep -q lost stderr || fail "lost too early"
    mv ball-1.png whole.png
    submits=$(jsonValue counts.json submits)
    for eighth in 1 2 4; do
        rm -f ball-1.*
        lose 1 $((submits * eighth / 8))
        expectDone pointrt-view ball.pro --replay user.txt --offscreen --spp 2
        grep -q "device was lost and has been opened again" stderr || fail "nothing says that the device was lost"
        cmp whole.png ball-1.png || fail "another picture after a loss at $eighth eighths"
    done
    ! ls "$XDG_STATE_HOME"/pointrt/autosave/*.toml 2>/dev/null || fail "the autosave is left"
}

runCase "$@"
