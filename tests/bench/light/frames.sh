#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Compares frame times of splats with those of Mitsuba 3 and Blender's Cycles for the mesh that they were sampled from, with
# the same rooms, lamps, bounces, samples and cores, alternately. Prints a table, also to OUT_DIR/FRAMES.md. Takes about 6
# minutes on two cores.
#   tests/bench/light/frames.sh BIN_DIR MESH.ply OUT_DIR [OPTION...]     # --scenes room glass --turns 5 --spp 16
# Settings, from the environment, with defaults:
#   POINTS=1000000      splats sampled from the mesh
#   SIZE=512            pixels of a side
#   CORES=0-1           for all programs
#   CYCLES=1            0 leaves Cycles out; so does a Python without a build of bpy on PyPI (bpy needs 3.11)
# BIN_DIR holds trace_speed, too: a dev build's, or a release build's made with -D POINTRT_BUILD_TESTS=ON.
# Installs Debian's libllvm19 and python3-venv where they are missing (root or sudo), and Mitsuba, OpenEXR and bpy from PyPI
# into OUT_DIR/environment.
set -euo pipefail
[ $# -ge 3 ] || {
    sed -n '3,14s/^# //p' "$0" >&2
    exit 2
}
here=$(cd "$(dirname "$0")" && pwd)
bin=$(cd "$1" && pwd) mesh=$(realpath "$2")
mkdir -p "$3"
out=$(cd "$3" && pwd)
shift 3
points=${POINTS:-1000000} size=${SIZE:-512} cores=${CORES:-0-1} cycles=${CYCLES:-1}

say() { printf '==> %s\n' "$*" >&2; }
python() { taskset -c "$cores" "$out/environment/bin/python" "$@"; }

installPackages() {
    local package missing=() as_root=()
    for package in libllvm19 python3-venv; do
        dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null | grep -x installed >/dev/null || missing+=("$package")
    done
    [ ${#missing[@]} -gt 0 ] || return 0
    say "installing ${missing[*]}"
    [ "$(id -u)" = 0 ] || as_root=(sudo)
    "${as_root[@]}" apt-get -q update >&2
    "${as_root[@]}" apt-get -q -y install --no-install-recommends "${missing[@]}" >&2
}

installPython() {
    local pip=("$out/environment/bin/pip" install -q --disable-pip-version-check)
    [ -e "$out/environment/complete" ] && return
    say "installing Mitsuba and OpenEXR"
    python3 -m venv "$out/environment"
    "${pip[@]}" mitsuba==3.9.1 OpenEXR==3.5.3 numpy pillow
    [ "$cycles" = 0 ] || "${pip[@]}" bpy==4.5.15 || say "without Cycles: no bpy for $(python3 --version)"
    touch "$out/environment/complete"
}

installPackages
installPython
DRJIT_LIBLLVM_PATH=$(dpkg -L libllvm19 | grep -m 1 -E '/libLLVM\.so\.19\.[0-9.]+$')
export DRJIT_LIBLLVM_PATH PYTHONDONTWRITEBYTECODE=1
programs=(ours mitsuba)
[ "$cycles" = 0 ] || ! python -c 'import bpy' 2>/dev/null || programs+=(cycles)
python "$here/frame_scenes.py" "$out" "$mesh" --size "$size"
if [ ! "$out/mesh.pro" -nt "$mesh" ]; then
    say "baking $points points"
    "$bin/pointrt-bake" "$out/mesh.ply" --sample "$points" --force -o "$out/mesh.pro" >"$out/bake.log" 2>&1
fi
python "$here/frame_table.py" "$bin" "$out" --size "$size" --programs "${programs[@]}" "$@" | tee "$out/FRAMES.md"
