#!/usr/bin/env bash
# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#
# Runs programs that are linked with Playpen against a real Player server with Stage, and tells for each
# what it did; then mirrors a robot of Stage.
set -euo pipefail

usage() {
  cat <<'TEXT'
Usage: tests/interop/real_server.sh --prefix DIR --build DIR [OPTIONS]

Starts Player with Stage, as build_peers.sh has installed them, under Xvfb. Four Pioneers stand in Stage's
cave (stage.cfg, stage.world). Each program runs for some seconds of real time, while another program
watches through SimulationProxy how far the robots drive. Afterwards `playpen run --real` mirrors a robot.

  --prefix DIR   as for build_peers.sh
  --build DIR    build folder of Playpen, with the command and the programs of tests/compat (for example
                 build/dev)
  --player DIR   Player's sources, for its examples (default: DIR/source/player of the prefix)
  --worlds DIR   Stage's folder of worlds (default: DIR/share/stage/worlds of the prefix)
  --robot DIR    a folder with the course's robot.cc and robot.h; without it they are left out
  --out DIR      where outputs, film and picture go (default: ./interop)
  --port PORT    first port of the server (default: 16665)
  --only NAME    run this program only, or "mirror"; may be repeated
TEXT
}

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$here/../.." && pwd)
prefix=
build=
player=
worlds=
robot=
out=interop
port=16665
only=()
while (($# > 0)); do
  case $1 in
    --help | -h)
      usage
      exit 0
      ;;
    --prefix) prefix=${2:?--prefix needs a folder} ;;
    --build) build=${2:?--build needs a folder} ;;
    --player) player=${2:?--player needs a folder} ;;
    --worlds) worlds=${2:?--worlds needs a folder} ;;
    --robot) robot=${2:?--robot needs a folder} ;;
    --out) out=${2:?--out needs a folder} ;;
    --port) port=${2:?--port needs a number} ;;
    --only) only+=("${2:?--only needs a name}") ;;
    *)
      usage >&2
      printf 'real_server: unknown argument: %s\n' "$1" >&2
      exit 2
      ;;
  esac
  shift 2
done
if [[ -z $prefix || -z $build ]]; then
  usage >&2
  echo 'real_server: --prefix and --build are needed' >&2
  exit 2
fi
prefix=$(cd "$prefix" && pwd)
build=$(cd "$build" && pwd)
player=${player:-$prefix/source/player}
worlds=${worlds:-$prefix/share/stage/worlds}
mkdir -p "$out/server" "$out/bin"
out=$(cd "$out" && pwd)
display=  # of start_stage
# shellcheck source=tests/interop/stage_server.sh
source "$here/stage_server.sh"
trap stop_stage EXIT

# compile PROGRAM SOURCE... [OPTION...]: with Playpen's headers and library.
compile() {
  local program=$1
  shift
  g++ -std=gnu++14 -O1 "$@" -I"$root/libplayerlike/include" -I"$build/libplayerlike/include" \
    -o "$out/bin/$program" "$build/libplayerlike/libplaypen_playerlike.so" -pthread \
    -Wl,-rpath,"$build/libplayerlike:$build/libsim" -Wl,-rpath-link,"$build/libsim" \
    >"$out/$program.compiler.txt" 2>&1
}

row() { printf '%-24s %-8s %s\n' "$1" "$2" "$3"; }

wanted() {
  ((${#only[@]} == 0)) && return 0
  local name
  for name in "${only[@]}"; do [[ $name == "$1" ]] && return 0; done
  return 1
}

# starts: where the robots stand in stage.world.
starts=("r0,-7,-7,45" "r1,-4,-7,45" "r2,6,4,180" "r3,2,-7,135")
failed=0

# try NAME SECONDS LEAST_PATH_M MOVING TEXT COMMAND...: runs a program. The first robot must drive so far,
# so many robots must move, and the output must contain the text (an extended regular expression). `expect`
# is the exit code of programs that do not return 0.
expect=0
try() {
  local name=$1 seconds=$2 least=$3 moving=$4 text=$5
  shift 5
  wanted "$name" || return 0
  # A line buffer, so that programs which are told to end have printed.
  if ! PLAYPEN_WORLD=player://127.0.0.1:$port timeout $((seconds + 30)) "$out/bin/watch_program" "$port" \
    "$seconds" "$out/$name.report" "${starts[@]}" -- /usr/bin/stdbuf -oL "$@" \
    >"$out/$name.txt" 2>&1 </dev/null; then
    row "$name" FAILED "$(tail -n 1 "$out/$name.txt")"
    failed=1
    return
  fi
  local end path others verdict=ok
  end=$(head -n 1 "$out/$name.report")
  path=$(awk 'NR == 2 {printf "%.1f", $2}' "$out/$name.report")
  others=$(awk 'NR > 1 && $2 >= 0.1 {++n} END {print n + 0}' "$out/$name.report")
  case $end in
    running | "exit $expect") ;;
    *) verdict=FAILED ;;
  esac
  awk -v path="$path" -v least="$least" 'BEGIN {exit !(path >= least)}' || verdict=FAILED
  ((others >= moving)) || verdict=FAILED
  [[ -z $text ]] || grep -qE -- "$text" "$out/$name.txt" || verdict=FAILED
  local shown=
  [[ -z $text ]] || shown=$(grep -oE -m 1 -- "$text" "$out/$name.txt" | head -n 1 || true)
  if [[ $verdict != ok ]]; then
    local missing
    missing=$(sed -n 's/.*there is no device \([a-z0-9_]*:[0-9]*\) .*/\1/p' "$out/$name.txt" | head -n 1)
    if [[ -n $missing ]]; then
      row "$name" - "Stage has no $missing"
      return
    fi
    failed=1
    shown="expected \"$text\", at least $least m; last line: $(tail -n 1 "$out/$name.txt")"
  fi
  row "$name" "$verdict" "$end; $path m; $others moved; $shown"
}

compile watch_program "$here/watch_program.cc"
start_stage "$here/stage.world" "$here/stage.cfg"

programs=$build/tests/compat/programs/bin/compat_
c_programs=$build/tests/compat/c_programs/bin/compat_c_

# C++ programs of tests/compat.
try wander_laser 15 3 1 '^laser.0.127' "${programs}wander_laser"
try wander_ranger 15 0.5 1 'ranges: 16 .*max 5' "${programs}wander_ranger"
try sonar_ranger 30 3 1 '16 sonars, 180 beams' "${programs}sonar_ranger"
try wall_follow 15 2 1 '' "${programs}wall_follow"
try background_thread 20 1 1 '' "${programs}background_thread"
try posix_threads 15 0.5 1 '' "${programs}posix_threads"
try standard_threads 20 0.5 2 '' "${programs}standard_threads"
try two_clients_one_port 15 0.5 1 '' "${programs}two_clients_one_port"
try four_ports 15 0.5 4 '' "${programs}four_ports"
try own_goto 40 1 1 'distance left 0\.0' "${programs}own_goto"
try goto_goal 60 2 1 '3 goals reached' "${programs}goto_goal"
try square_by_odometry 40 3.9 1 'closed within 0\.[0-9]* m' "${programs}square_by_odometry"
try square_counting_turns 40 3.8 1 '' "${programs}square_counting_turns"
try square_sleeping 40 3.8 1 '' "${programs}square_sleeping"
try wall_clock 30 0.8 1 'took 1\.[0-9]*' "${programs}wall_clock"
try exceptions 20 1 1 'no arm|ended|LaserProxy' "${programs}exceptions"
try globals 15 0.5 1 '' "${programs}globals"
try own_proxy 20 0 0 '50 scans' "${programs}own_proxy"
try read_signals 25 0.5 1 '150 poses' "${programs}read_signals"
try push_wall 20 0.1 1 '' "${programs}push_wall"
try simulation 10 0.1 1 'moved by 0\.3' "${programs}simulation" r0
try map_reader 10 0 0 '500 x 500 cells of 0\.032 m' "${programs}map_reader"
try bumper_maze 20 0.5 1 'bumpers' "${programs}bumper_maze"
try fiducial_chase 40 0.1 1 'reached fiducial [0-9]+' "${programs}fiducial_chase"
expect=2 try urg_wander 10 0 0 '180 beams: this is no URG' "${programs}urg_wander"
try potential_field 15 0.5 1 '' "${programs}potential_field"
for name in blackboard blob_chase can_collector instruments logger never_deleted past_the_end speaking \
  wander_sonar infrared; do
  try "$name" 15 0 0 '' "$programs$name"
done

# C programs of tests/compat.
try c_square 40 1.9 1 '' "${c_programs}square"
try c_laser_wall 20 1 1 '' "${c_programs}laser_wall"
try c_polling 20 0.3 1 '' "${c_programs}polling"
try c_endless 15 0.3 1 '' "${c_programs}endless"

# The examples of Player's C++ library, unchanged, with Playpen's headers.
# example NAME ...: as try, and compiles the program first.
example() {
  local name=example_$1
  wanted "$name" || return 0
  if ! compile "$name" -DHAVE_GETOPT=1 -w "$player/examples/libplayerc++/$1.cc"; then
    row "$name" FAILED "does not compile: $(head -n 1 "$out/$name.compiler.txt")"
    failed=1
    return
  fi
  local program=$1
  shift
  try "$name" "${@:1:4}" "$out/bin/example_$program" "${@:5}"
}
if [[ -d $player/examples/libplayerc++ ]]; then
  example example0 10 0 0 ''
  example example1 15 0 0 ''
  example example2 15 0 0 ''
  example example3 15 0 0 ''
  example example4 15 0 0 ''
  example laserobstacleavoid 15 1 1 ''
  example randomwalk 15 1 1 '' -l
  example wallfollow 15 0 0 ''
  example sonarobstacleavoid 10 0 0 ''
  example goto 15 0 0 '' -x 1 -y 0 -m
  example clientgraphics 30 0 0 ''
  example grip 15 0 0 ''
  expect=1 example speech 10 0 0 ''  # it always returns 1
  example speech_cpp_client 10 0 0 ''
  example camera 10 0 0 ''
  example ptz 10 0 0 ''
  example clientgraphics3d 10 0 0 ''
elif wanted examples; then
  row examples - "there is no folder $player/examples/libplayerc++"
fi

# The course's robot, compiled for the robot: it drives by its host name alone.
if [[ -n $robot ]] && wanted robot; then
  if compile robot -w -I"$robot" "$robot/robot.cc" "$here/robot_main.cc"; then
    try robot 15 1 1 '' "$out/bin/robot" --host player://127.0.0.1 --port "$port"
  else
    row robot FAILED "does not compile: $(head -n 1 "$out/robot.compiler.txt")"
    failed=1
  fi
fi

# `playpen run --real` mirrors a robot of Stage, with live window and film: how far the mirrored robot is
# from Stage's, and how long scans take to the screen.
if wanted mirror; then
  cp -r "$worlds/bitmaps" "$out"
  cp "$here/mirror_stage.json" "$out"
  compile mirror_drive "$here/mirror_drive.cc"
  # Robots start where the world has them.
  "$out/bin/watch_program" "$port" 1 "$out/mirror.report" "${starts[@]}" -- /bin/true
  (sleep 12 && ffmpeg -y -loglevel error -f x11grab -draw_mouse 0 -video_size 867x974 -i "$display" \
    -frames:v 1 "$out/mirror_window.png") &
  picture=$!
  if DISPLAY=$display "$build/bin/playpen" run "$out/mirror_stage.json" --quiet --out "$out/mirror" --view \
    --real "r1=player://127.0.0.1:$((port + 1))" --record "$out/mirror.mp4" --record-fps 10 -- \
    "$out/bin/mirror_drive" "player://127.0.0.1:$port" r1 20 >"$out/mirror.txt" 2>"$out/mirror.err"; then
    row mirror ok "$(tail -n 1 "$out/mirror.txt")"
    python3 - "$out/mirror/report.json" <<'PYTHON'
import json
import sys

with open(sys.argv[1], encoding="utf-8") as file:
    robot = json.load(file)["mirror"][0]
for name in "latency", "screen_latency":
    print("%-24s %-8s mean %.0f ms, at most %.0f ms" % (
        name, "", 1000 * robot[name]["mean"], 1000 * robot[name]["max"]))
ghost = robot["ghost"]
print("%-24s %-8s mean %.0f mm, at most %.0f mm" % (
    "ghost distance", "", 1000 * ghost["distance"]["mean"], 1000 * ghost["distance"]["max"]))
scan = robot["scan_difference"]
print("%-24s %-8s mean %.0f mm; %.0f %% of the beams differ by more than 100 mm" % (
    "scan difference", "", 1000 * scan["range"]["mean"], 100 * scan["share"]["mean"]))
PYTHON
    ffmpeg -y -loglevel error -ss 12 -i "$out/mirror.mp4" -frames:v 1 "$out/mirror.png"
    row film ok "$out/mirror.mp4; a picture of it: $out/mirror.png"
  else
    row mirror FAILED "$(tail -n 1 "$out/mirror.err")"
    failed=1
  fi
  wait "$picture" || true
fi
exit "$failed"
