#!/usr/bin/env python3
# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
"""Lets `playpen fuzz` search worlds for planted faults, and prints a table for docs/fuzz.md.

Usage: faults_table.py FOLDER [--runs N] [--seeds N] [--jobs N] [--results FILE] [--only NAME...]

FOLDER contains playpen and the programs of tests/integration/planted, such as build/dev/bin. Each
fault is searched with each seed (1 to 3), guided and with --random, up to N runs (1000) of 30
simulated seconds, on one core. Times are of the processor, with those of making a finding simpler and
of its pictures. A median counts a search without a finding as longer than all others. Each finding is
repeated from its file in a new process. With --results, searches are kept in a file, and those in it
are not made again. --only takes names such as wall/lane. The exit status is 1 if a program without a
fault fails, if a finding does not happen again, or if a world has more than 3 obstacles.
"""
import argparse
import json
import os
import re
import shlex
import statistics
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from dataclasses import asdict, dataclass
from pathlib import Path

FOUND = re.compile(r"^1\. found after \d+ s and (\d+) runs, ([a-z-]+): ", re.MULTILINE)
NEVER = float("inf")
MOST_OBSTACLES = 3
LIMIT_S = 300  # of the processor
WALL_LIMIT_S = 4  # of a run
HARD_RUNS = 50  # a fault is hard if random worlds show it later, in the median

# Name, world and options of each program. Without its faults, it never fails there.
PROGRAMS = {
    "roamer": ("a roamer", ["par_intro", "--without", "moving"]),
    "readme": ("the README's", ["par_intro", "--without", "starts,obstacles,moving,noise"]),
    "wall": ("`solution_wall`", ["par_intro", "--without", "moving,noise"]),
    "planning": ("`solution_dijkstra`", ["par_planning", "--without", "moving,noise", "--look-for",
                                         "crash,hang,collision,goal,stuck"]),
}


@dataclass
class Search:
    """What a search gave."""
    kind: str = ""
    runs: float = NEVER
    seconds: float = NEVER
    obstacles: int = 0
    repeats: bool = True


def run(call):
    """Runs a program. Returns its exit status, its output and its processor time [s]."""
    with tempfile.TemporaryFile("w+") as output:
        process = subprocess.Popen(call, stdout=output, stderr=output)
        _, status, used = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        output.seek(0)
        return process.returncode, output.read(), used.ru_utime + used.ru_stime


def obstacles_of(world_file):
    """Number of obstacles that the search has added to a world."""
    text = "".join(line for line in world_file.read_text().splitlines(keepends=True)
                   if not line.lstrip().startswith("//"))
    added = {obstacle["name"].rstrip("ab")  # a door is two boxes
             for obstacle in json.loads(text)["arena"].get("obstacles", [])
             if obstacle["name"].startswith("found")}
    return len(added)


def repeats(bin_folder, world_file, kind, printed):
    """Whether the call in a world's comment fails again."""
    if "did not happen again" in printed:
        return False
    if kind in ("stuck", "goal"):  # the call has no expectation; the search has run it
        return True
    call = re.search(r"^// Again: (.*)$", world_file.read_text(), re.MULTILINE)[1]
    words = shlex.split(call)
    at = words.index("playpen")
    words[at:at + 2] = [str(bin_folder / "playpen"), "run", "--out",
                        str(world_file.parent / "again")]
    status, _, _ = run(words)
    return status == 124 if kind == "hang" else status not in (0, 2)


def search(bin_folder, fault, runs, seed, guided):
    """Searches for a fault once."""
    program, name = fault.split("/")
    with tempfile.TemporaryDirectory() as folder:
        call = [bin_folder / "playpen", "fuzz", *PROGRAMS[program][1], "--most", "1", "--jobs", "1",
                "--timeout", str(WALL_LIMIT_S), "--runs", str(runs), "--seed", str(seed), "--out",
                folder, *([] if guided else ["--random"]), "--",
                bin_folder / f"planted_{program}", name]
        status, printed, seconds = run(call)
        if status not in (0, 1):
            sys.exit(f"{fault}: playpen fuzz ended with status {status}: {printed}")
        found = FOUND.search(printed)
        if not found:
            return Search()
        world = Path(folder) / "1.json"
        return Search(found[2], int(found[1]), seconds, obstacles_of(world),
                      repeats(bin_folder, world, found[2], printed))


class Searches:
    """Makes searches, or takes them from a file."""

    def __init__(self, bin_folder, runs, file):
        self.bin_folder = bin_folder
        self.runs = runs
        self.file = file
        self.known = {}
        if file and file.exists():
            for line in file.read_text().splitlines():
                one = json.loads(line)
                self.known[tuple(one["key"])] = Search(**one["search"])

    def get(self, fault, seed, guided):
        key = (fault, self.runs, seed, guided)
        if key not in self.known:
            self.known[key] = search(self.bin_folder, *key)
            if self.file:
                with self.file.open("a") as file:
                    file.write(json.dumps({"key": key, "search": asdict(self.known[key])}) + "\n")
        return self.known[key]


def median(searches, figure):
    return statistics.median_high([getattr(one, figure) for one in searches])


def number(value):
    return "–" if value == NEVER else f"{value:.0f}"


def row(fault, text, guided, random):
    """A row of the table."""
    both = guided + random
    kinds = ", ".join(sorted({one.kind for one in both if one.kind})) or "–"
    cells = [PROGRAMS[fault.split("/")[0]][0], text, kinds,
             max(one.obstacles for one in both) if kinds != "–" else "–"]
    for searches in (guided, random):
        cells += [f"{sum(bool(one.kind) for one in searches)} of {len(searches)}",
                  number(median(searches, "runs")), number(median(searches, "seconds"))]
    return "| " + " | ".join(str(cell) for cell in cells) + " |"


def faults_in(bin_folder, only):
    """Names and texts of the faults."""
    faults = {}
    for program in PROGRAMS:
        _, printed, _ = run([bin_folder / f"planted_{program}", "--list"])
        for line in printed.splitlines():
            name, text = line.split(": ", 1)
            if not only or f"{program}/{name}" in only:
                faults[f"{program}/{name}"] = text
    return faults


def summary(table):
    """Lines about all faults. table has guided and random searches by fault."""
    planted = {fault: both for fault, both in table.items() if not fault.endswith("/none")}
    hard = [fault for fault, both in planted.items() if median(both[1], "runs") > HARD_RUNS]
    names = ("guided", "`--random`")
    found = [sum(median(both[i], "seconds") <= LIMIT_S for both in planted.values())
             for i in range(2)]
    yield f"Of {len(planted)} faults, found in most searches within {LIMIT_S} s of the processor: " \
        + ", ".join(f"{names[i]} {found[i]}" for i in range(2)) + "."
    if hard:
        medians = [number(statistics.median([median(planted[fault][i], "runs") for fault in hard]))
                   for i in range(2)]
        total = [sum(bool(one.kind) for fault in hard for one in planted[fault][i])
                 for i in range(2)]
        yield f"The {len(hard)} that random worlds show after {HARD_RUNS} runs or later: " + \
            ", ".join(f"{names[i]} {total[i]} searches with a finding, median {medians[i]} runs"
                      for i in range(2)) + "."


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("folder", type=Path)
    parser.add_argument("--runs", type=int, default=1000)
    parser.add_argument("--seeds", type=int, default=3)
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--results", type=Path)
    parser.add_argument("--only", nargs="+")
    arguments = parser.parse_args()
    searches = Searches(arguments.folder.resolve(), arguments.runs, arguments.results)
    faults = faults_in(searches.bin_folder, arguments.only)
    seeds = range(1, arguments.seeds + 1)
    table = {}
    with ThreadPoolExecutor(arguments.jobs) as pool:
        promised = {fault: [[pool.submit(searches.get, fault, seed, guided) for seed in seeds]
                            for guided in (True, False)] for fault in faults}
        print("| program | it ... | found as | obstacles, at most | found, guided | runs | s "
              "| found, `--random` | runs | s |")
        print("|---|---|---|---|---|---|---|---|---|---|")
        for fault, both in promised.items():
            table[fault] = [[one.result() for one in list_of_one] for list_of_one in both]
            print(row(fault, faults[fault], *table[fault]), flush=True)
    print()
    print("\n".join(summary(table)))
    bad = []
    for fault, (guided, random) in table.items():
        if fault.endswith("/none") and any(one.kind for one in guided + random):
            bad.append(f"{fault}: fails")
        if not all(one.repeats for one in guided + random):
            bad.append(f"{fault}: a finding did not happen again")
        if any(one.obstacles > MOST_OBSTACLES for one in guided + random):
            bad.append(f"{fault}: more than {MOST_OBSTACLES} obstacles")
    print("\n".join(bad), file=sys.stderr)
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
