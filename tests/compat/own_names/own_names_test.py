#!/usr/bin/env python3
# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
"""own_names_test.py COMPILER PLAYPEN WORLD LIBRARY INCLUDE_FOLDER...: fails if a program's own
functions or variables get into the library.

A C program may define read(), or a variable y0, without knowing that the C library has such names.
The dynamic linker then gives them to all shared libraries. The test collects the names of all
functions of the C library that Playpen's library and those below it call, defines all of them in one
program, as functions that end the process and as variables, and runs a short Player program with
them: in its own process, by `playpen run`, and on a server. If that fails, it says which names did
it.
"""

import os
import pathlib
import re
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent

# Of the program, deliberately: what one allocator gives, the same one must take back.
ALLOCATION = r"\w*alloc\w*|free|memalign|posix_memalign"
# Compilers call these for loops, copies and casts, so a program's must do what the C library's do.
COMPILERS = r"mem(cpy|move|set|cmp)|strlen|strcmp"
# What the library needs to redirect its calls.
LOADING = r"dl\w+|mprotect|sysconf"
# The C++ library calls these before that.
LOCALE = r"wctob|btowc"
# Reserved by the C standard and by POSIX: no program defines them.
RESERVED = r"_\w+|pthread_\w+"
EXCLUDED = re.compile("|".join([ALLOCATION, COMPILERS, LOADING, LOCALE, RESERVED]))
# Names that no library below calls today, or only some of the systems.
MORE = """accept bind listen select poll time clock sleep usleep index log y0 y1 j0 j1 signal pause wait kill link
remove rename access pipe dup truncate send recv connect stat read write open close""".split()


def run(*command, **options):
    return subprocess.run(command, capture_output=True, text=True, check=False, **options)


def needed(library):
    """The library and all libraries that it needs, except the C library itself."""
    found = re.findall(r"=> (/\S+)", run("ldd", library).stdout)
    return [library] + [f for f in found if not re.search(r"/(libc|libm|ld-\w[^/]*)\.so", f)]


def called_names(libraries):
    names = set(MORE)
    for library in libraries:
        table = run("readelf", "--dyn-syms", "-W", library).stdout
        names.update(re.findall(r"FUNC +(?:GLOBAL|WEAK) +DEFAULT +UND (\w+)@GLIBC_", table))
    return sorted(n for n in names if not EXCLUDED.fullmatch(n))


class Programs:
    def __init__(self, folder, arguments):
        self.folder = pathlib.Path(folder)
        self.compiler, self.playpen, self.world, self.player_library, *self.includes = arguments
        self.flags = ["-w", "-fno-builtin", "-O1"]
        self.servers = []
        self.main = self.folder / "main.o"
        done = run(self.compiler, "-c", *self.flags, *(f"-I{i}" for i in self.includes),
                   str(HERE / "program.c"), "-o", str(self.main))
        if done.returncode != 0:
            sys.exit(done.stderr)

    def link(self, definition, names):
        source = self.folder / "names.c"
        source.write_text("".join(definition.format(n) + "\n" for n in names), encoding="utf-8")
        program = self.folder / "program"
        done = run(self.compiler, *self.flags, str(source), str(self.main), self.player_library,
                   f"-Wl,-rpath,{pathlib.Path(self.player_library).parent}", "-o", str(program))
        if done.returncode != 0:
            sys.exit(done.stderr)
        return str(program)

    def server(self):
        """The address of a new server."""
        command = [self.playpen, "serve", self.world, "--tcp-port", "0", "--time", "lockstep", "--out",
                   str(self.folder / "served")]
        self.servers.append(subprocess.Popen(command, stdout=subprocess.PIPE, text=True))
        return re.fullmatch(r"listening on (\S+)\n", self.servers[-1].stdout.readline())[1]

    def stop(self):
        for server in self.servers:
            server.kill()
            server.communicate()

    def problem(self, way, definition, names):
        """What went wrong, or None."""
        program = self.link(definition, names)
        picture = self.folder / "picture.ppm"
        picture.unlink(missing_ok=True)
        if way == "alone":
            command = [program, f"sim:{self.world}", str(picture)]
        elif way == "by playpen run":
            command = [self.playpen, "run", self.world, "--out", str(self.folder / "out"), "--",
                       program, "localhost", str(picture)]
        else:
            command = [program, "tcp://" + self.server(), str(picture)]
        done = run(*command, timeout=300, env={**os.environ, "PLAYPEN_OUT": str(self.folder / "out")})
        if done.returncode != 0:
            return f"status {done.returncode}: {done.stdout[-300:]}{done.stderr[-700:]}"
        return None if picture.stat().st_size > 1000 else "no picture"


def main():
    names = called_names(needed(sys.argv[4]))
    if len(names) < 150 or "read" not in names:
        sys.exit(f"only {len(names)} names: {names}")
    with tempfile.TemporaryDirectory() as folder:
        programs = Programs(folder, sys.argv[1:])
        try:
            for way in ("alone", "by playpen run", "on a server"):
                for definition in ("void {0}(void) {{ __builtin_trap(); }}", "char {0}[64];"):
                    problem = programs.problem(way, definition, names)
                    if problem is None:
                        continue
                    guilty = [n for n in names if programs.problem(way, definition, [n])]
                    sys.exit(f"{way}, {definition}: {problem}\neach alone: {guilty}")
        finally:
            programs.stop()
    print(f"{len(names)} names")


if __name__ == "__main__":
    main()
