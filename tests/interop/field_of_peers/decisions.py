# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
"""What the programs of decisions_of_peers.py share: the policy and the measurement."""
import sys
import time

import numpy as np

STEP_S = 0.01
LEAST_TIME_S = 3.0
TURN_S = 0.3  # the best of turns of this time counts


def roam(scans):
    """The policy for all robots, [R, 2] speeds [m/s] and turn rates [rad/s] for [R, B] ranges [m]:
    drive on; if something is near ahead, turn. That of playpen_client.py."""
    middle, side = scans.shape[1] // 2, scans.shape[1] // 6
    near = scans[:, middle - side:middle + side:side // 6].min(axis=1) < 0.3
    return np.where(near[:, None], (0.0, 1.5), (0.3, 0.0))


def print_decisions(decide, robots, first_scan, positions=None, clock=time.process_time):
    """Prints the first robot's first scan, and decisions a second of the clock, the best of turns.

    @param decide      lets all robots decide, and gets their next scans.
    @param first_scan  [B], or None if the robot is not at the first start pose.
    @param positions   returns the (x, y) of all robots; they must be in the arena at the end.
    @return the clock's time of a decision in the best turn [s].
    """
    if first_scan is not None:
        print("scan", *(f"{value:.5f}" for value in first_scan))
    begin_s = clock()
    decide()
    calls = max(1, int(TURN_S / max(clock() - begin_s, 1e-6) / 3))
    best_s, total_s = float("inf"), 0.0
    while total_s < LEAST_TIME_S:
        begin_s = clock()
        for _ in range(calls):
            decide()
        used_s = clock() - begin_s
        best_s, total_s = min(best_s, used_s / calls / robots), total_s + used_s
    if positions is not None and not all(0 < x < 3.42 and 0 < y < 3.72 for x, y in positions()):
        sys.exit("a robot has left the arena")
    print(f"figure decisions {1.0 / best_s:.6g}")
    return best_s
