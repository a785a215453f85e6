#!/usr/bin/env python3
# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
"""Makes submissions of a made-up class, for tests of `playpen class`.

Usage: made_up_class.py honest FOLDER NUMBER
       made_up_class.py copy FOLDER ID NEW_ID

honest  writes NUMBER programs in C to FOLDER/ID/robot.c. They follow 20 rules (rules.py) with constants and parts that
        are drawn for each of them.
copy    writes FOLDER/NEW_ID/robot.c, a disguised copy of FOLDER/ID/robot.c: with other names, no comments, the
        functions in another order, and each constant with a decimal point changed by one to three units of its third
        digit.

Equal arguments give equal files.
"""

import math
import os
import random
import re
import sys

sys.dont_write_bytecode = True  # the sources may belong to somebody else
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import rules  # noqa: E402

HEAD = """#include <libplayerc/playerc.h>
#include <math.h>
#include <stdio.h>
"""

MAIN = """
int main(void) {
  playerc_client_t *client = playerc_client_create(NULL, "localhost", 6665);
  if (playerc_client_connect(client) != 0) return 1;
  position = playerc_position2d_create(client, 0);
  laser = playerc_laser_create(client, 0);
  if (playerc_position2d_subscribe(position, PLAYERC_OPEN_MODE) != 0 ||
      playerc_laser_subscribe(laser, PLAYERC_OPEN_MODE) != 0) {
    fprintf(stderr, "%s\\n", playerc_error_str());
    return 1;
  }
  while (playerc_client_read(client) != NULL) {
    if (laser->scan_count > 0) decide();
  }
  return 0;
}
"""

DEVICES = """static playerc_position2d_t *position;
static playerc_laser_t *laser;
"""


def constant(name, value):
    kind = "int" if isinstance(value, int) else "double"
    return f"static const {kind} {name} = {value};\n"


def honest_program(number):
    """The text of a program. Programs whose numbers differ by 20 follow the same rule."""
    name, constants, functions = rules.RULES[number % len(rules.RULES)]
    draw = random.Random(f"program {number}")
    sense_constants, sense = draw.choice(rules.SENSES)
    drive_constants, drive = draw.choice(rules.DRIVES)
    chosen = {**constants, **sense_constants, **drive_constants}
    text = f"/* {name}, written by student {number} */\n" + HEAD + "\n"
    text += "".join(constant(key, draw.choice(values)) for key, values in chosen.items())
    text += "\n" + DEVICES
    if "nearest(" in functions:
        text += sense
    return text + drive + functions + MAIN


def write_program(folder, student, text):
    place = os.path.join(folder, student)
    os.makedirs(place, exist_ok=True)
    with open(os.path.join(place, "robot.c"), "w", encoding="utf-8") as file:
        file.write(text)


def changed_in_third_digit(value, draw):
    unit = 10.0 ** (math.floor(math.log10(abs(value))) - 2)
    return value + draw.choice([-3, -2, -1, 1, 2, 3]) * unit


def renamed(text, draw):
    """With other names for all that the text defines: what follows the name of a type or a star."""
    kinds = r"(?:double|int|unsigned|void|playerc_\w+_t)"
    names = set(re.findall(rf"\b{kinds}\s+\**\s*([A-Za-z_]\w*)", text)) - {"main"}
    fresh = draw.sample(range(100, 1000), len(names))
    new = {name: f"value_{number}" for name, number in zip(sorted(names), fresh)}
    # Members of the library's structures and its functions keep their names.
    return re.sub(r'(?<![\w.>"])[A-Za-z_]\w*', lambda m: new.get(m.group(), m.group()), text)


def reordered(text, draw):
    """With the functions in another order, behind their prototypes."""
    text = re.sub(r"/\*.*?\*/\n?", "", text)
    pattern = r"^(?:static )?[a-z]\w* \**\w+\([^)\n]*\) \{(?:[^\n]*\}\n|\n.*?^\}\n)"
    functions = re.findall(pattern, text, flags=re.M | re.S)
    rest = text
    for function in functions:
        rest = rest.replace(function, "", 1)
    functions.reverse()
    cut = draw.randrange(len(functions))
    functions = functions[cut:] + functions[:cut]
    prototypes = [function[: function.index(" {")] + ";\n" for function in functions]
    return re.sub(r"\n{2,}", "\n", rest) + "\n" + "".join(prototypes) + "\n" + "\n".join(functions)


def disguised(text, seed):
    draw = random.Random(seed)
    text = re.sub(
        r"(static const double \w+ = )([-\d.]+);",
        lambda m: f"{m.group(1)}{changed_in_third_digit(float(m.group(2)), draw):.6g};",
        text,
    )
    return renamed(reordered(text, draw), draw)


def main(arguments):
    if len(arguments) == 3 and arguments[0] == "honest":
        for number in range(int(arguments[2])):
            write_program(arguments[1], f"student_{number:03}", honest_program(number))
        return 0
    if len(arguments) == 4 and arguments[0] == "copy":
        folder, student, new_student = arguments[1:]
        with open(os.path.join(folder, student, "robot.c"), encoding="utf-8") as file:
            text = file.read()
        write_program(folder, new_student, disguised(text, f"copy {new_student}"))
        return 0
    print(__doc__, file=sys.stderr)
    return 2


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
