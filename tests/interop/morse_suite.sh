#!/usr/bin/env bash
# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#
# Runs MORSE's own tests, unmodified, against `playpen serve`, and prints a table of the results.
set -euo pipefail

usage() {
  cat <<'TEXT'
Usage: tests/interop/morse_suite.sh --morse DIR --playpen COMMAND [NAME ...]

Runs the tests in testing/base of MORSE's source against `playpen serve`, over Debian's pymorse
(python3-morse-simulator). It uses the ports 4000, 5000 and 60000 and up, and takes about ten minutes.
With names, only the test files run whose names contain one of them.

  --morse DIR        a checkout of https://github.com/morse-simulator/morse, for example of 1.4
  --playpen COMMAND  the command playpen
  --time FACTOR      pace of simulated time [1]. The tests sleep in simulated time, and expect that a command arrives
                     within some steps of 1/60 s: on a busy machine, a slower pace makes that true
TEXT
}

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
morse=
playpen=
while (($# > 0)); do
  case $1 in
    --help | -h)
      usage
      exit 0
      ;;
    --morse) morse=${2:?--morse needs a folder} ;;
    --playpen) playpen=${2:?--playpen needs a command} ;;
    --time) export MORSE_SUITE_TIME=${2:?--time needs a factor} ;;
    *) break ;;
  esac
  shift 2
done
if [[ -z $morse || -z $playpen ]]; then
  usage >&2
  echo 'morse_suite: --morse and --playpen are needed' >&2
  exit 2
fi
exec /usr/bin/python3 "$here/morse_suite/run.py" "$playpen" "$(cd "$morse" && pwd)" "$@"
