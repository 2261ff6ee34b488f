#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Perceptual difference of pictures: NVIDIA's FLIP of each TEST against REFERENCE, as a JSON array.
#   tests/bench/quality/flip.sh REFERENCE.png TEST.png...
# The environment variable FLIP names flip-evaluator's command. Without it, installs that from PyPI into the Python
# environment named by FLIP_ENVIRONMENT (kept for the next call), or into a temporary one.
set -euo pipefail
[ $# -ge 2 ] || {
    sed -n '3,6s/^# //p' "$0" >&2
    exit 2
}
reference=$1
shift
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

flip=${FLIP:-}
if [ -z "$flip" ]; then
    environment=${FLIP_ENVIRONMENT:-$folder/environment}
    flip=$environment/bin/flip
    if [ ! -e "$flip" ]; then
        python3 -m venv "$environment"
        "$environment/bin/pip" install -q --disable-pip-version-check flip-evaluator==1.7
    fi
fi

separator='['
for test in "$@"; do
    "$flip" -r "$reference" -t "$test" -nerm -c "$folder/flip.csv" -v 0 >/dev/null
    # columns: reference, test, mean, median, two quartiles, least, most, seconds
    tail -n 1 "$folder/flip.csv" | awk -F '","' -v separator="$separator" -v test="$(basename "$test")" \
        '{ printf "%s{\"test\": \"%s\", \"mean\": %s, \"max\": %s}", separator, test, $3, $8 }' >>"$folder/all.json"
    separator=', '
done
cat "$folder/all.json"
echo ']'
