#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Builds the Debian packages of the last commit twice, in folders of different depths and in different time zones. Fails if
# a byte differs.
#   reproducible.sh [FOLDER]   FOLDER: where to build, or to resume interrupted builds (default: a new folder)
set -euo pipefail
cd "$(dirname "$0")/../.."
work=${1:-$(mktemp -d)}

first=$work/first second=$work/the/second/build
for folder in "$first" "$second"; do
    [ -e "$folder/CMakeLists.txt" ] || { mkdir -p "$folder" && git archive HEAD | tar -x -C "$folder"; }
done
SOURCE_DATE_EPOCH=$(git log -1 --format=%ct)
export SOURCE_DATE_EPOCH
TZ=UTC "$first/packaging/deb.sh"
TZ=Asia/Tokyo "$second/packaging/deb.sh"

packages=build/package/packages
diff -r "$first/$packages" "$second/$packages" && (cd "$first/$packages" && sha256sum ./*) &&
    echo "the same bytes twice"
