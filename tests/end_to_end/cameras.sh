#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Pictures from a list of cameras.
# shellcheck source=lib.sh
. "$(dirname "$0")/lib.sh"

# writeList COUNT: cameras on the +z axis that look down at a unit sphere, ball.pro.
writeList() {
    sphere 3000 >ball.xyz
    pointrt-bake -q ball.xyz -o ball.pro
    awk -v count="$1" 'BEGIN {
        print "{\"w\": 48, \"h\": 32, \"fl_x\": 40, \"frames\": ["
        for (i = 0; i < count; i++)
            printf "{\"file_path\": \"in/%05d.jpg\", \"transform_matrix\": [[1,0,0,0],[0,1,0,0],[0,0,1,%g],[0,0,0,1]]}%s\n",
                i, 3 + i / count, i + 1 < count ? "," : ""
        print "]}"
    }' >list.json
}

case_a_picture_of_each() {
    writeList 3
    expectDone pointrt-view ball.pro -v --cameras list.json -o out/set --spp 2 --stats stats.json
    [ "$(cd out/set && echo *)" = "depth exr normal rgb transforms.json" ] || fail "there is $(ls out/set)"
    for layer in depth normal rgb; do
        [ "$(cd out/set/$layer && echo *)" = "00000.png 00001.png 00002.png" ] || fail "$layer: $(ls out/set/$layer)"
    done
    grep -Eq '^wrote 3 pictures and out/set/transforms.json$' stderr || fail "nothing of it on stderr"
    [ "$(jsonValue stats.json width)" = 48 ] || fail "stats.json has no size"
    expectKeys stats.json first_frame_seconds frame_ms.median
    # rendering only the EXR gives the same bytes
    expectDone pointrt-view ball.pro -q --cameras list.json -o out/again --spp 2 --layers exr
    cmp out/set/exr/00001.exr out/again/exr/00001.exr
}

case_an_interrupt_leaves_a_list_of_what_is_there() {
    local viewer status=0
    writeList 10000
    pointrt-view ball.pro -q --cameras list.json -o out/set --spp 16 --layers rgb 2>stderr &
    viewer=$!
    for _ in $(seq 600); do
        [ ! -e out/set/rgb/00001.png ] || break
        sleep 0.1
    done
    kill -TERM "$viewer"
    wait "$viewer" || status=$?
    [ "$status" = 143 ] || fail "exit status $status where 143 was expected"
    grep -Eq 'interrupted after [0-9]+ of 10000 pictures$' stderr || fail "stderr is $(cat stderr)"
    [ "$(find out/set/rgb -type f | wc -l)" = "$(grep -c file_path out/set/transforms.json)" ] || fail "other files"
}

runCase "$@"
