#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Installs the libraries into a temporary prefix, builds and runs against them: a C++ program, the examples of
# docs/examples, and a C program that uses the format library alone.
# usage: run.sh FORMAT_BUILD_FOLDER TRACE_BUILD_FOLDER FILE.pro
set -eu
here=$(cd "$(dirname "$0")" && pwd)
examples=$(cd "$here/../../../../docs/examples" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
prefix=$work/prefix

for build in "$1" "$2"; do
    cmake --install "$build" --component dev --prefix "$prefix" >"$work/install.log" || { cat "$work/install.log"; exit 1; }
done
! grep -rlE 'vulkan|glm|runtime/' "$prefix/include" || { echo "installed headers mention private dependencies"; exit 1; }

# build SOURCES FOLDER LANGUAGE
build() {
    cmake -S "$1" -B "$2" -DCMAKE_PREFIX_PATH="$prefix" "-DCMAKE_$3_FLAGS=${CONSUME_CXXFLAGS:-}" \
        "-DPOINTRT_EXAMPLES=$examples" --no-warn-unused-cli >"$work/cmake.log" 2>&1 &&
        cmake --build "$2" >>"$work/cmake.log" 2>&1 || { cat "$work/cmake.log"; exit 1; }
}
build "$here" "$work/build" CXX
build "$here/../../../format/consume" "$work/build-c" C
LD_LIBRARY_PATH=$(dirname "$(find "$prefix" -name 'libpointrt_pro.*' | head -n 1)")
export LD_LIBRARY_PATH
"$work/build/consume_trace" "$3" "$work/missing.pro"
"$work/build-c/consume" "$3"

"$work/build/read_pro" "$3" >"$work/splats.txt"
grep -qx '10.500 20.750 30.500 radius 0.5000 normal .* 1.000' "$work/splats.txt" || { echo "read_pro printed:"; cat "$work/splats.txt"; exit 1; }

# a ray onto splat 0 of the tiny scene, and one beside the scan
hit=$("$work/build/minimal" "$3" 10.5 20.75 31 "$work/minimal.png")
[ "$hit" = "splat 0 at 10.500 20.750 30.500, distance 0.500" ] || { echo "minimal printed: $hit"; exit 1; }
[ "$(od -An -tx1 -N8 "$work/minimal.png" | tr -d ' ')" = 89504e470d0a1a0a ] || { echo "minimal wrote no PNG"; exit 1; }
[ "$("$work/build/minimal" "$3" 0 0 0 "$work/minimal.png")" = "no hit" ] || { echo "minimal hit nothing it could"; exit 1; }
