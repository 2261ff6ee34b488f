#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Bakes a tile set with Slurm: slurm.sh SITE.proset SCAN ... [-- OPTION ...]
# Submits the steps as dependent jobs, those of blocks as arrays. Run it again to resume after jobs failed or were
# cancelled. POINTRT_BAKE names the program; SBATCH_... variables set Slurm's options.
set -euo pipefail
set=${1:?slurm.sh SITE.proset SCAN ... [-- OPTION ...]}
shift
command=("${POINTRT_BAKE:-pointrt-bake}" -o "$set" -q)
while [ $# -gt 0 ] && [ "$1" != -- ]; do
    command+=("$1")
    shift
done
[ $# -eq 0 ] || shift
command+=("$@")

# submit NAME STEP [SBATCH OPTION ...]: prints the job number.
submit() {
    local name=$1 step=$2
    shift 2
    sbatch --parsable --job-name="$name" --output="$set.work/slurm-%x.log" --kill-on-invalid-dep=yes "$@" --wrap \
        "exec srun --ntasks=1 $(printf '%q ' "${command[@]}")-j \${SLURM_CPUS_PER_TASK:-1} --step $step"
}

mkdir -p "$set.work"
submit plan split --wait >/dev/null # also makes the plan, which has the number of blocks
last=$(($(sed 's/.*"first_tile_of_block":\[\([0-9,]*\)\].*/\1/' "$set.work/plan.json" | tr -dc , | wc -c) - 1))
of_blocks=(--array="0-$last" --output="$set.work/slurm-%x-%a.log")
# shellcheck disable=SC2016 # expanded in the job
block=$(submit block 'block:$SLURM_ARRAY_TASK_ID' "${of_blocks[@]}")
levels=$(submit levels levels --dependency="afterok:$block")
# shellcheck disable=SC2016
tile=$(submit tile 'tile:$SLURM_ARRAY_TASK_ID' "${of_blocks[@]}" --dependency="afterok:$levels")
submit top top --dependency="afterok:$tile"
