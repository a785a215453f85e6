#!/usr/bin/env python3
# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
"""Draws the maps of this folder. Needs nothing but Python: ./make_maps.py"""

import math
import pathlib
import struct
import zlib

FREE, WALL = 255, 0


class Plan:
    """A floor plan in grey pixels; coordinates in pixels from the bottom left corner."""

    def __init__(self, width, height):
        self.width, self.height = width, height
        self.rows = [bytearray([FREE] * width) for _ in range(height)]

    def box(self, x, y, width, height, shade=WALL):
        for row in range(y, y + height):
            for column in range(x, x + width):
                self.rows[self.height - 1 - row][column] = shade

    def disc(self, x, y, radius, shade=WALL):
        for row in range(y - radius, y + radius + 1):
            for column in range(x - radius, x + radius + 1):
                if (row - y) ** 2 + (column - x) ** 2 <= radius * radius:
                    self.rows[self.height - 1 - row][column] = shade

    def save_png(self, path):
        """8-bit grey, no filter (PNG specification, sections 5 and 9)."""

        def chunk(kind, data):
            checksum = struct.pack(">I", zlib.crc32(kind + data))
            return struct.pack(">I", len(data)) + kind + data + checksum

        header = struct.pack(">IIBBBBB", self.width, self.height, 8, 0, 0, 0, 0)
        pixels = zlib.compress(b"".join(b"\0" + bytes(row) for row in self.rows), 9)
        path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", pixels)
                         + chunk(b"IEND", b""))


def flat():
    """Four rooms and a corridor, 200 x 150 pixels: 10 x 7.5 m at 0.05 m a pixel."""
    plan = Plan(200, 150)
    for x, y, width, height in [(0, 0, 200, 2), (0, 148, 200, 2), (0, 0, 2, 150), (198, 0, 2, 150)]:
        plan.box(x, y, width, height)
    plan.box(0, 60, 200, 2)        # between the lower rooms and the corridor
    plan.box(0, 84, 200, 2)        # between the corridor and the upper rooms
    plan.box(100, 0, 2, 60)        # between the lower rooms
    plan.box(100, 84, 2, 66)       # between the upper rooms
    for x in (30, 150):            # doors into the corridor, 1 m wide
        plan.box(x, 60, 20, 2, FREE)
        plan.box(x, 84, 20, 2, FREE)
    plan.box(100, 100, 2, 20, FREE)  # door between the upper rooms
    plan.box(60, 20, 24, 12)       # a table
    plan.disc(150, 30, 8)          # a pillar
    plan.box(20, 130, 40, 18)      # shelves
    plan.box(120, 138, 60, 10)
    return plan


# The cave in metres; the centre of the floor is (0, 0).
CHAMBERS = [(-5.2, 5.0, 2.3), (-0.8, 4.3, 1.5), (5.0, 5.1, 2.2), (-5.2, -0.6, 1.6), (0.4, 0.2, 2.4),
            (5.3, 0.3, 1.7), (-4.9, -5.3, 2.2), (1.0, -4.6, 1.6), (5.4, -5.3, 2.0),
            (1.6, 6.6, 0.9), (-2.2, -2.4, 0.9), (-1.6, -6.4, 1.0), (6.8, -2.7, 0.8), (3.0, 2.8, 0.9)]
TUNNELS = [(0, 1), (1, 2), (0, 3), (3, 6), (6, 11), (11, 7), (7, 8), (8, 12), (12, 5), (5, 2),
           (1, 4), (4, 13), (13, 2), (4, 10), (10, 6), (4, 7), (1, 9), (3, 10)]
ROCKS = [(1.1, 0.9, 0.45), (-0.6, -0.4, 0.35), (-5.6, 5.5, 0.45), (5.6, -5.7, 0.45),
         (5.6, 5.7, 0.35), (-4.6, -5.0, 0.4)]
TUNNEL_HALF_WIDTH = 0.75


def wobble(x, y):
    """A smooth unevenness of the rock, within about 0.4 m."""
    return (0.16 * math.sin(1.6 * x + 1.1 * y) + 0.13 * math.sin(1.9 * y - 2.3 * x + 1.0)
            + 0.09 * math.sin(4.3 * x + 0.4) * math.sin(3.9 * y + 2.0))


def to_segment(x, y, ax, ay, bx, by):
    """Distance of a point from a line between two."""
    dx, dy = bx - ax, by - ay
    t = max(0.0, min(1.0, ((x - ax) * dx + (y - ay) * dy) / (dx * dx + dy * dy)))
    return math.hypot(x - ax - t * dx, y - ay - t * dy)


def into_rock(x, y):
    """How deep a point lies in the rock, roughly; below 0: in the open [m]."""
    depth = min(math.hypot(x - cx, y - cy) - radius for cx, cy, radius in CHAMBERS)
    for i, j in TUNNELS:
        (ax, ay, _), (bx, by, _) = CHAMBERS[i], CHAMBERS[j]
        depth = min(depth, to_segment(x, y, ax, ay, bx, by) - TUNNEL_HALF_WIDTH)
    depth += wobble(x, y)
    for cx, cy, radius in ROCKS:
        depth = max(depth, radius - math.hypot(x - cx, y - cy) + 0.5 * wobble(2 * x, 2 * y))
    return max(depth, 0.25 - (8.0 - max(abs(x), abs(y))))


def cave():
    """Chambers, tunnels between them and rocks, 320 x 320 pixels: 16 x 16 m at 0.05 m a pixel."""
    plan = Plan(320, 320)
    for row in range(320):
        for column in range(320):
            if into_rock((column + 0.5) * 0.05 - 8.0, (row + 0.5) * 0.05 - 8.0) > 0.0:
                plan.box(column, row, 1, 1)
    return plan


# The clearing in metres; the centre of the floor is (0, 0). Tongues of rock start at the walls,
# rocks stand alone.
TONGUES = [(-8.0, 1.5, -4.6, 1.0, 0.4), (1.5, -8.0, 1.0, -4.4, 0.45), (8.0, -1.0, 4.4, -1.6, 0.4),
           (-1.0, 8.0, -1.6, 4.4, 0.45)]
CLEARING_ROCKS = [(0.4, 0.2, 0.9), (5.0, 4.6, 0.7), (-4.6, 5.2, 0.5), (5.4, -5.6, 0.6)]


def clearing():
    """One large room with rocks, free round (-7, -7); 320 x 320 pixels: 16 x 16 m."""
    plan = Plan(320, 320)
    for row in range(320):
        for column in range(320):
            x, y = (column + 0.5) * 0.05 - 8.0, (row + 0.5) * 0.05 - 8.0
            depth = 0.3 + 0.5 * wobble(x, y) - (8.0 - max(abs(x), abs(y)))
            for ax, ay, bx, by, half_width in TONGUES:
                depth = max(depth, half_width + wobble(x, y) - to_segment(x, y, ax, ay, bx, by))
            for cx, cy, radius in CLEARING_ROCKS:
                depth = max(depth, radius - math.hypot(x - cx, y - cy) + wobble(x, y))
            if depth > 0.0 or max(abs(x), abs(y)) > 7.9:
                plan.box(column, row, 1, 1)
    return plan


def office():
    """A corridor, rooms on both sides, desks; 600 x 360 pixels: 30 x 18 m at 0.05 m a pixel."""
    plan = Plan(600, 360)

    def box(x, y, width, height, shade=WALL):  # in m from the bottom left corner
        plan.box(*(round(v / 0.05) for v in (x, y, width, height)), shade)

    for x, y, width, height in [(0, 0, 30, 0.2), (0, 17.8, 30, 0.2), (0, 0, 0.2, 18),
                                (29.8, 0, 0.2, 18)]:
        box(x, y, width, height)
    box(0, 7.0, 30, 0.15)     # the corridor's lower wall
    box(0, 10.0, 30, 0.15)    # and its upper one
    for x in (6.0, 12.0, 18.0, 24.0):
        box(x, 10.0, 0.15, 8)   # five rooms above
    for x in (8.0, 20.0):
        box(x, 0, 0.15, 7)      # a hall between two rooms below
    for x in (2.4, 8.4, 14.4, 20.4, 26.4):
        box(x, 10.0, 1.2, 0.15, FREE)  # doors, 1.2 m wide
    for x in (3.4, 25.2):
        box(x, 7.0, 1.2, 0.15, FREE)
    box(12.5, 7.0, 3.2, 0.15, FREE)    # the hall is open
    box(12.0, 13.6, 0.15, 1.2, FREE)   # doors from room to room
    box(20.0, 3.0, 0.15, 1.2, FREE)

    for x in (0.6, 6.6, 18.6, 24.6):   # two desks and a cupboard each in four rooms above
        box(x, 16.4, 1.8, 0.8)
        box(x + 3.2, 16.4, 1.8, 0.8)
        box(x + 4.4, 12.4, 0.5, 1.6)
    box(13.6, 13.4, 2.8, 1.4)          # the table of the meeting room
    box(1.0, 1.0, 1.8, 0.8)            # the workshop below on the left
    box(4.2, 1.0, 1.8, 0.8)
    box(1.0, 4.6, 0.8, 1.8)
    for x in (10.5, 14.0, 17.5):       # pillars of the hall
        plan.disc(round(x / 0.05), round(3.6 / 0.05), 6)
    box(13.0, 0.2, 2.6, 0.7)           # its reception
    for x in (22.0, 24.5, 27.0):       # shelves of the store
        box(x, 1.2, 0.6, 3.6)
    for x in (1.2, 18.6):              # benches in the corridor
        box(x, 9.4, 1.6, 0.5)
    return plan


if __name__ == "__main__":
    here = pathlib.Path(__file__).resolve().parent
    for draw in (flat, cave, clearing, office):
        draw().save_png(here / f"{draw.__name__}.png")
