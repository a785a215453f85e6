#!/usr/bin/env python3
# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
"""light_headers_test.py COMPILER INCLUDE_FOLDER...: fails if playerc++.h brings along a header that
takes long to compile, or that client programs have no business with: of a library that only
Playpen's sources use, of the simulator, or of Boost, which programs may include themselves.
"""

import re
import subprocess
import sys

HEAVY = re.compile(r"/(Eigen|opencv\d?|nlohmann|spdlog|fmt|asio|yaml-cpp|CLI|box2d|boost|sim|"
                   r"playerlike)/|/regex$|/(ranges|format|filesystem|chrono_io)$")


def main():
    compiler, *folders = sys.argv[1:]
    run = subprocess.run([compiler, "-std=c++17", "-H", "-fsyntax-only", *(f"-I{f}" for f in folders), "-x", "c++",
                          "-"],
                         input="#include <libplayerc++/playerc++.h>\n", capture_output=True,
                         text=True, check=False)
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
