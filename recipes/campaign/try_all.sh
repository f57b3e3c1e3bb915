#!/bin/bash
# Tests the recipes of this folder with a campaign of a hundred cases, as far as one machine allows:
#   try_all.sh UNDERSTUDY [slurm|parallel|gitlab|github]...
# For Slurm, it starts a cluster of one node on the loopback interface, and ends it; this needs root, slurm-wlm and
# munge. The jobs of GitLab and GitHub are read from their files, and their commands run with the variables that a
# runner sets, one shard after another; only the installation is skipped. Each recipe must produce the same results as
# one run without shards. Exit code: 77 if something that was requested is not installed.
set -eu
understudy=$(realpath "$1")
shift
recipes=("$@")
[ ${#recipes[@]} -gt 0 ] || recipes=(slurm parallel gitlab github)
here=$(realpath "$(dirname "$0")")
work=$(mktemp -d)
started=()
cluster=  # not empty if this script started Slurm
finish() {
  local pid
  if [ -n "$cluster" ]; then  # if this ends early, jobs still run, and the daemons would wait for them
    timeout 5 scancel --quiet --name=understudy || true
    for _ in $(seq 50); do
      [ -n "$(timeout 5 squeue -h 2>/dev/null)" ] || break
      sleep 0.2
    done
  fi
  for pid in "${started[@]}"; do kill "$pid" 2>/dev/null || true; done
  for pid in "${started[@]}"; do wait "$pid" 2>/dev/null || true; done
  rm -rf "$work"
}
trap finish EXIT

mkdir "$work/bin" "$work/project"
ln -s "$understudy" "$work/bin/understudy"
export PATH=$work/bin:$PATH
# A hundred cases, one in ten of which fails, so that a misplaced case is noticed.
cat >"$work/project/campaign.yaml" <<'YAML'
understudy: 1
name: a campaign
bench: { lines: { rs485: { stations: [ { name: feeder, model: simple2-r3 } ] } } }
vary:
  speed: { from: 1, to: 100, step: 1 }
steps:
  - write: { feeder.Aaxis_Speed: "${speed}" }
  - assert: feeder.Aaxis_Speed % 10 != 0
YAML
mkdir -p "$work/project/tests/campaign" "$work/project/third_party"
cp "$work/project/campaign.yaml" "$work/project/tests/campaign/"
cp "$here/merge_results.py" "$work/project/third_party/"
# The expected results of a recipe: a line for each case, sorted by identity.
rows="SELECT case_id, verdict, hash FROM results ORDER BY case_id"
listed() { python3 -c 'import sqlite3, sys
for row in sqlite3.connect(sys.argv[1]).execute(sys.argv[2]): print(*row)' "$1" "$rows"; }
cd "$work/project"
status=0
understudy run campaign.yaml --results "$work/whole.sqlite" --failures "$work/failures" >/dev/null || status=$?
[ $status -eq 1 ]
listed "$work/whole.sqlite" >"$work/expected"
[ "$(wc -l <"$work/expected")" -eq 100 ]

# judge RECIPE: its results must equal those of the whole campaign, and its shards must not overlap.
judge() {
  status=0
  python3 "$here/merge_results.py" all.sqlite results/*.sqlite >"$work/merged" || status=$?
  cat "$work/merged"
  [ $status -eq 1 ]
  grep -q '^10 failed, 90 passed' "$work/merged"
  listed all.sqlite | diff - "$work/expected"
  local sum=0 file
  for file in results/*.sqlite; do sum=$((sum + $(listed "$file" | wc -l))); done
  [ $sum -eq 100 ]
  [ "$(find results -name '*.jsonl' | wc -l)" -gt 0 ]  # recordings of failures
  rm -rf results all.sqlite
  echo "$1: as one run without shards"
}

missing() {
  echo "$1 is not here: $2" >&2
  exit 77
}

free_port() { python3 -c 'import socket
s = socket.socket()
s.bind(("127.0.0.1", 0))
print(s.getsockname()[1])'; }

try_slurm() {
  [ "$(id -u)" -eq 0 ] || missing slurm "its daemons want root"
  local program
  for program in munged slurmctld slurmd sbatch; do command -v "$program" >/dev/null || missing slurm "$program"; done
  local slurm=$work/slurm node
  node=$(hostname -s)
  mkdir -p "$slurm/state" "$slurm/spool"
  dd if=/dev/urandom of="$slurm/munge.key" bs=1024 count=1 status=none
  chmod 600 "$slurm/munge.key"
  # --force: otherwise munged rejects files below /tmp
  munged --foreground --force --key-file="$slurm/munge.key" --socket="$slurm/munge.socket" \
    --pid-file="$slurm/munge.pid" --log-file="$slurm/munge.log" --seed-file="$slurm/munge.seed" 2>"$slurm/munge.err" &
  started+=($!)
  cat >"$slurm/slurm.conf" <<CONF
ClusterName=campaign
SlurmctldHost=$node(127.0.0.1)
SlurmUser=root
SlurmdUser=root
SlurmctldPort=$(free_port)
SlurmdPort=$(free_port)
AuthType=auth/munge
AuthInfo=socket=$slurm/munge.socket
CredType=cred/munge
StateSaveLocation=$slurm/state
SlurmdSpoolDir=$slurm/spool
SlurmctldPidFile=$slurm/slurmctld.pid
SlurmdPidFile=$slurm/slurmd.pid
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
SelectType=select/cons_tres
SchedulerParameters=sched_interval=1
ReturnToService=2
NodeName=$node NodeAddr=127.0.0.1 CPUs=$(nproc) State=UNKNOWN
PartitionName=all Nodes=$node Default=YES MaxTime=INFINITE State=UP
CONF
  export SLURM_CONF=$slurm/slurm.conf
  cluster=yes
  slurmctld -D -c >"$slurm/slurmctld.log" 2>&1 &
  started+=($!)
  slurmd -D -N "$node" >"$slurm/slurmd.log" 2>&1 &
  started+=($!)
  local i
  for i in $(seq 300); do
    [ "$(sinfo -h -o %T 2>/dev/null)" = idle ] && break
    sleep 0.1
  done
  [ "$(sinfo -h -o %T)" = idle ] || {
    tail "$slurm"/*.log >&2
    return 1
  }
  # Some fail, as they should; the script exits with the worst exit code.
  sbatch --wait --array=1-7:2 --output="$work/slurm-%a.log" "$here/slurm_array.sh" campaign.yaml || true
  cat "$work"/slurm-*.log
  judge "Slurm $(slurmctld -V | cut -d' ' -f2), an array of 4"
}

try_parallel() {
  command -v parallel >/dev/null || missing parallel "GNU parallel"
  status=0
  SHARDS=6 JOBS=2 PARALLEL_FLAGS=--will-cite "$here/gnu_parallel.sh" campaign.yaml >"$work/parallel.log" || status=$?
  [ $status -gt 0 ]  # shards in which something failed
  judge "GNU parallel, 6 shards"
}

# commands FILE PYTHON: prints the commands of a file's jobs, one a line; `file` is the parsed file.
commands() { python3 -c 'import sys, yaml
file = yaml.safe_load(open(sys.argv[1]))
for script in '"$2"': print(script)' "$1"; }

try_gitlab() {
  local i
  python3 -c 'import yaml' 2>/dev/null || missing gitlab python3-yaml
  export CI_NODE_TOTAL=8
  commands "$here/gitlab.yml" 'file["campaign"]["script"]' >"$work/script"
  for i in $(seq "$CI_NODE_TOTAL"); do CI_NODE_INDEX=$i bash -e "$work/script" >/dev/null || [ $? -eq 1 ]; done
  commands "$here/gitlab.yml" 'file["campaign results"]["script"]' >"$work/script"
  bash -e "$work/script" || [ $? -eq 1 ]
  [ -s all.sqlite ]
  judge "GitLab's commands, 8 nodes"
}

try_github() {
  local i
  python3 -c 'import yaml' 2>/dev/null || missing github python3-yaml
  commands "$here/github.yml" '[s["run"] for s in file["jobs"]["campaign"]["steps"] if s.get("name") == "Shard"]' \
    >"$work/script"
  for i in 1 2 3 4 5 6 7 8; do
    sed "s/\${{ matrix.shard }}/$i/g" "$work/script" | bash -e >/dev/null || [ $? -eq 1 ]
  done
  commands "$here/github.yml" '[s["run"] for s in file["jobs"]["results"]["steps"] if s.get("name") == "Merge"]' \
    >"$work/script"
  bash -e "$work/script" || [ $? -eq 1 ]
  [ -s all.sqlite ]
  judge "GitHub's commands, a matrix of 8"
}

for recipe in "${recipes[@]}"; do "try_$recipe"; done
