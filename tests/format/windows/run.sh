#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Builds the format library for Windows with mingw-w64, and a C program with it that reads and writes a file in Wine.
# usage: run.sh REPOSITORY
set -eu
for tool in x86_64-w64-mingw32-g++-posix wine; do
    command -v $tool >/dev/null || { echo "SKIPPED: no $tool here"; exit 77; }
done
repository=$1
golden=$repository/tests/format/golden/tiny_compact.pro # what pro_write writes of it again
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir "$work/xxhash" # alone: the other headers beside it are this system's
cp /usr/include/xxhash.h "$work/xxhash"

# build SOURCES FOLDER OPTION...
build() {
    sources=$1 folder=$2
    shift 2
    cmake -S "$sources" -B "$folder" -G Ninja -D CMAKE_SYSTEM_NAME=Windows -D CMAKE_BUILD_TYPE=Release \
        -D CMAKE_C_COMPILER=x86_64-w64-mingw32-gcc-posix -D CMAKE_CXX_COMPILER=x86_64-w64-mingw32-g++-posix \
        "$@" >"$work/log" 2>&1 && cmake --build "$folder" >>"$work/log" 2>&1 || { cat "$work/log"; exit 1; }
}
build "$repository" "$work/library" -D XXHASH_INCLUDE_DIR="$work/xxhash" -D POINTRT_BUILD_INFO=OFF \
    -D POINTRT_BUILD_BAKE=OFF -D POINTRT_BUILD_VIEW=OFF -D POINTRT_BUILD_TESTS=OFF
cmake --install "$work/library" --component dev --prefix "$work/prefix" >"$work/log"
build "$repository/tests/format/windows" "$work/program" -D pointrt_DIR="$work/prefix/lib/cmake/pointrt"

export WINEPREFIX="$work/wine" WINEDEBUG=-all
unset DISPLAY
cd "$work"
cp "$golden" in.pro
touch out.pro.tmp-abcdefgh # as a killed process leaves it
wine program/copy.exe in.pro out.pro
cmp out.pro "$golden"
[ "$(echo out.pro*)" = out.pro ] || { echo "left behind: $(echo out.pro.*)"; exit 1; }
mkdir folder
! wine program/copy.exe in.pro folder || { echo "a folder was written over"; exit 1; }
! wine program/copy.exe in.pro nowhere/out.pro || { echo "a file in no folder"; exit 1; }
wineserver -w 2>/dev/null || true
echo "read and written on Windows"
