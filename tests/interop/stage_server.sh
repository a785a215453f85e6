# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
# shellcheck shell=bash disable=SC2154
#
# For scripts that source it: starts and stops the real Player server with Stage under Xvfb. They set
# prefix (where both are installed), worlds (Stage's folder of worlds), out and port.
stage_pids=()

stop_stage() {
  local pid
  for pid in "${stage_pids[@]}"; do
    kill "$pid" 2>/dev/null || true
    wait "$pid" 2>/dev/null || true
  done
  stage_pids=()
}

# start_stage WORLD CFG: in a folder with Stage's pictures and includes. PORT1, PORT2, ... in the .cfg
# become the ports after the first.
start_stage() {
  stop_stage
  local folder=$out/server i
  mkdir -p "$folder"
  cp -r "$worlds/." "$folder"
  cp "$1" "$folder/stage.world"
  cp "$2" "$folder/stage.cfg"
  for i in 1 2 3 4 5 6 7 8 9; do sed -i "s/\bPORT$i\b/$((port + i))/g" "$folder/stage.cfg"; done
  Xvfb -displayfd 3 -screen 0 1000x1064x24 -nolisten tcp 3>"$folder/display" 2>"$folder/xvfb.txt" &
  stage_pids+=($!)
  local try
  for ((try = 0; try < 100; ++try)); do
    [[ -s $folder/display ]] && break
    sleep 0.1
  done
  display=:$(<"$folder/display")
  (cd "$folder" && exec env DISPLAY="$display" LIBGL_ALWAYS_SOFTWARE=1 \
    LD_LIBRARY_PATH="$prefix/lib:$prefix/lib64" LTDL_LIBRARY_PATH="$prefix/lib:$prefix/lib64" \
    "$prefix/bin/player" -p "$port" stage.cfg >player.txt 2>&1) &
  stage_pids+=($!)
  for ((try = 0; try < 300; ++try)); do
    if (exec 3<>"/dev/tcp/127.0.0.1/$port") 2>/dev/null; then return; fi
    sleep 0.1
  done
  cat "$folder/player.txt" >&2
  echo 'the Player server does not listen' >&2
  exit 1
}
