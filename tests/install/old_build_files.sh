#!/usr/bin/env bash
# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#
# Builds programs with an installed package in the ways that build files for Player do, runs each,
# and checks its output. See usage().
set -euo pipefail

usage() {
  cat <<'TEXT'
Usage: tests/install/old_build_files.sh PREFIX FOLDER

PREFIX is where Playpen is installed, FOLDER where programs are built (it is emptied first). CXX, CC,
CXXFLAGS and CFLAGS are taken from the environment.
TEXT
}
if (($# != 2)) || [[ $1 == -* ]]; then
  usage >&2
  exit 2
fi

prefix=$(cd "$1" && pwd)
sources=$(cd "$(dirname "${BASH_SOURCE[0]}")/old" && pwd)
rm -rf -- "$2"
mkdir -p -- "$2"
cp -R -- "$sources/." "$2"
cd "$2"
# Use a name without blanks, because the shell splits the output of a command at blanks.
ln -s "$prefix" here
folder=$(dirname "$(find -L here -name 'playerc++.pc' -printf '%p\n' | head -n 1)")
[[ -f $folder/playerc++.pc ]] || { echo "$prefix has no playerc++.pc" >&2; exit 1; }
libraries=$(dirname "$folder")
export PKG_CONFIG_PATH=$folder
read -ra cxx_flags <<<"${CXXFLAGS:-}"
read -ra c_flags <<<"${CFLAGS:-}"
cxx=("${CXX:-g++}" "${cxx_flags[@]}")
cc=("${CC:-gcc}" "${c_flags[@]}")
unset CPATH LIBRARY_PATH LD_RUN_PATH LD_LIBRARY_PATH CXXFLAGS CFLAGS LDFLAGS
unset PLAYPEN_WORLD PLAYPEN_DURATION PLAYPEN_RUN PLAYPEN_OUT

cases=0
fail() {
  printf 'old_build_files: %s\n' "$@" >&2
  exit 1
}

# try COMMAND...: runs it quietly; its output is shown if it fails.
try() {
  "$@" >log 2>&1 || fail "failed: $*" "$(cat log)"
}

# prints PATTERN COMMAND...: runs it; its output must match.
prints() {
  local pattern=$1
  shift
  try "$@"
  grep -qE -- "$pattern" log || fail "$* printed, instead of '$pattern':" "$(cat log)"
  cases=$((cases + 1))
}

drove='drove to [0-9.]+ [0-9.]+'

# pkg-config must print only flags, and no folder of this machine.
count=0
for file in "$folder"/*.pc; do
  package=$(basename "$file" .pc)
  read -ra flags <<<"$(pkg-config --cflags --libs "$package")"
  for flag in "${flags[@]}"; do
    [[ $flag == -* ]] || fail "pkg-config prints the bare name '$flag' for $package: ${flags[*]}"
  done
  if grep -q '=/' "$file"; then fail "$file names a folder of this machine" "$(cat "$file")"; fi
  count=$((count + 1))
done
for package in playerc++ playerc playercore playerinterface playercommon playererror; do
  pkg-config --exists "$package" || fail "there is no $package.pc in $folder"
done
pkg-config --atleast-version=3.0 playerc++ || fail "playerc++ has no version of Player 3"
((count >= 6)) || fail "only $count packages are there"

# Compile and link in one command, with the flags after and before the source.
# shellcheck disable=SC2046  # pkg-config's words are flags
{
  try "${cxx[@]}" wander.cc $(pkg-config --cflags --libs playerc++) -o after
  prints "saw 682 beams, $drove" ./after localhost
  try "${cxx[@]}" $(pkg-config --cflags --libs playerc++) wander.cc -o before
  prints "saw 682 beams, $drove" ./before
  try "${cc[@]}" $(pkg-config --cflags --libs playerc) wander.c -o before_c
  prints "$drove" ./before_c
  try "${cxx[@]}" -c $(pkg-config --cflags playerc++) wander.cc
  try "${cc[@]}" -c $(pkg-config --cflags playerc) wander.c -o wander_c.o
}
# With a linker that drops libraries that nothing has needed yet, as gcc does on Debian and Ubuntu.
for package in playerc++ playerc playercore playerinterface 'playerc++ playerc' 'playerc playerc++'; do
  read -ra flags <<<"$(pkg-config --libs "$package")"
  try "${cxx[@]}" -Wl,--as-needed "${flags[@]}" wander.o -o "as_needed_before"
  prints "$drove" ./as_needed_before
  try "${cxx[@]}" -Wl,--as-needed wander.o "${flags[@]}" -o "as_needed_after"
  prints "$drove" ./as_needed_after
  try "${cc[@]}" -Wl,--as-needed "${flags[@]}" wander_c.o -o "as_needed_c"
  prints "$drove" ./as_needed_c
done

# A makefile that inserts pkg-config's words into a line, so that folders may contain blanks.
cat >Makefile.pkg <<'TEXT'
FLAGS = $(shell pkg-config --cflags --libs playerc++)
flat_made: flat.cc
	$(CXX) $< $(FLAGS) -o $@
TEXT
PKG_CONFIG_PATH=$prefix/${folder#here/} prints '' make -f Makefile.pkg CXX="${cxx[*]}" flat_made
prints 'laser:0 .*position2d:0 ' ./flat_made

# Names and folders written by hand. LD_LIBRARY_PATH finds a library that is outside the loader's
# folders, as for Player's own.
try "${cxx[@]}" example.cc -Ihere/include/player-3.1 -Ihere/include/player-3.1/player-examples \
  -Lhere/"${libraries#here/}" -lplayerc++ -o hand
LD_LIBRARY_PATH=$libraries prints 'read for a second at localhost:6665' ./hand
try "${cc[@]}" wander.c -Ihere/include/player-2.1 -L"$libraries" -lplayerc -lm -o hand_c
LD_LIBRARY_PATH=$libraries prints "$drove" ./hand_c
# By Playpen's own name: the linker takes the shared library even if there is an archive of that
# name.
try "${cxx[@]}" wander.o -L"$libraries" -lplaypen_playerlike -o own_name
LD_LIBRARY_PATH=$libraries prints "$drove" ./own_name
# Bare names before the sources, with the guide's option for compilers that drop them.
try "${cxx[@]}" -Wl,--no-as-needed -L"$libraries" -lplayerc++ wander.o -o names_before
LD_LIBRARY_PATH=$libraries prints "$drove" ./names_before
# An unchanged makefile for a Player in /usr/local: variables point the compiler and the linker to
# it.
CPATH=here/include/player-3.1 LIBRARY_PATH=$libraries LD_RUN_PATH=$libraries \
  prints '' make -f Makefile.names CXX="${cxx[*]}" CC="${cc[*]}"
prints "$drove" ./named_cc
prints "$drove" ./named_c

# shellcheck disable=SC2046  # pkg-config's words are flags
{
  # A program with its own args.h; both client libraries in one program.
  try "${cxx[@]}" own_args/own_args.cc $(pkg-config --cflags --libs playerc++) -o own
  prints 'read 3 times at port 6665' ./own -r 3
  try "${cxx[@]}" both.cc $(pkg-config --cflags playerc++) -L"$libraries" \
    -Wl,-rpath,"$libraries" -lplayerc++ -lplayerc -o both
}
prints 'one robot for both libraries' ./both
needed=$(readelf -d both | grep -c 'NEEDED.*\(player\|playpen\)' || true)
[[ $needed == 1 ]] || fail "a program of both client libraries needs $needed libraries of Playpen" \
  "$(readelf -d both | grep NEEDED)"

# configure_and_build FOLDER [CMAKE ARGUMENTS...]
configure_and_build() {
  local folder=$1
  shift
  # CMake 4 accepts projects for CMake 2 only with this option.
  try cmake -S "$folder" -B "$folder/build" -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_POLICY_VERSION_MINIMUM=3.5 \
    -DCMAKE_CXX_COMPILER="${CXX:-g++}" -DCMAKE_CXX_FLAGS="${cxx_flags[*]}" \
    -DCMAKE_C_COMPILER="${CC:-gcc}" -DCMAKE_C_FLAGS="${c_flags[*]}" "$@"
  try cmake --build "$folder/build"
}
configure_and_build cmake_find "-DCMAKE_PREFIX_PATH=$prefix"
prints "$drove" cmake_find/build/program
configure_and_build cmake_use "-DPLAYER_PREFIX=$prefix"
prints 'read 20 times' cmake_use/build/program
prints "$drove" cmake_use/build/own
try cmake --install cmake_use/build --prefix "$PWD/installed"
prints 'read 20 times' installed/bin/program
configure_and_build cmake_use_c "-DPLAYER_PREFIX=$prefix"
prints "$drove" cmake_use_c/build/program
configure_and_build cmake_c "-DCMAKE_PREFIX_PATH=$prefix"
prints "$drove" cmake_c/build/program
PKG_CONFIG_PATH='' configure_and_build cmake_pkg "-DCMAKE_PREFIX_PATH=$PWD/here"
for program in by_flags by_names by_target; do prints "$drove" cmake_pkg/build/$program; done

# wrong WHAT PATTERN: checks an error message of the module.
wrong() {
  if cmake -S cmake_use -B wrong -DCMAKE_POLICY_VERSION_MINIMUM=3.5 "-DPLAYER_PREFIX=$prefix" "-DWRONG=$1" >log 2>&1; then
    fail "CMake took $1 without an error"
  fi
  tr -s '\n ' ' ' <log | grep -qE -- "$2" || fail "CMake's message about $1:" "$(cat log)"
  cases=$((cases + 1))
}
wrong "no sources" 'PLAYER_ADD_PLAYERCPP_CLIENT\(program\) has no sources: expected'
wrong "no sources" 'passed over what stands before .*: wander\.cc'
wrong "plugin" 'PLAYER_ADD_PLUGIN_DRIVER\(driver\): Playpen has no player server'

echo "old_build_files: $cases cases, $count packages"
