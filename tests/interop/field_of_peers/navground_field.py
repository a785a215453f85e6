#!/usr/bin/env python3
# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
"""The hall of bench_field in navground.

Reads the lines of `bench_field --hall N` from its standard input, and prints "figure field NUMBER":
simulated seconds a second of processor time. The world and its lidars are navground's C++ code; the
rule is a behaviour in Python. Robots are discs with the area of the footprint. A box is four walls.
"""
import math
import sys

from navground import core, sim
from navground.core.kinematics import TwoWheelsDifferentialDriveKinematics
from navground.sim.state_estimations import LidarStateEstimation

from hall import STEP_S, Hall, choose, print_figure

WHEELS_M = 0.14


class Wander(core.Behavior):
    """The wandering rule: navground asks for a command in each step, after the lidar's update."""

    def __init__(self, robot, kinematics, radius):
        super().__init__(kinematics, radius)
        self.robot = robot
        self.state = core.SensingState()

    def get_environment_state(self):
        return self.state

    def compute_cmd_internal(self, time_step):
        speed, turn_rate = choose(self.state.buffers["range"].data, self.robot)
        return core.Twist2((speed, 0.0), turn_rate, core.Frame.relative)


def lines_around(x, y, size_x, size_y):
    corners = [(x + 0.5 * a * size_x, y + 0.5 * b * size_y)
               for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    return zip(corners, corners[1:] + corners[:1])


def radius_of(footprint):
    """Radius of the disc with the area of a polygon."""
    area = 0.5 * sum(x * v - u * y for (x, y), (u, v) in
                     zip(footprint, footprint[1:] + footprint[:1]))
    return math.sqrt(area / math.pi)


def world_of(hall):
    world = sim.World()
    floor = (0.5 * hall.side, 0.5 * hall.side, hall.side, hall.side)
    for rectangle in [floor, *hall.boxes]:
        for begin, end in lines_around(*rectangle):
            world.add_wall(core.LineSegment(begin, end))
    radius = radius_of(hall.footprint)
    for number, (x, y, yaw) in enumerate(hall.robots):
        lidar = LidarStateEstimation(hall.range, hall.first, hall.view, hall.beams,
                                     (hall.laser_x, 0.0))
        kinematics = TwoWheelsDifferentialDriveKinematics(
            max_speed=1.0, wheel_axis=WHEELS_M, max_angular_speed=3.0)
        agent = sim.Agent(radius, Wander(number, kinematics, radius), kinematics, None, [lidar])
        agent.pose = core.Pose2((x, y), yaw)
        world.add_agent(agent)
    return world


def main():
    hall = Hall(sys.stdin)
    world = world_of(hall)

    def positions():
        return [tuple(agent.position) for agent in world.agents]

    print_figure(hall, lambda: world.update(STEP_S), positions)


if __name__ == "__main__":
    main()
