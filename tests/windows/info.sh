#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# pointrt-info for Windows: output, exports, exit codes, file names with any characters, long paths, and hostile files.
# shellcheck source=lib.sh
. "$(dirname "$0")/lib.sh"
needs pointrt-info

# exported SUFFIX: both write the same
exported() {
    "$bin/pointrt-info" scan.pro --export "here.$1"
    wine "$build/bin/pointrt-info.exe" scan.pro --export "there.$1" || fail "cannot export .$1"
    cmp "here.$1" "there.$1"
}

cp "$golden"/*.pro .
cp -r "$golden/small.proset" .
cp tiny_v1_5.pro scan.pro
alike pointrt-info --help
alike pointrt-info --version
for input in *.pro small.proset; do
    alike pointrt-info "$input"
    alike pointrt-info "$input" --json
    alike pointrt-info "$input" --verify
done
suffixes="ply pcd las"
if ! grep -q 'Without LAZ and E57' "$build/log"; then suffixes+=" laz e57"; fi
for suffix in $suffixes; do exported "$suffix"; done
alike pointrt-info scan.pro --export - # no line ends of Windows

for name in "${names[@]}"; do
    cp scan.pro "$name.pro"
    alike pointrt-info "$name.pro"
    wine "$build/bin/pointrt-info.exe" scan.pro --export "$name.ply" && cmp here.ply "$name.ply"
done

# the details that the Explorer shows of each program, and the manifest that lets it open any file name
version=$("$bin/pointrt-info" --version | awk '{ print $2; exit }')
for program in "$build"/bin/*.exe; do
    x86_64-w64-mingw32-windres -J coff -i "$program" -O rc -o resources
    for words in "\"OriginalFilename\", \"$(basename "$program")\"" "\"ProductVersion\", \"$version\"" \
        '"GLFW_ICON" 14 /* RT_GROUP_ICON */' '1 24 /* RT_MANIFEST */'; do
        grep -aqF "$words" resources || fail "$program: no resource says $words"
    done
done

# missing files, folders, and hostile files: one line and the same code
mkdir folder
refused pointrt-info none.pro
refused pointrt-info none/scan.pro
refused pointrt-info folder
refused pointrt-info scan.pro --export folder
refused pointrt-info scan.pro --export none/scan.ply
refused pointrt-info scan.pro --export here.ply # it exists
size=$(stat -c %s scan.pro)
for bytes in 0 1 63 64 511 512 $((size / 2)) $((size - 1)); do
    head -c "$bytes" scan.pro >cut.pro
    refused pointrt-info cut.pro
done
for ((at = 8; at < size; at += size / 16)); do
    cp scan.pro changed.pro
    printf '\xff\xff' | dd of=changed.pro bs=1 seek=$at conv=notrunc status=none
    run pointrt-info changed.pro
    cmp here.err windows.err || fail "changed at $at: $(cat windows.err)"
done
echo "the same in Windows"
