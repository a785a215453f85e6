#!/usr/bin/env bash
# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#
# Checks the scripts of the replay page: ESLint, then their unit tests with Node.js.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

viewer=apps/playpen/replay/viewer
# Debian's ESLint finds its own modules here, even if Node.js is not Debian's.
export NODE_PATH=/usr/share/nodejs
lint() { eslint --no-eslintrc --config tests/lint/eslintrc.json --format unix "$@"; }
# Each script of the page defines one name, which the others use.
globals=$(sed -nE 's/^const ([A-Z][a-z]+) = \(function \(\) \{$/\1/p' "$viewer"/*.js | paste -sd,)
lint --env browser --global "$globals,DecompressionStream" "$viewer"
lint --env node,browser --global DecompressionStream tests/page

for test in tests/page/*_test.js; do node "$test"; done
