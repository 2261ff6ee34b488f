#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Runs the tests that enter no Vulkan driver under ThreadSanitizer (GCC's), and prints every report that it has, once.
#   tsan.sh [CTEST OPTION...]      for example tsan.sh -R octree; builds into build/tsan
# A oneTBB that is instrumented is built first, into build/tsan-tbb: of a usual one ThreadSanitizer does not see that a
# task begins after what made it, so that every loop would be a report. Its source is the Debian package's, fetched
# beside the system's lists, or in the folder that TBB_SOURCE names. TSAN_TARGETS are built instead of all.
# No driver is found here. Lavapipe runs shaders that it compiles itself, on threads of its own, and hands on work in
# ways that ThreadSanitizer does not see either. What asks for a device runs until there, fails, and is counted apart.
# Left out are torture, which runs the same commands as end_to_end some thousand times, and the wheel, whose Python
# cannot load what is instrumented. Two tests ask what ThreadSanitizer cannot do: it hands on signals where a call may
# block, of which open, of a pipe that nobody writes to, is none to it, and wants more addresses than ulimit -v leaves.
# Exit status: 1 where there is a report, or where a test failed for another reason.
set -euo pipefail
cd "$(dirname "$0")/../.."
. .ci/common.sh

tbb=$PWD/build/tsan-tbb build=$PWD/build/tsan
reports=$build/reports junit=$build/ctest.xml

# Debian's sources, of the release that is here: the lists that apt has, but for source packages, in a folder of ours.
fetchTbb() {
    local parts=$tbb/apt/parts file options
    command -v apt-get >/dev/null || die "no apt-get here: TBB_SOURCE names the folder of oneTBB's source"
    mkdir -p "$parts" "$tbb/apt/lists/partial" "$tbb/apt/cache/archives/partial" "$tbb/source"
    for file in /etc/apt/sources.list /etc/apt/sources.list.d/*; do
        [ -f "$file" ] || continue
        case $file in
            *.sources) sed 's/^Types: deb$/Types: deb-src/' "$file" >"$parts/${file##*/}" ;;
            *.list) sed -n 's/^deb /deb-src /p' "$file" >"$parts/${file##*/}" ;;
        esac
    done
    options=(-q -o Dir::Etc::SourceList=/dev/null -o "Dir::Etc::SourceParts=$parts" -o "Dir::State::Lists=$tbb/apt/lists"
        -o "Dir::Cache=$tbb/apt/cache" -o "APT::Sandbox::User=$(id -un)")
    apt-get "${options[@]}" update
    (cd "$tbb/source" && apt-get "${options[@]}" source onetbb) || die "oneTBB's source package cannot be fetched"
}

buildTbb() {
    [ ! -e "$tbb/lib/cmake/TBB/TBBConfig.cmake" ] || return 0
    local source=${TBB_SOURCE:-}
    if [ -z "$source" ]; then
        [ -n "$(find "$tbb/source" -maxdepth 2 -name CMakeLists.txt 2>/dev/null)" ] || fetchTbb
        source=$(dirname "$(find "$tbb/source" -maxdepth 2 -name CMakeLists.txt)")
    fi
    say "building $(basename "$source") with ThreadSanitizer"
    # its allocator, its tests and what binds threads to cores are not wanted; GCC warns of fences that it does not see
    cmake -G Ninja -S "$source" -B "$tbb/build" -D CMAKE_BUILD_TYPE=RelWithDebInfo -D CMAKE_INSTALL_PREFIX="$tbb" \
        -D CMAKE_INSTALL_LIBDIR=lib -D CMAKE_CXX_FLAGS=-Wno-tsan -D TBB_SANITIZE=thread -D TBB_TEST=OFF \
        -D TBB_STRICT=OFF -D TBBMALLOC_BUILD=OFF -D TBB_DISABLE_HWLOC_AUTOMATIC_SEARCH=ON
    cmake --build "$tbb/build" --parallel "$(buildJobs)" --target install
}

# What came of each test: "passed", "skipped", "device" (it asked for one) or "failed", and its name.
outcomes() {
    awk '
        function end() { print status, name; name = "" }
        /<testcase / {
            match($0, / name="[^"]*"/)
            name = substr($0, RSTART + 7, RLENGTH - 8)
            status = /status="run"/ ? "passed" : "failed"
        }
        /<skipped/ { status = "skipped" }
        # 3: what tools end with that this machine cannot do, as tests tell it that keep their words to themselves
        /no Vulkan driver: install one|^    Which is: 3$/ && status == "failed" { status = "device" }
        name != "" && /<\/testcase>/ { end() }' "$junit"
}

buildTbb
read -ra targets <<<"${TSAN_TARGETS:-all}"
say "building with the tsan preset, $(buildJobs) at a time"
output=$(cmake --preset tsan 2>&1) || {
    printf '%s\n' "$output" >&2
    die "cmake could not configure the build"
}
cmake --build --preset tsan --parallel "$(buildJobs)" --target "${targets[@]}"
readelf -d "$build"/bin/test_octree | grep -q "RUNPATH.*$tbb/lib" || die "the tests have another TBB than $tbb/lib"

rm -rf "$reports" "$junit"
mkdir -p "$reports"
status=0
cannot='^end_to_end\.(endings\.signals_end_a_bake|film\.refuses_what_memory_cannot_hold)$'
TSAN_OPTIONS="log_path=$reports/report" ctest --preset tsan -j "$(nproc)" --no-tests=error --exclude-regex "$cannot" \
    --label-exclude '^(torture|python)$' --output-junit "$junit" "$@" >"$build/ctest.log" 2>&1 || status=$?
[ -s "$junit" ] || die "ctest left no report, exit status $status: $build/ctest.log"

outcomes >"$build/outcomes"
count() { grep -c "^$1 " "$build/outcomes" || true; }
echo "$(count passed) passed, $(count skipped) skipped, $(count device) left out when they asked for a device, $(count failed) failed"
sed -n 's/^failed /FAILED: /p' "$build/outcomes"
summaries=$(find "$reports" -type f -exec sed -n 's/^SUMMARY: ThreadSanitizer: //p' {} + | sort | uniq -c | sort -rn)
[ -z "$summaries" ] || printf 'reports, how many times each; in full in %s:\n%s\n' "$reports" "$summaries"
[ -z "$summaries" ] && [ "$(count failed)" = 0 ]
