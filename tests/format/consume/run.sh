#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Installs the format library into a temporary prefix and builds a C program against it, with CMake and with pkg-config.
# usage: run.sh BUILD_FOLDER FILE.pro
set -eu
build=$1
file=$2
here=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
prefix=$work/prefix

cmake --install "$build" --component dev --prefix "$prefix" >"$work/install.log" || { cat "$work/install.log"; exit 1; }

cmake -S "$here" -B "$work/build" -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_C_FLAGS="${CONSUME_CFLAGS:-}" >"$work/cmake.log" 2>&1 &&
    cmake --build "$work/build" >>"$work/cmake.log" 2>&1 || { cat "$work/cmake.log"; exit 1; }
LD_LIBRARY_PATH=$(dirname "$(find "$prefix" -name 'libpointrt_pro.*' | head -n 1)")
export LD_LIBRARY_PATH
"$work/build/consume" "$file"

PKG_CONFIG_PATH=$(dirname "$(find "$prefix" -name pointrt.pc)")
export PKG_CONFIG_PATH
# the words of pkg-config's answer are separate arguments
# shellcheck disable=SC2046,SC2086
cc ${CONSUME_CFLAGS:-} "$here/main.c" $(pkg-config --cflags --libs pointrt) -o "$work/consume"
"$work/consume" "$file"
