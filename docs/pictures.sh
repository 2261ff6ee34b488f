#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Renders the README's pictures: docs/pictures.sh DATA, with DATA holding the Stanford range scans of the Dragon
# (stanford_dragon_raw/dragonStandRight.conf) and the Happy Buddha (stanford_happy_raw/happyStandRight.conf).
set -euo pipefail
data=$(cd "${1:?usage: docs/pictures.sh DATA}" && pwd)
cd "$(dirname "$0")/.."
bin=build/release/bin
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$bin/pointrt-bake" "$data/stanford_dragon_raw/dragonStandRight.conf" -o "$work/dragon.pro"
"$bin/pointrt-view" "$work/dragon.pro" --room matte --lights 4 -o docs/dragon.png
"$bin/pointrt-bake" "$data/stanford_happy_raw/happyStandRight.conf" -o "$work/buddha.pro"
"$bin/pointrt-view" "$work/buddha.pro" --room mirror --bounces 10 --lights 4 -o docs/buddha.png
