#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# A tile set baked by Slurm: slurm.sh SITE.proset SCAN ... [-- OPTION ...]
# Submits its steps as jobs that wait for one another, those of blocks as arrays. Submitted again, it goes on where jobs
# failed or were ended. POINTRT_BAKE names the program; SBATCH_... set what Slurm wants to know.
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

# submit NAME STEP [SBATCH OPTION ...]: prints the number of the job.
submit() {
    local name=$1 step=$2
    shift 2
    sbatch --parsable --job-name="$name" --output="$set.work/slurm-%x.log" --kill-on-invalid-dep=yes "$@" --wrap \
        "exec srun --ntasks=1 $(printf '%q ' "${command[@]}")-j \${SLURM_CPUS_PER_TASK:-1} --step $step"
}

mkdir -p "$set.work"
submit plan split --wait >/dev/null # the plan is made on the way, and says how many blocks there are
last=$(($(sed 's/.*"first_tile_of_block":\[\([0-9,]*\)\].*/\1/' "$set.work/plan.json" | tr -dc , | wc -c) - 1))
of_blocks=(--array="0-$last" --output="$set.work/slurm-%x-%a.log")
# shellcheck disable=SC2016 # the jobs themselves know their numbers
block=$(submit block 'block:$SLURM_ARRAY_TASK_ID' "${of_blocks[@]}")
levels=$(submit levels levels --dependency="afterok:$block")
# shellcheck disable=SC2016
tile=$(submit tile 'tile:$SLURM_ARRAY_TASK_ID' "${of_blocks[@]}" --dependency="afterok:$levels")
submit top top --dependency="afterok:$tile"
