#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Checks which rooms each room includes; the other cases test that the check finds violations.
# rooms.sh CASE REPOSITORY rooms.txt
set -euo pipefail
check=$2/tests/structure/check_rooms.awk

sources() { find format preprocess runtime shaders -name '*.h' -o -name '*.hpp' -o -name '*.cpp' -o -name '*.glsl'; }
fail() {
    echo "$*" >&2
    exit 1
}

# expectFinding TEXT: the check of the small tree must fail and print TEXT.
expectFinding() {
    local said
    # shellcheck disable=SC2046 # a list of words
    if said=$(awk -v most_rooms=3 -v most_purpose=30 -v os_room=low -f "$check" rooms.txt $(find low high -type f)); then fail "the check found nothing"; fi
    [ "$said" = "$1" ] || fail "the check said: $said"
}

# smallTree: makes a tree with two rooms that passes the check.
smallTree() {
    cd "$(mktemp -d)"
    trap 'rm -rf "$PWD"' EXIT
    mkdir low high
    printf 'low||Below.\nhigh|low|Above.\n' >rooms.txt
    printf '#include <vector>\n' >low/a.h
    printf '#include "low/a.h"\n#include "high/c.h"\n#include "shaders/x.spv.h"\n' >high/b.cpp
    printf '#pragma once\n' >high/c.h
    # shellcheck disable=SC2046
    awk -v most_rooms=3 -v most_purpose=30 -v os_room=low -f "$check" rooms.txt $(find low high -type f) || fail "the small tree should pass"
}

case_tree() {
    cd "$1"
    # shellcheck disable=SC2046
    awk -f "$check" "$2" $(sources)
}
# The table of rooms in CONTRIBUTING.md is up to date.
case_table() {
    diff <(awk -f "$1/tests/structure/room_table.awk" "$2") \
        <(sed -n '/^| room | what it is for/,/^$/p' "$1/CONTRIBUTING.md" | sed '$d') ||
        fail "CONTRIBUTING.md: put there what awk -f tests/structure/room_table.awk build/dev/rooms.txt prints"
}
case_arrow_up() {
    smallTree
    printf '#include "high/c.h"\n' >>low/a.h
    expectFinding 'low/a.h:2: low may not include high ("high/c.h"): its CMakeLists.txt does not use that room'
}
case_circle() {
    smallTree
    printf 'low|high|Below.\nhigh|low|Above.\n' >rooms.txt
    printf '#include "high/c.h"\n' >>low/a.h
    expectFinding 'rooms in a circle: low -> high -> low'
}
case_relative() {
    smallTree
    printf '#include "../low/a.h"\n' >>high/c.h
    expectFinding 'high/c.h:2: "../low/a.h" is not a file of a room by its path from the root'
}
case_stray() {
    smallTree
    mkdir low/attic
    : >low/attic/d.h
    printf '\n' >low/attic/d.h
    expectFinding 'low/attic/d.h: lies in no room'
}
case_unused() {
    smallTree
    printf '#pragma once\n' | tee high/b.cpp >high/c.h
    expectFinding 'high: includes nothing of low, which it uses'
}
case_two_ideas() {
    smallTree
    printf 'low||Below.\nhigh|low|Above, and besides that a few other things.\n' >rooms.txt
    expectFinding 'high: its purpose takes more than 30 characters'
}
case_system() {
    smallTree
    printf '#include <unistd.h>\n' >>low/a.h
    printf '#  include <sys/stat.h> // sizes\n' >>high/c.h
    expectFinding 'high/c.h:2: <sys/stat.h> is of one system: what needs it belongs in low'
}
case_folder() {
    smallTree
    printf 'fs::directory_iterator entry(folder);\n' | tee -a low/a.h >>high/c.h
    expectFinding 'high/c.h:2: lists a folder by itself: listFolder of low does'
}
case_thread_local() {
    smallTree
    printf '    static thread_local std::string text;\n' | tee -a low/a.h >>high/c.h
    expectFinding 'high/c.h:2: is thread_local: on Windows its destructor would run after its memory is freed'
}
case_crowd() {
    smallTree
    printf 'low||Below.\nhigh|low|Above.\nattic||Up.\nloft||Up.\n' >rooms.txt
    expectFinding 'there are more than 3 rooms'
}

"case_$1" "$2" "$3"
