# shellcheck shell=bash disable=SC2034  # other scripts use the variable
# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#
# Scripts that compare processor times with budgets read this file; it does nothing by itself.

# measure_machine: sets machine_percent: processor time of this machine for a fixed compilation, in
# percent of the time on the machine of the budgets (docs/decisions/build_time.md). The shortest of
# three counts.
measure_machine() {
  local budget_machine_ms=2500 shortest_ms=0 ms i
  for i in 1 2 3; do
    ms=$(
      TIMEFORMAT='%U %S'
      { time g++ -std=c++20 -O2 -c -o /dev/null "${BASH_SOURCE[0]%/*}/support/machine_reference.cpp"; } 2>&1 |
        awk '{ printf "%d", 1000 * ($1 + $2) }'
    )
    if ((shortest_ms == 0 || ms < shortest_ms)); then shortest_ms=$ms; fi
  done
  machine_percent=$((100 * shortest_ms / budget_machine_ms))
}
