#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# No script pipes into grep -q: it ends at the first match, and what writes to it later fails, sometimes, under pipefail.
# usage: pipes.sh REPOSITORY|can_fail
set -euo pipefail

# hasNoEarlyEnd FOLDER: succeeds if no script pipes into grep -q; prints each line that does.
hasNoEarlyEnd() { ! grep -rnE --include='*.sh' --exclude-dir=build --exclude-dir=.git '[^|]\| *grep +-[a-zA-Z]*q' "$1"; }

if [ "$1" = can_fail ]; then
    work=$(mktemp -d)
    trap 'rm -rf "$work"' EXIT
    printf 'tool || grep -q a file\ntool | grep a >/dev/null\n' >"$work/a.sh"
    hasNoEarlyEnd "$work"
    printf 'tool %s grep -Eq a\n' '|' >"$work/b.sh"
    ! hasNoEarlyEnd "$work" >"$work/found"
    grep -q 'b.sh:1:' "$work/found"
else
    hasNoEarlyEnd "$1" || {
        echo "these scripts pipe into grep -q: let grep read to the end (>/dev/null)" >&2
        exit 1
    }
fi
