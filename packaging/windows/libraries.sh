#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Makes a folder with libraries for the Windows tools that Debian does not package for mingw: headers of installed
# packages, and static libraries (GLFW: shared) built from Debian's sources.
#   packaging/windows/libraries.sh FOLDER [headers]   headers: only those that pointrt-info needs; no network
# Does nothing if this version of the script has already made the folder.
set -euo pipefail
repository=$(cd "$(dirname "$0")/../.." && pwd)
floats_header=$repository/packaging/windows/glibc_floats.h
madeBy() { cat "$repository/packaging/windows/libraries.sh" "$floats_header"; }
prefix=$(mkdir -p "$1" && cd "$1" && pwd)
! madeBy | cmp -s - "$prefix/made_by" || exit 0
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# Only the Linux headers that are independent of the system: the others in that folder would hide those of Windows.
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

# sources PACKAGE...: downloads the sources of packages, with lists and settings separate from the system's.
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
# Their assertions contain source paths, which must not be paths of this machine.
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

# compile LIBRARY FLAGS SOURCE...: compiles C sources to a static library, for packages without a usable build system.
compile() {
    local library=$1 flags=$2 objects=$work/objects-$1
    shift 2
    mkdir -p "$objects"
    # shellcheck disable=SC2016 # expanded by the shells that xargs starts
    printf '%s\n' "$@" | flags="-O2 -w $paths $flags" objects=$objects xargs -P "$(nproc)" -I{} sh -c \
        'source={}; x86_64-w64-mingw32-gcc-posix $flags -c "$source" -o "$objects/$(basename "$source").o"'
    x86_64-w64-mingw32-ar rcsD "$prefix/lib/lib$library.a" "$objects"/*.o
}
# describe NAME LIBRARIES: writes a pkg-config file for a static library and everything it links.
describe() {
    mkdir -p "$prefix/lib/pkgconfig"
    printf '%s\n' "Name: $1" "Description: static" "Version: 0" "Cflags: -I$prefix/include" \
        "Libs: -L$prefix/lib $2" >"$prefix/lib/pkgconfig/$1.pc"
}

sources libpng1.6 glfw3 imgui onetbb draco libzstd libwebp libjpeg-turbo tiff lerc brotli bzip2 lz4
build libpng1.6 -D PNG_SHARED=OFF -D PNG_TESTS=OFF -D PNG_EXECUTABLES=OFF
build glfw3 -D BUILD_SHARED_LIBS=ON -D GLFW_BUILD_DOCS=OFF -D GLFW_BUILD_TESTS=OFF -D GLFW_BUILD_EXAMPLES=OFF

# Dear ImGui has no build system of its own
mkdir -p "$prefix/include/imgui"
cp -p "$work"/imgui-*/*.h "$work"/imgui-*/misc/cpp/*.h "$prefix/include/imgui/"
for source in imgui imgui_draw imgui_tables imgui_widgets misc/cpp/imgui_stdlib; do
    # shellcheck disable=SC2086 # a list of words
    x86_64-w64-mingw32-g++-posix -O2 -w $paths -I"$prefix/include/imgui" -I/usr/include/stb \
        -c "$work"/imgui-*/"$source.cpp" -o "$work/${source##*/}.o"
done
x86_64-w64-mingw32-ar rcsD "$prefix/lib/libimgui.a" "$work"/imgui*.o

# Additional headers for pointrt-bake, kept separate from those of the system.
headers=$repository/build/headers/usr/include # where .ci/common.sh unpacks those of packages that are not installed
for folder in eigen3/Eigen boost CGAL; do
    ln -sfn "/usr/include/$folder" "$prefix/include/$(basename "$folder")"
done
for folder in /usr/include/pcl-*/pcl "$headers"/pcl-*/pcl /usr/include/flann "$headers/flann"; do
    [ ! -d "$folder" ] || ln -sfn "$folder" "$prefix/include/$(basename "$folder")"
done
for folder in Eigen boost CGAL pcl flann; do
    [ -d "$prefix/include/$folder" ] || { echo "no headers of $folder: .ci/packages.txt" && exit 1; }
done
mkdir -p "$prefix/lib/cmake/eigen3" "$prefix/lib/cmake/CGAL"
cat >"$prefix/lib/cmake/eigen3/Eigen3Config.cmake" <<'END'
add_library(Eigen3::Eigen INTERFACE IMPORTED)
target_include_directories(Eigen3::Eigen INTERFACE ${CMAKE_CURRENT_LIST_DIR}/../../../include)
END
# Without GMP and MPFR: nothing here uses their exact numbers.
cat >"$prefix/lib/cmake/CGAL/CGALConfig.cmake" <<'END'
add_library(CGAL::CGAL INTERFACE IMPORTED)
target_include_directories(CGAL::CGAL INTERFACE ${CMAKE_CURRENT_LIST_DIR}/../../../include)
target_compile_definitions(CGAL::CGAL INTERFACE CGAL_DISABLE_GMP)
target_compile_options(CGAL::CGAL INTERFACE -frounding-math)
END
for package in eigen3/Eigen3 CGAL/CGAL; do
    echo 'set(PACKAGE_VERSION_COMPATIBLE TRUE)' >"$prefix/lib/cmake/${package}ConfigVersion.cmake"
done

build onetbb -D BUILD_SHARED_LIBS=OFF -D TBB_TEST=OFF -D TBBMALLOC_BUILD=OFF -D TBB_STRICT=OFF -D TBB_ENABLE_IPO=OFF
build draco
build libjpeg-turbo -D ENABLE_SHARED=OFF -D WITH_TURBOJPEG=OFF
build libwebp -DWEBP_BUILD_{ANIM_UTILS,CWEBP,DWEBP,GIF2WEBP,IMG2WEBP,VWEBP,WEBPINFO,LIBWEBPMUX,WEBPMUX,EXTRAS}=OFF
build lerc -D BUILD_SHARED_LIBS=OFF
compile bz2 -D_FILE_OFFSET_BITS=64 "$work"/bzip2-*/{blocksort,huffman,crctable,randtable,compress,decompress,bzlib}.c
compile lz4 -DXXH_NAMESPACE=LZ4_ "$work"/lz4-*/lib/{lz4,lz4hc,lz4frame,xxhash}.c
compile zstd "-DZSTD_DISABLE_ASM -DZSTD_MULTITHREAD=0" "$work"/libzstd-*/lib/{common,compress,decompress}/*.c
compile brotlidec "-I$(echo "$work"/brotli-*/c/include)" "$work"/brotli-*/c/{common,dec}/*.c
cp -rp "$work"/bzip2-*/bzlib.h "$work"/lz4-*/lib/lz4*.h "$work"/libzstd-*/lib/z*.h "$work"/brotli-*/c/include/brotli \
    "$prefix/include/"
build tiff -D BUILD_SHARED_LIBS=OFF -Dtiff-{tools,tests,contrib,docs}=OFF -D cxx=OFF

# The bake must round as on Linux, so it uses glibc's float functions, which differ from those of mingw-w64 in the last
# digit. In double precision both are exact enough to give the same floats. These functions include headers of glibc
# that are empty here.
sources --download-only glibc
tar -xJf "$work"/glibc_*.orig.tar.xz -C "$work" --wildcards '*/sysdeps/ieee754/flt-32/*.[ch]' '*/sincosf_poly.h'
floats=$(echo "$work"/glibc-*/sysdeps/ieee754/flt-32)
mkdir "$work/empty"
for header in libm-alias-finite libm-alias-float math-barriers math-narrow-eval math-svid-compat math-underflow \
    math-use-builtins math_private nan-high-order-bit; do
    : >"$work/empty/$header.h"
done
compile m_glibc "-std=gnu11 -fno-builtin -include $floats_header -I$work/empty -I$floats
    -I$(dirname "$(find "$work"/glibc-* -name sincosf_poly.h | sed -n 1p)")" \
    "$floats"/{e_{expf,exp2f,exp2f_data,atan2f,hypotf},s_{sinf,cosf,sincosf,sincosf_data,atanf,cbrtf,expm1f},math_errf}.c

cp -p /usr/x86_64-w64-mingw32/lib/libz.a "$prefix/lib/" # beside which there is no shared one to be found first
describe libzstd -lzstd
describe libwebp -lwebp
describe libjpeg -ljpeg
describe libpng "-lpng -lz"
describe libtiff-4 "-ltiff -lLerc -ljpeg -lwebp -lzstd -lz"
describe libbrotlidec -lbrotlidec
madeBy >"$prefix/made_by"
