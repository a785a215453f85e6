#!/usr/bin/env bash
# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#
# Makes the pictures of the README and the documentation anew: builds what it needs, runs the
# programs, takes their pictures. Usage: docs/images/make_pictures.sh [FOLDER WITH THE PROGRAMS]
# With a folder, for example build/dev/bin, nothing is built.
set -euo pipefail
given=${1:+$(realpath "$1")}
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
cd "$root"
for tool in convert import Xvfb xdotool chromium; do
  if ! command -v "$tool" >/dev/null; then
    echo "$0: $tool is missing (packages imagemagick, xvfb, xdotool, chromium)" >&2
    exit 1
  fi
done
if [[ -n $given ]]; then
  bin=$given
else
  cmake --preset dev >/dev/null
  cmake --build build/dev --target playpen docs_thirteen docs_layers docs_living_arena docs_moving docs_mirror docs_snd_snd_goals \
    docs_wavefront_office_goals \
    docs_speech_speech docs_blinkenlight_blinkenlight docs_camera_camera docs_gripper_gripper \
    docs_actarray_actarray \
    compat_four_ports compat_roomba_maze \
    par_intro_solution_wall par_intro_solution_avoid par_planning_solution_dijkstra par_planning_solution_theta \
    par_exploration_solution_nearest par_traps_solution_learn \
    par_exploration_changing_solution_again par_chase_solution_patrol \
    par_localization_solution_particles
  bin=build/dev/bin
fi
out=out/pictures
images=docs/images

# run WORLD NAME OPTION... -- PROGRAM: results in out/pictures/NAME.
run() {
  local world=$1 name=$2
  shift 2
  "$bin/playpen" run "$world" --out "$out/$name" --seed 1 --quiet "$@" >"$out/$name.log" 2>&1 || {
    cat "$out/$name.log" >&2
    exit 1
  }
}

# take PICTURE NAME: few colours are enough, and half the bytes.
take() {
  convert "$out/$1" -strip +dither -colors 200 "$images/$2.png"
  echo "$images/$2.png"
}

mkdir -p "$out"
run worlds/examples/thirteen_robots.json thirteen --duration 9 -- "$bin/docs_thirteen"
take thirteen/scene.png thirteen_robots

run worlds/examples/living_arena.json living_arena --duration 14 --snapshot-every 0.2 --hide fans -- \
  "$bin/docs_living_arena"
take living_arena/snapshots/scene_000004.800s.png arena_controller
take living_arena/snapshots/scene_000012.800s.png arena_controller_waiting

run worlds/examples/moving.json moving --duration 7 --hide fans -- "$bin/docs_moving"
take moving/scene.png moving

# A server plays the real robot.
"$bin/playpen" serve "$images/mirror_real.json" --seed 4 --tcp-port 0 --quiet --out "$out/mirror_real" \
  >"$out/mirror_server.log" &
server=$!
trap 'kill "$server" 2>/dev/null || true' EXIT
until grep -q '^listening' "$out/mirror_server.log"; do sleep 0.1; done
address=$(sed -n 's/^listening on \([^ ,]*\).*/\1/p' "$out/mirror_server.log")
run "$images/mirror.json" mirror --duration 7 --real "r1=tcp://$address" -- "$bin/docs_mirror"
kill "$server"
trap - EXIT
take mirror/scene.png mirror

run worlds/tasks/par_intro.json intro --duration 120 -- "$bin/par_intro_solution_wall"
take intro/scene.png wall_follower

for solution in dijkstra theta; do
  run worlds/tasks/par_planning.json "planning_$solution" --snapshot-every 4 -- \
    "$bin/par_planning_solution_$solution"
  take "planning_$solution/snapshots/scene_000012.000s.png" "planning_$solution"
done
run worlds/tasks/par_planning_2.json planning_2 -- "$bin/par_planning_solution_dijkstra"
take planning_2/scene.png planning_2

run worlds/tasks/par_traps.json traps -- "$bin/par_traps_solution_learn"
take traps/scene.png traps
run worlds/tasks/par_exploration_changing.json exploration_changing --snapshot-every 4 -- \
  "$bin/par_exploration_changing_solution_again"
take exploration_changing/snapshots/scene_000048.000s.png exploration_changing
run worlds/tasks/par_chase.json chase -- "$bin/par_chase_solution_patrol"
take chase/scene.png chase
run worlds/tasks/par_localization.json localization --snapshot-every 1.5 -- \
  "$bin/par_localization_solution_particles"
take localization/snapshots/scene_000001.500s.png localization
run worlds/tasks/par_exploration.json exploration --snapshot-every 4 -- \
  "$bin/par_exploration_solution_nearest"
take exploration/snapshots/scene_000024.000s.png exploration
"$bin/playpen" replay "$out/exploration" >"$out/replay.txt"
# page FRAGMENT NAME WIDTH,HEIGHT OPTION...: a picture of the replay at a time.
page() {
  local fragment=$1 name=$2 size=$3
  shift 3
  chromium --headless --no-sandbox --hide-scrollbars --virtual-time-budget=5000 --window-size="$size" "$@" \
    --screenshot="$out/$name.png" "file://$root/$out/exploration/replay.html#$fragment" \
    2>"$out/$name.log"
  take "$name.png" "$name"
}
page 't=31.4&robot=r1' replay 1200,760
page 't=31.4&robot=r1' replay_phone 390,1100 --blink-settings=preferredColorScheme=0
run worlds/tasks/par_exploration.json exploration_map --snapshot-every 64 --view-mode full-screen -- \
  "$bin/par_exploration_solution_nearest"
take exploration_map/snapshots/scene_000064.000s.png exploration_map
run worlds/tasks/par_exploration.json exploration_corner --snapshot-every 28 --view-mode mini-map -- \
  "$bin/par_exploration_solution_nearest"
take exploration_corner/snapshots/scene_000028.000s.png exploration_mini_map

for mode in ground mini-map full-screen; do
  run default "view-$mode" --duration 45 --view-mode "$mode" --snapshot-every 45 -- "$bin/docs_layers"
  take "view-$mode/snapshots/scene_000045.000s.png" "view_${mode//-/_}"
done

run worlds/cave.json cave -- "$bin/../tests/compat/programs/bin/compat_four_ports"
take cave/scene.png cave

run worlds/examples/roomba_maze.json roomba_maze --duration 400 -- "$bin/../tests/compat/programs/bin/compat_roomba_maze"
take roomba_maze/scene.png roomba_maze

"$bin/playpen" render worlds/examples/shapes.json --out "$out/shapes.png"
take shapes.png shapes

run default snd -- "$bin/docs_snd_snd_goals"
take snd/scene.png snd

run worlds/examples/wavefront_amcl.json wavefront_amcl --snapshot-every 200 --duration 201 -- \
  "$bin/docs_wavefront_office_goals"
take wavefront_amcl/snapshots/scene_000200.000s.png wavefront_amcl

for solution in wall avoid; do
  run worlds/tasks/par_intro.json "$solution" --duration 30 -- "$bin/par_intro_solution_$solution"
done
"$bin/playpen" plot "$out/wall" "$out/avoid" --out "$out/plot.png"
take plot.png plot
"$bin/playpen" diff "$out/avoid" "$out/wall" --out "$out/diff.png" > "$out/diff.txt" || [ $? = 1 ]
take diff.png diff

for device in speech blinkenlight; do
  run "worlds/devices/$device.json" "$device" --snapshot-every 0.2 --duration 0.4 -- \
    "$bin/docs_${device}_$device"
  take "$device/snapshots/scene_000000.200s.png" "devices_$device"
done

run worlds/devices/gripper.json gripper --snapshot-every 0.2 --duration 2 -- \
  "$bin/docs_gripper_gripper"
take gripper/snapshots/scene_000001.800s.png devices_gripper

run worlds/devices/actarray.json actarray --snapshot-every 0.2 --duration 2 -- \
  "$bin/docs_actarray_actarray"
take actarray/snapshots/scene_000002.000s.png devices_actarray

# What a camera sees: its program saves it where it runs.
programs=$(realpath "$bin")
(cd "$out" && "$programs/playpen" run "$root/worlds/devices/camera.json" --out camera --seed 1 \
  --quiet -- "$programs/docs_camera_camera" >camera.log 2>&1) || {
  cat "$out/camera.log" >&2
  exit 1
}
take camera0000.ppm devices_camera

"$images/picture_live_window.sh" "$bin/playpen" worlds/examples/thirteen_robots.json "$out/window" \
  "$images/live_window.png" "$bin/docs_thirteen"
echo "$images/live_window.png"

# The live page of the same robots.
for look in 'page --size 1200x760' 'page_phone --size 390x844 --phone --dark'; do
  read -r name options <<<"$look"
  # shellcheck disable=SC2086 # several options
  "$images/picture_page.py" "$bin/playpen" worlds/examples/thirteen_robots.json "$out/page" \
    "$out/$name.png" "$bin/docs_thirteen" $options
  take "$name.png" "$name"
done
