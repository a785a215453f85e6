#!/usr/bin/env python3
# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
"""One robot in each environment of a batch of IR-SIM-X, in the arena of `bench_field --arena N`
(standard input). Prints the lines of decisions.py.

The laser of a batch stands at the middle of the robot, so it is compared at another place: the first
pose is moved by the laser's offset. A batch tells of collisions, but robots drive on through walls.
"""
import math
import sys
import tempfile

import irsim
import numpy as np
import yaml

from decisions import STEP_S, print_decisions, roam
from hall import Hall


def batch_of(arena):
    lidar = {"name": "lidar2d", "range_min": 0, "range_max": arena.range, "angle_range": arena.view,
             "number": arena.beams}
    radius = max(math.hypot(*point) for point in arena.footprint)
    world = {"world": {"width": 4, "height": 4, "step_time": STEP_S},
             "robot": {"kinematics": {"name": "diff"}, "shape": {"name": "circle", "radius": radius},
                       "vel_min": [-1, -3, -3], "vel_max": [1, 3, 3], "sensors": [lidar]}}
    with tempfile.NamedTemporaryFile("w", suffix=".yaml") as file:
        yaml.dump(world, file)
        file.flush()
        batch = irsim.make(file.name, batch_size=len(arena.robots))
    for corners in arena.outlines:
        closed = [list(point) for point in corners + corners[:1]]
        batch.add_obstacle({"type": "linestring", "vertices": closed})
    # Only circles and rectangles make the batch sort its obstacles into the grid that speeds scans up.
    batch.add_obstacle({"type": "circle", "x": 100.0, "y": 100.0, "radius": 0.1})
    return batch


def main():
    arena = Hall(sys.stdin)
    batch = batch_of(arena)
    poses = np.array(arena.robots)
    poses[:, 0] += arena.laser_x * np.cos(poses[:, 2])
    poses[:, 1] += arena.laser_x * np.sin(poses[:, 2])
    batch.set_poses(poses)
    scans = batch.get_lidar_scan()
    actions = np.zeros((len(poses), 3), np.float32)

    def decide():
        nonlocal scans
        actions[:, :2] = roam(scans)
        batch.step(actions)
        scans = batch.get_lidar_scan()

    print_decisions(decide, len(poses), scans[0],
                    lambda: batch.get_robot_state()[:, :2, 0])


main()
