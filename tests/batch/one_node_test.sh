#!/usr/bin/env bash
# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#
# Runs job arrays on the cluster of one_node.sh. See usage().
set -euo pipefail

usage() {
  cat <<'TEXT'
Usage: tests/batch/one_node_test.sh DIR

Starts a Slurm cluster in DIR, which must be empty or not exist, and runs arrays of 20 jobs there: undisturbed;
with slurmd killed in the middle and started again; and the same with the jobs killed too. Each job must have run
to its end. Then it stops the cluster, and no process may be left. Works for root and for ordinary users.
TEXT
}
if (($# != 1)) || [[ $1 == -* ]]; then
  usage >&2
  exit 2
fi

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
cluster=$here/one_node.sh
fail() {
  printf 'one_node_test: %s\n' "$@" >&2
  exit 1
}

settings=$("$cluster" start "$1" 4)
eval "$settings"
trap '"$cluster" stop "$folder" || true' EXIT
folder=$(cd "$1" && pwd -P)

# submit NAME: an array of 20 jobs of about a second. Each notes its number before and after.
submit() {
  mkdir "$folder/$1"
  cat >"$folder/$1/job.sh" <<'TEXT'
#!/bin/sh
echo "$SLURM_ARRAY_TASK_ID" >>begun
sleep "0.$((5 + SLURM_ARRAY_TASK_ID % 4))"
echo "$SLURM_ARRAY_TASK_ID" >>ended
TEXT
  sbatch --quiet --array=0-19 --requeue --output="$folder/$1/log_%a" --open-mode=append \
    --chdir="$folder/$1" "$folder/$1/job.sh"
}

# begun NAME: how many jobs have begun, counting each attempt.
begun() { grep -c '' "$folder/$1/begun" 2>/dev/null || true; }

# ended NAME: how many jobs have ended.
ended() { sort -u "$folder/$1/ended" 2>/dev/null | grep -c '' || true; }

# wait_for NAME COUNT: until COUNT jobs have ended.
wait_for() {
  local try
  for ((try = 0; try < 1200; ++try)); do
    if (($(ended "$1") >= $2)); then return; fi
    sleep 0.1
  done
  squeue >&2
  fail "$1: only $(ended "$1") of $2 jobs have ended after 120 s"
}

# wait_for_middle NAME: until 5 jobs have ended and others run.
wait_for_middle() {
  local try
  wait_for "$1" 5
  for ((try = 0; try < 1200; ++try)); do
    if (($(begun "$1") >= $(ended "$1") + 2)); then return; fi
    sleep 0.1
  done
  fail "$1: no two jobs run side by side"
}

# report NAME
report() {
  wait_for "$1" 20
  printf '%-28s 20 of 20 jobs ended after %s s, %s were begun\n' "$1" "$((SECONDS - first_second))" "$(begun "$1")"
}

first_second=$SECONDS
submit undisturbed
report undisturbed

first_second=$SECONDS
submit node_killed
wait_for_middle node_killed
"$cluster" kill-node "$folder"
"$cluster" start-node "$folder"
report node_killed

first_second=$SECONDS
submit jobs_killed
wait_for_middle jobs_killed
"$cluster" kill-node "$folder" --with-jobs
"$cluster" start-node "$folder"
report jobs_killed
(($(begun jobs_killed) > 20)) || fail 'jobs_killed: no job was begun again'

trap - EXIT
"$cluster" stop "$folder"
left=$(find /proc/[0-9]*/fd -lname "$folder/*" 2>/dev/null || true)
[[ -z $left ]] || fail 'these processes have not ended:' "$left"
