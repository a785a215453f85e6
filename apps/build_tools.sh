# shellcheck shell=bash disable=SC2034  # other scripts use the variables
# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#
# What the scripts that build Playpen share. They read this file; it does nothing by itself.

# count_processor_seconds: sets processor_seconds to the processor time of this shell and of all
# programs that it has waited for, user and system [s].
count_processor_seconds() {
  local file
  file=$(mktemp)
  times >"$file"  # a pipe would run it in another process, which has waited for none
  processor_seconds=$(awk '{
    for (i = 1; i <= 2; ++i) { split($i, part, /[ms]/); sum += 60 * part[1] + part[2] }
  } END { printf "%d", sum + 0.5 }' "$file")
  rm -f -- "$file"
}

# launcher: options for CMake that make a compiler cache work, if one is installed and
# PLAYPEN_CACHE is not "off". Without precompiled headers, because ccache cannot store what used one.
launcher=()
if [[ ${PLAYPEN_CACHE:-} != off ]] && command -v ccache >/dev/null 2>&1; then
  launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache -DPLAYPEN_PCH=)
fi

# jobs: compilations at a time: one a processor, but each needs up to 2.2 GB of memory.
memory_kb=$(awk '/^MemAvailable:/ { print $2 }' /proc/meminfo)
jobs=$((${memory_kb:-0} / 2300000))
if ((jobs > $(nproc))); then jobs=$(nproc); fi
if ((jobs < 1)); then jobs=1; fi
