# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
"""Runs of Playpen with a live page, for tests and pictures of the page."""

import json
import secrets
import signal
import subprocess


class PageOf:
    """A run with a page, on a free port and with a token of its own.

    command: the arguments of playpen without the page's options; folder: for files of the run;
    program: what `playpen run` runs.
    """

    def __init__(self, command, folder, program=()):
        self.token = secrets.token_hex(16)
        tokens = folder / "tokens.json"
        tokens.touch(mode=0o600)
        tokens.write_text(json.dumps({"command": self.token}))
        self.process = subprocess.Popen(
            [*command, "--page", "--page-port", "0", "--page-token-file", str(tokens),
             "--out", str(folder / "out"), "--quiet", *(["--", *program] if program else [])],
            stdout=subprocess.PIPE, text=True)
        for line in self.process.stdout:
            name, _, link = line.strip().partition(": ")
            if name == "commands":
                break
        else:
            raise RuntimeError(f"{' '.join(command)} did not print the links of its page")
        self.link = link  # for commands
        self.address = link.partition("#")[0]  # for watching
        self.port = int(self.address.rstrip("/").rpartition(":")[2])

    def end(self):
        """Ends the run as Ctrl-C does. Returns playpen's exit code."""
        self.process.send_signal(signal.SIGINT)
        return self.process.wait(60)

    def close(self):
        if self.process.poll() is None:
            self.process.kill()
            self.process.wait(30)
        self.process.stdout.close()
