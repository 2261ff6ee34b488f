#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Makes the wheel of the Python package for 64-bit Windows and Python 3.12 or later: the module is linked only with
# Python's stable ABI, and needs no other libraries than those of the system.
#   packaging/windows/wheel.sh LINUX_WHEEL [BUILD [PYTHON [OPTION...]]]
#   LINUX_WHEEL: made from the same sources (pip wheel ./python); its type stubs of the module are copied
#   BUILD: a build folder made with cmake/mingw-w64.cmake (default: build/windows, built first)
#   PYTHON: a folder with include and libs of a Python for Windows (default: BUILD/python, unpacked by python.sh)
#   OPTION: options for pip wheel
# Prints the path of the wheel in BUILD/packages. Reproducible: its only date is that of the newest commit, and it contains
# no paths of this machine.
set -euo pipefail
[ $# -ge 1 ] || { sed -n 's/^#   //p' "$0" >&2 && exit 2; }
linux_wheel=$(realpath "$1")
cd "$(dirname "$0")/../.."
. .ci/common.sh
. packaging/archive.sh

build=${2:-} python=${3:-}
if [ -z "$build" ]; then
    installPackages build bake view package windows
    build=build/windows
    packaging/windows/libraries.sh $build/libraries
    buildPreset windows --target pointrt_trace_archive pointrt_pro
fi
build=$(cd "$build" && pwd)
[ -n "$python" ] || packaging/windows/python.sh "$build/python"
python=$(cd "${python:-$build/python}" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# quiet COMMAND...: shows the output of the command only if it fails.
quiet() { "$@" >"$work/log" 2>&1 || die "$(cat "$work/log")"; }

quiet python3 -m venv "$work/maker"
maker=$work/maker/bin
quiet "$maker/pip" install 'scikit-build-core>=0.11' 'nanobind>=2.4' wheel
quiet python3 -m zipfile -e "$linux_wheel" "$work/linux"
quiet cmake --install "$build" --prefix "$work/prefix" --component dev
copyLicences "$work/licences" libcli11-dev libfmt-dev libpng-dev libproj-dev libtinyexr-dev libtomlplusplus-dev \
    libvulkan-dev libxxhash-dev libz-mingw-w64-dev mingw-w64-common nlohmann-json3-dev
cp "$("$maker/python" -c 'import nanobind; print(nanobind.__path__[0])')"-*/licenses/LICENSE "$work/licences/nanobind.copyright"

paths="-ffile-prefix-map=$work=. -ffile-prefix-map=$PWD=. -ffile-prefix-map=$build=. -ffile-prefix-map=$python=."
settings=(CMAKE_TOOLCHAIN_FILE="$PWD/cmake/mingw-w64.cmake" CMAKE_CXX_FLAGS="$paths"
    POINTRT_WINDOWS_LIBRARIES="$build/libraries" POINTRT_WINDOWS_PYTHON="$python" POINTRT_STUB="$work/linux/pointrt/_core.pyi"
    POINTRT_LICENCES="$work/licences" pointrt_DIR="$work/prefix/lib/cmake/pointrt"
    nanobind_DIR="$("$maker/python" -m nanobind --cmake_dir)")
PATH=$maker:$PATH quiet "$maker/pip" wheel "$PWD/python" --no-build-isolation --no-deps -w "$work/wheels" \
    -C build-dir="$work/build" -C build.targets=_core -C wheel.tags=cp312-abi3-win_amd64 "${settings[@]/#/-Ccmake.define.}" "${@:4}"
# repacked, because scikit-build-core takes metadata files in file system order
quiet "$maker/wheel" unpack -d "$work/unpacked" "$work/wheels"/*.whl
mkdir -p "$build/packages"
quiet "$maker/wheel" pack -d "$build/packages" "$work/unpacked/pointrt-$version"
wheel=$build/packages/pointrt-$version-cp312-abi3-win_amd64.whl
say "wheel: $wheel, $(du -h "$wheel" | cut -f1)"
