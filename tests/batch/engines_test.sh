#!/usr/bin/env bash
# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#
# Runs a batch by its engines and compares the results. See usage().
set -euo pipefail

usage() {
  cat <<'TEXT'
Usage: tests/batch/engines_test.sh PLAYPEN PROGRAM DIR [RUNS]

Runs a batch of RUNS runs [500] of a client program here, by Slurm and by GNU parallel, and compares the results:
they must be equal but for wall times. On the way, Slurm's node is killed twice, once with its jobs, and processes of
the batch are killed by SIGKILL; units are lost by none of it. DIR is emptied first.
Exits with 77 if Slurm, munge, GNU parallel or sshd is not installed.
TEXT
}
if (($# < 3 || $# > 4)) || [[ $1 == -* ]]; then
  usage >&2
  exit 2
fi

PATH=$PATH:/usr/sbin:/sbin
for command in sbatch slurmd munged parallel sshd; do
  if ! command -v "$command" >/dev/null; then
    echo "engines_test: $command is not installed: apps/install_dependencies.sh cluster"
    exit 77
  fi
done

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
playpen=$(readlink -f "$1")
program=$(readlink -f "$2")
runs=${4:-500}
rm -rf "$3"
mkdir -p "$3"
folder=$(cd "$3" && pwd -P)
cd "$folder"

fail() {
  printf 'engines_test: %s\n' "$@" >&2
  exit 1
}

stop_all() {
  "$here/one_node.sh" stop "$folder/cluster" || true
  "$here/local_ssh.sh" stop "$folder/ssh" || true
}
trap stop_all EXIT

# Two conditions, and a program that fails beside the one that does not.
cat >plan.json <<TEXT
{
  "programs": ["$program", {"name": "none", "command": ["/bin/false"]}],
  "worlds": ["par_intro"],
  "duration": 5,
  "seeds": $(((runs + 3) / 4)),
  "parameters": {"/robots/0/pose/x": [0.5, 0.55]}
}
TEXT

# ended OUT: the number of units with results.
ended() { find "$1/units" -mindepth 2 -maxdepth 2 -name unit.json 2>/dev/null | grep -c '' || true; }

# wait_for_units OUT COUNT
wait_for_units() {
  local try
  for ((try = 0; try < 3000; ++try)); do
    if (($(ended "$1") >= $2)); then return; fi
    sleep 0.1
  done
  fail "$1: only $(ended "$1") of $2 units have results after 300 s"
}

# without_times FILE: a result without its wall times.
without_times() {
  case $1 in
    *.json) sed '/"wall_time"/d' "$1" ;;
    *) sed 's/,[^,]*\r$//' "$1" ;;
  esac
}

# compare OUT: with the results of the local engine.
compare() {
  local file
  for file in batch.json results.csv; do
    cmp <(without_times "local/$file") <(without_times "$1/$file") || fail "$1/$file differs from local/$file"
  done
  cmp local/statistics.csv "$1/statistics.csv" || fail "$1/statistics.csv differs"
  [[ ! -e $1/work ]] || fail "$1/work is left over: $(ls "$1/work")"
}

# as_usual COMMAND...: fails unless all runs have results. Runs that have not passed are no failure.
as_usual() { "$@" >"$folder/said" 2>&1 || fail "$*: status $?" "$(cat "$folder/said")"; }

first_second=$SECONDS
report() {
  printf '%-9s %s runs in %s s%s\n' "$1" "$(ended "$1")" "$((SECONDS - first_second))" "${2:-}"
  first_second=$SECONDS
}

as_usual "$playpen" batch plan.json --out local
report local

settings=$("$here/one_node.sh" start "$folder/cluster" 2)
eval "$settings"
as_usual "$playpen" batch plan.json --out slurm --engine slurm --parts 20
wait_for_units slurm "$((runs / 10))"
"$here/one_node.sh" kill-node "$folder/cluster"
"$here/one_node.sh" start-node "$folder/cluster"
wait_for_units slurm "$((runs / 4))"
"$here/one_node.sh" kill-node "$folder/cluster" --with-jobs
"$here/one_node.sh" start-node "$folder/cluster"
# Units are doubled: a second submission while the first one runs.
as_usual "$playpen" batch plan.json --out slurm --engine slurm --parts 20 --wait
for ((try = 0; try < 3000; ++try)); do
  [[ -n $(squeue -h) ]] || break
  sleep 0.1
done
as_usual "$playpen" batch --out slurm --collect
compare slurm
report slurm

eval "$("$here/local_ssh.sh" start "$folder/ssh")"
login=2/${ssh_login:?}
"$playpen" batch plan.json --out parallel --engine parallel --parts 20 \
  "--engine-option=--sshlogin=$login" >said 2>&1 &
batch=$!
wait_for_units parallel "$((runs / 10))"
# One of the workers; parallel tries its part again.
for ((try = 0; try < 300; ++try)); do
  worker=$(pgrep -f -- "^$playpen batch --out $folder/parallel --part" | head -n 1 || true)
  if [[ -n $worker ]] && kill -KILL "$worker"; then break; fi
  sleep 0.02
done
((try < 300)) || fail 'no worker is running'
wait_for_units parallel "$((runs / 4))"
kill -KILL "$batch"
{ wait "$batch" || true; } 2>/dev/null
as_usual "$playpen" batch plan.json --out parallel --engine parallel --parts 20 \
  "--engine-option=--sshlogin=$login"
compare parallel
report parallel

trap - EXIT
stop_all
