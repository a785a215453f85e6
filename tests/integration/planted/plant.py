#!/usr/bin/env python3
# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
"""Copies sources of a program into a folder, with the faults of faults.ini as choices at run time.

Usage: plant.py PROGRAM FOLDER SOURCE...

An expression becomes `(planted::has("name") ? (faulty) : (right))`, so one build has all faults of a
program (mutant schemata: R. H. Untch, A. J. Offutt and M. J. Harrold, "Mutation analysis using mutant
schemata", ISSTA 1993). `main` becomes `program_main`, which main.cpp calls. From a page (.md) the
block after `<!-- file: main.cpp -->` is taken. FOLDER/faults.inc gets the names and descriptions.
Exit status: 2 if an expression does not occur exactly once.
"""
import configparser
import re
import sys
from pathlib import Path

MAIN = re.compile(r"\bint main\([^)]*\)")


def code_of(source):
    """Name and text of a source; of a page its program."""
    text = source.read_text(encoding="utf-8")
    if source.suffix != ".md":
        return source.name, text
    block = re.search(r"<!-- file: main\.cpp -->\n```cpp\n(.*?)```", text, re.DOTALL)
    return "main.cc", block[1]


def main():
    program, folder, *sources = sys.argv[1:]
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    parser = configparser.ConfigParser(interpolation=None)
    parser.read(Path(__file__).with_name("faults.ini"), encoding="utf-8")
    faults = {name.split("/")[1]: parser[name] for name in parser.sections()
              if name.startswith(program + "/")}
    codes = dict(code_of(Path(source)) for source in sources)
    choices = {}  # of each expression
    for name, fault in faults.items():
        places = [(file, text.count(fault["right"])) for file, text in codes.items()]
        if sum(count for _, count in places) != 1:
            sys.exit(f"faults.ini: [{program}/{name}]: '{fault['right']}' must occur once in "
                     f"{', '.join(sources)}; adapt the list to the source")
        choices.setdefault(fault["right"], []).append((name, fault["faulty"]))
    for file, text in codes.items():
        for right, list_of_faults in choices.items():
            choice = right
            for name, faulty in list_of_faults:
                choice = f'(planted::has("{name}") ? ({faulty}) : ({choice}))'
            text = text.replace(right, choice)
        text = MAIN.sub("int program_main([[maybe_unused]] int argc, [[maybe_unused]] char** argv)",
                        text)
        (folder / file).write_text('#include "planted.h"\n' + text, encoding="utf-8")
    (folder / "faults.inc").write_text(
        "".join(f'{{"{name}", "{fault["text"]}"}},\n' for name, fault in faults.items()),
        encoding="utf-8")


if __name__ == "__main__":
    main()
