#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Makes a folder with the libraries that the tools need for Windows and for which Debian has no mingw package: headers
# of installed packages, and libpng, GLFW and Dear ImGui built of Debian's sources.
#   packaging/windows/libraries.sh FOLDER [headers]   headers: only those, which is all that pointrt-info needs; no network
# Leaves a folder as it is that this script has made.
set -euo pipefail
repository=$(cd "$(dirname "$0")/../.." && pwd)
script=$repository/packaging/windows/libraries.sh
prefix=$(mkdir -p "$1" && cd "$1" && pwd)
! cmp -s "$script" "$prefix/made_by" || exit 0
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# Of Linux's headers only those that belong to no system: the others beside them would hide Windows's.
mkdir -p "$prefix/include" "$prefix/lib/cmake/fmt"
for header in CLI nlohmann fmt vulkan vk_video toml++ xxhash.h proj.h proj_experimental.h tinyexr.h; do
    cp -rLp "/usr/include/$header" "$prefix/include/"
done
cp -rLp /usr/share/cmake/CLI11 /usr/share/cmake/nlohmann_json "$prefix/lib/cmake/"
cat >"$prefix/lib/cmake/fmt/fmtConfig.cmake" <<'END'
add_library(fmt::fmt INTERFACE IMPORTED)
target_include_directories(fmt::fmt INTERFACE ${CMAKE_CURRENT_LIST_DIR}/../../../include)
target_compile_definitions(fmt::fmt INTERFACE FMT_HEADER_ONLY)
END
[ "${2:-}" != headers ] || exit 0

# sources PACKAGE...: the sources of packages, by lists and settings apart from the system's.
sources() {
    local mirror
    mkdir -p "$work/apt/lists/partial"
    mirror=$(find /etc/apt -name '*.list' -o -name '*.sources' | xargs cat |
        sed -n 's/^URIs: \(.*debian\)$/\1/p; s/^deb .*\(http[^ ]*debian\) .*/\1/p' | sed -n 1p)
    . /etc/os-release
    echo "deb-src [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] $mirror $VERSION_CODENAME main" \
        >"$work/apt/sources.list"
    local settings=(-qq -o "Dir::Etc::SourceList=$work/apt/sources.list" -o Dir::Etc::SourceParts=/dev/null
        -o "Dir::State::Lists=$work/apt/lists" -o Dir::Cache::pkgcache= -o Dir::Cache::srcpkgcache=
        -o APT::Sandbox::User=root)
    apt-get "${settings[@]}" update
    (cd "$work" && apt-get "${settings[@]}" source "$@" >"$work/log")
}
# Their assertions name their sources, but not in folders of this machine.
paths="-ffile-prefix-map=$work=. -ffile-prefix-map=$prefix=."

# build NAME OPTION...: builds and installs a source folder NAME-* with CMake.
build() {
    local name=$1
    shift
    cmake -S "$work/$name"-* -B "$work/build-$name" -G Ninja --toolchain "$repository/cmake/mingw-w64.cmake" \
        -D POINTRT_WINDOWS_LIBRARIES="$prefix" -D CMAKE_BUILD_TYPE=Release -D CMAKE_C_FLAGS="$paths" \
        -D CMAKE_INSTALL_PREFIX="$prefix" "$@" >"$work/log"
    cmake --build "$work/build-$name" --target install >"$work/log" || { cat "$work/log" && exit 1; }
}

sources libpng1.6 glfw3 imgui
build libpng1.6 -D PNG_SHARED=OFF -D PNG_TESTS=OFF -D PNG_EXECUTABLES=OFF
build glfw3 -D BUILD_SHARED_LIBS=ON -D GLFW_BUILD_DOCS=OFF -D GLFW_BUILD_TESTS=OFF -D GLFW_BUILD_EXAMPLES=OFF

# Dear ImGui has no build of its own
mkdir -p "$prefix/include/imgui"
cp -p "$work"/imgui-*/*.h "$work"/imgui-*/misc/cpp/*.h "$prefix/include/imgui/"
for source in imgui imgui_draw imgui_tables imgui_widgets misc/cpp/imgui_stdlib; do
    # shellcheck disable=SC2086 # a list of words
    x86_64-w64-mingw32-g++-posix -O2 -w $paths -I"$prefix/include/imgui" -I/usr/include/stb \
        -c "$work"/imgui-*/"$source.cpp" -o "$work/${source##*/}.o"
done
x86_64-w64-mingw32-ar rcsD "$prefix/lib/libimgui.a" "$work"/imgui*.o
cp "$script" "$prefix/made_by"
