#!/usr/bin/env python3
# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
"""Counts the instructions of steps, scans, reads and more, and compares them with instructions.json.

Unlike times, they do not depend on the machine's load. valgrind runs the program twice, so that what
it does at its start cancels out. A count that differs by more than 3 % is an error: if it is more,
find the cause; if it is less, or the cause is wanted, write the file again.

Usage: instructions.py PROGRAM [--write]
"""
import json
import re
import subprocess
import sys
from pathlib import Path

FILE = Path(__file__).with_name("instructions.json")
TOLERANCE = 0.03
# How often each work is done, in the two runs.
TIMES = {"beams": (100, 300), "pixels": (100, 300), "read": (200, 600), "save": (10, 30),
         "many": (200, 600), "many_180": (200, 600), "scan": (200, 600), "sonar_rings": (100, 300), "step": (2000, 6000),
         "wandering_step": (200, 600)}


def instructions(program, work, times):
    """Of a whole run of the program."""
    run = subprocess.run(
        ["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null", program, work, str(times)],
        capture_output=True, text=True)
    found = re.search(r"Collected : (\d+)", run.stderr)
    if run.returncode != 0 or not found:
        sys.exit(f"instructions.py: {work} failed under valgrind:\n{run.stderr}")
    return int(found[1])


def main():
    if len(sys.argv) not in (2, 3) or sys.argv[2:] not in ([], ["--write"]):
        sys.exit(__doc__)
    expected = json.loads(FILE.read_text()) if FILE.exists() else {}
    counted = {}
    wrong = []
    for work, (few, many) in TIMES.items():
        more = instructions(sys.argv[1], work, many) - instructions(sys.argv[1], work, few)
        counted[work] = round(more / (many - few))
        known = expected.get(work)
        change = "" if known is None else f"{counted[work] / known - 1:+7.1%}"
        print(f"{work:16} {counted[work]:9} instructions, {known or 'none':>9} in the file {change}")
        if known is None or abs(counted[work] / known - 1) > TOLERANCE:
            wrong.append(work)
    if sys.argv[2:]:
        FILE.write_text(json.dumps(counted, indent=2) + "\n")
    elif wrong:
        sys.exit(f"instructions.py: more than {TOLERANCE:.0%} from {FILE.name}: {', '.join(wrong)}")


main()
