#!/usr/bin/env bash
# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#
# Tests the package in the form in which users get it. See usage().
set -euo pipefail

usage() {
  cat <<'TEXT'
Usage: tests/install/package.sh [--shared] FOLDER

Follows the pages for new users in this checkout, with what apps/demo.sh has built in build/release and
an empty home below FOLDER: every command runs as it is written there, and so does the walk of walk.sh.
Then the Debian packages are made and checked (deb.sh).
With --shared, build/release is configured for shared libraries meanwhile, which compiles nothing again.
TEXT
}
shared=false
if [[ ${1:-} == --shared ]]; then shared=true && shift; fi
if (($# != 1)) || [[ $1 == -* ]]; then
  usage >&2
  exit 2
fi

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
# shellcheck source=SCRIPTDIR/../../apps/build_tools.sh
source "$root/apps/build_tools.sh"
pages=(README.md docs/bring_your_program.md docs/playerc.md)
rm -rf -- "$1"
mkdir -p "$1/home"
home=$(cd "$1/home" && pwd)

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

# follow PAGE...
follow() { "$root/tests/install/pages.sh" --clone "$root" --home "$home" "${@/#/$root/}"; }

# kind_is SHARED: configures build/release and builds what apps/demo.sh builds.
kind_is() {
  cd "$root"
  cmake --preset release "-DBUILD_SHARED_LIBS=$1"
  cmake --build build/release --parallel "$jobs" --target programs
}

if $shared; then
  trap 'kind_is OFF' EXIT
  timed "the shared build" kind_is ON
  timed "the pages" follow docs/start_here.md "${pages[@]}"
  loaded=$(ldd "$home/README/build/my_robot")
  [[ $loaded == *libplaypen_playerlike.so*libplaypen_sim.so* ]] ||
    fail "the shared package is not shared:" "$loaded"
  exit 0
fi

timed "the walk" env "PLAYPEN_WALK_CLONE=$root" "$root/tests/install/walk.sh" "$home"
timed "the pages" follow "${pages[@]}"
# The target playpen::playerlike is the library that the demo has built: static.
loaded=$(ldd "$home/README/build/my_robot")
[[ $loaded != *libplaypen* ]] || fail "the static package is not static:" "$loaded"

"$root/apps/install_dependencies.sh" package
timed "the Debian packages" "$root/tests/install/deb.sh" "$root/build/release" "$1/deb"
