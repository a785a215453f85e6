#!/usr/bin/env python3
# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
"""One robot of ir-sim in the arena of `bench_field --arena N` (standard input). Prints the lines of
decisions.py. Nothing is drawn. Robots that touch something go on (collision mode "contact")."""
import sys
import tempfile

import irsim
import yaml

from decisions import STEP_S, print_decisions, roam
from hall import Hall


def world_of(arena):
    walls = [{"shape": {"name": "linestring", "vertices": [list(point) for point in corners + corners[:1]]},
              "state": [0, 0, 0]} for corners in arena.outlines]
    lidar = {"name": "lidar2d", "range_min": 0, "range_max": arena.range, "angle_range": arena.view,
             "number": arena.beams, "noise": False, "offset": [arena.laser_x, 0, 0]}
    robot = {"kinematics": {"name": "diff"},
             "shape": {"name": "polygon", "vertices": [list(point) for point in arena.footprint]},
             "state": list(arena.robots[0]), "vel_min": [-1, -3], "vel_max": [1, 3], "sensors": [lidar]}
    return {"world": {"width": 4, "height": 4, "step_time": STEP_S, "sample_time": STEP_S,
                      "control_mode": "auto", "collision_mode": "contact"},
            "robot": [robot], "obstacle": walls}


def main():
    arena = Hall(sys.stdin)
    with tempfile.NamedTemporaryFile("w", suffix=".yaml") as file:
        yaml.dump(world_of(arena), file)
        file.flush()
        world = irsim.make(file.name, headless=True, log_level="ERROR")
    robot = world.robot_list[0]

    def decide():
        world.step([list(roam(robot.lidar.range_data[None, :])[0])], [0])

    print_decisions(decide, 1, robot.lidar.range_data, lambda: [robot.state[:2, 0]])


main()
