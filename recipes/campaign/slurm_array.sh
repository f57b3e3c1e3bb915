#!/bin/bash
# Runs a campaign as a Slurm array, in which each task is a shard with its own file of results:
#   sbatch --array=1-20 --cpus-per-task=4 slurm_array.sh SCENARIO...
# Array and processors are flags of sbatch. RESULTS is a folder that all nodes see. A requeued task continues where it
# was killed. When all tasks are finished: merge_results.py all.sqlite results/*.sqlite
#SBATCH --job-name=understudy
#SBATCH --requeue
#SBATCH --open-mode=append
set -eu
results=${RESULTS:-results}
count=$SLURM_ARRAY_TASK_COUNT
shard=$(((SLURM_ARRAY_TASK_ID - SLURM_ARRAY_TASK_MIN) / ${SLURM_ARRAY_TASK_STEP:-1} + 1))
mkdir -p "$results"
exec understudy run "$@" --shard "$shard/$count" --jobs "${SLURM_CPUS_PER_TASK:-1}" \
  --results "$results/$shard.sqlite" --resume --failures "$results/failures-$shard"
