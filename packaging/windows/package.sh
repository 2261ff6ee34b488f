#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Makes an archive of the tools for 64-bit Windows, which runs from any folder, and an installer of the same files: the
# four tools, GLFW's library, documentation and licences. pointrt-bake is under the GPL (see LICENSE).
#   packaging/windows/package.sh [BUILD]
#   BUILD: a build folder made with cmake/mingw-w64.cmake (default: build/windows, built first)
# Prints the paths of both: pointrt-VERSION-windows-x86_64.zip and .exe in BUILD/packages. Reproducible: their only date is
# that of the newest commit, and they contain no paths of this machine.
set -euo pipefail
cd "$(dirname "$0")/../.."
. .ci/common.sh
. packaging/archive.sh

for tool in zip makensis; do command -v $tool >/dev/null || die "$tool is missing: install the packages zip and nsis"; done
build=${1:-}
if [ -z "$build" ]; then
    installPackages build bake view package windows
    build=build/windows
    packaging/windows/libraries.sh $build/libraries
    buildPreset windows
fi
build=$(cd "$build" && pwd)
name=pointrt-$version-windows-x86_64
installTree "$build" "$name"
rm -rf "$tree/share/mime" "$tree/share/applications" "$tree/share/icons" "$tree/share/thumbnailers" # for Linux desktops

# the libraries that the programs are linked with
boost=$(dpkg-query -S /usr/include/boost/version.hpp | cut -d: -f1)
copyLicences "$tree/share/doc/pointrt/libraries" "$boost" libbrotli-dev libbz2-dev libc6 libcgal-dev libcli11-dev \
    libdraco-dev libeigen3-dev libflann-dev libfmt-dev libglfw3-dev libimgui-dev libjpeg62-turbo-dev liblerc-dev liblz4-dev \
    libpcl-dev libpng-dev libproj-dev libstb-dev libtbb-dev libtiff-dev libtinyexr-dev libtomlplusplus-dev libvulkan-dev \
    libwebp-dev libxxhash-dev libz-mingw-w64-dev libzstd-dev nlohmann-json3-dev

out=$build/packages
mkdir -p "$out"
rm -f "$out/$name.zip"
find "$tree" -exec touch -d "@$SOURCE_DATE_EPOCH" {} +
(cd "$work" && find "$name" -type f | LC_ALL=C sort | TZ=UTC zip -9 -X -q "$out/$name.zip" -@)
# Folder by folder and sorted, because makensis takes the files of a folder in file system order.
(cd "$tree" && find . -type f | LC_ALL=C sort) | awk -v tree="$tree" '{
    folder = $0; sub(/^\.\/?/, "", folder); sub(/\/?[^\/]*$/, "", folder); gsub(/\//, "\\", folder)
    if (folder != last) print "SetOutPath \"$INSTDIR\\" folder "\""
    last = folder
    print "File \"" tree substr($0, 2) "\""
}' >"$work/files.nsh"
makensis -V2 -NOCD -DVERSION="$version" -DTREE="$tree" -DFILES="$work/files.nsh" -DOUT="$out/$name.exe" \
    packaging/windows/installer.nsi >"$work/log" || die "$(cat "$work/log")"
say "installer: $out/$name.exe, $(du -h "$out/$name.exe" | cut -f1)"
say "archive: $out/$name.zip, $(du -h "$out/$name.zip" | cut -f1); unpacked $(du -sh "$tree" | cut -f1)"
