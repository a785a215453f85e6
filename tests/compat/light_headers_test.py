#!/usr/bin/env python3
# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
"""light_headers_test.py COMPILER INCLUDE_FOLDER...: fails if playerc++.h brings along a header that
takes long to compile, or that client programs have no business with: of a library that only
Playpen's sources use, of the simulator, or of Boost, which programs may include themselves. Also
compiles what old programs need: playerc.h as C++98, and, with the flags that playerc++.h names to a
program in C++98, members that are an extension of C++98.
"""

import re
import subprocess
import sys

HEAVY = re.compile(r"/(Eigen|opencv\d?|nlohmann|spdlog|fmt|asio|yaml-cpp|CLI|box2d|boost|sim|"
                   r"playerlike)/|/regex$|/(ranges|format|filesystem|chrono_io)$")


OLD_PROGRAM = """#include <libplayerc++/playerc++.h>
struct Robot { static const double kSpeed = 0.3; };
int main() { return Robot::kSpeed > 1; }
"""


def compile_text(compiler, folders, flags, text):
    return subprocess.run([compiler, *flags, "-fsyntax-only", *(f"-I{f}" for f in folders), "-x", "c++", "-"],
                          input=text, capture_output=True, text=True, check=False)


def check_old_programs(compiler, folders):
    run = compile_text(compiler, folders, ["-std=gnu++98", "-Wall", "-Wextra", "-Werror"],
                       "#include <libplayerc/playerc.h>\n")
    if run.returncode != 0:
        sys.exit(f"playerc.h does not compile as C++98:\n{run.stderr}")
    first = re.search(r"error: (.*)", compile_text(compiler, folders, ["-std=gnu++98"], OLD_PROGRAM).stderr)[1]
    flags = re.search(r"clang: (.*?)\)" if "clang" in compiler else r"compile with (.*?) \(", first)[1].split()
    run = compile_text(compiler, folders, flags, OLD_PROGRAM)
    if run.returncode != 0:
        sys.exit(f"an old program does not compile with {flags}:\n{run.stderr}")


def main():
    compiler, *folders = sys.argv[1:]
    check_old_programs(compiler, folders)
    run = compile_text(compiler, folders, ["-std=c++17", "-H"], "#include <libplayerc++/playerc++.h>\n")
    if run.returncode != 0:
        sys.exit(f"the header does not compile:\n{run.stderr}")
    headers = [m[1] for m in re.finditer(r"^\.+ (.*)$", run.stderr, re.M)]
    if not any(h.endswith("libplayerc++/playerc++.h") for h in headers):
        sys.exit("the compiler did not say what it includes")
    heavy = [h for h in headers if HEAVY.search(h)]
    if heavy:
        sys.exit("playerc++.h brings along:\n" + "\n".join(heavy))
    print(f"{len(headers)} headers, none of them heavy")


if __name__ == "__main__":
    main()
