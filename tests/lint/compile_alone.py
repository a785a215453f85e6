#!/usr/bin/env python3
# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
"""Usage: compile_alone.py BUILD [JOBS]

Compiles each source of the libraries and programs alone and without output, by the commands of
BUILD/compile_commands.json, which has been configured without groups of sources. So a source that
lacks an include is found. Exits with 1 if a source does not compile."""
import concurrent.futures
import json
import os
import shlex
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
FOLDERS = tuple(os.path.join(ROOT, name, "") for name in ("libsim", "libplayerlike", "apps"))


def compiles(entry):
    command = shlex.split(entry["command"])
    output = command.index("-o")
    del command[output:output + 2]
    return subprocess.run(command + ["-fsyntax-only"], cwd=entry["directory"], check=False).returncode == 0


def main(arguments):
    if not 1 <= len(arguments) <= 2 or arguments[0].startswith("-"):
        print(__doc__, file=sys.stdout if "--help" in arguments else sys.stderr)
        return 0 if "--help" in arguments else 2
    with open(os.path.join(arguments[0], "compile_commands.json"), encoding="utf-8") as file:
        entries = [entry for entry in json.load(file) if entry["file"].startswith(FOLDERS)]
    jobs = int(arguments[1]) if len(arguments) > 1 else os.cpu_count()
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        failed = [entry["file"] for entry, good in zip(entries, pool.map(compiles, entries)) if not good]
    print(f"{len(entries) - len(failed)} of {len(entries)} sources compile alone")
    for file in failed:
        print(f"{os.path.relpath(file, ROOT)}: does not compile alone")
    return 1 if failed or not entries else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
