#!/usr/bin/env python3
# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
"""Runs what a page tells of a server against `playpen serve`.

    with_server.py PLAYPEN WORLD FILE.py [ARGUMENT...]   a program, told host and port
    with_server.py PLAYPEN WORLD FILE.txt                a conversation: lines that begin with "> "
                                                         are sent, the others must come; "..."
                                                         stands for anything
The server must end well, too, when it is told to.
"""
import os
import pathlib
import re
import signal
import socket
import subprocess
import sys
import tempfile

# Anything that takes longer hangs.
TIMEOUT_S = float(os.environ.get("PLAYPEN_TEST_PATIENCE_S", 900))


def converse(port, script):
    lines = script.read_text(encoding="utf-8").splitlines()
    if not any(not line.startswith("> ") for line in lines):
        sys.exit(f"{script}: nothing is answered")
    with socket.create_connection(("127.0.0.1", port), TIMEOUT_S) as connection:
        stream = connection.makefile("rw", encoding="utf-8", newline="\n")
        for line in lines:
            if line.startswith("> "):
                stream.write(line[2:] + "\n")
                stream.flush()
                continue
            answer = stream.readline().rstrip("\n")
            if not re.fullmatch(".*".join(re.escape(part) for part in line.split("...")), answer):
                sys.exit(f"expected: {line}\nfound:    {answer}")


def main(playpen, world, file, *arguments):
    # A separate folder: two servers that write into one folder at the same time remove each other's
    # results.
    results = tempfile.TemporaryDirectory()
    server = subprocess.Popen(
        [playpen, "serve", world, "--tcp-port", "0", "--time", "lockstep", "--out", results.name],
        stdout=subprocess.PIPE, text=True)
    try:
        line = server.stdout.readline()
        found = re.match(r"listening on .*:(\d+)", line)
        if not found:
            sys.exit(f"the server says: {line!r}")
        port = int(found[1])
        if file.endswith(".py"):
            subprocess.run([sys.executable, file, "127.0.0.1", str(port), *arguments],
                           check=True, timeout=TIMEOUT_S)
        else:
            converse(port, pathlib.Path(file))
        server.send_signal(signal.SIGTERM)
        server.communicate(timeout=TIMEOUT_S)
        if server.returncode != 0:
            sys.exit(f"the server ended with status {server.returncode}")
    finally:
        server.kill()
        server.wait()
        results.cleanup()


if __name__ == "__main__":
    main(*sys.argv[1:])
