#!/usr/bin/env bash
# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#
# Makes the Debian packages of a build folder and checks them. See usage().
set -euo pipefail

usage() {
  cat <<'TEXT'
Usage: tests/install/deb.sh BUILD FOLDER

Makes the packages of the build folder BUILD (target `package`), which compiles nothing that is built already,
and checks them: lintian reports no error, the packages hold what they should, and unpacked into FOLDER
they serve a student, who makes a project, builds it and has it graded. Then it installs from BUILD into
FOLDER, and the target `uninstall` leaves nothing of that. It needs no rights, and installs nothing in the
system. FOLDER is emptied first. Needs the packages of `apps/install_dependencies.sh package`.
TEXT
}
if (($# != 2)) || [[ $1 == -* || $2 == -* ]]; then
  usage >&2
  exit 2
fi

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
build=$(cd "$1" && pwd)
rm -rf -- "$2"
mkdir -p -- "$2/home"
folder=$(cd "$2" && pwd)
fail() {
  printf 'deb: %s\n' "$@" >&2
  exit 1
}
headline() { printf '\n##### %s\n' "$*"; }

headline "The packages"
cmake --build "$build" --target package
shopt -s nullglob
debs=("$build"/packages/playpen_*.deb "$build"/packages/playpen-dev_*.deb)
tarballs=("$build"/packages/playpen-*.tar.gz)
((${#debs[@]} == 2 && ${#tarballs[@]} == 1)) ||
  fail "expected two .deb and one .tar.gz in $build/packages:" "$(ls "$build/packages")"
lintian --fail-on error --tag-display-limit 0 "${debs[@]}"

headline "What they hold"
for deb in "${debs[@]}"; do
  dpkg-deb --info "$deb"
  dpkg-deb --fsys-tarfile "$deb" | tar -t | grep -v '/$' | sort >"$folder/$(basename "${deb%%_*}").list"
done
both=$(comm -12 "$folder/playpen.list" "$folder/playpen-dev.list")
[[ -z $both ]] || fail "files that are in both packages:" "$both"
libraries=./usr/lib/$(dpkg-architecture -q DEB_HOST_MULTIARCH)
# holds PACKAGE FILE...
holds() {
  local file
  for file in "${@:2}"; do
    grep -qxF -- "$file" "$folder/$1.list" || fail "$1 has no $file:" "$(<"$folder/$1.list")"
  done
}
holds playpen ./usr/bin/playpen ./usr/bin/playpen-page ./usr/bin/playpen-view "$libraries/libplaypen_playerlike.so.0.1" \
  "$libraries/libplaypen_batch.so.0.1" ./usr/share/playpen/docs/examples/playpen_gym.py \
  ./usr/share/playpen/docs/examples/playpen_client.py \
  "$libraries/playpen/libplaypen_virtual_time.so" ./usr/share/playpen/worlds/cave.json \
  ./usr/share/playpen/templates/intro/robot.cc ./usr/share/man/man1/playpen.1.gz \
  ./usr/share/bash-completion/completions/playpen ./usr/share/playpen/docs/start_here.md \
  ./usr/share/doc/playpen/docs ./usr/share/doc/playpen/copyright
holds playpen-dev ./usr/include/playpen/libplayerc++/playerc++.h "$libraries/libplayerc++.so" \
  "$libraries/libplaypen_playerlike.so" "$libraries/cmake/playpen/playpenConfig.cmake" \
  "$libraries/pkgconfig/playerc++.pc" ./usr/include/playpen/playpen_batch.h \
  "$libraries/libplaypen_batch.so" "$libraries/pkgconfig/playpen_batch.pc"
strays=$(grep -vE "^\./usr/(bin|include|share)/|^$libraries/" "$folder"/playpen{,-dev}.list || true)
[[ -z $strays ]] || fail "files in places that the packages should not use:" "$strays"
dependencies=$(dpkg-deb --field "${debs[0]}" Depends)
[[ $dependencies == *libc6\ \(\>=* && $dependencies == *libbox2d* && $dependencies == *libopencv-imgproc* && $dependencies == *libavformat* ]] ||
  fail "dependencies are missing: $dependencies"

headline "A student, without rights"
for deb in "${debs[@]}"; do dpkg-deb --extract "$deb" "$folder/root"; done
size_kb=$(du --summarize --apparent-size --block-size=1000 "$folder/root" | cut -f 1)
echo "unpacked: $size_kb kB; packed: $(du --total --apparent-size --block-size=1000 "${debs[@]}" | tail -n 1)"
((size_kb <= 65000)) || fail "the packages unpack to $size_kb kB, more than 65 MB"
unset PKG_CONFIG_PATH CMAKE_PREFIX_PATH CPATH LIBRARY_PATH LD_LIBRARY_PATH PLAYPEN_LIBRARIES
export HOME=$folder/home
# With shared libraries, the loader does not know this folder; of an installed package it does.
export LD_LIBRARY_PATH=$folder/root/${libraries#./}
cd "$HOME"
playpen=$folder/root/usr/bin/playpen
readelf -d "$playpen" | grep -E 'R(UN)?PATH' && fail "the command has a path of its own to libraries"
"$playpen" --version
[[ $("$playpen" doc --names) == *$'\nstart_here\n'* ]] || fail "'playpen doc' does not list start_here"
"$playpen" doc start_here | cmp - "$folder/root/usr/share/doc/playpen/docs/start_here.md"
"$playpen" new intro robot
"$here/fill_intro.sh" robot/robot.cc
# The commands of its README: indented lines before the first paragraph.
mapfile -t commands < <(sed -n 's/^    //p' robot/README.md | head -n 3)
[[ ${commands[0]} == 'cmake -S . -B build && cmake --build build' && ${commands[2]} == 'playpen grade '* ]] ||
  fail "the project's README begins with other commands:" "${commands[@]}"
(
  cd robot
  PATH=$folder/root/usr/bin:$PATH
  for command in "${commands[@]}"; do
    printf -- '--- %s\n' "$command"
    eval "$command" || fail "failed: $command"
  done
)
grep -q "^playpen_DIR:PATH=$folder/root/" robot/build/CMakeCache.txt || fail "CMake found another Playpen"
# Pictures: text and the modules are found below lib/ of this kind of machine.
[[ -s robot/out/par_intro/scene.png ]] || fail "the run left no picture"
"$playpen" run cave --duration 1 --record film.mp4 --out film -- robot/build/par_intro_template
[[ -s film.mp4 ]] || fail "the run left no film"
export PKG_CONFIG_LIBDIR=$folder/root/${libraries#./}/pkgconfig
mkdir flags && cp "$folder/root/usr/share/playpen/templates/client/main.cc" flags
# shellcheck disable=SC2046  # pkg-config's words are flags
g++ flags/main.cc $(pkg-config --cflags --libs playerc++) -o flags/wander
"$playpen" run cave --duration 5 --out flags/out -- flags/wander | grep '5.0 s simulated'
# shellcheck disable=SC2046  # pkg-config's words are flags
gcc "$folder/root/usr/share/playpen/docs/examples/many_robots.c" \
  $(pkg-config --cflags --libs playpen_batch) -o flags/many_robots
flags/many_robots "$folder/root/usr/share/playpen/worlds/syrotek.json" | grep '^64 robots'

"$playpen" new test tested
cmake -S tested -B tested/build
cmake --build tested/build
ctest --test-dir tested/build --output-on-failure --no-tests=error

headline "Installed and removed again"
cmake --install "$build" --prefix "$folder/prefix" >/dev/null
"$folder/prefix/bin/playpen" doc laser >/dev/null
cmake --build "$build" --target uninstall
[[ ! -e $folder/prefix ]] || fail "these are left:" "$(find "$folder/prefix")"
if cmake --build "$build" --target uninstall >"$folder/again.log" 2>&1; then
  fail "a second uninstall should be an error"
fi
grep -q 'Nothing is installed from this build folder' "$folder/again.log" || cat "$folder/again.log"
[[ $(tar --list --gzip --file "${tarballs[0]}") == */lib/pkgconfig/playerc++.pc* ]] ||
  fail "the tarball has no lib/pkgconfig/playerc++.pc"
headline "The packages are good"
