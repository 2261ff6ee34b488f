#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Installs the libraries into a temporary prefix and builds a C++ program against them, and one of C alone, which wants
# the format library and no more.
# usage: run.sh FORMAT_BUILD_FOLDER TRACE_BUILD_FOLDER FILE.pro
set -eu
here=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
prefix=$work/prefix

for build in "$1" "$2"; do
    cmake --install "$build" --component dev --prefix "$prefix" >"$work/install.log" || { cat "$work/install.log"; exit 1; }
done
! grep -rlE 'vulkan|glm|runtime/' "$prefix/include" || { echo "installed headers name what is not theirs"; exit 1; }

# build SOURCES FOLDER LANGUAGE
build() {
    cmake -S "$1" -B "$2" -DCMAKE_PREFIX_PATH="$prefix" "-DCMAKE_$3_FLAGS=${CONSUME_CXXFLAGS:-}" >"$work/cmake.log" 2>&1 &&
        cmake --build "$2" >>"$work/cmake.log" 2>&1 || { cat "$work/cmake.log"; exit 1; }
}
build "$here" "$work/build" CXX
build "$here/../../../format/consume" "$work/build-c" C
LD_LIBRARY_PATH=$(dirname "$(find "$prefix" -name 'libpointrt_pro.*' | head -n 1)")
export LD_LIBRARY_PATH
"$work/build/consume_trace" "$3" "$work/missing.pro"
"$work/build-c/consume" "$3"
