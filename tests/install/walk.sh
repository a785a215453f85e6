#!/usr/bin/env bash
# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#
# The steps of a new user, from a clone to a program of one's own. See usage().
set -euo pipefail

usage() {
  cat <<'TEXT'
Usage: tests/install/walk.sh FOLDER

Walks through what a new user does, and fails at the first thing that does not work: clones Playpen, runs
the demo and docs/start_here.md to its end, fills in a template and has it graded, runs a program for
Pioneers that pkg-config's flags compile, and tries `playpen new`, `list` and `doctor`. FOLDER, which is
emptied first, is the user's home. On a machine that has none of Playpen's packages, the demo installs
them.

Environment:
  PLAYPEN_WALK_SOURCE  what is cloned: a checkout or an address (default: this checkout)
  PLAYPEN_WALK_CLONE   a clone to go on with, so that what was built there is not built again; FOLDER is
                       not emptied then
TEXT
}
if (($# != 1)) || [[ $1 == -* ]]; then
  usage >&2
  exit 2
fi

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
fail() {
  printf 'walk: %s\n' "$@" >&2
  exit 1
}
headline() { printf '\n##### %s\n' "$*"; }
# has FILE...: the files must exist and not be empty.
has() {
  local file
  for file in "$@"; do [[ -s $file ]] || fail "$file was not written"; done
}
# says PATTERN COMMAND...: runs it and shows its output, which must match.
says() {
  local pattern=$1 output status=0
  shift
  printf -- '--- %s\n' "$*"
  output=$("$@" 2>&1 </dev/null) || status=$?
  printf '%s\n' "$output"
  ((status == 0)) || fail "'$*' ended with status $status"
  grep -qE -- "$pattern" <<<"$output" || fail "'$*' does not say '$pattern'"
}

if [[ -n ${PLAYPEN_WALK_CLONE:-} ]]; then
  clone=$(cd "$PLAYPEN_WALK_CLONE" && pwd)
  HOME=$(cd "$1" && pwd)
else
  source=${PLAYPEN_WALK_SOURCE:-$(cd "$here/../.." && pwd)}
  rm -rf -- "$1"
  mkdir -p -- "$1/src"
  HOME=$(cd "$1" && pwd)
  headline "Clone"
  clone=$HOME/src/playpen
  git clone --quiet -- "$source" "$clone"
fi
export HOME
unset PKG_CONFIG_PATH CMAKE_PREFIX_PATH CPATH LIBRARY_PATH LD_RUN_PATH LD_LIBRARY_PATH
rm -rf -- "$HOME/playpen" "$HOME/walk" "$clone/out/demo"
mkdir -p -- "$HOME/walk"

headline "The demo, and start_here to its end"
"$here/pages.sh" --clone "$clone" --home "$HOME" "$clone/docs/start_here.md"
(cd "$clone/out/demo" && has film.mp4 replay.html scene.png canvas.png layers/occupancy.pgm report.json)
(cd "$HOME/start_here" && has out/par_intro/scene.png out/my_world/report.json my_world.png \
  out/mine/trajectory.csv)
playpen=$HOME/playpen/bin/playpen

headline "A template, filled in and graded"
cp -r "$clone/apps/par_intro/template" "$HOME/walk/intro"
cd "$HOME/walk/intro"
"$here/fill_intro.sh" robot.cc
says . cmake -S . -B build "-DCMAKE_PREFIX_PATH=$HOME/playpen"
says . cmake --build build
says '5 of 5 runs passed' "$playpen" grade par_intro -- build/par_intro_template

headline "A program for Pioneers, by pkg-config"
mkdir "$HOME/walk/pioneer"
cd "$HOME/walk/pioneer"
cat >wander.cc <<'TEXT'
#include <libplayerc++/playerc++.h>

int main() {
  PlayerCc::PlayerClient robot("localhost", 6665);
  PlayerCc::Position2dProxy drive(&robot, 0);
  PlayerCc::SonarProxy sonar(&robot, 0);
  drive.SetMotorEnable(true);
  for (;;) {
    robot.Read();
    const double left = std::min(sonar[1], sonar[2]), right = std::min(sonar[5], sonar[6]);
    const double ahead = std::min(sonar[3], sonar[4]);
    if (std::min(ahead, std::min(left, right)) < 0.7) {
      drive.SetSpeed(0.0, left < right ? -0.7 : 0.7);
    } else {
      drive.SetSpeed(0.4, 0.0);
    }
  }
}
TEXT
export PKG_CONFIG_PATH=$HOME/playpen/lib/pkgconfig
# shellcheck disable=SC2046  # pkg-config's words are flags
g++ wander.cc $(pkg-config --cflags --libs playerc++) -o wander
says '60.0 s simulated' "$playpen" run cave --duration 60 -- ./wander
has out/cave/scene.png out/cave/report.json

headline "A class: a CMake project, and makefiles by pkg-config and by names"
mkdir "$HOME/walk/class"
cd "$HOME/walk/class"
cp -r ../intro cmake
mkdir flags names
cp ../pioneer/wander.cc flags
cp ../pioneer/wander.cc names
# shellcheck disable=SC2016  # make's words
printf 'robot: ; $(CXX) wander.cc $$(pkg-config --cflags --libs playerc++) -o robot\n' >flags/Makefile
# shellcheck disable=SC2016
printf 'robot: ; $(CXX) wander.cc -lplayerc++ -o robot\n' >names/Makefile
unset PKG_CONFIG_PATH
says '3 submissions, 3 compiled, 1 passed all runs' "$playpen" class par_intro --seeds 1, \
  --submissions . --out "$HOME/walk/graded" --isolated best
has ../graded/index.html ../graded/results.csv ../graded/submissions/cmake/par_intro/par_intro_seed1/scene.png

headline "A batch: a program with other starts"
cd "$HOME/walk/pioneer"
printf '{"programs": ["./wander"], "worlds": ["cave"], "duration": 5, "seeds": 2,
  "parameters": {"/robots/0/pose/yaw_deg": [0, 90]}}' >plan.json
says '4 runs, 4 ended, 4 passed' "$playpen" batch plan.json --out "$HOME/walk/batch"
has ../batch/results.csv ../batch/statistics.csv ../batch/charts/least_clearance.png

headline "playpen new, list and doctor"
says 'cave' "$playpen" list
# playpen_new_test builds the others, too, against the build folder.
kinds=(client)
if [[ -n ${PLAYPEN_NIGHTLY:-} ]]; then
  kinds=(intro planning exploration traps exploration_changing chase localization client)
fi
for kind in "${kinds[@]}"; do
  cd "$HOME/walk"
  says . "$playpen" new "$kind" "new_$kind"
  says . cmake -S "new_$kind" -B "new_$kind/build"
  says . cmake --build "new_$kind/build"
done
says . "$playpen" new test tested
says . cmake -S tested -B tested/build
says . cmake --build tested/build
says '100% tests passed' ctest --test-dir tested/build --no-tests=error
says . "$playpen" doctor

headline "The walk is at its end"
