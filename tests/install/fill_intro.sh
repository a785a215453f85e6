#!/usr/bin/env bash
# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#
# Fills in the template of the introduction task, so that it passes: fill_intro.sh FOLDER/robot.cc
set -euo pipefail

if (($# != 1)) || [[ $1 == -* ]]; then
  echo "Usage: tests/install/fill_intro.sh FILE" >&2
  exit 2
fi
# The body of the function that the template leaves to the reader.
awk '
  /^void CRobot::decideSpeeds\(\) \{/ {
    print
    print "  double left = laser->GetMaxRange(), right = left;"
    print "  for (unsigned i = 0; i < laser->GetCount(); ++i) {"
    print "    const double bearing = laser->GetBearing(i);"
    print "    if (bearing < -0.9 || bearing > 0.9) continue;"
    print "    double& side = bearing < 0 ? right : left;"
    print "    if ((*laser)[i] < side) side = (*laser)[i];"
    print "  }"
    print "  const bool close = left < 0.3 || right < 0.3;"
    print "  forwardSpeed = close ? 0.0 : 0.3;"
    print "  if (!close) turnRate = 0.0;"
    print "  if (close && turnRate == 0.0) turnRate = left < right ? -1.0 : 1.0;"
    print "}"
    skip = 1
    found = 1
  }
  !skip { print }
  /^\}/ { skip = 0 }
  END { exit !found }' "$1" >"$1.filled" || {
  echo "fill_intro: $1 has no decideSpeeds()" >&2
  exit 1
}
mv -- "$1.filled" "$1"
