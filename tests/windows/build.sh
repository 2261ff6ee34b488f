#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Builds or updates the tools for Windows: pointrt-info, and the others if the sources of their libraries can be
# downloaded. Sets up Wine to run them.
#   build.sh REPOSITORY BUILD
set -euo pipefail
repository=$1 build=$2
for tool in x86_64-w64-mingw32-g++-posix x86_64-w64-mingw32-windres ninja; do
    command -v $tool >/dev/null || { echo "SKIPPED: no $tool here" && exit 77; }
done
[ -e /usr/x86_64-w64-mingw32/include/zlib.h ] || { echo "SKIPPED: no libz-mingw-w64-dev here" && exit 77; }

mkdir -p "$build"
libraries=$repository/packaging/windows/libraries.sh
others=ON
if ! "$libraries" "$build/libraries" >"$build/log" 2>&1; then
    cat "$build/log"
    echo "only pointrt-info, which needs none of those libraries"
    others=OFF
    "$libraries" "$build/libraries" headers
fi
# -O1 takes half as long to compile as a release, and rounds the same way.
cmake -S "$repository" -B "$build" -G Ninja --toolchain "$repository/cmake/mingw-w64.cmake" \
    -D POINTRT_WINDOWS_LIBRARIES="$build/libraries" -D CMAKE_BUILD_TYPE=Release -D CMAKE_CXX_FLAGS_RELEASE="-O1 -DNDEBUG" \
    -D POINTRT_CCACHE=OFF -D POINTRT_BUILD_BAKE=$others -D POINTRT_BUILD_VIEW=$others -D POINTRT_BUILD_TESTS=OFF \
    >"$build/log" 2>&1 &&
    cmake --build "$build" >>"$build/log" 2>&1 || { cat "$build/log" && exit 1; }
grep -A1 'Without LAZ and E57' "$build/log" || true

# Wine's folder for all tests: creating one takes ten seconds.
command -v wine >/dev/null || { echo "Nothing is run: no wine here" && exit 0; }
[ ! -e "$build/wine" ] || exit 0
export WINEPREFIX=$build/wine.new WINEDEBUG=-all
rm -rf "$WINEPREFIX"
env -u DISPLAY wineboot --init >"$build/wine.log" 2>&1 && wineserver -w || { cat "$build/wine.log" && exit 1; }
x86_64-w64-mingw32-gcc-posix -shared -O2 "$repository/tests/windows/bcryptprimitives.c" \
    -o "$WINEPREFIX/drive_c/windows/system32/bcryptprimitives.dll"
mv "$WINEPREFIX" "$build/wine"
