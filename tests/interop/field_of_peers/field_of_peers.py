#!/usr/bin/env python3
# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
"""Compares Playpen's speed with other simulators in the hall of tests/bench/bench_field.cpp.

Usage: field_of_peers.py --prefix DIR [--rounds N] BENCH_FOLDER

BENCH_FOLDER contains the bench_field of a release build (see tests/bench/readme_table.py). pip
installs ir-sim and navground in DIR/venv. Enki is in no distribution, and this command does not
build it: if DIR contains an installation (include/enki, lib/libenki.a), enki_field.cc is compiled
with it. None of them becomes part of Playpen.

All simulators run one after the other on one core, N times (3). The best value of each counts,
because other processes can only slow it down. The table is printed in Markdown. A simulator that
cannot be measured is named below it with the reason.
"""
import argparse
import sys
from pathlib import Path

from peers import HERE, PACKAGES, NotMeasured, figures_of, in_python, output_of, processor

ROBOTS = (1, 13, 100)
OURS = [("Playpen alone", "alone_100ms"), ("Playpen, clients", "clients_100ms")]


def enki(prefix):
    """Compiles the program for Enki. Returns its command."""
    library = prefix / "lib" / "libenki.a"
    if not library.exists():
        raise NotMeasured(f"not installed: {library} does not exist")
    program = prefix / "enki_field"
    output_of(["c++", "-std=c++17", "-O3", "-DNDEBUG", HERE / "enki_field.cc", "-isystem",
               prefix / "include", library, "-o", program], "enki_field.cc does not compile")
    return [program]


class Comparison:
    """The best figures of each simulator, by its name and a number of robots."""

    def __init__(self, bench, prefix):
        self.bench = bench
        self.halls = {robots: output_of([bench, "--hall", str(robots)], "bench_field --hall")
                      for robots in ROBOTS}
        self.best, self.commands, self.reasons = {}, {}, {}
        makers = {"Enki": lambda: enki(prefix),
                  "navground": lambda: in_python(prefix, "navground", "navground_field.py"),
                  "ir-sim": lambda: in_python(prefix, "ir-sim", "irsim_field.py")}
        for name, make in makers.items():
            self.tries(name, lambda name=name, make=make: self.commands.update({name: make()}))

    def tries(self, name, action):
        try:
            action()
        except NotMeasured as reason:
            self.reasons[name] = str(reason)
            self.commands.pop(name, None)

    def add(self, name, robots, value):
        print(f"  {name}, robots: {robots}, figure: {value:.6g}", file=sys.stderr, flush=True)
        self.best[name, robots] = max(self.best.get((name, robots), 0.0), value)

    def run_peer(self, name):
        for robots in ROBOTS:
            self.add(name, robots, figures_of(self.commands[name], self.halls[robots])["field"])

    def run(self):
        """One round of all simulators."""
        ours = figures_of([self.bench])
        for name, figure in OURS:
            for robots in ROBOTS:
                self.add(name, robots, ours[f"field_{figure}_{robots}"])
        for name in list(self.commands):
            self.tries(name, lambda name=name: self.run_peer(name))

    def table(self):
        names = [name for name, _ in OURS] + list(self.commands)
        titles = [f"{name} {PACKAGES[name]}" if name in PACKAGES else name for name in names]
        lines = [f"| robots | {' | '.join(titles)} |", "|---" * (len(names) + 1) + "|"]
        for robots in ROBOTS:
            values = [self.best[name, robots] for name in names]
            cells = [f"{value:,.0f}" if value >= 10 else f"{value:.2g}" for value in values]
            lines.append(f"| {robots} | {' | '.join(cells)} |")
        lines += [f"\nNot measured: {name}: {reason}." for name, reason in self.reasons.items()]
        return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n", maxsplit=1)[0])
    parser.add_argument("folder", type=Path, metavar="BENCH_FOLDER")
    parser.add_argument("--prefix", type=Path, required=True)
    parser.add_argument("--rounds", type=int, default=3)
    options = parser.parse_args()
    options.prefix.mkdir(parents=True, exist_ok=True)
    try:
        comparison = Comparison(options.folder.resolve() / "bench_field",
                                options.prefix.resolve())
        for number in range(options.rounds):
            print(f"round {number + 1} of {options.rounds}", file=sys.stderr, flush=True)
            comparison.run()
    except NotMeasured as reason:
        sys.exit(f"field_of_peers.py: {reason}")
    print(f"Processor: {processor()}. Steps of 100 ms, one core. Simulated seconds a second of "
          "processor time:\n")
    print(comparison.table())


main()
