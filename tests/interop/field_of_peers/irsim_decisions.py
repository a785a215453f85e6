#!/usr/bin/env python3
# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
"""One robot of ir-sim in the arena of `bench_field --arena N` (standard input). Prints the lines of
decisions.py. Nothing is drawn. Robots that touch something go on (collision mode "contact")."""
import sys

from decisions import STEP_S, print_decisions, roam
from hall import Hall
from irsim_world import make_world


def main():
    arena = Hall(sys.stdin)
    walls = [{"shape": {"name": "linestring", "vertices": [list(point) for point in corners + corners[:1]]},
              "state": [0, 0, 0]} for corners in arena.outlines]
    world = make_world(arena, 4, arena.robots[:1], walls, STEP_S)
    robot = world.robot_list[0]

    def decide():
        world.step([list(roam(robot.lidar.range_data[None, :])[0])], [0])

    print_decisions(decide, 1, robot.lidar.range_data, lambda: [robot.state[:2, 0]])


main()
