#!/usr/bin/env bash
# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#
# Runs a Slurm cluster that consists of this machine only. See usage().
set -euo pipefail

usage() {
  cat <<'TEXT'
Usage: tests/batch/one_node.sh start DIR [CPUS]
       tests/batch/one_node.sh kill-node DIR [--with-jobs]
       tests/batch/one_node.sh start-node DIR
       tests/batch/one_node.sh stop DIR

Runs a Slurm cluster with one node, this machine, for the current user. It needs neither systemd nor cgroups
nor rights, uses free ports and changes nothing outside DIR. DIR gets a munge key, slurm.conf, sockets and logs.
Needs the packages slurm-wlm and munge.

  start       starts munged, slurmctld and slurmd, waits until the node is idle, and prints the variables that
              Slurm's commands need. CPUS is how many the node claims to have [those of this machine]:
                eval "$(tests/batch/one_node.sh start /tmp/slurm 4)"
  kill-node   ends slurmd by SIGKILL. Its jobs go on, as they do on a real node. If slurmd is not started again
              within 10 s, Slurm gives the node up and requeues them. With --with-jobs they are killed and requeued
              at once, as if the node had lost its power. A requeued job waits for 10 s
  start-node  starts slurmd again, and waits until slurmctld has heard of it
  stop        cancels all jobs and ends all processes. The files stay
TEXT
}

fail() {
  printf 'one_node: %s\n' "$@" >&2
  exit 1
}

# Debian has the daemons in /usr/sbin, which is not in the PATH of ordinary users.
PATH=$PATH:/usr/sbin:/sbin

case ${1:-} in
  --help | -h)
    usage
    exit 0
    ;;
  start | kill-node) most=3 ;;
  start-node | stop) most=2 ;;
  *)
    usage >&2
    exit 2
    ;;
esac
command=$1
if (($# < 2 || $# > most)) || [[ $2 == -* ]]; then
  usage >&2
  exit 2
fi

if [[ $command == start ]]; then
  mkdir -p -- "$2"
elif [[ ! -e $2/slurm.conf ]]; then
  fail "$2 has no slurm.conf: no cluster was started there"
fi
folder=$(cd -- "$2" && pwd -P)
export SLURM_CONF=$folder/slurm.conf

# show_logs: the ends of all logs, on standard error.
show_logs() {
  local log
  for log in "$folder"/log/*; do
    [[ -s $log ]] || continue
    printf -- '--- the end of %s\n' "$log"
    tail -n 15 -- "$log"
  done >&2
}

# fail_with_logs TEXT...
fail_with_logs() {
  show_logs
  fail "$@"
}

# pid_of DAEMON: prints its process id if it runs. A file may have survived its process.
pid_of() {
  local pid
  pid=$(cat "$folder/run/$1.pid" 2>/dev/null) || return 1
  [[ -n $pid && $(cat "/proc/$pid/comm" 2>/dev/null) == "$1" ]] || return 1
  tr '\0' '\n' <"/proc/$pid/environ" 2>/dev/null | grep -qxF "SLURM_CONF=$SLURM_CONF" || return 1
  printf '%s\n' "$pid"
}

# step_pids: the process ids of the steps (slurmstepd) of this cluster, which do not end with slurmd. They write over
# their environment, but hold slurmd's log open.
step_pids() {
  local process
  for process in /proc/[0-9]*; do
    [[ $(cat "$process/comm" 2>/dev/null) == slurmstepd ]] || continue
    if [[ -n $(find "$process/fd" -lname "$folder/log/slurmd.log" 2>/dev/null) ]]; then
      printf '%s\n' "${process#/proc/}"
    fi
  done
}

# descendants PID: prints the process ids of its children, their children and so on.
descendants() {
  local child
  for child in $(ps -o pid= --ppid "$1"); do
    printf '%s\n' "$child"
    descendants "$child"
  done
}

# kill_steps: ends all steps and what they run.
kill_steps() {
  local step pids=()
  for step in $(step_pids); do
    mapfile -t -O "${#pids[@]}" pids < <(descendants "$step")
    pids+=("$step")
  done
  if ((${#pids[@]} > 0)); then kill -KILL "${pids[@]}" 2>/dev/null || true; fi
}

# until_true SECONDS COMMAND...: looks ten times a second.
until_true() {
  local try
  for ((try = 0; try < 10 * $1; ++try)); do
    if "${@:2}"; then return 0; fi
    sleep 0.1
  done
  return 1
}

# free_ports COUNT: prints ports of 127.0.0.1 at which nobody listens, below those that the system hands out.
free_ports() {
  local found=0 port try
  for ((try = 0; try < 1000 && found < $1; ++try)); do
    port=$((20000 + (RANDOM * 32768 + RANDOM) % 6000 * 2 + found))
    (exec 3<>"/dev/tcp/127.0.0.1/$port") 2>/dev/null && continue
    printf '%s\n' "$port"
    found=$((found + 1))
  done
}

# write_settings CPUS
write_settings() {
  local host user ports
  host=$(uname -n)
  host=${host%%.*}
  user=$(id -un) || fail "the user $(id -u) has no name, but slurm.conf needs it"
  mapfile -t ports < <(free_ports 2)
  ((${#ports[@]} == 2)) || fail 'found no free ports between 20000 and 32000'
  # A requeued job waits cred_expire seconds. config_overrides: the node may claim more CPUs than there are.
  cat >"$SLURM_CONF" <<TEXT
# Made by tests/batch/one_node.sh.
ClusterName=playpen
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=${ports[0]}
SlurmdPort=${ports[1]}
SlurmUser=$user
SlurmdUser=$user
AuthType=auth/munge
AuthInfo=socket=$folder/run/munge.socket,cred_expire=10
CredType=cred/munge
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool
SlurmctldPidFile=$folder/run/slurmctld.pid
SlurmdPidFile=$folder/run/slurmd.pid
SlurmctldLogFile=$folder/log/slurmctld.log
SlurmdLogFile=$folder/log/slurmd.log
CommunicationParameters=NoInAddrAny,NoCtldInAddrAny
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerParameters=batch_sched_delay=0,sched_min_interval=0,bf_interval=2
JobAcctGatherType=jobacct_gather/none
MailProg=/bin/true
ReturnToService=2
SlurmdTimeout=10
SlurmctldTimeout=10
KillWait=2
MaxJobCount=20000
MaxArraySize=10001
SlurmdParameters=config_overrides
NodeName=node NodeHostname=$host NodeAddr=127.0.0.1 CPUs=$1 State=UNKNOWN
PartitionName=main Nodes=node Default=YES MaxTime=INFINITE State=UP
TEXT
}

# run_daemon COMMAND...: starts a program that detaches itself. It must not hold the caller's output open.
run_daemon() {
  "$@" </dev/null >>"$folder/log/$1.out" 2>&1 || fail_with_logs "$1 does not start"
}

node_is_idle() { [[ $(sinfo --noheader --format=%T 2>/dev/null) == idle ]]; }

# A state with a suffix, such as "idle*", is one of a node that does not answer.
node_is_up() { [[ $(sinfo --noheader --format=%T 2>/dev/null) =~ ^(idle|mixed|allocated|completing)$ ]]; }

start_cluster() {
  local needed entries
  for needed in munged slurmctld slurmd sinfo scancel scontrol; do
    [[ -n $(command -v "$needed") ]] || fail "$needed is missing: apt-get install slurm-wlm munge"
  done
  [[ $folder =~ ^[A-Za-z0-9/._+-]+$ ]] ||
    fail "$folder has characters that slurm.conf cannot hold: use letters, digits and /._+-"
  # An address of a socket has at most 107 bytes.
  ((${#folder} <= 80)) || fail "$folder is too long for the name of a socket: use at most 80 characters"
  [[ $1 =~ ^[1-9][0-9]{0,3}$ ]] || fail "CPUS is '$1', but must be a number from 1 to 9999"
  shopt -s nullglob dotglob
  entries=("$folder"/*)
  shopt -u nullglob dotglob
  if [[ -e $SLURM_CONF ]]; then
    grep -qxF '# Made by tests/batch/one_node.sh.' "$SLURM_CONF" || fail "$SLURM_CONF is not one of this script"
    for needed in munged slurmctld slurmd; do
      if pid_of "$needed" >/dev/null; then fail "$needed of $folder runs already: stop it first"; fi
    done
    rm -rf -- "$folder"/{run,log,state,spool,munge}
  elif ((${#entries[@]} > 0)); then
    fail "$folder is neither empty nor one of this script"
  fi
  chmod go-w "$folder"
  mkdir -p "$folder"/{run,log,state,spool,munge}
  chmod 755 "$folder"/{run,log,state,spool}
  chmod 700 "$folder/munge"
  (umask 077 && head -c 128 /dev/urandom >"$folder/munge/key")
  write_settings "$1"

  trap 'if (($? > 0)); then stop_cluster; fi' EXIT
  # --force: folders above DIR may be writable for others, or not be readable by them.
  run_daemon munged --force --key-file="$folder/munge/key" --seed-file="$folder/munge/seed" \
    --socket="$folder/run/munge.socket" --pid-file="$folder/run/munged.pid" --log-file="$folder/log/munged.log"
  run_daemon slurmctld
  run_daemon slurmd
  until_true 60 node_is_idle ||
    fail_with_logs "the node is not idle after 60 s, but: $(sinfo --noheader --format='%T, %E' 2>&1 || true)"
  printf 'export SLURM_CONF=%q\n' "$SLURM_CONF"
}

kill_node() {
  local pid
  case ${1:-} in
    '' | --with-jobs) ;;
    *) fail "unknown argument: $1" ;;
  esac
  pid=$(pid_of slurmd) || fail "slurmd of $folder does not run"
  kill -KILL "$pid"
  until_true 10 dead "$pid" || fail "slurmd ($pid) is still there 10 s after SIGKILL"
  rm -f "$folder/run/slurmd.pid"
  if [[ ${1:-} == --with-jobs ]]; then
    kill_steps
    # slurmctld would find out by itself, but that takes up to a minute if slurmd is soon started again.
    if pid_of slurmctld >/dev/null; then
      scontrol update NodeName=node State=DOWN Reason='killed by one_node.sh' || fail_with_logs 'scontrol fails'
    fi
  fi
}

# dead PID: true also for a zombie, whose parent may never ask for it.
dead() { [[ ! -e /proc/$1 || $(ps -o stat= -p "$1") == Z* ]]; }

start_node() {
  if pid_of slurmd >/dev/null; then fail "slurmd of $folder runs already"; fi
  run_daemon slurmd
  until_true 60 node_is_up ||
    fail_with_logs "the node is not up after 60 s, but: $(sinfo --noheader --format='%T, %E' 2>&1 || true)"
}

no_steps() { [[ -z $(step_pids) ]]; }

stop_cluster() {
  local daemon pid
  if pid_of slurmctld >/dev/null && pid_of slurmd >/dev/null; then
    timeout 10 scancel --user="$(id -un)" 2>/dev/null || true
    until_true 10 no_steps || true
  fi
  for daemon in slurmctld slurmd munged; do
    pid=$(pid_of "$daemon") || continue
    kill "$pid" 2>/dev/null || true
    if ! until_true 10 dead "$pid"; then
      kill -KILL "$pid" 2>/dev/null || true
      until_true 10 dead "$pid" || fail "$daemon ($pid) is still there 10 s after SIGKILL"
    fi
  done
  kill_steps
}

case $command in
  start) start_cluster "${3:-$(nproc)}" ;;
  kill-node) kill_node "${3:-}" ;;
  start-node) start_node ;;
  stop) stop_cluster ;;
esac
