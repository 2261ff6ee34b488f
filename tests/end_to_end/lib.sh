# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# Tests of the tools' command lines. A script sources this, defines functions case_NAME and ends with runCase "$@". A case
# runs in a temporary folder that is empty except for an empty folder out/, with the tools in PATH.
set -euo pipefail

: "${POINTRT_BIN:?the folder of the built tools}"
export PATH=$POINTRT_BIN:$PATH LC_ALL=C POINTRT_INDEX_CACHE=off
unset DISPLAY WAYLAND_DISPLAY # a tool that opens a window would wait for its user
suite_dir=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)

fail() {
    printf 'FAIL: %s\n' "$*" >&2
    exit 1
}

# skip REASON: CTest counts exit status 77 as a skipped test.
skip() {
    printf 'SKIPPED: %s\n' "$*" >&2
    exit 77
}

# run COMMAND...: puts its exit status into $status and its output into the files stdout and stderr.
run() {
    status=0
    timeout 240 "$@" >stdout 2>stderr </dev/null || status=$?
    printf '$ %s\n' "$*"
    sed 's/^/    /' stderr
    printf '    exit status %s\n' "$status"
}

# expectDone COMMAND...: must exit with status 0.
expectDone() {
    run "$@"
    [ "$status" = 0 ] || fail "exit status $status where 0 was expected"
}

# expectError CODE PATTERN COMMAND...: must exit with CODE, print one line "TOOL: error: ..." to stderr that matches the
# extended regular expression PATTERN, nothing to stdout, and leave nothing new in out/.
expectError() {
    local code=$1 pattern=$2 before
    shift 2
    before=$(ls -A out)
    run "$@"
    [ "$status" = "$code" ] || fail "exit status $status where $code was expected"
    [ "$(wc -l <stderr)" = 1 ] || fail "stderr is not one line"
    grep -Eq "^pointrt-[a-z]+: error: .*$pattern" stderr || fail "no line 'NAME: error: $pattern' on stderr"
    [ ! -s stdout ] || fail "something on stdout"
    [ "$(ls -A out)" = "$before" ] || fail "left behind in out/: $(ls -A out)"
}

# sphere COUNT [NOISE]: COUNT points spread over a unit sphere, as text.
sphere() {
    awk -v count="$1" 'BEGIN {
        for (i = 0; i < count; i++) {
            z = 1 - (2 * i + 1) / count; r = sqrt(1 - z * z); phi = i * 2.399963229728653
            printf "%.6f %.6f %.6f\n", r * cos(phi), r * sin(phi), z
        }
    }'
}

# jsonValue FILE PATH: a number or string of a JSON file, at a path such as seconds.total; empty if it is missing.
jsonValue() {
    awk -f "$suite_dir/../../.ci/json.awk" "$1" | awk -F '\t' -v path="$2" '$1 == path { print $2 }'
}

# expectKeys FILE PATH...: every path must have a value.
expectKeys() {
    local file=$1 path
    shift
    for path in "$@"; do
        [ -n "$(jsonValue "$file" "$path")" ] || fail "$file has no $path"
    done
}

# useCache NAME: gives this case empty caches, except for the driver's compiled programs. $kept is the folder of the
# cache NAME.
useCache() {
    export MESA_SHADER_CACHE_DIR=${XDG_CACHE_HOME:-$HOME/.cache} XDG_CACHE_HOME=$PWD/cache
    unset POINTRT_INDEX_CACHE POINTRT_BAKE_CACHE
    kept=$XDG_CACHE_HOME/pointrt/$1
}

runCase() {
    folder=$(mktemp -d)
    export XDG_STATE_HOME=$folder/.state
    trap 'cd / && chmod -R u+rwx "$folder" && rm -rf "$folder"' EXIT
    cd "$folder"
    mkdir out
    "case_$1"
}
