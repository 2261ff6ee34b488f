#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Runs the tests that need no Vulkan driver under ThreadSanitizer (GCC's), and prints each of its reports once.
#   tsan.sh [CTEST OPTION...]      for example tsan.sh -R octree; builds into build/tsan
# First builds an instrumented oneTBB into build/tsan-tbb. With the system's oneTBB, ThreadSanitizer would not see that a
# task starts after the code that spawned it, and report every parallel loop. The source is that of the Debian package
# (fetched without changing the system's apt lists), or the folder TBB_SOURCE. TSAN_TARGETS: targets to build (default: all).
# Vulkan drivers are hidden: Lavapipe runs shaders that it compiles itself on its own threads, and synchronises in ways that
# ThreadSanitizer does not see either. Tests that need a device fail when they request one, and are counted separately.
# Not run: torture, which runs the commands of end_to_end some thousand times, and the Python wheel, whose interpreter cannot
# load instrumented libraries. Two more tests cannot pass: ThreadSanitizer delivers signals only at calls that it knows to
# block, which opening a pipe without a writer is not, and it needs more address space than ulimit -v leaves.
# Exit status: 1 if there is a report, or a test failed for another reason.
set -euo pipefail
cd "$(dirname "$0")/../.."
. .ci/common.sh

tbb=$PWD/build/tsan-tbb build=$PWD/build/tsan
reports=$build/reports junit=$build/ctest.xml

# fetchTbb: gets the source package of this Debian release, with copies of apt's lists that have source packages.
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
    # without its allocator, its tests and thread binding; GCC would warn of fences that ThreadSanitizer does not support
    cmake -G Ninja -S "$source" -B "$tbb/build" -D CMAKE_BUILD_TYPE=RelWithDebInfo -D CMAKE_INSTALL_PREFIX="$tbb" \
        -D CMAKE_INSTALL_LIBDIR=lib -D CMAKE_CXX_FLAGS=-Wno-tsan -D TBB_SANITIZE=thread -D TBB_TEST=OFF \
        -D TBB_STRICT=OFF -D TBBMALLOC_BUILD=OFF -D TBB_DISABLE_HWLOC_AUTOMATIC_SEARCH=ON
    cmake --build "$tbb/build" --parallel "$(buildJobs)" --target install
}

# outcomes: for each test "passed", "skipped", "device" (it needs one) or "failed", and its name.
outcomes() {
    awk '
        function end() { print status, name; name = "" }
        /<testcase / {
            match($0, / name="[^"]*"/)
            name = substr($0, RSTART + 7, RLENGTH - 8)
            status = /status="run"/ ? "passed" : "failed"
        }
        /<skipped/ { status = "skipped" }
        # 3 is the exit code for what this machine cannot do; some tests print only that code
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
readelf -d "$build"/bin/test_octree | grep "RUNPATH.*$tbb/lib" >/dev/null || die "the tests have another TBB than $tbb/lib"

rm -rf "$reports" "$junit"
mkdir -p "$reports"
status=0
cannot='^end_to_end\.(endings\.signals_end_a_bake|film\.refuses_what_memory_cannot_hold)$'
TSAN_OPTIONS="log_path=$reports/report" ctest --preset tsan -j "$(nproc)" --no-tests=error --exclude-regex "$cannot" \
    --label-exclude '^(torture|python)$' --output-junit "$junit" "$@" >"$build/ctest.log" 2>&1 || status=$?
[ -s "$junit" ] || die "ctest left no report, exit status $status: $build/ctest.log"

outcomes >"$build/outcomes"
count() { grep -c "^$1 " "$build/outcomes" || true; }
echo "$(count passed) passed, $(count skipped) skipped, $(count device) left out because they need a device, $(count failed) failed"
sed -n 's/^failed /FAILED: /p' "$build/outcomes"
summaries=$(find "$reports" -type f -exec sed -n 's/^SUMMARY: ThreadSanitizer: //p' {} + | sort | uniq -c | sort -rn)
[ -z "$summaries" ] || printf 'reports, how many times each; in full in %s:\n%s\n' "$reports" "$summaries"
[ -z "$summaries" ] && [ "$(count failed)" = 0 ]
