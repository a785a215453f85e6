#!/usr/bin/env python3
# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
"""Compares decisions with a fresh scan a second of processor time with other simulators.

Usage: decisions_of_peers.py --prefix DIR [--irsimx DIR] [--rounds N] BUILD

BUILD is a release build of playpen, playpen_batch_c, bench_parallel and bench_field (see
tests/bench/readme_table.py). pip installs ir-sim and navground in DIR/venv, and IR-SIM-X, which is in
no package index, from its sources in --irsimx (github.com/Ethereal1024/ir-simX) in DIR/venv_irsimx.
None of them becomes part of Playpen.

One robot with a laser of 682 beams stands in the SyRoTek arena, or one in each of 64 simulations, and
drives by the same policy. A decision is the policy, one step of 10 ms, and a new scan. All programs run
one after the other on one core, N times (3), and the best value of each counts, because other processes
can only slow it down. Each program's first scan is compared with Playpen's. The table is printed in
Markdown. A simulator that cannot be measured is named below it with the reason.
"""
import argparse
import os
import re
import sys
from pathlib import Path

from peers import (HERE, PACKAGES, NotMeasured, core_environment, in_python, in_python_from, on_one_core,
                   output_of, processor)

SIMULATIONS = 64
EXAMPLES = HERE.parents[2] / "docs" / "examples"
# A scan agrees if as many of its beams differ by less than this from Playpen's.
NEAR_M, LEAST_SHARE = 0.02, 0.95
PYTHON = "/usr/bin/python3" if Path("/usr/bin/python3").exists() else sys.executable


class Program:
    """A row of the table: a command, and the number of robots in its arena."""

    def __init__(self, name, command, robots=SIMULATIONS, environment=()):
        self.name, self.command, self.robots = name, command, robots
        self.environment = dict(environment)
        self.best, self.client_share, self.scan, self.reason = 0.0, None, None, None

    def run(self, arenas):
        try:
            text = output_of(self.command, "its program failed", input=arenas[self.robots],
                             env={**core_environment(), **self.environment}, preexec_fn=on_one_core)
        except NotMeasured as reason:
            self.reason = str(reason)
            return
        figures = dict(re.findall(r"^figure (\S+) (\S+)$", text, re.MULTILINE))
        c_name = f"many_{SIMULATIONS}_beams_682_steps_1_threads_1_per_cpu_second"
        value = float(figures.get("decisions") or figures[c_name])
        if value > self.best:
            self.best, self.client_share = value, figures.get("client_share")
        scan = re.search(r"^scan (.*)$", text, re.MULTILINE)
        self.scan = [float(word) for word in scan[1].split()] if scan else None
        print(f"  {self.name}: {value:.6g}", file=sys.stderr, flush=True)

    def check_scan(self, reference):
        """A simulator that sees something else is not measured."""
        if self.scan is None or self.reason:
            return
        near = sum(abs(a - b) < NEAR_M for a, b in zip(self.scan, reference))
        if len(self.scan) != len(reference) or near < LEAST_SHARE * len(reference):
            self.reason = (f"its first scan has {len(self.scan)} beams, and {near} of them agree within "
                           f"{NEAR_M} m with Playpen's {len(reference)}")

    def row(self):
        text = f"{self.best:,.0f}".replace(",", " ")
        if self.client_share is None:
            return f"| {self.name} | {text} | |"
        of_client, of_server = (1e6 * share / self.best for share in (
            float(self.client_share), 1 - float(self.client_share)))
        return f"| {self.name} | {text} | client {of_client:.1f} us, server {of_server:.1f} us |"


def programs_of(options):
    """All rows; a peer that cannot be installed has its reason already."""
    build, prefix = options.build.resolve(), options.prefix.resolve()
    library = {"PLAYPEN_BATCH_LIBRARY": str(build / "libsim" / "libplaypen_batch.so")}
    playpen = [PYTHON, HERE / "playpen_decisions.py", EXAMPLES]
    rows = [Program("Playpen in C, 64 simulations", [build / "bin" / "bench_parallel"]),
            Program("Playpen in Python (`playpen_gym.py`), 64 simulations",
                    [*playpen, "arrays", str(SIMULATIONS)], environment=library)]
    for robots, steps, text in ((1, 1, "one robot"), (1, 10, "one robot, 10 steps for each decision"),
                                (6, 1, "6 robots of one world")):
        rows.append(Program(f"Playpen over a socket (`playpen_client.py`), {text}",
                            [*playpen, "socket", build / "bin" / "playpen", str(robots), str(steps)],
                            robots=1))
    peers = (("IR-SIM-X", "64 environments of a batch", SIMULATIONS,
              lambda: in_python_from(prefix, options.irsimx, "irsimx_decisions.py")),
             ("navground", "64 worlds", SIMULATIONS,
              lambda: in_python(prefix, "navground", "navground_decisions.py")),
             ("ir-sim", "one robot", 1, lambda: in_python(prefix, "ir-sim", "irsim_decisions.py")))
    for name, text, robots, command in peers:
        row = Program(f"{name} {PACKAGES[name]}, {text}", None, robots)
        try:
            row.command = command()
        except NotMeasured as reason:
            row.reason = str(reason)
        rows.append(row)
    return rows


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n", maxsplit=1)[0])
    parser.add_argument("build", type=Path, metavar="BUILD")
    parser.add_argument("--prefix", type=Path, required=True)
    parser.add_argument("--irsimx", type=Path, metavar="DIR", help="the sources of IR-SIM-X")
    parser.add_argument("--rounds", type=int, default=3)
    options = parser.parse_args()
    options.prefix.mkdir(parents=True, exist_ok=True)
    try:
        bench_field = options.build.resolve() / "bin" / "bench_field"
        arenas = {count: output_of([bench_field, "--arena", str(count)], "bench_field --arena")
                  for count in (1, SIMULATIONS)}
    except NotMeasured as reason:
        sys.exit(f"decisions_of_peers.py: {reason}")
    rows = programs_of(options)
    for number in range(options.rounds):
        print(f"round {number + 1} of {options.rounds}", file=sys.stderr, flush=True)
        for row in rows:
            if not row.reason:
                row.run(arenas)
    reference = rows[1].scan
    for row in rows:
        if reference:
            row.check_scan(reference)
    print(f"Processor: {processor()}, {os.cpu_count()} processors, one core used. Decisions with a fresh "
          "scan of 682 beams a second of processor time (of client and server together):\n")
    print("| | decisions | of which |\n|---|---|---|")
    print("\n".join(row.row() for row in rows if not row.reason))
    for row in rows:
        if row.reason:
            print(f"\nNot measured: {row.name}: {row.reason}.")


main()
