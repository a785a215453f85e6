#!/usr/bin/env bash
# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#
# Builds the fuzzers and runs each for a while on its corpus.
set -euo pipefail

usage() {
  cat <<'TEXT'
Usage: tests/fuzz/run.sh [--program FILE] [SECONDS]

Builds the preset fuzz (clang, AddressSanitizer, UndefinedBehaviorSanitizer) and runs each fuzzer
for SECONDS (default: 20). What it starts from lies in tests/fuzz/corpus; what it discovers is kept
in build/fuzz/corpus, and a finding in build/fuzz/findings. Ends with 1 if there is any finding.

  --program FILE  run this fuzzer only, and build nothing
TEXT
}

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$here/../.." && pwd)
seconds=20
programs=()
while (($# > 0)); do
  case $1 in
    --help | -h)
      usage
      exit 0
      ;;
    --program)
      programs+=("${2:?tests/fuzz/run.sh: --program needs a file}")
      shift 2
      ;;
    *)
      seconds=$1
      shift
      ;;
  esac
done
if ! [[ $seconds =~ ^[1-9][0-9]*$ ]]; then
  usage >&2
  exit 2
fi

cd "$root"
if ((${#programs[@]} == 0)); then
  launcher=()
  if command -v ccache >/dev/null 2>&1; then
    launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache -DPLAYPEN_PCH=)
  fi
  cmake --preset fuzz "${launcher[@]}"
  cmake --build --preset fuzz
  programs=(build/fuzz/bin/fuzz_{lines,cbor,page,player,stage,world})
fi

failed=()
for program in "${programs[@]}"; do
  name=$(basename "$program")
  seeds=("$here/corpus/${name#fuzz_}")
  # The corpus of the world reader starts with every shipped world and every invalid test world.
  if [[ $name == fuzz_world ]]; then
    seeds+=(worlds/devices worlds/examples worlds/tasks tests/invalid_worlds)
  fi
  found=build/fuzz/findings/$name
  discovered=build/fuzz/corpus/$name
  mkdir -p "$found" "$discovered"
  echo "== $name, $seconds s"
  # A longer seed is truncated, so that small inputs are tried often.
  if ! ASAN_OPTIONS=detect_stack_use_after_return=1 UBSAN_OPTIONS=print_stacktrace=1 \
    "$program" -max_total_time="$seconds" -timeout=600 -rss_limit_mb=2048 -max_len=8192 \
    -print_final_stats=1 -verbosity=0 -artifact_prefix="$found/" "$discovered" "${seeds[@]}"; then
    failed+=("$name")
  fi
done

if ((${#failed[@]} > 0)); then
  echo "FOUND something: ${failed[*]}; to see it again: build/fuzz/bin/NAME FILE"
  ls -l build/fuzz/findings/*
  exit 1
fi
echo "found nothing in $seconds s each"
