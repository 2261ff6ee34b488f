#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Turntables and named views: many pictures of one scene.
# shellcheck source=lib.sh
. "$(dirname "$0")/lib.sh"

small="-q --size 32x32 --spp 2 --denoise off"

# writeScene: writes half.pro, half of a sphere, which looks different from each side, and a scene file with two views.
writeScene() {
    sphere 3000 | awk '$1 > 0' >half.xyz
    pointrt-bake -q half.xyz -o half.pro
    cat >scene.toml <<'EOF'
[camera]
eye = [0, 1, 4]
[[view]]
name = "side"
eye = [4, 1, 0]
target = [0, 0, 0]
[[view]]
name = "top view"
eye = [0, 5, 0]
[[instance]]
file = "half.pro"
EOF
}

case_begins_with_the_plain_picture() {
    writeScene
    # shellcheck disable=SC2086 # words
    {
        expectDone pointrt-view half.pro $small -o plain.png
        expectDone pointrt-view half.pro $small --turntable 3 -o out/a%02d.png
        expectDone pointrt-view half.pro $small -o plain.exr
        expectDone pointrt-view half.pro $small --turntable 2 -o out/b%d.exr --stats stats.json
    }
    [ "$(echo out/*)" = "out/a00.png out/a01.png out/a02.png out/b0.exr out/b1.exr" ] || fail "there is $(echo out/*)"
    cmp plain.png out/a00.png
    cmp plain.exr out/b0.exr
    ! cmp -s out/a00.png out/a01.png || fail "the second picture is the first"
    ! cmp -s out/a01.png out/a02.png || fail "the third picture is the second"
    ! cmp -s out/b0.exr out/b1.exr || fail "the second film is the first"
    expectKeys stats.json first_frame_seconds frame_ms.median
}

case_tells_how_far_it_is() {
    writeScene
    expectDone pointrt-view half.pro -v --size 32x32 --spp 1 --turntable 10 -o out/%d.png
    grep -Eq '^rendering 50%, [0-9.]+ s left, picture 5 of 10, ' stderr || fail "no progress on stderr"
}

case_wrong_patterns() {
    writeScene
    expectError 2 "out/a.png: --turntable .*%d" pointrt-view half.pro --turntable 3 -o out/a.png
    expectError 2 "out/%d%d.png: " pointrt-view half.pro --turntable 3 -o out/%d%d.png
    expectError 2 "out/%4d.png: " pointrt-view half.pro --turntable 3 -o out/%4d.png
    expectError 2 "out/%04d.png: .*--turntable" pointrt-view half.pro -o out/%04d.png
    expectError 2 "--turntable: " pointrt-view half.pro --turntable 0 -o out/%d.png
    expectError 2 "--turntable: .*-o FILE" pointrt-view half.pro --turntable 3
    expectError 2 "--turntable and --resume" pointrt-view half.pro --turntable 3 --resume -o out/%d.exr
    expectError 2 "--turntable and --bench" pointrt-view half.pro --turntable 3 --bench 1 -o out/%d.png
    expectError 4 "none/0.png: .*folder" pointrt-view half.pro --turntable 3 -o none/%d.png
}

case_an_interrupt_leaves_whole_pictures() {
    local viewer status=0
    writeScene
    pointrt-view half.pro -q --size 64x64 --spp 16 --turntable 10000 -o out/%05d.png 2>stderr &
    viewer=$!
    for _ in $(seq 600); do
        [ ! -e out/00001.png ] || break
        sleep 0.1
    done
    kill -TERM "$viewer"
    wait "$viewer" || status=$?
    [ "$status" = 143 ] || fail "exit status $status where 143 was expected"
    grep -Eq 'interrupted after [0-9]+ of 10000 pictures$' stderr || fail "stderr is $(cat stderr)"
    [ "$(find out -type f | wc -l)" = "$(grep -Eo '[0-9]+ of' stderr | grep -Eo '[0-9]+')" ] || fail "other files"
    for picture in out/*; do
        [ "$(tail -c 8 "$picture" | head -c 4)" = IEND ] || fail "$picture is cut off"
    done
}

case_path_through_the_views() {
    writeScene
    # shellcheck disable=SC2086 # words
    {
        expectDone pointrt-view scene.toml $small --lights 3 --path 3 -o out/p%d.png
        expectDone pointrt-view scene.toml $small --lights 3 --integrator depth --path 2 -o out/d%d.png
        expectDone pointrt-view scene.toml $small --lights 3 --integrator depth --view "top view" -o out/last.png
    }
    [ "$(echo out/p*)" = "out/p0.png out/p1.png out/p2.png" ] || fail "there is $(echo out/p*)"
    ! cmp -s out/p0.png out/p1.png || fail "the second picture is the first"
    ! cmp -s out/p1.png out/p2.png || fail "the third picture is the second"
    cmp out/d1.png out/last.png || fail "the path does not end at the last view"
    expectError 2 "--path: .*half.pro has 0 .*two" pointrt-view half.pro -q --path 3 -o out/%d.png
    expectError 2 "--path: .*--turntable and --path" pointrt-view scene.toml --turntable 2 --path 3 -o out/%d.png
    expectError 2 "out/a.png: --path .*%d" pointrt-view scene.toml --path 3 -o out/a.png
}

case_views() {
    writeScene
    # shellcheck disable=SC2086 # words
    {
        expectDone pointrt-view scene.toml $small --room matte -o out/camera.png
        expectDone pointrt-view scene.toml $small --room matte --view side -o out/side.png
        expectDone pointrt-view scene.toml $small --lights 3 --eye 4,1,0 --target 0,0,0 --integrator depth -o out/a.png
        expectDone pointrt-view scene.toml $small --lights 3 --view side --integrator depth -o out/b.png
        expectDone pointrt-view scene.toml $small --view "top view" --turntable 2 -o out/top%d.png
    }
    ! cmp -s out/camera.png out/side.png || fail "--view changes nothing"
    cmp out/a.png out/b.png
    expectError 2 'scene.toml .*view "inside"; .*side, top view, .*front, back' \
        pointrt-view scene.toml -q --view inside -o out/c.png
    expectError 2 'half.pro .*view "side"; .*none, ' pointrt-view half.pro -q --view side -o out/c.png
}

runCase "$@"
