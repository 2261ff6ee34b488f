#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Makes an archive of the tools that runs from any folder: the four tools, the shared libraries that they link or load,
# PROJ's database, manual pages, documentation and licences. The system provides the Vulkan loader and driver, X11, which
# GLFW loads, and the C and C++ runtimes, unless they are older than those that the tools were built with (launch.sh).
#   packaging/tarball.sh [BUILD]   BUILD: a build folder (default: build/package, built first)
# Prints the path of the archive, pointrt-VERSION-linux-x86_64.tar.gz in BUILD/packages. Reproducible: its only date is that
# of the newest commit, and it contains no paths of this machine.
set -euo pipefail
cd "$(dirname "$0")/.."
. .ci/common.sh
. packaging/archive.sh

command -v patchelf >/dev/null || die "patchelf is missing: install the package of that name"
build=${1:-}
if [ -z "$build" ]; then
    installPackages build bake view package
    buildPreset package
    build=build/package
fi
name=pointrt-$version-linux-$(uname -m)
installTree "$build" "$name"

# Libraries taken from the system if they are new enough: glibc, GCC's runtimes. And those always taken from it: X11.
of_runtime='^(ld-linux.*|libc|libm|libdl|libpthread|librt|libresolv|libstdc\+\+|libgcc_s)\.so'
of_system='^(libX.*|libxcb.*)\.so'

# librariesOf FILE...: paths of the shared libraries that these link, directly or through others.
librariesOf() { ldd "$@" | awk '$2 == "=>" && $3 ~ /^\// { print $3 }' | sort -u; }
# opened NAME: the path of a library that the tools load at run time.
opened() { ldconfig -p | awk -v name="$1" '$1 == name && /x86-64/ { print $NF; exit }'; }

proj=$(opened libproj.so.25)
glfw=$(opened libglfw.so.3)
[ -n "$proj" ] && [ -n "$glfw" ] || die "libproj.so.25 and libglfw.so.3 must be installed: libproj25 libglfw3"
loader=$(patchelf --print-interpreter "$tree/bin/pointrt-info")
# Drivers may link these libraries; the tools do not use them.
for_drivers=$(for name in libdl.so.2 libpthread.so.0 librt.so.1 libresolv.so.2; do opened $name; done)
mkdir -p "$tree/lib/runtime" "$tree/share/proj" "$tree/share/doc/pointrt/libraries"
{ librariesOf "$tree"/bin/* "$proj" "$glfw" && printf '%s\n' "$proj" "$glfw" "$loader" "$for_drivers"; } | sort -u |
    while read -r library; do
    [[ ${library##*/} =~ $of_system ]] && continue
    folder=$tree/lib
    [[ ${library##*/} =~ $of_runtime ]] && folder=$tree/lib/runtime
    cp -L "$library" "$folder/"
    file=$(readlink -f "$library")
    package=$(dpkg-query -S "*/${file##*/}" | sed -n '1s/:.*//p')
    cp -L "/usr/share/doc/$package/copyright" "$tree/share/doc/pointrt/libraries/$package.copyright"
done
cp /usr/share/proj/proj.db "$tree/share/proj/" # where libproj.so looks from its own folder

mv "$tree/bin" "$tree/lib/programs"
mkdir "$tree/bin"
glibc=$(ldd --version | sed -n '1s/.* 2\.//p')
for program in "$tree"/lib/programs/*; do
    patchelf --set-rpath '$ORIGIN/..' "$program"
    sed "s/@GLIBC_MINOR@/$glibc/; s/@LOADER@/${loader##*/}/" packaging/launch.sh >"$tree/bin/${program##*/}"
    chmod 755 "$tree/bin/${program##*/}"
done
for library in "$tree"/lib/*.so*; do patchelf --set-rpath '$ORIGIN' "$library"; done

out=$build/packages
mkdir -p "$out"
tar -C "$work" --sort=name --owner=0 --group=0 --numeric-owner --mtime="@$SOURCE_DATE_EPOCH" -cf - "$name" |
    gzip -9n >"$out/$name.tar.gz"
say "archive: $PWD/$out/$name.tar.gz, $(du -h "$out/$name.tar.gz" | cut -f1); unpacked $(du -sh "$tree" | cut -f1)"
# the newest version of glibc that a symbol needs; a system that has it uses its own glibc
objdump -T "$tree"/lib/programs/* "$tree"/lib/*.so* | grep -o 'GLIBC_[0-9.]*' | sort -uV | sed -n '$s/_/ /p' | sed 's/^/needs /'
