#!/usr/bin/env bash
# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#
# Drives robots of `playpen serve` with Player clients in Java, Ruby and Python.
set -euo pipefail

usage() {
  cat <<'TEXT'
Usage: tests/interop/other_languages.sh --playpen COMMAND [--java DIR] [--ruby DIR] [--python DIR]

  --playpen COMMAND  the command playpen
  --java DIR    JavaClient 3: the folder that contains the folder javaclient3 with its sources
  --ruby DIR    ruby-player: the folder lib of its sources (github.com/atimin/ruby-player); it needs
                the gem isna
  --python DIR  the folder of playerc.py and _playerc.so, the SWIG binding of Player's C library
                (Player's build makes it with -DBUILD_PYTHONC_BINDINGS=ON and SWIG). With Python 3,
                replace PyBuffer_FromMemory(p, n) in the generated playercPYTHON_wrap.c by
                PyMemoryView_FromMemory((char*)(p), n, PyBUF_READ)
TEXT
}

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
playpen=
java=
ruby=
python=
while (($# > 0)); do
  case $1 in
    --help | -h)
      usage
      exit 0
      ;;
    --playpen) playpen=${2:?--playpen needs a command} ;;
    --java) java=${2:?--java needs a folder} ;;
    --ruby) ruby=${2:?--ruby needs a folder} ;;
    --python) python=${2:?--python needs a folder} ;;
    *)
      usage >&2
      printf 'other_languages: unknown argument: %s\n' "$1" >&2
      exit 2
      ;;
  esac
  shift 2
done
if [[ -z $playpen ]]; then
  usage >&2
  echo 'other_languages: --playpen is missing' >&2
  exit 2
fi

work=$(mktemp -d)
server=
stop_server() {
  [[ -n $server ]] || return 0
  kill "$server" 2>/dev/null || true
  wait "$server" 2>/dev/null || true
  server=
}
trap 'stop_server; rm -rf "$work"' EXIT

# serve: starts a server of the cave on a free port, and sets `port`.
serve() {
  stop_server
  "$playpen" serve "$here/../../worlds/cave.json" --time lockstep --tcp-port 0 --player-port 0 \
    --out "$work/serve" >"$work/serve.log" 2>&1 &
  server=$!
  local try
  for ((try = 0; try < 100; ++try)); do
    port=$(sed -n "s/^Player's protocol on 127.0.0.1:\([0-9]*\): pioneer1$/\1/p" "$work/serve.log")
    if [[ -n $port ]]; then return; fi
    sleep 0.1
  done
  cat "$work/serve.log" >&2
  echo 'other_languages: the server does not listen' >&2
  exit 1
}

if [[ -n $java ]]; then
  serve
  echo '== Java'
  find "$java/javaclient3" -name '*.java' >"$work/sources"
  javac -nowarn -encoding ISO-8859-1 -d "$work" "@$work/sources" "$here/Drive.java"
  timeout 60 java -cp "$work" Drive 127.0.0.1 "$port"
fi
if [[ -n $ruby ]]; then
  serve
  echo '== Ruby'
  timeout 60 ruby -I "$ruby" "$here/drive.rb" 127.0.0.1 "$port"
fi
if [[ -n $python ]]; then
  serve
  echo '== Python'
  PYTHONPATH=$python timeout 60 python3 "$here/drive.py" 127.0.0.1 "$port"
fi
