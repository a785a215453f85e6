# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
"""Drives a robot with the Python binding of Player's C library; other_languages.sh runs it."""
import sys

from playerc import *  # noqa: F403 (the binding has no other form)


def main(host, port):
    client = playerc_client(None, host, port)
    if client.connect() != 0:
        sys.exit(playerc_error_str())
    position = playerc_position2d(client, 0)
    laser = playerc_laser(client, 0)
    sonar = playerc_sonar(client, 0)
    ranger = playerc_ranger(client, 0)
    power = playerc_power(client, 0)
    floor = playerc_map(client, 0)
    simulation = playerc_simulation(client, 0)
    for device in (position, laser, sonar, ranger, power, floor, simulation):
        if device.subscribe(PLAYERC_OPEN_MODE) != 0:
            sys.exit(playerc_error_str())
    position.get_geom()
    position.enable(1)
    position.set_cmd_vel(0.3, 0.0, 0.2, 1)
    for _ in range(100):
        if client.read() is None:
            sys.exit(playerc_error_str())
    position.set_cmd_vel(0.0, 0.0, 0.0, 1)
    print("position:", position.px, position.py, position.pa, "size:", position.size)
    print("laser:", laser.scan_count, "beams,", laser.ranges[0], "m")
    print("sonar:", sonar.scan_count, "ranger:", ranger.ranges_count)
    print("power:", power.charge, "V")
    print("map:", floor.get_map(), floor.width, "x", floor.height)
    print("pose:", simulation.get_pose2d("pioneer1"))
    client.disconnect()


main(sys.argv[1], int(sys.argv[2]))
