#!/bin/bash
# Runs a campaign with GNU parallel, on this machine or (with its --sshloginfile) on several that share a folder:
#   SHARDS=64 gnu_parallel.sh SCENARIO...
# When it is called again, it continues where it was interrupted. Exit code: that of GNU parallel, the number of shards
# with failures. When it is finished: merge_results.py all.sqlite results/*.sqlite
set -eu
results=${RESULTS:-results}
shards=${SHARDS:-$(nproc)}
mkdir -p "$results"
# shellcheck disable=SC2086  # several flags may be given
seq "$shards" | parallel --jobs "${JOBS:-100%}" --joblog "$results/shards.log" ${PARALLEL_FLAGS:-} \
  understudy run "${@@Q}" --shard "{}/$shards" --jobs 1 \
  --results "$results/{}.sqlite" --resume --failures "$results/failures-{}"
