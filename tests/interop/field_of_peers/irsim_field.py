#!/usr/bin/env python3
# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
"""The hall of bench_field in ir-sim.

Reads the lines of `bench_field --hall N` from its standard input, and prints "figure field NUMBER":
simulated seconds a second of processor time. Nothing is drawn. Robots that touch something are
pushed out of it and go on (collision mode "contact"), as in Playpen; by default they would stop for
good.
"""
import sys

from hall import STEP_S, Hall, choose, print_figure
from irsim_world import make_world

WALL_M = 0.2  # thickness of the walls around the hall


def obstacles_of(hall):
    side = hall.side
    walls = [(x, y, size_x, size_y) for at in (-0.5 * WALL_M, side + 0.5 * WALL_M)
             for x, y, size_x, size_y in ((at, 0.5 * side, WALL_M, side),
                                          (0.5 * side, at, side, WALL_M))]
    return [{"shape": {"name": "rectangle", "length": size_x, "width": size_y},
             "state": [x, y, 0]} for x, y, size_x, size_y in walls + hall.boxes]


def main():
    hall = Hall(sys.stdin)
    world = make_world(hall, hall.side, hall.robots, obstacles_of(hall), STEP_S)
    robots = world.robot_list
    numbers = list(range(len(robots)))

    def one_round():
        world.step([list(choose(robot.lidar.range_data, number))
                    for number, robot in enumerate(robots)], numbers)

    print_figure(hall, one_round, lambda: [robot.state[:2, 0] for robot in robots])


main()
