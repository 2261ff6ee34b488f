#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# All C and C++ sources are formatted as by clang-format 14. Skips without it, as other versions break lines differently.
# format.sh REPOSITORY
set -euo pipefail
cd "$1"
program=
for each in clang-format-14 clang-format; do
    command -v "$each" >/dev/null && "$each" --version | grep 'version 14\.' >/dev/null && program=$each && break
done
if [ -z "$program" ]; then
    echo "skipped: no clang-format 14 here"
    exit 77
fi

find format preprocess python runtime shaders tests \( -name '*.h' -o -name '*.hpp' -o -name '*.c' -o -name '*.cpp' \) -print0 |
    xargs -0 "$program" --dry-run --Werror 2>&1 | sed -n 's/: error:.*/: run clang-format-14 -i on it/p' | sort -u -t: -k1,1 |
    { ! grep .; }
