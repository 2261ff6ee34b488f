#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Bakes a tile set with JOBS processes at once, using GNU parallel: parallel.sh JOBS SITE.proset SCAN ... [OPTION ...]
# Resumes an interrupted run. POINTRT_BAKE names the program.
set -euo pipefail
jobs=${1:?parallel.sh JOBS SITE.proset SCAN ... [OPTION ...]} set=$2
shift 2
command=("${POINTRT_BAKE:-pointrt-bake}" "$@" -o "$set" -q)

"${command[@]}" --step split # also makes the plan, which has the number of blocks
last=$(($(sed 's/.*"first_tile_of_block":\[\([0-9,]*\)\].*/\1/' "$set.work/plan.json" | tr -dc , | wc -c) - 1))
# shellcheck disable=SC2054 # now,fail=1 is a single word
each=(parallel -j "$jobs" --halt now,fail=1 --retries 3 --joblog "$set.work/parallel.log" --quote "${command[@]}")
seq 0 "$last" | "${each[@]}" --step block:{}
"${command[@]}" --step levels
seq 0 "$last" | "${each[@]}" --step tile:{}
"${command[@]}" --step top
