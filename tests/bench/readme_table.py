#!/usr/bin/env python3
# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
"""Runs the benchmarks and writes the tables of README.md's section "How fast".

Usage: readme_table.py FOLDER [--rounds N] [--print]

FOLDER contains the programs that `cmake --preset release -DPLAYPEN_BUILD_BENCH=ON` and
`cmake --build build/release --target benchmarks` have built. Each benchmark runs N times (3), one
after the other on one core where it has one thread; the best value of each figure counts, because
other processes can only slow it down. With --print the tables are printed, and README.md stays.
"""
import argparse
import os
import re
import subprocess
import sys
from pathlib import Path

README = Path(__file__).resolve().parents[2] / "README.md"
# The tables are between these texts.
BEGIN, END = "wrote these tables:\n", "\nThe arena is the one in the picture"
# These have threads, or start programs that have.
ALL_CORES = {"bench_socket", "bench_start"}
# Figures of which less is better; of all others, more is.
LESS = re.compile(r"_(us|ms|ns|mb)(_|$)|ratio|clients_over_simulation|slowdown|loaded")
# What is measured, and how its figures are written.
ROWS = [
    ("one scan of 682 beams, edges collected and swept",
     "{scan_us:.2} us, {scan_ns_per_beam:.2} ns a beam"),
    ("the same scan with 682 calls of `b2World::RayCast`",
     "{scan_speedup_over_raycast:.0f} times as long"),
    ("a step of 13 robots with all sensors, relative to `b2World::Step` plus the bare scans",
     "{step_overhead_ratio:.2} times"),
    ("a step of one Pioneer with laser and odometry in the cave, among 10 / 50 / 200 Pioneers",
     "{robot_step_us_of_10:.2} / {robot_step_us_of_50:.2} / {robot_step_us_of_200:.2} us"),
    ("overhead of a client's `Read()`, on top of the simulated steps", "{read_overhead_us:.2} us"),
    ("13 client programs that drive 13 robots by laser, relative to the simulation alone",
     "{clients_over_simulation_13:.3} times"),
    ("the program above, once for each of 13 robots: simulated seconds a second",
     "{readme_program_13:.0f}"),
    ("the getter of one beam", "{beam_getter_ns:.2} ns"),
    ("saving / restoring the state of 1000 robots",
     "{save_ms_1000:.0f} / {restore_ms_1000:.0f} ms"),
    ("processor time from exec to the end of a client's first `Read()`, above that of an empty "
     "program; shared libraries loaded", "{start_cpu_ms:.2} ms; {libraries_loaded:.0f}"),
    ("processor time of `playpen run cave --duration 60` with a sonar wanderer and its pictures",
     "{run_60s_cpu_ms:.0f} ms"),
    ("processor time of `playpen grade par_intro` for one run of 120 s; of these the start and the "
     "pictures / the program and the simulation",
     "{graded_120s_cpu_ms:.0f} ms; {graded_start_and_pictures_cpu_ms:.0f} / "
     "{graded_driving_cpu_ms:.0f} ms"),
    ("processor time of a film, for each simulated second at 25 frames a second; memory",
     "{film_cpu_ms_per_s:.0f} ms; {film_memory_mb:.0f} MB"),
    ("cells a second drawn with single `SetPixel()` calls of a window, one thread",
     "{window_megapixels_per_second:.0f} million"),
    ("a whole picture of 172 x 186 cells drawn by a program", "{whole_image_us:.0f} us"),
    ("a path planned on the arena's grid of 172 x 186 cells, by Dijkstra / A* / Theta*",
     "{plan_ms_dijkstra:.2} / {plan_ms_a_star:.2} / {plan_ms_theta_star:.2} ms"),
    ("`Read()` calls a second over loopback with pose, odometry and laser, CBOR / JSON",
     "{read_rounds_per_s_cbor:,.0f} / {read_rounds_per_s_json:,.0f}"),
    ("whole canvases (172 x 186) a second over loopback, CBOR; relative to MORSE's `set_pixel`, "
     "64 requests in flight",
     "{canvases_per_s_cbor:,.0f}; {canvas_speedup_over_set_pixel_64_in_flight:.0f} times"),
    ("simulation speed that 100 watching clients cost 13 robots at full speed",
     "{slowdown_by_100_watchers:.0%} of the steps"),
]
FIELD = [("simulation alone", "alone"), ("a client program for each robot", "clients")]
NO_DETAILS = ["--benchmark_filter=NONE"]
BENCHES = [
    ("bench_scan", NO_DETAILS), ("bench_simulation", NO_DETAILS), ("bench_clients", NO_DETAILS),
    ("bench_simulation", ["--world", README.with_name("worlds") / "cave.json"]),
    ("bench_field", []), ("bench_start", []), ("bench_canvas", NO_DETAILS),
    ("bench_planning", NO_DETAILS), ("bench_socket", NO_DETAILS)]


def figures_of(program, arguments):
    """The figures that a run of a benchmark prints."""
    cores = os.sched_getaffinity(0)
    if program.name not in ALL_CORES:
        cores = {max(cores)}
    run = subprocess.run([program, *arguments], stdout=subprocess.PIPE, text=True, check=False,
                         preexec_fn=lambda: os.sched_setaffinity(0, cores))
    found = dict(re.findall(r"^figure (\S+) (\S+)$", run.stdout, re.MULTILINE))
    if run.returncode != 0 or not found:
        sys.exit(f"readme_table.py: {program.name} ended with status {run.returncode} and printed "
                 f"{len(found)} figures")
    return {name: float(value) for name, value in found.items()}


def best_of(folder, rounds):
    best = {}
    for number in range(rounds):
        for bench, arguments in BENCHES:
            print(f"round {number + 1} of {rounds}: {bench}", file=sys.stderr, flush=True)
            for name, value in figures_of(folder / bench, arguments).items():
                better = min if LESS.search(name) else max
                best[name] = better(best.get(name, value), value)
    return best


def machine():
    text = Path("/proc/cpuinfo").read_text(encoding="utf-8")
    model = re.search(r"^model name\s*: (.*)$", text, re.MULTILINE)
    compiler = subprocess.run(["c++", "--version"], capture_output=True, text=True,
                              check=True).stdout.split("\n")[0]
    return model[1] if model else os.uname().machine, compiler


def tables(best):
    processor, compiler = machine()
    best["window_megapixels_per_second"] = best["window_pixels_per_second"] * 1e-6
    lines = [f"Processor: {processor}. Compiler: {compiler}. One core, but for servers.", "",
             "| figure | value |", "|---|---|"]
    lines += [f"| {what} | {value.format(**best)} |" for what, value in ROWS]
    lines += ["", "Simulated seconds a second of processor time, in a hall of 16 x 16 m with 24 boxes. "
              "Each robot has a laser with 682 beams at 10 Hz and wanders by it:", "",
              "| | steps of | 1 robot | 13 robots | 100 robots |", "|---|---|---|---|---|"]
    for what, name in FIELD:
        for step in ("10", "100"):
            values = [f"{best[f'field_{name}_{step}ms_{robots}']:,.0f}" for robots in (1, 13, 100)]
            lines.append(f"| {what} | {step} ms | {' | '.join(values)} |")
    return "\n".join(lines) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("folder", type=Path)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--print", action="store_true", dest="print_only")
    options = parser.parse_args()
    made = tables(best_of(options.folder.resolve(), options.rounds))
    if options.print_only:
        print(made)
        return
    text = README.read_text(encoding="utf-8")
    if text.count(BEGIN) != 1 or text.count(END) != 1:
        sys.exit(f"readme_table.py: {README} has no place for the tables, between {BEGIN!r} and "
                 f"{END!r}")
    before = text.index(BEGIN) + len(BEGIN)
    README.write_text(text[:before] + "\n" + made + text[text.index(END):], encoding="utf-8")


main()
