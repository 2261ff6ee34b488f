#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The window of pointrt-view for Windows: a recording replayed in Wine on an X server gives the same picture as here.
# shellcheck source=lib.sh
. "$(dirname "$0")/lib.sh"
needsDisplay
needs pointrt-view

sphere 3000 | awk '$1 > 0' >half.xyz
"$bin/pointrt-bake" -q half.xyz -o half.pro
cat >user.txt <<'END'
pointrt-recording 1 window 640x480 scale 1
0 wait 1
1 cursor 150 200
1 button down left
2 cursor 170 205
3 cursor 190 210
4 button up left
4 wait 4
5 screenshot shown
5 key down F12
5 key up F12
6 key down Control
6 key down S
7 key up S
7 key up Control
12 quit
END

# replayed NAME COMMAND...: runs a replay and moves its files into the folder NAME. Picture and scene must be the same
# on both systems, except for the last digits of the camera, where trigonometric functions round differently.
replayed() {
    local folder=$1
    shift
    mkdir "$folder"
    cp half.pro "$folder"
    (cd "$folder" && "$@" half.pro --replay ../user.txt --spp 4 >../log 2>&1) || fail "$folder: $(cat log)"
    for file in half-1.exr shown.png; do [ -s "$folder/$file" ] || fail "$folder: no $file"; done
    cmp here/half-1.png "$folder/half-1.png" || fail "$folder: another picture"
    [ "$(rounded here)" = "$(rounded "$folder")" ] || fail "$folder: another scene: $(cat "$folder/half-1.toml")"
}
rounded() { sed -E 's/([0-9]\.[0-9]{6})[0-9]*/\1/g' "$1/half-1.toml"; }
replayed here "$bin/pointrt-view" --offscreen
replayed offscreen wine "$build/bin/pointrt-view.exe" --offscreen
replayed window wine "$build/bin/pointrt-view.exe"
echo "the same in Windows"
