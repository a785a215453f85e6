#!/usr/bin/env bash
# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#
# Makes the pictures of the README and the documentation anew.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
cd "$root"
cmake --preset dev >/dev/null
cmake --build build/dev --target playpen docs_thirteen par_intro_solution_wall
bin=build/dev/bin
out=out/pictures
"$bin/playpen" run worlds/examples/thirteen_robots.json --duration 9 --out "$out/thirteen" --quiet \
  -- "$bin/docs_thirteen"
"$bin/playpen" run worlds/tasks/par_intro.json --duration 120 --out "$out/wall" --quiet \
  -- "$bin/par_intro_solution_wall"
cp "$out/thirteen/scene.png" docs/images/thirteen_robots.png
cp "$out/wall/scene.png" docs/images/wall_follower.png
echo "docs/images/thirteen_robots.png, docs/images/wall_follower.png"
