#!/usr/bin/env bash
# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#
# Tests the package in the form in which users get it. See usage().
set -euo pipefail

usage() {
  cat <<'TEXT'
Usage: tests/install/package.sh FOLDER

Clones this checkout, with its changes, below FOLDER, builds there what apps/demo.sh builds, and follows
the pages for new users with an empty home: every command runs as it is written there, and so does the
walk of walk.sh. Then the same build folder is configured for shared libraries, which compiles nothing
again, and the pages are followed once more. What was built below FOLDER before is built on.
TEXT
}
if (($# != 1)) || [[ $1 == -* ]]; then
  usage >&2
  exit 2
fi

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
pages=(README.md docs/bring_your_program.md docs/playerc.md)
mkdir -p "$1/home/src"
folder=$(cd "$1" && pwd)
home=$folder/home
clone=$home/src/playpen
"$root/tests/install/clone.sh" "$root" "$clone"

fail() {
  printf 'package: %s\n' "$@" >&2
  exit 1
}

# timed WHAT COMMAND...
timed() {
  local what=$1 start=$SECONDS
  shift
  printf '===== %s\n\n' "$what"
  "$@"
  printf '\n===== %s: %d s\n\n' "$what" $((SECONDS - start))
}

# build SHARED: builds as demo.sh does, on a machine without the benchmark library.
build() {
  local settings=(-DCMAKE_DISABLE_FIND_PACKAGE_benchmark=ON "-DBUILD_SHARED_LIBS=$1")
  if command -v ccache >/dev/null 2>&1; then settings+=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache); fi
  (cd "$clone" && cmake --preset release "${settings[@]}" &&
    cmake --build build/release --parallel "$(nproc)" --target programs)
}

# follow PAGE...
follow() {
  "$clone/tests/install/pages.sh" --clone "$clone" --home "$home" "${@/#/$clone/}"
}

# The installed package, moved, with a separate project and the build files of old programs. For
# shared libraries the test install.consumer does this.
check_install() {
  cmake "-DBUILD_DIR=$clone/build/release" "-DSOURCE_DIR=$clone" \
    -DCONFIG=Release -DGENERATOR=Ninja -DCXX_COMPILER=g++ -DC_COMPILER=gcc -DCXX_FLAGS= \
    "-DSTAGE_DIR=$folder/stage" "-DCONSUMER_DIR=$clone/tests/install/consumer" \
    -P "$clone/tests/install/check_install.cmake"
}

timed "the static build" build OFF
PLAYPEN_WALK_CLONE=$clone timed "the walk" "$clone/tests/install/walk.sh" "$home"
# Run both at the same time: each alone leaves the second processor mostly idle.
check_install >"$folder/check_install.log" 2>&1 &
checking=$!
trap 'kill "$checking" 2>/dev/null || true' EXIT
timed "the pages" follow "${pages[@]}"
wait_for_check() { wait "$checking" || { cat "$folder/check_install.log" >&2 && return 1; }; }
timed "the installed package, further on" wait_for_check
trap - EXIT
# The target playpen::playerlike is the library that the demo has built: static.
loaded=$(ldd "$home/README/build/my_robot")
[[ $loaded != *libplaypen* ]] || fail "the static package is not static:" "$loaded"

timed "the shared build" build ON
rm -rf -- "$home/playpen"
timed "the pages" follow docs/start_here.md "${pages[@]}"
loaded=$(ldd "$home/README/build/my_robot")
[[ $loaded == *libplaypen_playerlike.so*libplaypen_sim.so* ]] ||
  fail "the shared package is not shared:" "$loaded"
