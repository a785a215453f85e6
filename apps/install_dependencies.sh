#!/usr/bin/env bash
# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#
# Installs the missing Debian or Ubuntu packages that Playpen needs. No other file names them;
# docs/decisions/dependencies.md explains why each is needed.
set -euo pipefail

usage() {
  cat <<'TEXT'
Usage: apps/install_dependencies.sh [--list] [GROUP...]

Installs what is missing of the groups, from Debian or Ubuntu packages (Debian 12, Ubuntu 22.04
or newer). Does nothing, and needs no rights, when all of it is there.

Groups (default: build):
  build   compiler, CMake, make and pkg-config, and the libraries that Playpen links
  test    GoogleTest, Google Benchmark, ffprobe, which looks at films, gdb, valgrind, a display
          without a screen for the live window, Python, locales with a decimal comma, and, where
          they can be had, MORSE's client library, Boost.Program_options and NumPy
  lint    clang, its formatter and linter, shellcheck
  page    Node.js and ESLint, for the scripts of the replay page
  browser Chromium and its driver, where they can be had, for the nightly test of that page
  doc     Doxygen
  cluster Slurm, GNU parallel and an ssh server, for the nightly test of playpen batch
  machines QEMU, a cross compiler and mmdebstrap, to run tests as on other machines
  package what the target `package` needs to make and check Debian packages

  --list  print the names of the groups' packages, one a line, and install nothing
  --help  print this
TEXT
}

# One entry per package: its name, or name=command if any installed version of that command is
# sufficient, whatever its origin.
build_packages=(
  "g++=g++" cmake=cmake ninja-build=ninja make=make pkg-config=pkg-config
  libbox2d-dev libeigen3-dev
  libopencv-core-dev libopencv-imgproc-dev libopencv-imgcodecs-dev libopencv-videoio-dev
  libopencv-highgui-dev libavformat-dev libavcodec-dev
  libx11-dev libpng-dev libjpeg-dev libfreetype-dev fonts-dejavu-core
  libasio-dev libboost-dev nlohmann-json3-dev libspdlog-dev libcli11-dev libyaml-cpp-dev zlib1g-dev
)
test_packages=(
  libgtest-dev libgmock-dev libbenchmark-dev locales ffmpeg=ffprobe gdb=gdb xvfb=Xvfb xdotool=xdotool
  valgrind=valgrind python3=python3 bubblewrap=bwrap
  libarchive-tools=bsdtar)
# If the system has no such package (Ubuntu 24.04 lacks the first), the tests that need it are
# skipped.
optional_test_packages=(python3-morse-simulator libboost-program-options-dev python3-numpy)
cluster_packages=(slurm-wlm=slurmd munge=munged parallel=parallel openssh-server=sshd)
lint_packages=(
  clang=clang clang-format=clang-format clang-tidy=clang-tidy shellcheck=shellcheck git=git)
page_packages=(nodejs=node eslint=eslint)
# Ubuntu has them as snaps only; then the test is skipped.
optional_browser_packages=(chromium chromium-driver)
doc_packages=(doxygen=doxygen)
machines_packages=(qemu-user-static=qemu-aarch64-static "g++-aarch64-linux-gnu=aarch64-linux-gnu-g++"
  mmdebstrap=mmdebstrap)
package_packages=(dpkg-dev=dpkg-shlibdeps file=file lintian=lintian)

fail() {
  printf 'install_dependencies: %s\n' "$@" >&2
  exit 1
}

# is_installed ENTRY
is_installed() {
  local package=${1%%=*} command="" PATH=$PATH:/usr/sbin
  [[ $1 == *=* ]] && command=${1#*=}
  if [[ -n $command ]] && command -v "$command" >/dev/null 2>&1; then return 0; fi
  [[ $(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null || true) == installed ]]
}

# missing_optional PACKAGE...: prints those that are not installed but known to apt, one per line.
missing_optional() {
  local package
  for package in "$@"; do
    if ! is_installed "$package" && apt-cache show "$package" >/dev/null 2>&1; then
      printf '%s\n' "$package"
    fi
  done
}

# The package that contains the sanitizer and fuzzer runtime of the packaged clang. Its name
# contains clang's version. In older releases (Ubuntu 22.04) the files are in another package, which
# clang depends on. Prints nothing if there is no such package, or if apt does not know it yet.
clang_runtime_package() {
  local depends version
  depends=$(dpkg-query -W -f '${Depends}' clang 2>/dev/null || true)
  if [[ -z $depends ]]; then
    depends=$(apt-cache show --no-all-versions clang 2>/dev/null | sed -n 's/^Depends: //p' || true)
  fi
  version=$(grep -oE '\bclang-[0-9]+' <<<"$depends" | head -n 1 | cut -d- -f2 || true)
  [[ -n $version ]] || return 0
  local package=libclang-rt-$version-dev
  if is_installed "$package" || apt-cache show "$package" >/dev/null 2>&1; then
    printf '%s\n' "$package"
  fi
}

clang_runtime_is_there() {
  command -v clang >/dev/null 2>&1 || return 1
  local found
  found=$(find "$(clang -print-resource-dir)/lib" -name 'libclang_rt.asan*.a' 2>/dev/null |
    head -n 1 || true)
  [[ -n $found ]]
}

list_only=false
groups=()
for argument in "$@"; do
  case $argument in
    --list) list_only=true ;;
    --help | -h)
      usage
      exit 0
      ;;
    build | test | cluster | lint | page | browser | doc | machines | package) groups+=("$argument") ;;
    *)
      usage >&2
      fail "unknown argument '$argument'"
      ;;
  esac
done
((${#groups[@]} > 0)) || groups=(build)

wanted=()
optional=()
with_lint=false
for group in "${groups[@]}"; do
  case $group in
    build) wanted+=("${build_packages[@]}") ;;
    test)
      wanted+=("${test_packages[@]}")
      optional+=("${optional_test_packages[@]}")
      ;;
    lint)
      wanted+=("${lint_packages[@]}")
      with_lint=true
      ;;
    cluster) wanted+=("${cluster_packages[@]}") ;;
    page) wanted+=("${page_packages[@]}") ;;
    browser) optional+=("${optional_browser_packages[@]}") ;;
    doc) wanted+=("${doc_packages[@]}") ;;
    machines) wanted+=("${machines_packages[@]}") ;;
    package) wanted+=("${package_packages[@]}") ;;
  esac
done

if $list_only; then
  printf '%s\n' "${wanted[@]%%=*}"
  for package in "${optional[@]}"; do
    if is_installed "$package" || [[ -n $(missing_optional "$package") ]]; then echo "$package"; fi
  done
  if $with_lint; then clang_runtime_package; fi
  exit 0
fi

if ! command -v apt-get >/dev/null 2>&1 || ! command -v dpkg-query >/dev/null 2>&1; then
  fail "this machine has no apt: install by hand what these Debian packages hold:" \
    "  ${wanted[*]%%=*}"
fi

missing=()
for entry in "${wanted[@]}"; do
  is_installed "$entry" || missing+=("${entry%%=*}")
done
mapfile -t missing_extras < <(missing_optional "${optional[@]}")
need_runtime=false
if $with_lint && ! clang_runtime_is_there; then need_runtime=true; fi
if ((${#missing[@]} + ${#missing_extras[@]} == 0)) && ! $need_runtime; then exit 0; fi

as_root=()
if ((EUID != 0)); then
  by_hand="$0 ${groups[*]}"
  command -v sudo >/dev/null 2>&1 ||
    fail "installing packages needs root, and there is no sudo. As root, run:" "  $by_hand"
  if ! sudo -n true 2>/dev/null; then
    [[ -t 0 ]] || fail "installing packages needs root, and sudo asks for a password, which" \
      "nobody can type here. Run this first:" "  sudo $by_hand"
    echo "Installing packages needs root; sudo may ask for your password." >&2
  fi
  as_root=(sudo)
fi
apt_get() {
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -qq \
    -o DPkg::Lock::Timeout=600 -o Acquire::Retries=3 "$@"
}

echo "Asking the package servers for their lists ..."
# A broken third-party source must not stop the script: only Playpen's packages have to be
# installable.
updated=true
apt_get update || updated=false

if $need_runtime; then
  runtime=$(clang_runtime_package)
  if [[ -n $runtime ]]; then missing+=("$runtime"); fi
fi
mapfile -t missing_extras < <(missing_optional "${optional[@]}")

unknown=()
for package in "${missing[@]}"; do
  apt-cache show "$package" >/dev/null 2>&1 || unknown+=("$package")
done
if ((${#unknown[@]} > 0)); then
  if $updated; then
    fail "this machine's package sources do not have: ${unknown[*]}" \
      "Playpen needs Debian 12 or Ubuntu 22.04, or newer (on Ubuntu, with 'universe' enabled)."
  fi
  fail "the package lists could not be fetched (see above): is there a network?" \
    "Still to be installed: ${missing[*]}"
fi

# install PACKAGE...
install() {
  echo "Installing $# packages: $*"
  apt_get install -y --no-install-recommends "$@" >/dev/null
}

if ((${#missing[@]} > 0)) && ! install "${missing[@]}"; then
  fail "apt-get could not install the packages (see above)." \
    "Common reasons: no network, a full disk, or an interrupted earlier installation," \
    "which 'dpkg --configure -a' (as root) mends. Still to be installed: ${missing[*]}"
fi
if ((${#missing_extras[@]} > 0)) && ! install "${missing_extras[@]}"; then
  echo "Without ${missing_extras[*]} a few tests are skipped." >&2
fi
echo "Packages are ready."
