#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Builds packages of the last commit twice, in folders of different depths and in different time zones. Fails if a byte
# differs.
#   reproducible.sh deb|tarball|windows [FOLDER]
#   FOLDER: where to build, or to resume interrupted builds (default: a new folder)
set -euo pipefail
cd "$(dirname "$0")/../.."
case ${1:-} in
    deb | tarball) script=packaging/$1.sh packages=build/package/packages ;;
    windows) script=packaging/windows/package.sh packages=build/windows/packages ;;
    *) echo "usage: reproducible.sh deb|tarball|windows [FOLDER]" >&2 && exit 2 ;;
esac
work=${2:-$(mktemp -d)}

first=$work/first second=$work/the/second/build
for folder in "$first" "$second"; do
    [ -e "$folder/CMakeLists.txt" ] || { mkdir -p "$folder" && git archive HEAD | tar -x -C "$folder"; }
done
SOURCE_DATE_EPOCH=$(git log -1 --format=%ct)
export SOURCE_DATE_EPOCH
TZ=UTC "$first/$script"
TZ=Asia/Tokyo "$second/$script"

diff -r "$first/$packages" "$second/$packages" && (cd "$first/$packages" && sha256sum ./*) &&
    echo "the same bytes twice"
