#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Makes an archive of the tools that runs wherever it is unpacked: the four tools, the shared libraries that they link
# or open, PROJ's database, manual pages, documentation and licences. From the system come the C and C++ runtimes, and
# Vulkan's loader and driver: a driver may need a newer C++ runtime than the tools were built with. X11, too: GLFW opens it.
#   packaging/tarball.sh [BUILD]   BUILD: a build folder (default: build/package, built first)
# Prints the archive, pointrt-VERSION-linux-x86_64.tar.gz in BUILD/packages. It has no date but that of the newest commit,
# and no path of this machine.
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

# Libraries that are the system's: glibc, GCC's runtimes, X11.
of_system='^(ld-linux.*|libc|libm|libdl|libpthread|librt|libresolv|libstdc\+\+|libgcc_s|libX.*|libxcb.*)\.so'

# librariesOf FILE...: paths of the shared libraries that these link, directly or through others.
librariesOf() { ldd "$@" | awk '$2 == "=>" && $3 ~ /^\// { print $3 }' | sort -u; }
# opened NAME: the path of a library that the tools open at run time.
opened() { ldconfig -p | awk -v name="$1" '$1 == name && /x86-64/ { print $NF; exit }'; }

proj=$(opened libproj.so.25)
glfw=$(opened libglfw.so.3)
[ -n "$proj" ] && [ -n "$glfw" ] || die "libproj.so.25 and libglfw.so.3 must be installed: libproj25 libglfw3"
mkdir -p "$tree/lib" "$tree/share/proj" "$tree/share/doc/pointrt/libraries"
{ librariesOf "$tree"/bin/* "$proj" "$glfw" && echo "$proj" && echo "$glfw"; } | sort -u | while read -r library; do
    [[ ${library##*/} =~ $of_system ]] && continue
    cp -L "$library" "$tree/lib/"
    file=$(readlink -f "$library")
    package=$(dpkg-query -S "*/${file##*/}" | sed -n '1s/:.*//p')
    cp -L "/usr/share/doc/$package/copyright" "$tree/share/doc/pointrt/libraries/$package.copyright"
done
cp /usr/share/proj/proj.db "$tree/share/proj/" # where libproj.so looks from its own folder

for program in "$tree"/bin/*; do patchelf --set-rpath '$ORIGIN/../lib' "$program"; done
for library in "$tree"/lib/*.so*; do patchelf --set-rpath '$ORIGIN' "$library"; done

out=$build/packages
mkdir -p "$out"
tar -C "$work" --sort=name --owner=0 --group=0 --numeric-owner --mtime="@$SOURCE_DATE_EPOCH" -cf - "$name" |
    gzip -9n >"$out/$name.tar.gz"
say "archive: $PWD/$out/$name.tar.gz, $(du -h "$out/$name.tar.gz" | cut -f1); unpacked $(du -sh "$tree" | cut -f1)"
# the newest version of glibc that a symbol asks for
objdump -T "$tree"/bin/* "$tree"/lib/* | grep -o 'GLIBC_[0-9.]*' | sort -uV | sed -n '$s/_/ /p' | sed 's/^/needs /'
