#!/usr/bin/env bash
# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#
# Installs missing packages, builds the command, lets a robot explore an unknown arena by itself,
# films it and grades its map. Then builds the other programs that the guides run.
# Results: out/demo/.
set -euo pipefail

case ${1:-} in
  '') ;;
  --help | -h)
    echo "Usage: apps/demo.sh"
    sed -n '4,6s/^# //p' "${BASH_SOURCE[0]}"
    exit 0
    ;;
  *)
    echo "demo: unknown argument '$1'; there are none but --help" >&2
    exit 2
    ;;
esac

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$root"
# shellcheck source=SCRIPTDIR/build_tools.sh
source apps/build_tools.sh
build=build/release
out=out/demo
log=$build/demo.log

if [[ -t 1 ]]; then bold=$'\e[1m' plain=$'\e[0m'; else bold='' plain=''; fi
headline() { printf '%s%s%s\n' "$bold" "$*" "$plain"; }
fail() {
  printf 'demo: %s\n' "$@" >&2
  exit 1
}

# quietly WHAT COMMAND...: runs it with its output in the log, which is shown if it fails.
quietly() {
  local what=$1
  shift
  if ! "$@" >>"$log" 2>&1; then
    tail -n 40 "$log" >&2
    fail "$what failed; the last lines are above, all of them in $root/$log"
  fi
}

headline "1/5  Packages"
"$root/apps/install_dependencies.sh" build ||
  fail "packages are missing and could not be installed; the reason is above"
echo "     all there"

# progress: copies ninja's lines to the log, and shows one in ten percent.
progress() {
  awk -v log_file="$log" '{
    print >> log_file
    if ($1 ~ /^[0-9]+%$/ && $1 + 0 >= next_one) {
      print "     " $1
      fflush()
      next_one = int($1 / 10) * 10 + 10
    }
  }'
}
# build TARGET...
build() {
  local names=()
  for name in "$@"; do names+=(--target "$name"); done
  if [[ -t 1 ]]; then
    # On a terminal ninja shows its progress in one line.
    cmake --build "$build" --parallel "$jobs" "${names[@]}" ||
      fail "the build failed; the compiler's messages are above"
  elif ! NINJA_STATUS='%p ' cmake --build "$build" --parallel "$jobs" "${names[@]}" 2>&1 |
    progress; then
    tail -n 40 "$log" >&2
    fail "the build failed; the last lines are above, all of them in $root/$log"
  fi
}

headline "2/5  Build what the film needs"
mkdir -p "$build" "$out"
: >"$log"
quietly "configuring" cmake --preset release "${launcher[@]}"
build playpen par_exploration_solution_nearest
echo "     $build/bin/playpen"

headline "3/5  A robot explores an arena that it does not know"
results=(film.mp4 replay.html scene.png canvas.png layers/occupancy.pgm layers/occupancy.yaml
  report.json trajectory.csv)
# Those of an earlier run must not pass for this one's.
(cd "$out" && rm -f "${results[@]}")
"$build/bin/playpen" run worlds/tasks/par_exploration.json --record "$out/film.mp4" \
  --record-speed 2.5 --html "$out/replay.html" --out "$out" -- "$build/bin/par_exploration_solution_nearest" ||
  fail "the run ended with status $?; its messages are above"

for file in "${results[@]}"; do
  [[ -s $out/$file ]] || fail "the run ended well but left no $out/$file; please report this"
done

echo
headline "Look at"
echo "  $root/$out/film.mp4         how it went, 2.5 times as fast"
echo "  $root/$out/replay.html      the same for a browser: any moment, scan, drawing and command"
echo "  $root/$out/scene.png        the arena, the robot, and what it knows at the end"
echo "  $root/$out/canvas.png       what it knows, alone; layers/ has each layer"
echo "  $root/$out/layers/occupancy.yaml   its map, for ROS's map_server"
echo "  $root/$out/report.json      the figures"
echo "  $root/$out/trajectory.csv   where it was, and when"
count_processor_seconds
echo "The film took $SECONDS s, $processor_seconds s of processor time."
echo

headline "4/5  The same again, judged as a student's program is"
"$build/bin/playpen" grade worlds/tasks/par_exploration.task.json \
  worlds/tasks/par_exploration.json --seeds 1, --out "$out/grade" \
  -- "$build/bin/par_exploration_solution_nearest" ||
  fail "the run did not pass; the reasons are above"

echo
headline "5/5  Build the other programs that the guides run"
echo "     You can interrupt this: what is above stays, and apps/demo.sh goes on from here next time."
build programs
echo "     $root/$build/bin has the course's programs and their solutions"
count_processor_seconds
echo "All took $SECONDS s, $processor_seconds s of processor time."
