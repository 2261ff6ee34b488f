#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Builds the Debian packages of what is committed twice, in folders of different depth and in other time zones, and
# fails where a byte differs.
#   reproducible.sh [FOLDER]   FOLDER: where to build, and to go on with builds that were interrupted; else a new one
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
