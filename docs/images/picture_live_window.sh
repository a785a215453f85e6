#!/usr/bin/env bash
# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#
# Takes the picture of the live window, on a display without a screen. make_pictures.sh runs it.
# Usage: picture_live_window.sh PLAYPEN WORLD OUTPUT_FOLDER PICTURE.png PROGRAM
set -euo pipefail
playpen=$1 world=$2 out=$3 picture=$4 program=$5
for tool in Xvfb xdotool import; do
  if ! command -v "$tool" >/dev/null; then
    echo "$0: $tool is missing (packages xvfb, xdotool, imagemagick)" >&2
    exit 1
  fi
done

folder=$(mktemp -d)
mkfifo "$folder/number"
Xvfb -displayfd 1 -screen 0 1000x1064x24 -nolisten tcp >"$folder/number" 2>/dev/null &
server=$!
trap 'kill "$server" 2>/dev/null; rm -rf "$folder"' EXIT
read -r number <"$folder/number"
export DISPLAY=:$number

"$playpen" run "$world" --view --time 4 --seed 1 --quiet --out "$out" -- "$program" &
run=$!
# Until the window is there; the pointer over it gives it the keyboard.
window=$(xdotool search --sync --onlyvisible --name '^Playpen: ' | head -n 1)
xdotool mousemove 400 400
sleep 3
xdotool key Tab
xdotool key Tab
sleep 0.5
import -window "$window" "$folder/window.png"
xdotool key q
wait "$run"
# Few colours are enough, and half the bytes.
convert "$folder/window.png" -strip +dither -colors 200 "$picture"
