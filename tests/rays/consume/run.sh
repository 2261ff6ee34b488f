#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Installs the libraries into a temporary prefix and builds a C++ program against them.
# usage: run.sh FORMAT_BUILD_FOLDER TRACE_BUILD_FOLDER FILE.pro
set -eu
here=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
prefix=$work/prefix

for build in "$1" "$2"; do
    cmake --install "$build" --prefix "$prefix" >"$work/install.log" || { cat "$work/install.log"; exit 1; }
done
! grep -rlE 'vulkan|glm|runtime/' "$prefix/include" || { echo "installed headers name what is not theirs"; exit 1; }

cmake -S "$here" -B "$work/build" -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_CXX_FLAGS="${CONSUME_CXXFLAGS:-}" >"$work/cmake.log" 2>&1 &&
    cmake --build "$work/build" >>"$work/cmake.log" 2>&1 || { cat "$work/cmake.log"; exit 1; }
LD_LIBRARY_PATH=$(dirname "$(find "$prefix" -name 'libpointrt_pro.*' | head -n 1)")
export LD_LIBRARY_PATH
"$work/build/consume_trace" "$3" "$work/missing.pro"
