#!/usr/bin/env python3
# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
"""Playpen's robots in the SyRoTek arena, from Python. Prints the lines of decisions.py.

    playpen_decisions.py EXAMPLES arrays SIMULATIONS
    playpen_decisions.py EXAMPLES socket PLAYPEN ROBOTS STEPS

EXAMPLES is the folder of playpen_gym.py and playpen_client.py. "arrays" needs PLAYPEN_BATCH_LIBRARY.
"socket" starts PLAYPEN serve with a world whose scans come after every STEPS steps of 10 ms, and also
prints the processor time of a decision of the client and of the server.
"""
import json
import os
import re
import subprocess
import sys
import tempfile
import time

import numpy as np

from decisions import STEP_S, print_decisions, roam
from hall import Hall


def arrays(arena, simulations):
    import playpen_gym
    batch = playpen_gym.Batch(simulations=simulations, threads=1)
    batch.reset(poses=np.array(arena.robots).reshape(simulations, 1, 3))

    def decide():
        batch.step(roam(batch.scans[:, 0])[:, None])

    print_decisions(decide, simulations, batch.scans[0, 0], lambda: batch.poses[:, 0, :2])


def processor_time(process):
    """Of all its threads [s]."""
    folder = f"/proc/{process}/task"
    times = [open(f"{folder}/{thread}/schedstat", encoding="ascii").read().split()[0]
             for thread in os.listdir(folder)]
    return 1e-9 * sum(map(int, times))


def world_of(arena, robots, steps):
    """One robot at the first start pose, or several in the corridor at the bottom of the arena."""
    rate = {"frequency": 1.0 / (steps * STEP_S)}
    places = [arena.robots[0]] if robots == 1 else [(0.45 + 0.5 * i, 0.26, 0.0) for i in range(robots)]
    return {"arena": {"preset": "syrotek"}, "simulation": {"step": STEP_S, "time": "lockstep"},
            "robots": [{"name": f"r{i}", "pose": {"x": x, "y": y, "yaw_deg": np.degrees(yaw)},
                        "devices": {"laser": rate, "pose": rate}}
                       for i, (x, y, yaw) in enumerate(places)]}


def socket(arena, playpen, robots, steps):
    import playpen_client
    with tempfile.TemporaryDirectory() as folder:
        world = f"{folder}/world.json"
        with open(world, "w", encoding="utf-8") as file:
            json.dump(world_of(arena, robots, steps), file)
        server = subprocess.Popen([playpen, "serve", world, "--tcp-port", "0", "--out", folder],
                                  stdout=subprocess.PIPE, text=True)
        try:
            port = int(re.match(r"listening on .*:(\d+)", server.stdout.readline())[1])
            with playpen_client.Session(port=port) as session:
                measure(session, server.pid)
        finally:
            server.terminate()
            server.wait()


def measure(session, server):
    robots = len(session.robots)
    parts = []

    def clock():
        parts.append((time.process_time(), processor_time(server)))
        return sum(parts[-1])

    session.step()
    print_decisions(lambda: session.step(roam(session.scans)), robots,
                    session.scans[0] if robots == 1 else None,
                    lambda: session.poses[:, :2], clock)
    turns = [(b[0] - a[0], b[1] - a[1]) for a, b in zip(parts[2::2], parts[3::2])]
    client, server = min(turns, key=sum)
    print(f"figure client_share {client / (client + server):.4f}")


def main():
    examples, what, *arguments = sys.argv[1:]
    sys.path.insert(0, examples)
    arena = Hall(sys.stdin)
    if what == "arrays":
        arrays(arena, int(arguments[0]))
    else:
        socket(arena, arguments[0], int(arguments[1]), int(arguments[2]))


main()
