#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# format/pointio is linked to pointrt-bake, but neither to the viewer nor to the format library.
# links.sh pointrt-bake pointrt-view LIBRARY
set -euo pipefail

# holds FILE: whether it contains symbols of format/pointio: openLas in C++, scan_laz_open and others in Rust.
holds() { nm -C "$1" 2>/dev/null | grep -E '^[0-9a-f]+ [TtWw] (pointrt::openLas\(|scan_(laz|e57)_)' >/dev/null; }

holds "$1" || {
    echo "$1 does not hold format/pointio: this test looks for the wrong names"
    exit 1
}
for program in "$2" "$3"; do
    if holds "$program"; then
        echo "$program is linked to format/pointio"
        exit 1
    fi
done
