#!/usr/bin/env python3
# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
"""Draws the maps of this folder. Needs nothing but Python: ./make_maps.py"""

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


if __name__ == "__main__":
    flat().save_png(pathlib.Path(__file__).resolve().parent / "flat.png")
