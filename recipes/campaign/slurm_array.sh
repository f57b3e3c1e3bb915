#!/bin/bash
# A campaign as an array of Slurm, each task a shard with its own file of results:
#   sbatch --array=1-20 --cpus-per-task=4 slurm_array.sh SCENARIO...
# Array and processors are sbatch's to say; RESULTS is a folder that all nodes see. A task that is requeued goes on where it
# was killed. When all are over: merge_results.py all.sqlite results/*.sqlite
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
