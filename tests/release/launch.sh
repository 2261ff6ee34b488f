#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# packaging/launch.sh: programs run by the system's C library where it is new enough, and by the archive's where it is
# not, from any folder, through links, and find each other.
#   launch.sh REPOSITORY BIN
set -euo pipefail
repository=$1 bin=$2
loader=/lib64/ld-linux-x86-64.so.2
[ -e $loader ] || { echo "SKIPPED: no glibc for x86-64 here" && exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() {
    echo "$*" >&2
    exit 1
}

mkdir -p "$work/bin" "$work/lib/programs" "$work/lib/runtime" "$work/elsewhere"
cp "$bin"/pointrt-{bake,info,view} "$work/lib/programs/"
ldd "$bin/pointrt-info" | awk '$1 ~ /^lib(c|m|stdc\+\+|gcc_s)\.so/ { print $3 }' |
    xargs -I{} cp -L {} $loader "$work/lib/runtime/"
ln -s ../bin/pointrt-info "$work/elsewhere/linked"
cd "$work/elsewhere"

# launchers GLIBC_MINOR: writes launchers for programs built with that glibc
launchers() {
    local program
    for program in "$work"/lib/programs/*; do
        sed "s/@GLIBC_MINOR@/$1/; s/@LOADER@/${loader##*/}/" "$repository/packaging/launch.sh" >"$work/bin/${program##*/}"
        chmod 755 "$work/bin/${program##*/}"
    done
}
# libraryOf COMMAND: prints the C library with which it runs
libraryOf() { LD_DEBUG=libs "$1" --version 2>&1 | sed -n 's|.*calling init: \(.*/libc.so.6\)$|\1|p' | tail -1; }

launchers 0
[ "$(../bin/pointrt-info --version)" = "$("$bin/pointrt-info" --version)" ] || fail "prints another version"
[ "$(libraryOf ./linked)" = "$(libraryOf "$bin/pointrt-info")" ] || fail "does not run by the system's C library"

launchers 999
chmod -x "$work"/lib/programs/* # as an older system would not start them by itself
for launched in ../bin/pointrt-info ./linked; do
    [ "$(libraryOf $launched)" = "$work/lib/runtime/libc.so.6" ] || fail "$launched: not by the archive's C library"
done
(cd / && PATH=$work/bin:$PATH && pointrt-info --version >/dev/null)
code=0
../bin/pointrt-info none.pro 2>said || code=$?
[ $code = 1 ] && grep -q '^pointrt-info: error: none.pro: ' said || fail "exit code $code: $(cat said)"
printf '%s\n' '0 0 0' '1 0 0' '0 1 0' '1 1 0' >scan.xyz
POINTRT_INDEX_CACHE=off XDG_CACHE_HOME=$work PATH=/usr/bin:/bin ../bin/pointrt-view scan.xyz -o a.png --size 16x12 2>said ||
    fail "pointrt-view does not bake: $(cat said)"
[ -s a.png ] || fail "no picture"
