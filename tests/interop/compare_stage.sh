#!/usr/bin/env bash
# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#
# Compares Playpen with real Stage, for the worlds that Stage ships: ranges from the same poses, and where
# robots get to by the same commands.
set -euo pipefail

usage() {
  cat <<'TEXT'
Usage: tests/interop/compare_stage.sh --prefix DIR --build DIR [OPTIONS] [WORLD...]

For each world: stage_scans.cc, a program with real Stage's library, puts up to three robots at random
places, and writes what their rangers measure. `playpen import` reads the same world, and
compare_stage.cc measures at the same places and drives with the same commands; it says when a beam agrees.
Controllers (ctrl) and cameras are removed from the worlds, and noise is switched off in Stage.

  --prefix DIR     as for build_peers.sh
  --build DIR      build folder of Playpen (for example build/dev)
  --worlds DIR     Stage's folder of worlds (default: DIR/share/stage/worlds of the prefix)
  --out DIR        where scans and imported worlds go (default: ./compare_stage)
  --poses N        poses of a world (default: 100)
  --seed N         of the random places (default: 1)
  --resolution M   cells of Stage's raster [m] instead of those of the world; ranges are still compared with
                   the world's cells. Small cells show how much of the difference comes from the raster.
  --list N         print the first N beams of a world that differ
  --imported FILE  compare the world with this world file of Playpen instead of importing it
TEXT
}

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$here/../.." && pwd)
prefix=
build=
worlds=
out=compare_stage
poses=100
seed=1
resolution=
imported=
list=0
names=()
while (($# > 0)); do
  case $1 in
    --help | -h)
      usage
      exit 0
      ;;
    --prefix) prefix=${2:?--prefix needs a folder} ;;
    --build) build=${2:?--build needs a folder} ;;
    --worlds) worlds=${2:?--worlds needs a folder} ;;
    --out) out=${2:?--out needs a folder} ;;
    --poses) poses=${2:?--poses needs a number} ;;
    --seed) seed=${2:?--seed needs a number} ;;
    --resolution) resolution=${2:?--resolution needs a number} ;;
    --list) list=${2:?--list needs a number} ;;
    --imported) imported=$(realpath "${2:?--imported needs a file}") ;;
    --*)
      usage >&2
      printf 'compare_stage: unknown argument: %s\n' "$1" >&2
      exit 2
      ;;
    *)
      names+=("$(basename "$1" .world)")
      shift
      continue
      ;;
  esac
  shift 2
done
if [[ -z $prefix || -z $build ]]; then
  usage >&2
  echo 'compare_stage: --prefix and --build are needed' >&2
  exit 2
fi
prefix=$(cd "$prefix" && pwd)
build=$(cd "$build" && pwd)
worlds=${worlds:-$prefix/share/stage/worlds}
mkdir -p "$out"
out=$(cd "$out" && pwd)
rm -rf "$out/worlds"
mkdir "$out/worlds"
cp -r "$worlds/." "$out/worlds"
# Robots must stay where they are put. Stage's cameras do not work without its window.
python3 - "$out/worlds"/*.world "$out/worlds"/*.inc <<'PYTHON'
import re
import sys

for name in sys.argv[1:]:
    with open(name, encoding="latin-1") as file:
        text = file.read()
    text = re.sub(r'(?m)^([^#\n]*)\bctrl\s+"[^"]*"', r"\1", text)
    text = re.sub(r"(?m)^([^#\n]*)\bcamera\s*\((?:[^()]|\([^()]*\))*\)", r"\1", text)
    with open(name, "w", encoding="latin-1") as file:
        file.write(text)
PYTHON
if ((${#names[@]} == 0)); then
  for file in "$out/worlds"/*.world; do names+=("$(basename "$file" .world)"); done
fi

export PKG_CONFIG_PATH=$prefix/lib/pkgconfig:$prefix/lib64/pkgconfig
read -ra stage_flags <<<"$(pkg-config --cflags stage)"
g++ -std=gnu++14 -O1 -fpermissive -fno-access-control -w "${stage_flags[@]}" "$here/stage_scans.cc" -o "$out/stage_scans" \
  -L"$prefix/lib" -L"$prefix/lib64" -lstage -Wl,-rpath,"$prefix/lib:$prefix/lib64"
read -ra eigen_flags <<<"$(pkg-config --cflags eigen3)"
g++ -std=c++20 -O2 "${eigen_flags[@]}" -I"$root/libsim/include" "$here/compare_stage.cc" \
  -o "$out/compare_stage" "$build/libsim/libplaypen_sim.so" -Wl,-rpath,"$build/libsim"

failed=0
for name in "${names[@]}"; do
  world=$out/worlds/$name.world
  printf '== %s\n' "$name"
  if [[ -n $resolution ]]; then
    cp "$world" "$out/worlds/$name.fine.world"
    sed -i -E "s/^([^#]*)\bresolution[[:space:]]+[0-9.]+/\1resolution $resolution/" \
      "$out/worlds/$name.fine.world"
  fi
  if ! (cd "$out/worlds" && timeout 300 "$out/stage_scans" \
    "$name${resolution:+.fine}.world" "$poses" "$seed") >"$out/$name.txt" 2>"$out/$name.stage.err"; then
    printf 'Stage does not run it: %s\n' "$(tail -n 1 "$out/$name.stage.err")"
    continue
  fi
  if [[ -n $resolution ]]; then
    own=$(sed -nE 's/^[^#]*\bresolution[[:space:]]+([0-9.]+).*/\1/p' "$world" | head -n 1)
    sed -i "s/^resolution .*/resolution ${own:-0.02}/" "$out/$name.txt"
  fi
  if ! grep -q '^pose' "$out/$name.txt"; then
    echo 'no robot with a ranger'
    continue
  fi
  if [[ -n $imported ]]; then
    file=$out/worlds/$(basename "$imported")  # its pictures are Stage's
    cp "$imported" "$file"
  else
    config=()
    [[ -f $out/worlds/$name.cfg ]] && config=("$out/worlds/$name.cfg")
    if ! "$build/bin/playpen" import "$world" "${config[@]}" --out "$out/imported/$name" \
      >"$out/$name.import.txt" 2>&1; then
      printf 'Playpen does not import it: %s\n' "$(tail -n 1 "$out/$name.import.txt")"
      failed=1
      continue
    fi
    file=$(find "$out/imported/$name" -name '*.json' ! -name '*.model.json' | head -n 1)
  fi
  timeout 300 "$out/compare_stage" "$file" "$out/$name.txt" --list "$list" 2>"$out/$name.compare.err" || {
    printf 'not compared: %s\n' "$(tail -n 1 "$out/$name.compare.err")"
    failed=1
  }
done
exit "$failed"
