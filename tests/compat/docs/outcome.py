#!/usr/bin/env python3
# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
"""Runs a program of a page and compares its outcome with what the page lets a reader expect.

    outcome.py OUTCOMES NAME PROGRAM [ARGUMENT...]

The program must end with status 0. OUTCOMES may have a section [NAME] with
    duration     of the run, in simulated seconds; 2 if it is not given
    world        a file in worlds/, instead of that of the page
    prints       regular expressions, one a line. Each must match a whole line of the output; their
                 order is that of the lines
    path_length  least and greatest path of the first robot [m], from report.json in the program's
                 output folder
"""
import configparser
import json
import os
import pathlib
import re
import subprocess
import sys


def main(file, name, *command):
    outcomes = configparser.RawConfigParser()
    outcomes.read(file, encoding="utf-8")
    expected = outcomes[name] if name in outcomes else {}
    environment = {**os.environ, "PLAYPEN_DURATION": expected.get("duration", "2")}
    if "world" in expected:
        worlds = pathlib.Path(file).resolve().parents[3] / "worlds"
        environment["PLAYPEN_WORLD"] = str(worlds / expected["world"])
    run = subprocess.run(command, capture_output=True, text=True, check=False, env=environment)
    print(run.stdout + run.stderr)
    if run.returncode != 0:
        sys.exit(f"the program ended with status {run.returncode}")
    lines = iter(run.stdout.splitlines())
    for pattern in filter(None, expected.get("prints", "").splitlines()):
        if not any(re.fullmatch(pattern, line) for line in lines):
            sys.exit(f"the program did not print {pattern}")
    if "path_length" in expected:
        report = pathlib.Path(os.environ["PLAYPEN_OUT"]) / "report.json"
        path_m = json.loads(report.read_text(encoding="utf-8"))["robots"][0]["path_length"]
        least_m, most_m = map(float, expected["path_length"].split())
        if not least_m <= path_m <= most_m:
            sys.exit(f"the robot drove {path_m} m, not {least_m} m to {most_m} m")


if __name__ == "__main__":
    main(*sys.argv[1:])
