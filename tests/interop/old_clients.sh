#!/usr/bin/env bash
# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#
# Runs the real Player's programs against `playpen serve`, and tells for each what it said.
set -euo pipefail

usage() {
  cat <<'TEXT'
Usage: tests/interop/old_clients.sh --prefix DIR --playpen COMMAND [--out DIR] [--port PORT]

Starts `playpen serve` and runs against it, from the real Player that build_peers.sh has installed:
playerprint for each interface, Player's tests of its C++ library, a program that measures how many
rounds it reads a second, and playerv, of which it makes a picture under Xvfb.

  --prefix DIR       as for build_peers.sh
  --playpen COMMAND  the command playpen
  --out DIR          where the outputs and the picture go (default: ./interop)
  --port PORT        first Player port of the server (default: 16665)
TEXT
}

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$here/../.." && pwd)
prefix=
playpen=
out=interop
port=16665
while (($# > 0)); do
  case $1 in
    --help | -h)
      usage
      exit 0
      ;;
    --prefix) prefix=${2:?--prefix needs a folder} ;;
    --playpen) playpen=${2:?--playpen needs a command} ;;
    --out) out=${2:?--out needs a folder} ;;
    --port) port=${2:?--port needs a number} ;;
    *)
      usage >&2
      printf 'old_clients: unknown argument: %s\n' "$1" >&2
      exit 2
      ;;
  esac
  shift 2
done
if [[ -z $prefix || -z $playpen ]]; then
  usage >&2
  echo 'old_clients: --prefix and --playpen are needed' >&2
  exit 2
fi
mkdir -p "$out"
out=$(cd "$out" && pwd)
prefix=$(cd "$prefix" && pwd)

server=
stop_server() {
  [[ -n $server ]] || return 0
  kill "$server" 2>/dev/null || true
  wait "$server" 2>/dev/null || true
  server=
}
trap stop_server EXIT

# serve WORLD TIME: starts the server and waits until it listens.
serve() {
  stop_server
  "$playpen" serve "$root/worlds/$1" --time "$2" --tcp-port 0 --player-port "$port" \
    --out "$out/serve" >"$out/serve.log" 2>&1 &
  server=$!
  local try
  for ((try = 0; try < 100; ++try)); do
    if grep -q "127.0.0.1:$port:" "$out/serve.log"; then return; fi
    sleep 0.1
  done
  cat "$out/serve.log" >&2
  echo 'old_clients: the server does not listen' >&2
  exit 1
}

# row NAME VERDICT TEXT
row() { printf '%-24s %-8s %s\n' "$1" "$2" "$3"; }

# print INTERFACE: shows three readings of a device.
print() {
  local log=$out/playerprint_$1.txt
  timeout 20 "$prefix/bin/playerprint" -h 127.0.0.1 -p "$port" -c 3 "$1" >"$log" 2>&1 || true
  # Its warning about the connection is not data.
  if grep -v 'playerc warning' "$log" | grep -qE '[0-9]' && ! grep -q 'Error thrown' "$log"; then
    row "playerprint $1" ok "$(grep -c '' "$log") lines"
  else
    row "playerprint $1" FAILED "$(tail -n 1 "$log")"
  fi
}

serve cave.json lockstep
for interface in position2d laser ranger sonar gps fiducial power bumper ir imu gripper ptz \
  blobfinder aio dio wifi localize camera; do
  print "$interface"
done

for interface in position2d laser ranger sonar power dio aio ptz gripper camera speech; do
  log=$out/playercpp_test_$interface.txt
  # The test of the camera writes its pictures into the current folder.
  if (cd "$out" && timeout 60 "$prefix/bin/playercpp_test" -h 127.0.0.1 -p "$port" \
    "--$interface") >"$log" 2>&1 && ! grep -qi 'fail' "$log"; then
    row "playercpp_test $interface" ok "$(grep -ciE 'PASS' "$log" || true) steps passed"
  else
    row "playercpp_test $interface" FAILED "$(grep -i 'fail' "$log" | head -n 1 || true)"
  fi
done

export PKG_CONFIG_PATH=$prefix/lib/pkgconfig:$prefix/lib64/pkgconfig
read -ra client_flags <<<"$(pkg-config --cflags --libs playerc++)"
g++ -std=gnu++14 -O2 -fpermissive -w "$here/read_rate.cc" -o "$out/read_rate" "${client_flags[@]}" \
  -Wl,-rpath,"$prefix/lib"
row read_rate ok "$("$out/read_rate" 127.0.0.1 "$port")"

# playerv has no size of its own, and there is no window manager to give it one.
serve cave.json real
display=:97
Xvfb "$display" -screen 0 800x600x24 >"$out/xvfb.log" 2>&1 &
x_server=$!
sleep 1
export DISPLAY=$display
"$prefix/bin/playerv" -h 127.0.0.1 -p "$port" --position2d:0 --laser:0 --sonar:0 \
  >"$out/playerv.txt" 2>&1 &
viewer=$!
window=$(timeout 20 xdotool search --sync --onlyvisible --name playerv | tail -n 1 || true)
if [[ -n $window ]]; then xdotool windowmove "$window" 0 0 windowsize "$window" 800 600; fi
sleep 4
if ffmpeg -y -loglevel error -f x11grab -draw_mouse 0 -video_size 800x600 -i "$display" -frames:v 1 \
  "$out/playerv.png"; then
  row playerv ok "$out/playerv.png"
else
  row playerv FAILED 'no picture'
fi
kill "$viewer" "$x_server" 2>/dev/null || true
