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

# pretendEncoder BODY: a program ffmpeg that runs BODY; $video is the file that it is to write.
pretendEncoder() {
    mkdir -p tools
    printf '#!/bin/sh\necho "$@" >>%q/called\nfor video; do :; done\n%s\n' "$PWD" "$1" >tools/ffmpeg
    chmod +x tools/ffmpeg
    export PATH=$PWD/tools:$PATH
}

# ffmpeg gets all pictures, in order, at the frame rate; only the video is left.
case_video_of_all_pictures() {
    writeScene
    pretendEncoder 'ls -R out >listed; echo film >"$video"'
    # shellcheck disable=SC2086 # words
    expectDone pointrt-view scene.toml $small --path 3 --fps 12 -o out/flight.mp4
    [ "$(cat out/flight.mp4)" = film ] || fail "the video is not what ffmpeg wrote"
    [ "$(ls -A out)" = flight.mp4 ] || fail "left behind: $(ls -A out)"
    [ "$(grep -c 'png$' listed)" = 3 ] || fail "ffmpeg got $(cat listed)"
    grep -q -e '-framerate 12 ' called || fail "another frame rate: $(cat called)"
    # shellcheck disable=SC2086
    expectDone pointrt-view half.pro $small --turntable 2 -o out/turn.webm
    grep -q 'vp9' called || fail "a WebM is not VP9: $(cat called)"
}

# What ffmpeg says is passed on, and pictures that took long to render are not lost.
case_a_failed_video_leaves_its_pictures() {
    writeScene
    pretendEncoder 'echo "no room in the reel" >&2; exit 1'
    # shellcheck disable=SC2086 # words
    run pointrt-view scene.toml $small --path 3 -o out/flight.mp4
    [ "$status" = 3 ] || fail "exit status $status where 3 was expected"
    grep -q 'flight.mp4: .*no room in the reel' stderr || fail "ffmpeg's reason is not given"
    [ ! -e out/flight.mp4 ] || fail "a video was written"
    [ "$(find out -name '*.png' | wc -l)" = 3 ] || fail "the pictures are gone"
    pretendEncoder 'echo film >"$video"'
    # shellcheck disable=SC2086
    expectDone pointrt-view scene.toml $small --path 2 -o out/flight.mp4
    [ "$(ls -A out)" = flight.mp4 ] || fail "the former pictures are left: $(ls -A out)"
}

case_a_video_needs_ffmpeg_and_a_moving_camera() {
    local shell
    writeScene
    expectError 2 "out/a.mp4: .*--turntable or --path" pointrt-view half.pro -o out/a.mp4
    expectError 2 "out/a.mp4: .*transparent" pointrt-view half.pro --turntable 2 --background transparent -o out/a.mp4
    shell=$(command -v pointrt-view)
    run env PATH=/nowhere "$shell" half.pro --turntable 2 -o out/a.mp4
    [ "$status" = 3 ] || fail "exit status $status where 3 was expected"
    grep -q 'out/a.mp4: ffmpeg.*/nowhere' stderr || fail "it does not say what is missing: $(cat stderr)"
    [ -z "$(ls -A out)" ] || fail "left behind: $(ls -A out)"
}

# The real ffmpeg: as many pictures as were rendered, of even sides, at the frame rate.
case_video_plays() {
    local played
    command -v ffmpeg >/dev/null && command -v ffprobe >/dev/null || skip "ffmpeg is not installed"
    ffmpeg -hide_banner -encoders >encoders 2>/dev/null
    grep -q libx264 encoders || skip "ffmpeg lacks libx264"
    writeScene
    expectDone pointrt-view scene.toml -q --size 33x31 --spp 1 --denoise off --path 5 --fps 10 -o out/flight.mp4
    played=$(ffprobe -v error -count_frames -select_streams v \
        -show_entries stream=width,height,r_frame_rate,nb_read_frames -of csv=p=0 out/flight.mp4)
    [ "$played" = "34,32,10/1,5" ] || fail "width, height, rate and pictures are $played"
}

runCase "$@"
