#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Installs what is missing (Debian 12 or 13, root or sudo), builds everything and runs every test.
#   ./test.sh [CTEST OPTION...]      for example ./test.sh -R octree
# POINTRT_DATA names a folder of real scans for the tests that can use one; without it, they are skipped with a message.
set -euo pipefail
cd "$(dirname "$0")"
. .ci/common.sh

if [ -z "${POINTRT_DATA:-}" ] && [ -d ../shared/data ]; then
    POINTRT_DATA=$(cd ../shared/data && pwd)
    export POINTRT_DATA
fi

installPackages build bake view tests
# A new build folder is configured for the shortest compile time: it builds only what the tests run, compiles sources in
# batches (which ccache could not keep), and has the debug information that stack traces need. An existing build folder
# keeps its own options.
options=()
[ -e build/dev/CMakeCache.txt ] ||
    options=(-D POINTRT_CCACHE=OFF -D POINTRT_BUILD_BENCHES=OFF -D "CMAKE_CXX_FLAGS_RELWITHDEBINFO=-O2 -g1 -DNDEBUG")
buildPreset dev "${options[@]}"

# The tools sync each file that they complete, and the tests write thousands of files; on a disk each takes some 10 ms.
if [ -z "${TMPDIR:-}" ] && folder=$(folderInMemory 2048); then
    export TMPDIR=$folder
    trap 'rm -rf "$TMPDIR"' EXIT
fi

report=$PWD/build/dev/ctest.xml
rm -f "$report"
status=0
ctest --preset dev -j 2 --timeout 600 --no-tests=error --output-junit "$report" "$@" || status=$?
[ -s "$report" ] || die "ctest left no report"

# The last lines of failed tests say why they failed; print them here, where they are not lost among thousands of
# others.
awk -v shown=15 '
    /<testcase / { name = $0; sub(/.* name="/, "", name); sub(/".*/, "", name); failed = / status="fail"/; lines = 0 }
    failed && /<system-out>/ { inside = 1; sub(/.*<system-out>/, "") }
    inside { line[lines++] = $0 }
    /<\/system-out>/ && inside {
        inside = 0
        printf "==> %s failed:\n", name
        for (i = lines > shown ? lines - shown : 0; i < lines; ++i) { sub(/<\/system-out>/, "", line[i]); print line[i] }
    }' "$report"

# The counts in the <testsuite> element; CTest writes one attribute per line.
awk -v RS='[ \t\n]+' -F '"' '
    /^tests=/ { tests = $2 } /^failures=/ { failed = $2 } /^skipped=/ { skipped += $2 } /^disabled=/ { skipped += $2 }
    /^<testcase/ { exit }
    END { printf "%d passed, %d failed, %d skipped\n", tests - failed - skipped, failed, skipped }' "$report"
exit "$status"
