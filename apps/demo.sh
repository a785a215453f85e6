#!/usr/bin/env bash
# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#
# Installs missing packages, builds the programs, lets a robot explore an unknown arena by
# itself, films it and grades its map.
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

headline "1/4  Packages"
"$root/apps/install_dependencies.sh" build ||
  fail "packages are missing and could not be installed; the reason is above"
echo "     all there"

headline "2/4  Build"
mkdir -p "$build" "$out"
: >"$log"
launcher=()
if command -v ccache >/dev/null 2>&1; then
  launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
fi
quietly "configuring" cmake --preset release "${launcher[@]}"
# The command, the package that `cmake --install` installs, and the programs that the guides run.
targets=(programs)
jobs=$(nproc)
if [[ -t 1 ]]; then
  # On a terminal ninja shows its progress in one line.
  cmake --build "$build" --parallel "$jobs" --target "${targets[@]}" ||
    fail "the build failed; the compiler's messages are above"
else
  quietly "the build" cmake --build "$build" --parallel "$jobs" --target "${targets[@]}"
fi
echo "     $build/bin/playpen, and the course's programs beside it"

headline "3/4  A robot explores an arena that it does not know"
results=(film.mp4 scene.png canvas.png layers/occupancy.pgm layers/occupancy.yaml report.json
  trajectory.csv)
# Those of an earlier run must not pass for this one's.
(cd "$out" && rm -f "${results[@]}")
"$build/bin/playpen" run worlds/tasks/par_exploration.json --record "$out/film.mp4" \
  --record-speed 2.5 --out "$out" -- "$build/bin/par_exploration_solution_nearest" ||
  fail "the run ended with status $?; its messages are above"

for file in "${results[@]}"; do
  [[ -s $out/$file ]] || fail "the run ended well but left no $out/$file; please report this"
done

headline "4/4  The same again, judged as a student's program is"
"$build/bin/playpen" grade worlds/tasks/par_exploration.task.json \
  worlds/tasks/par_exploration.json --seeds 1, --out "$out/grade" \
  -- "$build/bin/par_exploration_solution_nearest" ||
  fail "the run did not pass; the reasons are above"

echo
headline "Look at"
echo "  $root/$out/film.mp4         how it went, 2.5 times as fast"
echo "  $root/$out/scene.png        the arena, the robot, and what it knows at the end"
echo "  $root/$out/canvas.png       what it knows, alone; layers/ has each layer"
echo "  $root/$out/layers/occupancy.yaml   its map, for ROS's map_server"
echo "  $root/$out/report.json      the figures"
echo "  $root/$out/trajectory.csv   where it was, and when"
