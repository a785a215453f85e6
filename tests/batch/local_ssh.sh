#!/usr/bin/env bash
# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#
# Runs an ssh server of this machine for GNU parallel. See usage().
set -euo pipefail

usage() {
  cat <<'TEXT'
Usage: tests/batch/local_ssh.sh start DIR
       tests/batch/local_ssh.sh stop DIR

Runs an sshd for the current user on a free port of 127.0.0.1. It lets in this user only, with a key in DIR.
~/.ssh is neither read nor written. Nothing outside DIR changes, except that root gets the folder /run/sshd, without
which sshd does not start. Needs the package openssh-server.

  start  starts sshd, waits until a login works, and prints a variable for the shell: ssh_login is an argument for
         parallel's --sshlogin. The file DIR/sshlogins has the same line, for parallel's --sshloginfile:
           eval "$(tests/batch/local_ssh.sh start /tmp/ssh)"
           parallel --sshlogin "$ssh_login" echo ::: 1 2 3
  stop   ends sshd and its connections. The files stay
TEXT
}

fail() {
  printf 'local_ssh: %s\n' "$@" >&2
  exit 1
}

# Debian has sshd in /usr/sbin, which is not in the PATH of ordinary users. sshd wants to be called by its path.
PATH=$PATH:/usr/sbin:/sbin

case ${1:-} in
  --help | -h)
    usage
    exit 0
    ;;
  start | stop) ;;
  *)
    usage >&2
    exit 2
    ;;
esac
if (($# != 2)) || [[ $2 == -* ]]; then
  usage >&2
  exit 2
fi
if [[ $1 == start ]]; then
  mkdir -p -- "$2"
elif [[ ! -e $2/sshd_config ]]; then
  fail "$2 has no sshd_config: no server was started there"
fi
folder=$(cd -- "$2" && pwd -P)

# server_pid: prints sshd's process id if it runs. The file may have survived its process.
server_pid() {
  local pid
  pid=$(cat "$folder/sshd.pid" 2>/dev/null) || return 1
  [[ -n $pid ]] && tr '\0' ' ' 2>/dev/null <"/proc/$pid/cmdline" | grep -qF "$folder/sshd_config" || return 1
  printf '%s\n' "$pid"
}

fail_with_log() {
  tail -n 20 "$folder/sshd.out" "$folder/sshd.log" >&2 || true
  fail "$@"
}

# free_port: prints a port of 127.0.0.1 at which nobody listens, below those that the system hands out.
free_port() {
  local port try
  for ((try = 0; try < 1000; ++try)); do
    port=$((20000 + (RANDOM * 32768 + RANDOM) % 12000))
    (exec 3<>"/dev/tcp/127.0.0.1/$port") 2>/dev/null && continue
    printf '%s\n' "$port"
    return
  done
  fail 'found no free port between 20000 and 32000'
}

# write_settings PORT: StrictModes=no, since folders above DIR may be writable for others.
write_settings() {
  cat >"$folder/sshd_config" <<TEXT
# Made by tests/batch/local_ssh.sh.
Port $1
ListenAddress 127.0.0.1
HostKey $folder/host_key
PidFile $folder/sshd.pid
AuthorizedKeysFile $folder/authorized_keys
AuthenticationMethods publickey
PermitRootLogin prohibit-password
AllowUsers $user
UsePAM no
StrictModes no
PrintMotd no
PrintLastLog no
PermitUserRC no
MaxStartups 100
MaxSessions 100
TEXT
  cat >"$folder/ssh_config" <<TEXT
# Made by tests/batch/local_ssh.sh.
Host *
  HostName 127.0.0.1
  Port $1
  User $user
  IdentityFile $folder/key
  IdentitiesOnly yes
  IdentityAgent none
  UserKnownHostsFile $folder/known_hosts
  GlobalKnownHostsFile /dev/null
  BatchMode yes
  ConnectTimeout 10
TEXT
  printf '[127.0.0.1]:%s %s\n' "$1" "$(<"$folder/host_key.pub")" >"$folder/known_hosts"
}

login_works() { ssh -F "$folder/ssh_config" 127.0.0.1 true 2>"$folder/ssh.log" </dev/null; }

start_server() {
  local needed server try
  for needed in sshd ssh ssh-keygen; do
    [[ -n $(command -v "$needed") ]] || fail "$needed is missing: apt-get install openssh-server openssh-client"
  done
  server=$(command -v sshd)
  # GNU parallel splits the login at blanks and commas.
  [[ $folder =~ ^[A-Za-z0-9/._+-]+$ ]] ||
    fail "$folder has characters that a login cannot hold: use letters, digits and /._+-"
  if [[ -e $folder/sshd_config ]]; then
    if server_pid >/dev/null; then fail "the sshd of $folder runs already: stop it first"; fi
    rm -f -- "$folder"/{host_key,key}{,.pub} "$folder"/{sshd.log,sshd.pid}
  fi
  user=$(id -un) || fail "the user $(id -u) has no name, but sshd needs it"
  ssh-keygen -q -t ed25519 -N '' -C local_ssh_host -f "$folder/host_key"
  ssh-keygen -q -t ed25519 -N '' -C local_ssh_user -f "$folder/key"
  cp "$folder/key.pub" "$folder/authorized_keys"
  write_settings "$(free_port)"
  # Otherwise systemd makes this folder.
  if ((EUID == 0)); then mkdir -p /run/sshd; fi
  "$server" -f "$folder/sshd_config" -E "$folder/sshd.log" </dev/null >"$folder/sshd.out" 2>&1 ||
    fail_with_log 'sshd does not start'
  trap 'if (($? > 0)); then stop_server; fi' EXIT
  for ((try = 0; try < 100; ++try)); do
    if login_works; then break; fi
    sleep 0.1
  done
  ((try < 100)) || fail_with_log "no login works after 10 s: $(<"$folder/ssh.log")"
  printf 'ssh -F %s 127.0.0.1\n' "$folder/ssh_config" >"$folder/sshlogins"
  printf 'export ssh_login=%q\n' "$(<"$folder/sshlogins")"
}

stop_server() {
  local pid child try
  pid=$(server_pid) || return 0
  for child in $(ps -o pid= --ppid "$pid"); do kill "$child" 2>/dev/null || true; done
  kill "$pid" 2>/dev/null || true
  for ((try = 0; try < 100; ++try)); do
    [[ -e /proc/$pid && $(ps -o stat= -p "$pid") != Z* ]] || return 0
    sleep 0.1
  done
  fail "sshd ($pid) is still there 10 s after SIGTERM"
}

case $1 in
  start) start_server ;;
  stop) stop_server ;;
esac
