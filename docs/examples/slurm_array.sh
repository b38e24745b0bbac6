#!/usr/bin/env bash
# Runs a campaign as a Slurm job array. Each task computes one shard of the runs:
#   sbatch -a 0-3 docs/examples/slurm_array.sh CAMPAIGN.toml OUT
# Each task writes a file OUT/CAMPAIGN-i-of-N.sqlite. If Slurm requeues a task, the task continues its file. When all tasks are done:
#   hil-bench campaign merge OUT/CAMPAIGN.sqlite OUT/CAMPAIGN-*-of-*.sqlite
#SBATCH --job-name=canhil
#SBATCH --cpus-per-task=1
#SBATCH --output=slurm-%A-%a.out
set -euo pipefail
campaign=${1:?expected a campaign file}
out=${2:?expected a folder for the results}
: "${SLURM_ARRAY_TASK_ID:?expected a task of a job array: sbatch -a 0-3 $0 ...}"
# The numbers of the shards start at 0 and have no gaps, even if the array has another start or step.
shard=$(((SLURM_ARRAY_TASK_ID - SLURM_ARRAY_TASK_MIN) / ${SLURM_ARRAY_TASK_STEP:-1}))
exec "${HIL_BENCH:-hil-bench}" campaign "$campaign" --shard "$shard/$SLURM_ARRAY_TASK_COUNT" \
  --threads "${SLURM_CPUS_PER_TASK:-1}" --out "$out" --resume
