#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The window without a display: recordings replace the user.
# shellcheck source=lib.sh
. "$(dirname "$0")/lib.sh"

# bakeHalf: bakes half.pro, half of a sphere, which looks different from each side.
bakeHalf() {
    sphere 3000 | awk '$1 > 0' >half.xyz
    pointrt-bake -q half.xyz -o half.pro
}

# replay LINES OPTION...: replays these lines of a recording with half.pro, in a window of 160x120.
replay() {
    { echo "pointrt-recording 1 window 160x120 scale 1" && printf '%s\n' "$1"; } >user.txt
    shift
    expectDone pointrt-view half.pro --replay user.txt --offscreen "$@"
}

orbit='0 wait 1
1 cursor 80 60
1 button down left
2 cursor 100 65
3 cursor 120 70
4 button up left'

case_picture_is_that_of_files() {
    bakeHalf
    for room in none matte mirror; do
        replay "$orbit
4 wait 4
5 key down F12
5 key up F12
6 key down Control
6 key down S
7 key up S
7 key up Control
12 quit" --room "$room" --spp 4
        expectDone pointrt-view half-1.toml -o file.png
        cmp half-1.png file.png || fail "the window's picture is not the file's, room $room"
        rm half-1.*
    done
}

# The window's picture and that of its saved scene have the same colours and legend.
case_colours_are_those_of_files() {
    bakeHalf
    replay "0 wait 4
5 key down F12
5 key up F12
6 key down Control
6 key down S
7 key up S
7 key up Control
12 quit" --spp 4 --color-by height --color-map turbo --legend on
    grep -q '^color_by = "height"' half-1.toml || fail "the scene does not keep what it is coloured by"
    expectDone pointrt-view half-1.toml -o file.png
    cmp half-1.png file.png || fail "the window's picture is not the file's"
    expectDone pointrt-view half-1.toml -o plain.png --color-by rgb
    ! cmp -s plain.png file.png || fail "no colours"
    expectDone pointrt-view half-1.toml -o bare.png --legend off
    ! cmp -s bare.png file.png || fail "no legend"
}

# A saved scene shows its room as chosen, and saved again it is the same.
case_saved_room_is_chosen_again() {
    bakeHalf
    save='0 wait 1
6 key down Control
6 key down S
7 key up S
7 key up Control
12 quit'
    for room in studio matte; do
        option=() && [ $room = studio ] || option=(--room $room)
        replay "$save" --spp 1 "${option[@]}"
        grep -A1 '^\[surroundings\]' half-1.toml | grep "^room = \"$room\"" >/dev/null || fail "the scene does not name its room"
        expectDone pointrt-view half-1.toml --replay user.txt --offscreen
        cmp half-1.toml half-1-1.toml || fail "the reopened scene is another one, room $room"
        expectDone pointrt-view half-1.toml --room none --size 32x24 -o none.png
        grep -v of_surroundings half-1.toml | sed '/^\[surroundings\]/,/^$/d' >own.toml
        expectDone pointrt-view own.toml --room none --size 32x24 -o own.png
        ! cmp -s none.png own.png || fail "the room stays, and another one is put around it"
        rm half-1*.toml
    done
}

case_hides_layers() {
    bakeHalf
    sphere 500 | awk '{ print $1 + 3, $2, $3 }' >other.xyz
    pointrt-bake -q other.xyz -o other.pro
    expectDone pointrt-view half.pro other.pro --size 64x48 --lights 1 -o both.png
    expectDone pointrt-view half.pro other.pro --size 64x48 --lights 1 --hide other.pro -o one.png
    expectDone pointrt-view half.pro --size 64x48 --lights 1 --integrator phong -o alone.png
    ! cmp -s both.png one.png || fail "nothing is hidden"
    expectError 2 "--hide: .*\"tower.*half.pro, other.pro" pointrt-view half.pro other.pro --hide tower.pro -o none.png
    cat >scene.toml <<'END'
[camera]
eye = [6, 0, 0]
target = [0, 0, 0]
[[instance]]
file = "half.pro"
name = "the half"
[[shape]]
type = "sphere"
center = [0, 0, 0]
radius = 2
visible = false
[[light]]
type = "point"
position = [9, 9, 9]
intensity = 300
[[light]]
type = "sphere"
center = [2, 0, 0]
radius = 0.5
radiance = 9
visible = false
END
    expectDone pointrt-view scene.toml --size 64x48 -o hidden.png
    awk '/\[\[shape/ { drop = 1 } /\[\[light/ { drop = ++lights > 1 } !drop' scene.toml >bare.toml
    expectDone pointrt-view bare.toml --size 64x48 -o bare.png
    cmp hidden.png bare.png || fail "a hidden shape or light is seen"
    expectDone pointrt-view scene.toml --size 64x48 --hide "the half" -o empty.png
    ! cmp -s hidden.png empty.png || fail "the scan is seen"
}

case_studio_follows_the_scene_not_the_camera() {
    bakeHalf
    replay "$orbit
4 wait 2
5 key down F12
6 key up F12
7 key down Control
7 key down S
8 key up S
12 quit" --spp 2
    expectDone pointrt-view half-1.toml -o file.png
    cmp half-1.png file.png || fail "the window's picture is not the file's"
}

case_clips_are_saved() {
    bakeHalf
    replay "0 wait 4
5 key down F12
5 key up F12
6 key down Control
6 key down S
7 key up S
7 key up Control
12 quit" --spp 4 --clip=-1,-1,-1,1,0.2,1
    grep -qF '[[clip]]' half-1.toml || fail "the scene does not keep its clip"
    expectDone pointrt-view half-1.toml -o file.png
    cmp half-1.png file.png || fail "the window's picture is not the file's"
    sed '/^\[\[clip\]\]/,/^$/d' half-1.toml >whole.toml
    expectDone pointrt-view whole.toml -o whole.png
    ! cmp -s whole.png file.png || fail "the clip cuts nothing"
}

# Two points are picked and kept: the scene has them, and pictures of it show them as the window does.
case_measurements_are_saved() {
    bakeHalf
    replay "0 wait 1
1 cursor 30 60
1 button down left
2 button up left
30 wait 1
31 cursor 40 50
31 button down left
32 button up left
60 wait 1
61 key down K
61 key up K
63 wait 4
64 key down F12
64 key up F12
70 key down Control
70 key down S
71 key up S
71 key up Control
75 quit" --spp 4
    [ "$(grep -c '^\[\[measure\]\]' half-1.toml)" = 1 ] || fail "the scene does not keep its measurement"
    expectDone pointrt-view half-1.toml -o file.png
    cmp half-1.png file.png || fail "the window's picture is not the file's"
    expectDone pointrt-view half-1.toml --hide "measurement 1" -o hidden.png
    sed '/^\[\[measure\]\]/,/^$/d' half-1.toml >without.toml
    expectDone pointrt-view without.toml -o without.png
    cmp hidden.png without.png || fail "a hidden measurement is drawn"
    ! cmp -s without.png file.png || fail "the measurement is not drawn"
    expectDone pointrt-view half-1.toml -o film.exr
    expectDone pointrt-view half-1.toml --hide "measurement 1" -o bare.exr
    cmp film.exr bare.exr || fail "the film has more than light"
}

# A view from above has another up direction than the scene, by which sky and rooms are oriented.
case_keeps_the_scenes_up() {
    bakeHalf
    replay "0 wait 1
1 key down 7
1 key up 7
14 key down 5
14 key up 5
28 wait 4
29 key down F12
29 key up F12
30 key down Control
30 key down S
31 key up S
31 key up Control
33 quit" --room mirror --lights 0 --spp 4
    expectDone pointrt-view half-1.toml -o file.png
    cmp half-1.png file.png || fail "the window's picture is not the file's"
}

case_records_its_input() {
    bakeHalf
    replay "$orbit
4 screenshot first
5 quit" --record again.txt
    cp first.png once.png
    expectDone pointrt-view half.pro --replay again.txt --offscreen
    [ "$(grep -c cursor again.txt)" = 3 ] || fail "cursor events were lost"
}

case_survives_any_size_and_key() {
    bakeHalf
    awk -v seed=1 'BEGIN {
        srand(seed)
        split("H P Tab Home 1 3 7 9 5 Space M V W A S D Q E", keys, " ")
        print "pointrt-recording 1 window 160x120 scale 1"
        for (frame = 1; frame <= 150; frame++) {
            pick = int(rand() * 6)
            if (pick == 0) printf "%d resize %dx%d scale %g\n", frame, rand() * 300, rand() * 300, 0.5 + int(rand() * 3) / 2
            if (pick == 1) { key = keys[1 + int(rand() * 18)]; printf "%d key down %s\n%d key up %s\n", frame, key, frame, key }
            if (pick == 2) printf "%d cursor %d %d\n", frame, rand() * 400 - 50, rand() * 400 - 50
            if (pick == 3) printf "%d button %s %s\n", frame, rand() < 0.5 ? "down" : "up", rand() < 0.7 ? "left" : "right"
            if (pick == 4) printf "%d wheel 0 %d\n", frame, rand() * 9 - 4
        }
        print "151 resize 160x120 scale 1"
        print "152 quit"
    }' >user.txt
    # without leak detection, for the reason in tests/CMakeLists.txt
    POINTRT_VALIDATION=1 ASAN_OPTIONS=detect_leaks=0 expectDone \
        pointrt-view half.pro --replay user.txt --offscreen --stats stats.json
    expectKeys stats.json device width moving_frame_ms.p95 refining_frame_ms.median first_picture_seconds
    [ "$(jsonValue stats.json width)" = 160 ] || fail "the window kept another size"
}

case_opens_what_is_dropped() {
    useCache bakes
    bakeHalf
    mkdir scans
    cp half.xyz "scans/a b.xyz"
    replay "0 wait 1
1 drop \"scans/a b.xyz\"
40 wait 1
41 screenshot dropped
42 key down Control
42 key down S
43 key up S
43 key up Control
44 quit"
    [ "$(ls scans)" = "a b.xyz" ] || fail "something was written beside the scan"
    [ -s dropped.png ] || fail "no screenshot"
    # the scene does not depend on the cache
    cmp "a b.pro" "$(find "$kept" -name '*.pro')" || fail "the bake is not kept for the scene"
    rm -r "$kept"
    expectDone pointrt-view "a b-1.toml" -o file.png
}

# Without a scene the window has a page to start from, with the files opened last.
case_starts_without_a_scene() {
    bakeHalf
    { echo "pointrt-recording 1 window 320x240 scale 1" && printf '%s\n' "2 screenshot empty" "3 drop \"half.pro\"" "5 wait 1" \
        "6 screenshot shown" "7 quit"; } >user.txt
    expectDone pointrt-view --replay user.txt --offscreen --spp 1
    [ "$(cat "$XDG_STATE_HOME/pointrt/recent")" = "$PWD/half.pro" ] || fail "the file is not listed"
    ! cmp -s empty.png shown.png || fail "nothing was opened"
    expectError 2 "no SCENE given" pointrt-view
}

# Killed after an edit, the window offers it when the file is opened again; a saved or unwanted edit is not offered.
case_edits_survive_a_crash() {
    local id left
    bakeHalf
    left=$XDG_STATE_HOME/pointrt/autosave
    { echo "pointrt-recording 1 window 160x120 scale 1" && printf '%s\n' "0 wait 1" "1 key down V" "1 key up V" "100000 quit"; } >user.txt
    pointrt-view half.pro --replay user.txt --offscreen --spp 1 &
    id=$!
    for _ in $(seq 200); do
        ! ls "$left"/*.toml >/dev/null 2>&1 || break
        sleep 0.1
    done
    kill -KILL "$id"
    wait "$id" || true
    ls "$left"/*.toml >/dev/null || fail "the edit was not kept"
    replay "0 wait 1
2 screenshot question
3 key down Escape
3 key up Escape
4 wait 1
5 key down Control
5 key down S
5 key up S
5 key up Control
8 quit" --spp 1
    grep -q "view 1" half-1.toml || fail "the edit was not restored"
    [ -z "$(find "$left" -type f)" ] || fail "what is saved is still kept"
}

# A view is saved every half second of the window's clock. Killed at any time, the window loses at most those of the last
# second, and nothing that it left is half a file.
case_a_kill_loses_a_second_of_edits() {
    local id left views shots moment
    bakeHalf
    left=$XDG_STATE_HOME/pointrt/autosave
    awk 'BEGIN {
        print "pointrt-recording 1 window 160x120 scale 1\n0 wait 1"
        for (edit = 1; edit <= 2000; edit++)
            printf "%d key down V\n%d key up V\n%d screenshot shot%d\n", 15 * edit, 15 * edit, 15 * edit + 1, edit
        print "100000 quit"
    }' >edits.txt
    for moment in 5 8 13; do
        rm -rf shot*.png "$left"
        pointrt-view half.pro --replay edits.txt --offscreen --spp 1 &
        id=$!
        for _ in $(seq 600); do
            [ ! -e shot$moment.png ] || break
            sleep 0.1
        done
        kill -KILL "$id"
        wait "$id" || true
        shots=$(find . -name 'shot*.png' | wc -l)
        [ "$shots" -ge "$moment" ] || fail "the window is too slow for this test"
        views=$(cat "$left"/*.toml | grep -c '^\[\[view\]\]')
        echo "killed after $shots edits: $views are kept"
        [ "$views" -ge $((shots - 2)) ] || fail "of $shots edits only $views are kept"
        # Esc restores them, as it is the last answer
        replay "0 wait 1
3 key down Escape
3 key up Escape
4 wait 1
5 key down Control
5 key down S
5 key up S
5 key up Control
8 quit" --spp 1
        [ "$(grep -c '^\[\[view\]\]' half-1.toml)" = "$views" ] || fail "not all that was kept is restored"
        rm half-1.toml
    done
}

# Ctrl+Q asks about unsaved edits; Esc cancels the question, Ctrl+Z makes it unnecessary.
case_asks_before_edits_are_lost() {
    bakeHalf
    replay "0 wait 1
1 key down V
1 key up V
3 key down Control
3 key down Q
3 key up Q
4 key up Control
5 key down Escape
5 key up Escape
7 key down Control
7 key down Z
7 key up Z
9 key down Q
9 key up Q
9 key up Control
12 screenshot late
20 quit" --spp 1
    [ ! -e late.png ] || fail "Ctrl+Q did not quit without edits"
    replay "0 wait 1
1 key down V
1 key up V
3 key down Control
3 key down Q
3 key up Q
3 key up Control
12 screenshot late
20 quit" --spp 1
    [ -s late.png ] || fail "Ctrl+Q quit with unsaved edits"
}

case_wrong_input() {
    bakeHalf
    echo nonsense >bad.txt
    expectError 1 "bad.txt:1: " pointrt-view half.pro --replay bad.txt --offscreen
    expectError 1 "missing.txt" pointrt-view half.pro --replay missing.txt --offscreen
    { echo "pointrt-recording 1 window 64x64 scale 1" && echo "0 wait 1"; } >user.txt
    expectError 1 "missing.pro" pointrt-view missing.pro --replay user.txt --offscreen
    expectError 2 "--offscreen .*--replay FILE" pointrt-view half.pro --offscreen
    expectError 4 "no/such" pointrt-view half.pro --replay user.txt --offscreen --record no/such/file.txt
}

# Layers: the only scan is turned about z and made larger; both undone, the picture is the former one again.
case_scans_are_moved_and_undone() {
    local start=("0 wait 2" "0 key down F12" "0 key up F12" "1 wait 2" "2 cursor 660 18" "2 button down left" "3 button up left" "5 wait 2")
    sphere 2000 | awk '{ print $1, 0.5 * $2, 0.3 * $3 }' >egg.xyz
    pointrt-bake -q egg.xyz -o egg.pro
    { echo "pointrt-recording 1 window 900x700 scale 1" && printf '%s\n' "${start[@]}" "6 cursor 740 389" "6 button down left" \
        "7 cursor 800 389" "8 cursor 840 389" "8 button up left" "9 wait 2" "10 cursor 740 415" "11 button down left" \
        "12 cursor 780 415" "13 cursor 790 415" "13 button up left" "13 wait 2" "13 key down F12" "13 key up F12" "14 wait 2" "15 key down Control" \
        "15 key down S" "15 key up S" "16 wait 2" "17 key down Z" "17 key up Z" "18 wait 2" "19 key down Z" "19 key up Z" \
        "19 key up Control" "20 wait 2" "21 key down F12" "21 key up F12" "22 wait 2" "23 quit"; } >user.txt
    expectDone pointrt-view egg.pro --replay user.txt --offscreen --spp 2
    ! cmp -s egg-1.png egg-2.png || fail "nothing has moved"
    cmp egg-1.png egg-3.png || fail "undo does not bring the picture back"
    grep -q "rotate = { matrix" egg-1.toml || fail "the saved scene has no rotation"
    grep -Eq "scale = 1\.[1-9]" egg-1.toml || fail "the saved scene has another scale"
}

# The arrow along z, in the middle of the free part of the window, moves the scan up; dragging it does not turn the
# view.
case_arrows_move_scans() {
    sphere 2000 | awk '{ print $1, 0.5 * $2, 0.3 * $3 }' >egg.xyz
    pointrt-bake -q egg.xyz -o egg.pro
    { echo "pointrt-recording 1 window 900x700 scale 1" && printf '%s\n' "0 wait 2" "2 cursor 660 18" "2 button down left" \
        "3 button up left" "5 wait 2" "6 cursor 303 266" "8 button down left" "9 cursor 303 230" "10 cursor 303 200" \
        "11 button up left" "12 wait 2" "13 key down Control" "13 key down S" "13 key up S" "13 key up Control" "14 wait 2" \
        "15 quit"; } >user.txt
    expectDone pointrt-view egg.pro --replay user.txt --offscreen --spp 2
    grep -Eq "^translate = \[0(\.0)?, 0(\.0)?, 0\.[1-9]" egg-1.toml || fail "moved elsewhere: $(grep translate egg-1.toml)"
}

runCase "$@"
