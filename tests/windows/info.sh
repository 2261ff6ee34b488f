#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Builds pointrt-info for Windows and compares it in Wine with this system's: what it prints and writes, its exit codes,
# names of files with any characters, long paths, and hostile files.
#   info.sh REPOSITORY POINTRT-INFO BUILD   BUILD: where to build it, or to build it again
set -euo pipefail
repository=$1 here=$2 build=$3
for tool in x86_64-w64-mingw32-g++-posix x86_64-w64-mingw32-windres wine ninja; do
    command -v $tool >/dev/null || { echo "SKIPPED: no $tool here" && exit 77; }
done
[ -e /usr/x86_64-w64-mingw32/include/zlib.h ] || { echo "SKIPPED: no libz-mingw-w64-dev here" && exit 77; }
golden=$repository/tests/format/golden

fail() {
    echo "$*" >&2
    exit 1
}

"$repository/packaging/windows/libraries.sh" "$build/libraries" headers
cmake -S "$repository" -B "$build" -G Ninja --toolchain "$repository/cmake/mingw-w64.cmake" \
    -D POINTRT_WINDOWS_LIBRARIES="$build/libraries" -D CMAKE_BUILD_TYPE=Release \
    -D POINTRT_BUILD_BAKE=OFF -D POINTRT_BUILD_VIEW=OFF -D POINTRT_BUILD_TESTS=OFF >"$build/log" 2>&1 &&
    cmake --build "$build" >>"$build/log" 2>&1 || { cat "$build/log" && exit 1; }

work=$(mktemp -d)
finish() {
    wineserver -k 2>/dev/null || true # this prefix's alone
    rm -rf "$work"
}
trap finish EXIT
export WINEPREFIX=$work/wine WINEDEBUG=-all
unset DISPLAY WAYLAND_DISPLAY
cd "$work"
wine "$build/bin/pointrt-info.exe" --version >log 2>&1 || fail "it does not run in Wine: $(cat log)" # Wine says what it sets up

# run ARGUMENT...: both, into here.out, here.err, windows.out, windows.err; their exit codes must be the same
run() {
    local code=0 code_there=0
    "$here" "$@" >here.out 2>here.err || code=$?
    wine "$build/bin/pointrt-info.exe" "$@" >windows.out 2>windows.err || code_there=$?
    [ $code = $code_there ] || fail "$*: exit code $code_there in Windows, $code here: $(cat windows.err)"
}
# alike ARGUMENT...: prints the same
alike() {
    run "$@"
    cmp here.out windows.out || fail "$*: prints otherwise in Windows: $(head -c 300 windows.out)"
    cmp here.err windows.err || fail "$*: complains otherwise in Windows: $(cat windows.err)"
}
# exported SUFFIX: writes the same
exported() {
    "$here" scan.pro --export "here.$1"
    wine "$build/bin/pointrt-info.exe" scan.pro --export "there.$1" || fail "cannot export .$1"
    cmp "here.$1" "there.$1"
}

cp "$golden"/*.pro .
cp -r "$golden/small.proset" .
cp tiny_v1_5.pro scan.pro
alike --help
alike --version
for input in *.pro small.proset; do
    alike "$input"
    alike "$input" --json
    alike "$input" --verify
done
suffixes="ply pcd las"
if ! grep -q 'Without LAZ and E57' "$build/log"; then suffixes+=" laz e57"; fi
for suffix in $suffixes; do exported "$suffix"; done
alike scan.pro --export - # no line ends of Windows

# names of any characters, and longer than the 260 characters of old
long=$(printf '%0100d/' 1 2 3)
mkdir -p "$long"
for name in 'Müller, Straße.pro' 'скан 点群.pro' 'emoji 😀.pro' "${long}scan.pro"; do
    cp scan.pro "$name"
    alike "$name"
    wine "$build/bin/pointrt-info.exe" scan.pro --export "${name%.pro}.ply" && cmp here.ply "${name%.pro}.ply"
done

# files that are missing, folders, and hostile files: one line, the same code
refused() {
    run "$@"
    [ "$(wc -l <windows.err)" = 1 ] || fail "$*: not one line: $(cat windows.err)"
    grep -q '^pointrt-info: error: ' windows.err || fail "$*: $(cat windows.err)"
}
mkdir folder
refused none.pro
refused none/scan.pro
refused folder
refused scan.pro --export folder
refused scan.pro --export none/scan.ply
refused scan.pro --export here.ply # it exists
size=$(stat -c %s scan.pro)
for bytes in 0 1 63 64 511 512 $((size / 2)) $((size - 1)); do
    head -c "$bytes" scan.pro >cut.pro
    refused cut.pro
done
for ((at = 8; at < size; at += size / 16)); do
    cp scan.pro changed.pro
    printf '\xff\xff' | dd of=changed.pro bs=1 seek=$at conv=notrunc status=none
    run changed.pro
    cmp here.err windows.err || fail "changed at $at: $(cat windows.err)"
done
echo "the same in Windows"
