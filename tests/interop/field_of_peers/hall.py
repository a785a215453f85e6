# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
"""What the programs in Python share: the hall, the wandering rule, the measurement."""
import sys
import time

STEP_S = 0.1
LEAST_TIME_S = 2.0


class Hall:
    """The hall that `bench_field --hall N` describes, or the arena of --arena, in metres and radians.

    side (of the hall), beams, first (angle of the first beam), step (angle between two), range, laser_x: numbers;
    footprint: points; boxes: (x, y, size_x, size_y); outlines: corners (x, y) of the arena's room and
    of each block; robots: (x, y, yaw).
    """

    def __init__(self, lines):
        self.boxes, self.outlines, self.robots = [], [], []
        for line in lines:
            what, *words = line.split()
            numbers = [float(word) for word in words]
            if what == "side":
                (self.side,) = numbers
            elif what == "laser":
                beams, self.first, self.step, self.range, self.laser_x = numbers
                self.beams = int(beams)
            elif what == "footprint":
                self.footprint = list(zip(numbers[::2], numbers[1::2]))
            elif what == "box":
                x, y, size_x, size_y = numbers
                self.boxes.append((x, y, size_x, size_y))
            elif what == "outline":
                self.outlines.append(list(zip(numbers[::2], numbers[1::2])))
            elif what == "robot":
                x, y, yaw = numbers
                self.robots.append((x, y, yaw))
            else:
                raise ValueError(f"unknown line {line!r}")

    @property
    def view(self):
        """Angle from the first beam to the last one [rad]."""
        return (self.beams - 1) * self.step


def choose(ranges, robot):
    """The rule of tests/bench/wanderers.h: speed [m/s] and turn rate [rad/s] of a robot.

    @param ranges  a numpy array, beam 0 the rightmost; numpy looks for the least one.
    """
    nearest = int(ranges.argmin())
    if ranges[nearest] < 0.25:
        return 0.0, -1.5 if nearest > len(ranges) // 2 else 1.5
    return 0.3, 0.1 * (robot % 13 - 6)


def print_figure(hall, one_round, positions):
    """Prints simulated seconds a second of processor time: the best of several turns.

    @param one_round  lets all robots choose, then simulates STEP_S.
    @param positions  returns the (x, y) of all robots; they must be in the hall at the end.
    """
    rounds = max(20, 2000 // len(hall.robots))
    best_s, total_s = float("inf"), 0.0
    while total_s < LEAST_TIME_S:
        begin_s = time.process_time()
        for _ in range(rounds):
            one_round()
        used_s = time.process_time() - begin_s
        best_s, total_s = min(best_s, used_s), total_s + used_s
    if not all(0 < x < hall.side and 0 < y < hall.side for x, y in positions()):
        sys.exit("a robot has left the hall")
    print(f"figure field {rounds * STEP_S / best_s:.6g}")
