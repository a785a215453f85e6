#!/usr/bin/env bash
# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#
# Clones a checkout into a folder, including its uncommitted changes. An existing clone is updated
# and keeps its build folders.
set -euo pipefail

if (($# != 2)) || [[ $1 == -* ]]; then
  echo "Usage: tests/install/clone.sh CHECKOUT FOLDER" >&2
  exit 2
fi
from=$1 to=$2

[[ -d $to/.git ]] || git clone --quiet -- "$from" "$to"
from=$(cd "$from" && pwd)
to=$(cd "$to" && pwd)

# Touches only files that differ, so that nothing else has to be built again.
git -C "$from" ls-files -z -co --exclude-standard | while IFS= read -r -d '' file; do
  if [[ -f $from/$file ]] && ! cmp -s -- "$from/$file" "$to/$file"; then
    mkdir -p -- "$(dirname -- "$to/$file")"
    cp -- "$from/$file" "$to/$file"
  fi
done
git -C "$to" ls-files -z -co --exclude-standard | while IFS= read -r -d '' file; do
  if [[ ! -e $from/$file ]]; then rm -f -- "$to/$file"; fi
done
