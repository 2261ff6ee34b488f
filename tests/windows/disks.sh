#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The tools for Windows on full and on read-only disks, mounted as drives and as folders: error messages, no partial
# files left behind, and reading from such disks.
# shellcheck source=lib.sh
. "$(dirname "$0")/lib.sh"
[ "$(id -u)" = 0 ] || skip "only root can mount the disks"
needs pointrt-info
sphere 20000 >large.xyz

cp "$golden/tiny_v1_5.pro" scan.pro
mkdir full read_only
mount -t tmpfs -o size=64k tmpfs full 2>/dev/null || skip "disks cannot be mounted here"
mount -t tmpfs -o size=1m tmpfs read_only
finishDisks() {
    rm "$WINEPREFIX"/dosdevices/[fr]:
    umount full read_only
    finish
}
trap finishDisks EXIT
ln -sfn "$work/full" "$WINEPREFIX/dosdevices/f:"
ln -sfn "$work/read_only" "$WINEPREFIX/dosdevices/r:"

# refusedOnDrive DRIVE SUFFIX: exporting to this drive fails with one line and code 4
refusedOnDrive() {
    local code=0
    wine "$build/bin/pointrt-info.exe" scan.pro --export "$1:\\a.$2" 2>windows.err || code=$?
    [ $code = 4 ] || fail "drive $1: exit code $code: $(cat windows.err)"
    [ "$(wc -l <windows.err)" = 1 ] || fail "drive $1: not one line: $(cat windows.err)"
}

head -c 64K /dev/zero >full/other
for suffix in ply pcd las; do
    refused pointrt-info scan.pro --export full/a.$suffix
    cmp here.err windows.err || fail "full/a.$suffix: complains otherwise in Windows: $(cat windows.err)"
    refusedOnDrive f $suffix
done
if [ -e "$build/bin/pointrt-bake.exe" ] && [ -e "$bin/pointrt-bake" ]; then
    refused pointrt-bake -q large.xyz -o full/a.pro
    cmp here.err windows.err || fail "full/a.pro: complains otherwise in Windows: $(cat windows.err)"
fi
[ "$(ls full)" = other ] || fail "left on a full disk: $(ls full)"
rm full/other

cp scan.pro read_only
mount -o remount,ro read_only
alike pointrt-info read_only/scan.pro --verify
wine "$build/bin/pointrt-info.exe" 'r:\scan.pro' --verify >windows.out || fail "cannot read from drive r"
refused pointrt-info scan.pro --export read_only/a.ply # "Permission denied", as Windows has no other word for it
refusedOnDrive r ply
if [ -e "$build/bin/pointrt-bake.exe" ] && [ -e "$bin/pointrt-bake" ]; then
    refused pointrt-bake -q large.xyz -o read_only/a.pro
    refused pointrt-bake -q large.xyz -o read_only/a.proset
fi
refused pointrt-info scan.pro --export read_only/scan.pro # it exists
echo "the same in Windows"
