#!/usr/bin/env python3
# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
"""Writes random worlds for Stage: random_world.py --worlds N --seed S --out DIR.

World K depends on the seed and K only. They have what worlds of others have and readers get wrong: bodies and obstacles
of several and concave blocks, heights, origins, parts on parts, things that rangers or robots do not meet, rangers of
several sensors, robots of equal height that see each other, and bitmaps. many_worlds.py compares them with real Stage.
"""
import argparse
import math
import os
import random
import struct
import zlib

HALF = 6.0  # of the floor [m]


def number(value):
    return "%.6g" % value


def tuple_of(*values):
    return "[%s]" % " ".join(number(value) for value in values)


class World:
    def __init__(self, random_numbers):
        self.random = random_numbers
        self.taken = []  # circles (x, y, radius) in which something stands
        self.pictures = {}

    def chance(self, probability):
        return self.random.random() < probability

    def between(self, low, high):
        return self.random.uniform(low, high)

    def place(self, radius):
        """A free place, or None."""
        for _ in range(60):
            x, y = self.between(-HALF + 1, HALF - 1), self.between(-HALF + 1, HALF - 1)
            if all(math.hypot(x - a, y - b) > radius + r + 0.1 for a, b, r in self.taken):
                self.taken.append((x, y, radius))
                return round(x, 3), round(y, 3)
        return None

    def polygon(self):
        """Points of a block in any unit: Stage stretches all blocks of a model to its size."""
        kind = self.random.choice(["box", "box", "convex", "l", "u", "star", "t"])
        if kind == "box":
            return [(0, 0), (1, 0), (1, 1), (0, 1)]
        if kind == "l":
            return [(0, 0), (3, 0), (3, 1), (1, 1), (1, 3), (0, 3)]
        if kind == "u":
            return [(0, 0), (4, 0), (4, 3), (3, 3), (3, 1), (1, 1), (1, 3), (0, 3)]
        if kind == "t":
            return [(1, 0), (2, 0), (2, 2), (3, 2), (3, 3), (0, 3), (0, 2), (1, 2)]
        count = self.random.randint(3, 8)
        points = []
        for i in range(count):
            radius = (1.0 if kind == "convex" or i % 2 == 0 else 0.45)
            angle = 2 * math.pi * i / count
            points.append((round(radius * math.cos(angle), 3), round(radius * math.sin(angle), 3)))
        return points

    def block(self, points, low, high):
        rows = ["block( points %d" % len(points)]
        rows += ["  point[%d] %s" % (i, tuple_of(*point)) for i, point in enumerate(points)]
        return rows + ["  z %s )" % tuple_of(low, high)]

    def shape(self):
        """Blocks of a model; none is a box."""
        if self.chance(0.4):
            return []
        if self.chance(0.7):
            return self.block(self.polygon(), 0, self.random.choice([1, 0.2, 0.5]))
        rows = []
        for _ in range(self.random.randint(2, 3)):
            dx, dy = self.between(-3, 3), self.between(-3, 3)
            points = [(round(x + dx, 3), round(y + dy, 3)) for x, y in self.polygon()]
            low = 0.3 if self.chance(0.05) else 0
            rows += self.block(points, low, low + self.random.choice([0.3, 0.5, 1]))
        return rows

    def returns(self, obstacle):
        rows = []
        if self.chance(0.15):
            rows.append("obstacle_return 0")
        if self.chance(0.15):
            rows.append("ranger_return %s" % self.random.choice(["-1", "-1", "0", "0.5"]))
        if self.chance(0.2):
            rows.append("fiducial_return %d" % self.random.randint(1, 20))
        if obstacle and self.chance(0.1):
            rows.append("gripper_return 1")
        return rows

    def origin(self, size):
        if not self.chance(0.2):
            return []
        turn = self.random.choice([0, 0, 90, 30])
        return ["origin %s" % tuple_of(self.between(-0.3, 0.3) * size[0], self.between(-0.3, 0.3) * size[1],
                                       self.random.choice([0, 0, 0.1]), turn)]

    def picture(self):
        """A bitmap of black boxes on white, as a PNG of one channel."""
        width, height = self.random.randint(20, 60), self.random.randint(20, 60)
        cells = [[255] * width for _ in range(height)]
        for _ in range(self.random.randint(1, 4)):
            left, top = self.random.randrange(width - 4), self.random.randrange(height - 4)
            for row in range(top, min(height, top + self.random.randint(3, 14))):
                for column in range(left, min(width, left + self.random.randint(3, 14))):
                    cells[row][column] = 0
        data = b"".join(b"\0" + bytes(row) for row in cells)

        def chunk(name, content):
            return (struct.pack(">I", len(content)) + name + content +
                    struct.pack(">I", zlib.crc32(name + content)))

        name = "picture_%d.png" % len(self.pictures)
        self.pictures[name] = (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 0, 0, 0, 0)) +
                               chunk(b"IDAT", zlib.compress(data)) + chunk(b"IEND", b""))
        return name

    def sensor(self, samples, range_max):
        rows = ["sensor( range %s" % tuple_of(self.random.choice([0, 0, 0.1]), range_max),
                "  fov %s samples %d" % (number(self.random.choice([30, 90, 180, 270]) if samples > 1 else 20), samples)]
        rows.append("  pose %s" % tuple_of(self.between(-0.1, 0.1), self.between(-0.1, 0.1),
                                           self.random.choice([0, 0, 0.05]), self.random.randrange(-180, 180, 15)))
        if self.chance(0.3):
            rows.append("  size %s" % tuple_of(0.02, 0.04, self.random.choice([0.02, 0.1])))
        return rows + [")"]

    def ranger(self, height):
        rows = ["ranger("]
        kind = self.random.choice(["laser", "laser", "ring", "several"])
        count = {"laser": 1, "ring": self.random.randint(2, 8), "several": self.random.randint(2, 3)}[kind]
        range_max = self.random.choice([3, 5, 8])
        for _ in range(count):
            samples = {"laser": self.random.choice([19, 45, 91]), "ring": 1, "several": self.random.choice([3, 5])}[kind]
            rows += ["  " + row for row in self.sensor(
                samples, range_max if self.chance(0.97) else 4)]
        if self.chance(0.7):
            rows.append("  size %s" % tuple_of(self.random.choice([0.05, 0.15]), 0.15, self.random.choice([0.1, 0.2])))
        # Mostly on the body, sometimes within it.
        rows.append("  pose %s" % tuple_of(self.between(-0.1, 0.1), self.between(-0.1, 0.1),
                                           self.random.choice([0, 0, 0, -0.5 * height, 0.1]),
                                           self.random.choice([0, 0, 0, 90, -20])))
        if self.chance(0.2):
            rows.append("  ranger_return -1")
        return rows + [")"]

    def part(self, size):
        """A model on another one."""
        rows = ["model( pose %s" % tuple_of(self.between(-0.2, 0.2) * size[0], self.between(-0.2, 0.2) * size[1],
                                            self.random.choice([0, 0, 0.05, -0.5 * size[2]]), self.random.choice([0, 45])),
                "  size %s" % tuple_of(self.between(0.3, 0.8) * size[0], self.between(0.3, 0.8) * size[1],
                                       self.random.choice([0.05, 0.1, 0.3]))]
        return rows + ["  " + row for row in self.returns(False)] + [")"]

    def robot_type(self, index):
        size = (self.between(0.2, 0.6), self.between(0.2, 0.5), self.random.choice([0.1, 0.2, 0.3, 0.5]))
        rows = ["define robot_%d position(" % index, "  size %s" % tuple_of(*size), "  color \"red\""]
        body = self.shape() + self.returns(False) + self.origin(size)
        if self.chance(0.3):
            body += self.part(size)
        for _ in range(self.random.choice([1, 1, 1, 2])):
            body += self.ranger(size[2])
        rows += ["  " + row for row in body]
        return rows + [")"], 1.2 * max(size)

    def obstacle(self):
        size = (self.between(0.2, 2.0), self.between(0.2, 2.0), self.random.choice([0.01, 0.1, 0.2, 0.3, 0.5, 1.0]))
        at = self.place(0.75 * math.hypot(size[0], size[1]))
        if at is None:
            return []
        z = self.random.choice([0.1, 0.25]) if self.chance(0.03) else 0
        rows = ["model( pose %s size %s color \"blue\"" % (
            tuple_of(at[0], at[1], z, self.random.choice([0, 0, 90, self.random.randrange(0, 360, 15)])), tuple_of(*size))]
        body = self.returns(True) + self.origin(size)
        if self.chance(0.15):
            body.append("bitmap \"%s\"" % self.picture())
            if self.chance(0.5):
                body.append("boundary 1")
        else:
            body += self.shape()
            if self.chance(0.2):
                body += self.part(size)
        return rows + ["  " + row for row in body] + [")"]

    def text(self):
        rows = ["resolution %s" % self.random.choice(["0.02", "0.02", "0.01", "0.05"]), "interval_sim 100"]
        height = self.random.choice([0.3, 0.5, 1.0])
        rows.append("model( size %s boundary 1 noblocks 1 color \"gray30\" )" % tuple_of(2 * HALF, 2 * HALF, height))
        types = self.random.choice([1, 1, 2])
        robots = []
        radii = []
        for index in range(types):
            lines, radius = self.robot_type(index)
            rows += lines
            radii.append(radius)
        for number_of_robot in range(self.random.randint(1, 3)):
            kind = self.random.randrange(types)
            at = self.place(radii[kind])
            if at is not None:
                robots.append("robot_%d( name \"r%d\" pose %s )" % (
                    kind, number_of_robot, tuple_of(at[0], at[1], 0, self.random.randrange(-180, 180, 10))))
        for _ in range(self.random.randint(3, 10)):
            rows += self.obstacle()
        return "\n".join(rows + robots) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--worlds", type=int, default=500)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--out", required=True)
    arguments = parser.parse_args()
    for index in range(arguments.worlds):
        world = World(random.Random("%d %d" % (arguments.seed, index)))
        text = world.text()
        folder = os.path.join(arguments.out, "world_%04d" % index)
        os.makedirs(folder, exist_ok=True)
        with open(os.path.join(folder, "world_%04d.world" % index), "w", encoding="ascii") as file:
            file.write(text)
        for name, content in world.pictures.items():
            with open(os.path.join(folder, name), "wb") as file:
                file.write(content)


if __name__ == "__main__":
    main()
