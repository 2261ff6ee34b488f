# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# Shared by the tests that compare the tools for Windows, run in Wine, with those of this system. A script sources this
# with the arguments
#   REPOSITORY BIN BUILD   BIN: the tools of this system; BUILD: where build.sh has built those for Windows
# and then runs in an empty folder.
set -euo pipefail
repository=$1 bin=$2 build=$3
golden=$repository/tests/format/golden

fail() {
    echo "$*" >&2
    exit 1
}
# skip REASON: CTest counts exit status 77 as a skipped test.
skip() {
    echo "SKIPPED: $*"
    exit 77
}

command -v wine >/dev/null || skip "no wine here: install wine and wine64"
[ -e "$build/wine" ] || skip "Wine was not set up: windows.build says why"

work=$(mktemp -d)
x_server=
finish() {
    wineserver -k 2>/dev/null || true # this prefix's alone; CMakeLists.txt lets one test at a time use it
    [ -z "$x_server" ] || kill "$x_server"
    rm -rf "$work"
}
trap finish EXIT
export WINEPREFIX=$build/wine WINEDEBUG=-all LC_ALL=C.UTF-8 POINTRT_INDEX_CACHE=off
unset DISPLAY WAYLAND_DISPLAY
cd "$work"
# Nothing is baked yet, on either side.
export XDG_CACHE_HOME=$work/cache
rm -rf "$WINEPREFIX"/drive_c/users/*/AppData/Local/pointrt
# One server for the whole test: otherwise each program would start and stop its own, which takes seconds.
wineserver -p || true # it may be running already

# needs TOOL: skips the test if there is no such tool for Windows.
needs() {
    [ -e "$build/bin/$1.exe" ] || skip "$1.exe was not built: windows.build says why"
    wine "$build/bin/$1.exe" --version >log 2>&1 || fail "$1.exe does not run in Wine: $(cat log)"
}
# needsDisplay: starts an X server. Without one Wine shows neither windows nor Vulkan devices.
needsDisplay() {
    command -v Xvfb >/dev/null || skip "no Xvfb here"
    mkfifo display
    Xvfb -displayfd 3 -screen 0 1280x1024x24 -nolisten tcp 3>display 2>/dev/null &
    x_server=$!
    read -r number <display
    export DISPLAY=:$number
}

# run TOOL ARGUMENT...: runs both tools, with output in here.out, here.err, windows.out and windows.err; their exit
# codes must be equal.
run() {
    local code=0 code_there=0 tool=$1
    shift
    "$bin/$tool" "$@" >here.out 2>here.err </dev/null || code=$?
    wine "$build/bin/$tool.exe" "$@" >windows.out 2>windows.err </dev/null || code_there=$?
    [ $code = $code_there ] || fail "$tool $*: exit code $code_there in Windows, $code here: $(cat windows.err)"
}
# alike TOOL ARGUMENT...: both must print the same.
alike() {
    run "$@"
    cmp here.out windows.out || fail "$*: prints otherwise in Windows: $(head -c 300 windows.out)"
    cmp here.err windows.err || fail "$*: complains otherwise in Windows: $(cat windows.err)"
}
# refused TOOL ARGUMENT...: both must print one line with the reason, and have the same exit code.
refused() {
    run "$@"
    [ "$(wc -l <windows.err)" = 1 ] || fail "$*: not one line: $(cat windows.err)"
    grep -q "^$1: error: " windows.err || fail "$*: $(cat windows.err)"
}
# written FILE TOOL ARGUMENT...: with -o FILE, both must write the same file and print the same, except that Windows
# joins paths with \.
written() {
    local file=$1 tool=$2 name
    shift 2
    name=$(basename "$file")
    "$bin/$tool" "$@" -o "$file" >here.out 2>here.err </dev/null || fail "$tool $*: $(cat here.err)"
    mv "$file" "here.$name"
    wine "$build/bin/$tool.exe" "$@" -o "$file" >windows.out 2>windows.err </dev/null ||
        fail "$tool $*: fails in Windows: $(cat windows.err)"
    cmp "here.$name" "$file" || fail "$tool $* -o $file: another file in Windows"
    tr '\\' / <windows.err | cmp here.err - || fail "$tool $*: says otherwise in Windows: $(cat windows.err)"
}

# Names with any characters, and paths longer than the traditional limit of 260 characters.
long=$(printf '%0100d/' 1 2 3)
mkdir -p "$long"
names=('Müller, Straße' 'скан 点群' 'emoji 😀' "${long}scan")

# sphere COUNT: COUNT points spread over a unit sphere, as text.
sphere() {
    awk -v count="$1" 'BEGIN {
        for (i = 0; i < count; i++) {
            z = 1 - (2 * i + 1) / count; r = sqrt(1 - z * z); phi = i * 2.399963229728653
            printf "%.6f %.6f %.6f %d %d %d\n", r * cos(phi), r * sin(phi), z, i % 256, 255 - i % 256, 128
        }
    }'
}
# writeScene: scene.toml, spheres of glass, splats and mirror on a plane, of sphere.pro
writeScene() {
    cat >scene.toml <<'END'
[camera]
eye = [0, 2, 6]
target = [0, 0.5, 0]
[material.glass]
kind = "glass"
[material.mirror]
kind = "mirror"
[[instance]]
file = "sphere.pro"
material = "glass"
[[instance]]
file = "sphere.pro"
translate = [-2, 0, -1]
scale = 0.5
[[shape]]
type = "sphere"
center = [2, 0, -1]
radius = 1
material = "mirror"
[[shape]]
type = "plane"
point = [0, -1, 0]
normal = [0, 1, 0]
[[light]]
type = "sphere"
center = [3, 5, 2]
radius = 0.5
power = 500
END
}
# writeCameras: cameras.json, two pinhole cameras
writeCameras() {
    cat >cameras.json <<'END'
{"w": 48, "h": 32, "fl_x": 40, "frames": [
{"file_path": "in/1.jpg", "transform_matrix": [[1,0,0,0],[0,1,0,0],[0,0,1,3],[0,0,0,1]]},
{"file_path": "in/2.jpg", "transform_matrix": [[1,0,0,0],[0,1,0,0],[0,0,1,4],[0,0,0,1]]}]}
END
}
# writeGaussians: row.splat, three round Gaussians in a row
writeGaussians() {
    local x
    for x in '\0\0\0\0' '\0\0\x80\x3f' '\0\0\0\x40'; do
        printf "$x"'\0\0\0\0\0\0\0\0\0\0\x80\x3d\0\0\x80\x3d\0\0\x80\x3d\xff\xff\xff\xff\xff\x80\x80\x80'
    done >row.splat
}
