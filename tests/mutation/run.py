#!/usr/bin/env python3
# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
"""Plants the faults of tests/mutation/faults.ini, one at a time, and tells which test finds each.

It works in a copy of this checkout, with its changes, which is built as tests/run.sh does. A fault
is found if one of its expected tests fails or, after them, any test that runs before a merge. Prints
a line for each fault and a table for docs/decisions/mutation_check.md. Exit status: 1 if a fault that
the list calls found was not found, 2 if the list or the copy is wrong.
"""

import argparse
import configparser
import os
import pathlib
import re
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
KEYS = {"file", "find", "replace", "breaks", "tests", "preset", "timeout", "found"}
TIMEOUT_S = 900  # of one test


class BadList(Exception):
    pass


def read_faults(path):
    parser = configparser.ConfigParser(interpolation=None)
    parser.read_string(path.read_text(encoding="utf-8"), str(path))
    faults = []
    for name in parser.sections():
        fault = dict(parser[name], name=name)
        wrong = (set(fault) - {"name"}) ^ KEYS
        wrong -= {"preset", "timeout", "found"} - set(fault)
        if wrong:
            raise BadList(f"{path}: [{name}]: missing or unknown keys: {', '.join(sorted(wrong))}")
        fault["tests"] = fault["tests"].split()
        faults.append(fault)
    return faults


def planted(fault, text):
    """The text of the fault's file with the fault."""
    pattern = r"\s+".join(re.escape(word) for word in fault["find"].split())
    matches = list(re.finditer(pattern, text))
    if len(matches) != 1:
        raise BadList(f"[{fault['name']}]: its text to find occurs {len(matches)} times in "
                      f"{fault['file']}, not once; adapt the list to the source")
    return text[:matches[0].start()] + fault["replace"] + text[matches[0].end():]


class Copy:
    """The copy of the checkout in which faults are planted."""

    def __init__(self, folder, preset):
        self.folder = folder
        self.preset = preset  # of faults without a preset
        self.log = folder.parent / (folder.name + ".log")
        folder.parent.mkdir(parents=True, exist_ok=True)
        subprocess.run([ROOT / "tests/install/clone.sh", ROOT, folder], check=True)

    def call(self, command, what):
        """Runs a command in the copy. @return its status and output, which the log gets too."""
        environment = dict(os.environ, PLAYPEN_TEST_PATIENCE_S="300")
        done = subprocess.run(command, cwd=self.folder, env=environment, stdin=subprocess.DEVNULL,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                              errors="replace", check=False)
        with self.log.open("a", encoding="utf-8") as log:
            log.write(f"===== {what}: {' '.join(map(str, command))}\n{done.stdout}\n")
        return done.returncode, done.stdout

    def failures(self, preset, tests, timeout_s, what):
        """Builds what has changed, for a sanitizer only these tests, and runs these tests or, if
        there are none, those of a merge until one fails. @return the names of those that failed."""
        command = ["tests/run.sh", "--preset", preset, "--timeout", str(timeout_s)]
        if preset != self.preset:
            command[3:3] = [word for name in tests for word in ("--target", name)]
        if tests:
            command += ["-R", f"^({'|'.join(map(re.escape, tests))})$"]
        else:  # mutation_list would only tell that a source was changed
            command += ["-E", "^mutation_list$", "--stop-on-failure"]
        status, output = self.call(command, what)
        if "Test project" not in output:
            raise BadList(f"{what}: the build failed; see {self.log}")
        failed = output.partition("The following tests FAILED:")[2]
        failed = re.findall(r"^\s*\d+ - (\S+) ", failed, re.MULTILINE)
        missing = [name for name in tests if f": {name}\n" not in output]
        if missing or (status == 0) != (not failed):
            raise BadList(f"{what}: {', '.join(missing) or 'tests'} did not run; see {self.log}")
        return failed


def check(copy, faults):
    """Without a fault everything must be built and pass; otherwise each fault would be found."""
    presets = {}
    for fault in faults:
        presets.setdefault(fault.get("preset", copy.preset), set()).update(fault["tests"])
    for preset, tests in presets.items():
        what = f"without a fault, preset {preset}"
        if failed := copy.failures(preset, sorted(tests), TIMEOUT_S, what):
            raise BadList(f"{what}: {', '.join(failed)} failed; see {copy.log}")


def look_for(copy, fault, named_only):
    """Plants a fault and runs the tests. @return the names of those that find it."""
    file = copy.folder / fault["file"]
    text = file.read_text(encoding="utf-8")
    preset = fault.get("preset", copy.preset)
    timeout_s = int(fault.get("timeout", TIMEOUT_S))
    try:
        file.write_text(planted(fault, text), encoding="utf-8")
        found = copy.failures(preset, fault["tests"], timeout_s, fault["name"])
        if not found and preset == copy.preset and not named_only:
            found = copy.failures(preset, [], timeout_s, fault["name"])
        return found
    finally:
        file.write_text(text, encoding="utf-8")


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("faults", nargs="*", metavar="FAULT", help="names of faults (default: all)")
    parser.add_argument("--preset", default="tests", help="of faults that name none")
    parser.add_argument("--only", metavar="PRESET", help="only the faults that are found in a preset")
    parser.add_argument("--folder", type=pathlib.Path, default=ROOT / "build/mutation/playpen",
                        help="of the copy; one that exists is updated and built on")
    parser.add_argument("--named-only", action="store_true",
                        help="do not run all tests if the expected ones pass")
    parser.add_argument("--unchecked", action="store_true",
                        help="do not run the tests without a fault first")
    parser.add_argument("--list", action="store_true", help="check the list, print it and end")
    options = parser.parse_args()

    faults = read_faults(ROOT / "tests/mutation/faults.ini")
    if unknown := set(options.faults) - {fault["name"] for fault in faults}:
        raise BadList(f"there is no fault {', '.join(sorted(unknown))}; see --list")
    faults = [fault for fault in faults
              if (not options.faults or fault["name"] in options.faults) and
              (not options.only or fault.get("preset", options.preset) == options.only)]
    for fault in faults:
        planted(fault, (ROOT / fault["file"]).read_text(encoding="utf-8"))
        if options.list:
            print(f"{fault['name']:26} {fault['breaks']}")
    if options.list:
        return 0

    copy = Copy(options.folder.resolve(), options.preset)
    if not options.unchecked:
        check(copy, faults)
    rows, lost, found_count = [], 0, 0
    for fault in faults:
        start = time.monotonic()
        found = look_for(copy, fault, options.named_only)
        found_count += bool(found)
        lost += not found and fault.get("found", "yes") == "yes"
        preset = fault.get("preset", options.preset)
        found = ", ".join(found)
        line = f"found by {found}" if found else "NOT FOUND"
        print(f"{fault['name']:26} {preset:8} {line} ({time.monotonic() - start:.0f} s)", flush=True)
        rows.append(f"| `{fault['name']}` | {fault['breaks']} | {preset} | {found or '**none**'} |")
    print("\n| Fault | It breaks | Preset | Found by |\n|---|---|---|---|")
    print("\n".join(rows))
    print(f"\n{found_count} of {len(faults)} faults found")
    return 1 if lost else 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except (BadList, OSError, configparser.Error, subprocess.CalledProcessError) as error:
        print(f"tests/mutation/run.py: {error}", file=sys.stderr)
        sys.exit(2)
