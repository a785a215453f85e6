#!/usr/bin/env python3
# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
"""One robot in each of many worlds of navground, in the arena of `bench_field --arena N` (standard
input). Prints the lines of decisions.py. The worlds and their lidars are navground's C++ code; a
behaviour in Python passes on the speeds that the policy has chosen for all worlds together."""
import sys

import numpy as np
from navground import core, sim
from navground.core.kinematics import TwoWheelsDifferentialDriveKinematics
from navground.sim.state_estimations import LidarStateEstimation

from decisions import STEP_S, print_decisions, roam
from hall import Hall
from navground_field import WHEELS_M, radius_of


class Driven(core.Behavior):
    """Drives at the speeds of `action`."""

    def __init__(self, kinematics, radius):
        super().__init__(kinematics, radius)
        self.state = core.SensingState()
        self.action = (0.0, 0.0)

    def get_environment_state(self):
        return self.state

    def compute_cmd_internal(self, time_step):
        return core.Twist2((self.action[0], 0.0), self.action[1], core.Frame.relative)


def world_of(arena, pose):
    world = sim.World()
    for corners in arena.outlines:
        for begin, end in zip(corners, corners[1:] + corners[:1]):
            world.add_wall(core.LineSegment(begin, end))
    lidar = LidarStateEstimation(arena.range, arena.first, arena.view, arena.beams, (arena.laser_x, 0.0))
    radius = radius_of(arena.footprint)
    kinematics = TwoWheelsDifferentialDriveKinematics(max_speed=1.0, wheel_axis=WHEELS_M,
                                                      max_angular_speed=3.0)
    behavior = Driven(kinematics, radius)
    agent = sim.Agent(radius, behavior, kinematics, None, [lidar])
    agent.pose = core.Pose2(pose[:2], pose[2])
    world.add_agent(agent)
    return world, agent, behavior


def main():
    arena = Hall(sys.stdin)
    worlds = [world_of(arena, pose) for pose in arena.robots]
    scans = np.empty((len(worlds), arena.beams))

    def step():
        for i, (world, _, behavior) in enumerate(worlds):
            world.update(STEP_S)
            scans[i] = behavior.state.buffers["range"].data

    def decide():
        for action, (_, _, behavior) in zip(roam(scans), worlds):
            behavior.action = action
        step()

    step()
    print_decisions(decide, len(worlds), scans[0],
                    lambda: [tuple(agent.position) for _, agent, _ in worlds])


main()
