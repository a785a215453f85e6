#!/usr/bin/env bash
# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#
# Measures what it costs to build and test Playpen from a clean clone. See usage().
set -euo pipefail

usage() {
  cat <<'TEXT'
Usage: tests/build_cost.sh [--check] [--all] [COMMIT]

Clones this checkout's COMMIT (default: HEAD) into a temporary folder, runs apps/demo.sh and
tests/run.sh there without a compiler cache, and prints one line a phase: processor time (user and
system, of all processes), elapsed time, budget. Budgets are scaled by the speed of this machine
(tests/machine.sh). Do nothing else on the machine meanwhile.

  --check   exit with status 1 if a phase takes a fifth more processor time than its budget
  --all     also run .ci/run, from another clean clone
TEXT
}

check=false all=false
while (($# > 0)); do
  case $1 in
    --help | -h) usage && exit 0 ;;
    --check) check=true && shift ;;
    --all) all=true && shift ;;
    -*)
      usage >&2
      echo "tests/build_cost.sh: unknown option '$1'" >&2
      exit 2
      ;;
    *) break ;;
  esac
done
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
commit=$(git -C "$root" rev-parse --verify "${1:-HEAD}^{commit}")
export PLAYPEN_CACHE=off
unset PLAYPEN_NIGHTLY
"$root/apps/install_dependencies.sh" build test lint doc package
# shellcheck source=SCRIPTDIR/machine.sh
source "$root/tests/machine.sh"
measure_machine
echo "This machine needs $machine_percent % of the processor time of the budgets' machine."

folder=$(mktemp -d)
trap 'rm -rf -- "$folder"' EXIT
# clean_clone: prints the folder of a new clone.
clean_clone() {
  local clone
  clone=$(mktemp -d "$folder/XXXXXX")/playpen
  git clone --quiet -- "$root" "$clone"
  git -C "$clone" checkout --quiet "$commit"
  echo "$clone"
}

over=()
# phase NAME PROCESSOR ELAPSED [BUDGET]
phase() {
  printf '%-34s %6d s %6d s' "$1" "$2" "$3"
  if [[ -n ${4:-} ]]; then
    local budget=$(($4 * machine_percent / 100))
    printf ' %6d s' "$budget"
    if (($2 * 5 > budget * 6)); then over+=("$1") && printf '  over'; fi
  fi
  printf '\n'
}
# numbers LINE LOG: prints the two numbers of a script's line about its cost.
numbers() {
  sed -nE "s/^$1 ([0-9]+) s, ([0-9]+) s of processor time.*/\2 \1/p" "$2" | tail -n 1
}
# quietly COMMAND...: its output is kept, and shown if it fails.
quietly() {
  "$@" >"$folder/log" 2>&1 || {
    tail -n 60 "$folder/log" >&2
    echo "tests/build_cost.sh: failed: $*" >&2
    exit 1
  }
}

printf '%-34s %8s %8s %8s\n' "phase of $(git -C "$root" rev-parse --short "$commit")" \
  processor elapsed budget
clone=$(clean_clone)
cd "$clone"
quietly apps/demo.sh
read -r film film_elapsed <<<"$(numbers 'The film took' "$folder/log")"
read -r demo demo_elapsed <<<"$(numbers 'All took' "$folder/log")"
phase "apps/demo.sh until the film" "$film" "$film_elapsed" 260
phase "apps/demo.sh" "$demo" "$demo_elapsed" 400
quietly tests/run.sh
read -r build build_elapsed <<<"$(numbers 'Built after' "$folder/log")"
read -r run run_elapsed <<<"$(numbers 'Tested after' "$folder/log")"
phase "tests/run.sh after it: build" "$build" "$build_elapsed"
phase "tests/run.sh after it: tests" "$run" $((run_elapsed - build_elapsed))
phase "tests/run.sh after apps/demo.sh" $((build + run)) "$run_elapsed" 700
phase "both, from a clean clone" $((demo + build + run)) $((demo_elapsed + run_elapsed)) 1000
if $all; then
  rm -rf -- "$clone"
  cd "$(clean_clone)"
  quietly .ci/run
  sed 's/^/  /' "$folder/log"
  read -r ci ci_elapsed <<<"$(numbers 'passed: [0-9]+ stages in' "$folder/log")"
  phase ".ci/run" "$ci" "$ci_elapsed" 3000
fi
if $check && ((${#over[@]} > 0)); then
  echo "tests/build_cost.sh: over the budget by more than a fifth: ${over[*]}" >&2
  exit 1
fi
