#!/usr/bin/env bash
# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#
# Runs the tests of golden hashes on machines that are emulated: processors of the x86-64 family
# without and with newer instructions, with the C library of another release, and AArch64 with
# another build of everything. Prints a table.
set -Eeuo pipefail

usage() {
  cat <<'TEXT'
Usage: tests/machines.sh [--x86-only]

Builds the tests of the elementary functions and of the shipped worlds (preset tests), and runs them
as they are, with the C library's functions for older processors, in QEMU's models of processors, and
with the C and C++ libraries of Debian 13 (build/trixie_root). The latter must not be older than those
of this system. Then it compiles them for AArch64 against a root folder of Debian's packages
(build/aarch64_root), and runs them in QEMU. There the hashes of worlds in which Box2D takes part are not
compared, only since when it does (docs/trust.md). Stage asan of .ci/run runs them compiled by clang.

Installs what is missing: QEMU, and for AArch64 a cross compiler and mmdebstrap.
TEXT
}

x86_only=false
case ${1:-} in
  "") ;;
  --x86-only) x86_only=true ;;
  --help | -h)
    usage
    exit 0
    ;;
  *)
    usage >&2
    exit 2
    ;;
esac

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$root"
apps/install_dependencies.sh build test machines
# shellcheck source=SCRIPTDIR/../apps/build_tools.sh
source apps/build_tools.sh

tests=(sim_math_test sim_golden_worlds_test)
mkdir -p build
log=build/machines.log
: >"$log"
trap 'tail -n 50 "$log" >&2' ERR
failed=0

# row NAME COMMAND...: runs the programs by a command that gets the call of a test as its last arguments.
row() {
  local name=$1 result=equal call output
  shift
  echo "--- $name" >>"$log"
  for call in "${calls[@]}"; do
    # shellcheck disable=SC2086  # a call is several words
    if ! output=$("$@" $call --gtest_brief=1 \
      --gtest_filter='MathTest.Bits_*:MathTest.Calls*:GoldenWorlds.*' 2>&1); then
      result=DIFFERENT
    elif grep -qE 'SKIPPED|PASSED  \] 0 ' <<<"$output"; then
      result="NOT TESTED"
    fi
    printf '%s\n' "$output" >>"$log"
  done
  if [[ $result != equal ]]; then failed=1; fi
  printf '%-66s %s\n' "$name" "$result"
}

# make_root FOLDER RELEASE PACKAGES [OPTION...]: unpacks Debian packages into a folder that is missing.
make_root() {
  local folder=$1 release=$2 packages=$3 link
  if [[ -d $folder ]]; then return; fi
  rm -rf -- "$folder.part"
  mmdebstrap --variant=extract --include="$packages" "${@:4}" "$release" "$folder.part" >>"$log" 2>&1
  # Some links of the packages begin at the root of their system.
  find "$folder.part" -type l -lname '/*' -print0 | while IFS= read -r -d '' link; do
    ln -sfnr "$folder.part$(readlink "$link")" "$link"
  done
  mv -- "$folder.part" "$folder"
}

targets=()
for test in "${tests[@]}"; do targets+=(--target "$test"); done

folder=build/release
pattern="^($(
  IFS='|'
  echo "${tests[*]}"
))\$"
tests/run.sh "${targets[@]}" -R "$pattern" >>"$log" 2>&1
mapfile -t calls < <(ctest --test-dir "$folder" -R "$pattern" --show-only=json-v1 |
  python3 -c 'import json, sys
for test in json.load(sys.stdin)["tests"]: print(*test["command"])')
row "gcc, -O3, this processor" env
row "gcc, -O3, without AVX2, FMA and AVX-512 in the C library" \
  env GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4,-AVX512F
for model in qemu64 Nehalem max; do
  row "gcc, -O3, QEMU's processor $model" qemu-x86_64-static -cpu "$model"
done

# The other libraries, such as Box2D, are those of this system.
newer=$root/build/trixie_root
make_root "$newer" trixie libc6,libstdc++6,libgcc-s1
libraries=$newer/usr/lib/x86_64-linux-gnu
loader=$libraries/ld-linux-x86-64.so.2
version=$("$loader" --version | sed -nE '1s/.*GLIBC ([0-9.]+).*/\1/p')
row "gcc, -O3, C and C++ library of Debian 13 (glibc $version)" "$loader" --library-path "$libraries"

if ! $x86_only; then
  sysroot=$root/build/aarch64_root
  packages=$(apps/install_dependencies.sh --list build | grep -E -- '-dev$' | paste -sd,)
  make_root "$sysroot" bookworm "$packages,libgtest-dev,libgmock-dev,libc6-dev,libstdc++-12-dev" \
    --architectures=arm64
  folder=build/machines/aarch64
  libraries=$sysroot/usr/lib/aarch64-linux-gnu
  cmake --preset release -B "$folder" -DPLAYPEN_BUILD_TESTS=ON "${launcher[@]}" \
    -DCMAKE_SYSTEM_NAME=Linux -DCMAKE_SYSTEM_PROCESSOR=aarch64 "-DCMAKE_SYSROOT=$sysroot" \
    -DCMAKE_C_COMPILER=aarch64-linux-gnu-gcc -DCMAKE_CXX_COMPILER=aarch64-linux-gnu-g++ \
    -DCMAKE_LIBRARY_ARCHITECTURE=aarch64-linux-gnu "-DCMAKE_FIND_ROOT_PATH=$sysroot" \
    -DCMAKE_FIND_ROOT_PATH_MODE_PROGRAM=NEVER -DCMAKE_FIND_ROOT_PATH_MODE_LIBRARY=ONLY \
    -DCMAKE_FIND_ROOT_PATH_MODE_INCLUDE=ONLY -DCMAKE_FIND_ROOT_PATH_MODE_PACKAGE=ONLY \
    "-DCMAKE_EXE_LINKER_FLAGS=-Wl,-rpath-link,$libraries:$libraries/blas:$libraries/lapack -Wl,--unresolved-symbols=ignore-in-shared-libs" \
    >>"$log" 2>&1
  cmake --build "$folder" --parallel "$jobs" "${targets[@]}" >>"$log" 2>&1
  calls=("${tests[@]/#/$folder/bin/}")
  row "gcc, -O3, AArch64 in QEMU, but for the bits of Box2D" qemu-aarch64-static -L "$sysroot"
fi

if ((failed)); then
  echo "what differs is in $log"
  exit 1
fi
