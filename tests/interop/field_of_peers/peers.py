# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
"""What the comparisons of this folder share: running the programs of other simulators."""
import os
import re
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
# Names and versions of the packages in Python; the versions are those that the pages describe.
PACKAGES = {"navground": "0.7.0", "ir-sim": "2.12.0", "IR-SIM-X": "1.1.3"}


class NotMeasured(Exception):
    """Why there are no figures of a simulator."""


def output_of(command, what, **options):
    """What a command prints; its last line of errors is the reason if it fails."""
    try:
        run = subprocess.run(command, capture_output=True, text=True, check=False, **options)
    except OSError as error:
        raise NotMeasured(f"{what}: {error}") from error
    if run.returncode != 0:
        reason = (run.stderr.strip() or f"status {run.returncode}").splitlines()[-1]
        raise NotMeasured(f"{what}: {reason}")
    return run.stdout


def in_python(prefix, package, script):
    """Installs a package. Returns the command of its program."""
    python = prefix / "venv" / "bin" / "python"
    if not python.exists():
        output_of([sys.executable, "-m", "venv", prefix / "venv"], "no virtual environment")
    output_of([python, "-m", "pip", "install", "--quiet", f"{package}=={PACKAGES[package]}"],
              "not installed")
    return [python, HERE / script]


def in_python_from(prefix, sources, script):
    """Installs IR-SIM-X from its sources. Returns the command of its program."""
    python = prefix / "venv_irsimx" / "bin" / "python"
    if not python.exists():
        if sources is None:
            raise NotMeasured("not installed: give its sources by --irsimx")
        output_of([sys.executable, "-m", "venv", prefix / "venv_irsimx"], "no virtual environment")
        output_of([python, "-m", "pip", "install", "--quiet", sources], "not installed")
    return [python, HERE / script]


def core_environment():
    """The environment of a program that runs on one core."""
    # Workarounds for old OpenBLAS libraries slow numpy down, and one core needs one thread.
    environment = {name: value for name, value in os.environ.items()
                   if not name.startswith("OPENBLAS_")}
    environment.update(OPENBLAS_NUM_THREADS="1", OMP_NUM_THREADS="1", MPLBACKEND="Agg")
    return environment


def on_one_core():
    """Keeps this process on the last core."""
    os.sched_setaffinity(0, {max(os.sched_getaffinity(0))})


def figures_of(command, hall=None):
    """The figures that a program prints, by name. It runs on one core and reads `hall`."""
    text = output_of(command, "its program failed", input=hall, env=core_environment(),
                     preexec_fn=on_one_core)
    found = re.findall(r"^figure (\S+) (\S+)$", text, re.MULTILINE)
    if not found:
        raise NotMeasured("its program printed no figures")
    return {name: float(value) for name, value in found}


def processor():
    model = re.search(r"^model name\s*: (.*)$", Path("/proc/cpuinfo").read_text(encoding="utf-8"),
                      re.MULTILINE)
    return model[1] if model else os.uname().machine
