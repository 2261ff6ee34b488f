#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Builds the tools for Windows, again where they have been built: pointrt-info, and the others if the sources of the
# libraries that they need can be had.
#   build.sh REPOSITORY BUILD
set -euo pipefail
repository=$1 build=$2
for tool in x86_64-w64-mingw32-g++-posix x86_64-w64-mingw32-windres ninja; do
    command -v $tool >/dev/null || { echo "SKIPPED: no $tool here" && exit 77; }
done
[ -e /usr/x86_64-w64-mingw32/include/zlib.h ] || { echo "SKIPPED: no libz-mingw-w64-dev here" && exit 77; }

mkdir -p "$build"
libraries=$repository/packaging/windows/libraries.sh
view=ON
if ! cmp -s "$libraries" "$build/libraries.made_by"; then
    if "$libraries" "$build/libraries" >"$build/log" 2>&1; then
        cp "$libraries" "$build/libraries.made_by"
    else
        cat "$build/log"
        echo "only pointrt-info, which needs none of those libraries"
        view=OFF
        "$libraries" "$build/libraries" headers
    fi
fi
cmake -S "$repository" -B "$build" -G Ninja --toolchain "$repository/cmake/mingw-w64.cmake" \
    -D POINTRT_WINDOWS_LIBRARIES="$build/libraries" -D CMAKE_BUILD_TYPE=Release \
    -D POINTRT_BUILD_BAKE=OFF -D POINTRT_BUILD_VIEW=$view -D POINTRT_BUILD_TESTS=OFF >"$build/log" 2>&1 &&
    cmake --build "$build" >>"$build/log" 2>&1 || { cat "$build/log" && exit 1; }
grep -A1 'Without LAZ and E57' "$build/log" || true
x86_64-w64-mingw32-gcc-posix -shared -O2 "$repository/tests/windows/bcryptprimitives.c" -o "$build/bcryptprimitives.dll"
