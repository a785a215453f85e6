#!/usr/bin/env bash
# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#
# Installs missing packages, builds everything and runs the tests.
set -euo pipefail

usage() {
  cat <<'TEXT'
Usage: tests/run.sh [--preset NAME] [--target NAME]... [CTEST ARGUMENTS...]

Builds a preset of CMakePresets.json (default: tests) and runs its tests in parallel. The preset
tests adds the tests to build/release, which apps/demo.sh builds and users install; any other NAME
is built in build/NAME. With --target only these targets are built. Anything else is handed to
ctest, for example:
  tests/run.sh -R scan          only the tests whose name matches
  tests/run.sh -LE install      all but those labelled 'install'

Environment:
  PLAYPEN_NIGHTLY=1   run all cases, seeds and repetitions (docs/decisions/nightly.md)
  PLAYPEN_CACHE=off   do without ccache
TEXT
}

preset=tests
targets=()
while (($# > 0)); do
  case $1 in
    --help | -h)
      usage
      exit 0
      ;;
    --preset)
      preset=${2:?tests/run.sh: --preset needs a name}
      shift 2
      ;;
    --target)
      targets+=(--target "${2:?tests/run.sh: --target needs a name}")
      shift 2
      ;;
    *)
      break
      ;;
  esac
done

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$root"
apps/install_dependencies.sh build test

# shellcheck source=SCRIPTDIR/../apps/build_tools.sh
source apps/build_tools.sh
build=build/$preset
if [[ $preset == tests ]]; then build=build/release; fi
mkdir -p "$build"
configure_log=$build/configure.log
nightly=OFF
if [[ ${PLAYPEN_NIGHTLY:-0} != 0 ]]; then nightly=ON; fi
if ! cmake --preset "$preset" "-DPLAYPEN_NIGHTLY=$nightly" "${launcher[@]}" >"$configure_log" 2>&1; then
  cat "$configure_log" >&2
  echo "tests/run.sh: configuring preset '$preset' failed; the reason is above" >&2
  exit 1
fi
cmake --build "$build" --parallel "$jobs" "${targets[@]}"
count_processor_seconds
built=$processor_seconds
echo "Built after $SECONDS s, $built s of processor time."

# ThreadSanitizer of older compilers cannot place its memory if the kernel randomises addresses by
# more than 28 bits. It always can without randomisation.
run=()
if [[ $preset == tsan && $(cat /proc/sys/vm/mmap_rnd_bits 2>/dev/null || echo 28) -gt 28 ]]; then
  run=(setarch -R)
fi
# Test programs call setlocale(). Half of the world writes 0,5 for 0.5; this must not get into a
# file or onto a wire. Only numbers follow the locale; messages of the system stay English.
case $preset in
  asan) locale=cs_CZ ;;
  *) locale=de_DE ;;
esac
locales=$root/build/locales
if [[ ! -e $locales/$locale.UTF-8/LC_NUMERIC ]]; then
  mkdir -p "$locales"
  localedef -i "$locale" -f UTF-8 "$locales/$locale.UTF-8" >/dev/null 2>&1 || true
fi
if [[ -e $locales/$locale.UTF-8/LC_NUMERIC ]]; then
  unset LC_ALL
  export LOCPATH=$locales LC_NUMERIC=$locale.UTF-8
else
  echo "tests/run.sh: WARNING: the locale $locale.UTF-8 cannot be made (is the package 'locales'" \
    "installed?), so the tests run with a decimal point" >&2
fi

# Many tests wait for programs, sockets or a window, so run half a job more per processor.
status=0
"${run[@]}" ctest --preset "$preset" --parallel "$(($(nproc) + ($(nproc) + 1) / 2))" "$@" || status=$?
count_processor_seconds
echo "Tested after $SECONDS s, $((processor_seconds - built)) s of processor time in the tests."
exit "$status"
