#!/usr/bin/env bash
# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#
# Builds the real Player and Stage from their sources, as peers for the scripts of this folder.
set -euo pipefail

usage() {
  cat <<'TEXT'
Usage: tests/interop/build_peers.sh --prefix DIR [--player DIR] [--stage DIR]

Builds Player 3.1 (github.com/playerproject/player) and Stage 4.3 (github.com/rtv/Stage) from
checkouts of their sources, and installs them below the prefix. Neither becomes part of Playpen.

  --prefix DIR  where to install; the builds lie in DIR/build
  --player DIR  Player's sources (default: clone them into DIR/source/player)
  --stage DIR   Stage's sources (default: clone them into DIR/source/stage)

Debian 12's packages for both:
  apt-get install g++ make cmake python3 flex bison libltdl-dev libtirpc-dev libjpeg-dev \
    libgtk2.0-dev libfltk1.3-dev fluid libglu1-mesa-dev libpng-dev
TEXT
}

prefix=
player=
stage=
while (($# > 0)); do
  case $1 in
    --help | -h)
      usage
      exit 0
      ;;
    --prefix) prefix=${2:?--prefix needs a folder} ;;
    --player) player=${2:?--player needs a folder} ;;
    --stage) stage=${2:?--stage needs a folder} ;;
    *)
      usage >&2
      printf 'build_peers: unknown argument: %s\n' "$1" >&2
      exit 2
      ;;
  esac
  shift 2
done
if [[ -z $prefix ]]; then
  usage >&2
  echo 'build_peers: --prefix is missing' >&2
  exit 2
fi
mkdir -p "$prefix/build/player" "$prefix/build/stage" "$prefix/source"
prefix=$(cd "$prefix" && pwd)

# sources FOLDER REPOSITORY NAME: prints the folder of the sources, which are cloned if none is given.
sources() {
  if [[ -n $1 ]]; then
    (cd "$1" && pwd)
    return
  fi
  if [[ ! -d $prefix/source/$3 ]]; then git clone --depth 1 "$2" "$prefix/source/$3" >&2; fi
  printf '%s\n' "$prefix/source/$3"
}
player=$(sources "$player" https://github.com/playerproject/player player)
stage=$(sources "$stage" https://github.com/rtv/Stage stage)

# Both are older than C++17, and mix up what newer compilers keep apart. Player's client library looks
# for Boost.Signals, which Boost no longer has; it can do without.
flags='-std=gnu++14 -fpermissive -w -I/usr/include/tirpc'
cd "$prefix/build/player"
cmake "$player" -DCMAKE_BUILD_TYPE=Release -DCMAKE_INSTALL_PREFIX="$prefix" \
  -DCMAKE_CXX_FLAGS="$flags" -DCMAKE_C_FLAGS='-fcommon -w -I/usr/include/tirpc' \
  -DBUILD_PLAYERCC_BOOST=OFF -DBUILD_PYTHONC_BINDINGS=OFF -DBUILD_EXAMPLES=OFF
# Drivers of rare hardware may not compile; what the scripts need is checked at the end.
make -k -j "$(nproc)" install || true

cd "$prefix/build/stage"
export PKG_CONFIG_PATH=$prefix/lib/pkgconfig:$prefix/lib64/pkgconfig
cmake "$stage" -DCMAKE_BUILD_TYPE=Release -DCMAKE_INSTALL_PREFIX="$prefix" \
  -DCMAKE_CXX_FLAGS="$flags" -DOpenGL_GL_PREFERENCE=LEGACY
make -k -j "$(nproc)" install || true

# Player's own tests of its C++ library, which its build only makes with Boost. Files that the build does
# not name are for interfaces of older versions.
read -ra client_flags <<<"$(pkg-config --cflags --libs playerc++)"
tests=$player/client_libs/libplayerc++/test
mapfile -t test_sources < <(grep -oE '\btest(_[a-z0-9_]+)?\.cc' "$tests/CMakeLists.txt" | sort -u)
g++ -std=gnu++14 -fpermissive -w -I"$tests" -I"$prefix/build/player" \
  "${test_sources[@]/#/$tests/}" -o "$prefix/bin/playercpp_test" \
  "${client_flags[@]}" -Wl,-rpath,"$prefix/lib" ||
  echo 'build_peers: the tests of the C++ library do not compile' >&2

missing=()
for file in bin/player bin/playerprint bin/playerv bin/playercpp_test bin/stage lib/stageplugin.so; do
  [[ -e $prefix/$file || -e ${prefix}/${file/lib\//lib64/} ]] || missing+=("$file")
done
if ((${#missing[@]} > 0)); then
  printf 'build_peers: not built: %s\n' "${missing[*]}" >&2
  exit 1
fi
echo "Player and Stage are in $prefix"
