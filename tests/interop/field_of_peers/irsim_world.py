# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
"""What the programs for ir-sim share: making a world of a hall's robots."""
import tempfile

import irsim
import yaml


def make_world(hall, size, robots, obstacles, step_s):
    """A world in which robots that touch something go on (collision mode "contact"); by default they
    would stop for good. Nothing is drawn.

    @param hall       a Hall: laser and footprint of the robots.
    @param size       of the world's sides [m].
    @param robots     poses (x, y, yaw).
    @param obstacles  as ir-sim describes them.
    @param step_s     of world.step() [s].
    """
    lidar = {"name": "lidar2d", "range_min": 0, "range_max": hall.range, "angle_range": hall.view,
             "number": hall.beams, "noise": False, "offset": [hall.laser_x, 0, 0]}
    robot = {"kinematics": {"name": "diff"},
             "shape": {"name": "polygon", "vertices": [list(point) for point in hall.footprint]},
             "vel_min": [-1, -3], "vel_max": [1, 3], "sensors": [lidar]}
    world = {"world": {"width": size, "height": size, "step_time": step_s, "sample_time": step_s,
                       "control_mode": "auto", "collision_mode": "contact"},
             "robot": [{**robot, "state": list(pose)} for pose in robots], "obstacle": obstacles}
    with tempfile.NamedTemporaryFile("w", suffix=".yaml") as file:
        yaml.dump(world, file)
        file.flush()
        return irsim.make(file.name, headless=True, log_level="ERROR")
