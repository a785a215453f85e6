# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
"""Commands of gdb for programs whose world Playpen simulates: playpen-time, playpen-robots and
playpen-frame.

`playpen run --debug` loads this file. In another gdb, `source FILE` does. The commands read the
memory in which the host keeps the state of its run (libplayerlike/src/host/results/kept_layout.h).
They call no function of the program and need none of its locks, so they work wherever it stands.
"""
import json
import os
import struct

import gdb

MAGIC = 0x706C617970656E31
SIZE = 128 << 20
HEADER = struct.Struct("<QIIiIQqI4xQQI4xQQQ")
STEP = struct.Struct("<Qqdd")
ROBOT_SIZE = 160
NAMESPACES = ("playerlike::", "sim::", "PlayerCc::", "std::")  # of functions below a user's code
PHASES = (
    "no simulation yet",
    "the run goes on",
    "the run is over; its results are being written",
    "the run is over; its report is written",
    "the run is over; its results are written",
)


def variable_of_process(name):
    """The value of an environment variable of the running program; None: it has none."""
    try:
        with open(f"/proc/{gdb.selected_inferior().pid}/environ", "rb") as file:
            entries = file.read().split(b"\0")
    except OSError:
        return None
    for entry in entries:
        if entry.startswith(name.encode() + b"="):
            return os.fsdecode(entry.split(b"=", 1)[1])
    return None


def variable_for_program(name):
    """The value of an environment variable that `run` will give the program; None: none."""
    text = gdb.execute(f"show environment {name}", to_string=True).strip()
    return text.split(" = ", 1)[1] if " = " in text else None


class Run:
    """The kept state of the run at this moment."""

    def __init__(self):
        name = variable_of_process("PLAYPEN_STATE") or variable_for_program("PLAYPEN_STATE")
        if name is None:
            raise gdb.GdbError(
                "this program keeps no state that can be shown: start it by 'playpen run --debug', "
                "or source this file before 'run'")
        try:
            self.file = os.open(name, os.O_RDONLY | os.O_CLOEXEC)
        except OSError as error:
            raise gdb.GdbError(f"the state of the run, {name}, cannot be read: {error.strerror}")
        try:
            self.read()
        except (struct.error, ValueError, KeyError, TypeError):
            raise gdb.GdbError("the state of the run is damaged, or of another version of Playpen")
        finally:
            os.close(self.file)

    def read(self):
        (magic, self.phase, _, _, _, self.steps, self.now_ns, robots, first, second, newest, _, _,
         report) = HEADER.unpack(os.pread(self.file, HEADER.size, 0))
        if magic != MAGIC or self.phase >= len(PHASES):
            raise ValueError
        self.robots = []
        if self.phase == 0 or robots == 0:
            return
        place = second if newest else first
        steps, now_ns, _, _ = STEP.unpack(os.pread(self.file, STEP.size, place))
        if steps > self.steps:
            self.steps, self.now_ns = steps, now_ns
        text = os.pread(self.file, report & 0xFFFFFFFF, (report >> 32) * 8)
        names = [robot["name"] for robot in json.loads(text)["robots"]] if report else []
        for i in range(min(robots, 10000)):
            data = os.pread(self.file, ROBOT_SIZE, place + STEP.size + i * ROBOT_SIZE)
            pose = struct.unpack_from("<3d", data, 96)
            (stalled,) = struct.unpack_from("<I", data, 124)
            twist = struct.unpack_from("<3d", data, 136)
            name = names[i] if i < len(names) else f"robot {i}"
            self.robots.append((name, pose, twist, stalled != 0))


def require_no_argument(argument, name):
    if argument.strip():
        raise gdb.GdbError(f"{name} takes no argument")


def present_run():
    """The run. Raises gdb.GdbError if there is none yet."""
    run = Run()
    if run.phase == 0:
        raise gdb.GdbError(
            "no simulation runs in this program yet (or its world is in another process, as that "
            "of a server or of a run with several programs)")
    return run


class Time(gdb.Command):
    """Show the simulated time of the last step, the number of steps, and whether the run is over.

Simulated time stands still while the program does. Page: playpen doc debugging"""

    def __init__(self):
        super().__init__("playpen-time", gdb.COMMAND_USER)

    def invoke(self, argument, from_tty):
        require_no_argument(argument, "playpen-time")
        run = present_run()
        print(f"simulated time {run.now_ns / 1e9:.3f} s, {run.steps} steps; {PHASES[run.phase]}")


class Robots(gdb.Command):
    """Show where the robots are, how they move, and whether they are stalled.

True poses in the world [m, rad] and velocities [m/s to the front and to the left, rad/s
counter-clockwise] after the last step, not what sensors have read.
Page: playpen doc debugging"""

    def __init__(self):
        super().__init__("playpen-robots", gdb.COMMAND_USER)

    def invoke(self, argument, from_tty):
        require_no_argument(argument, "playpen-robots")
        run = present_run()
        width = max([5] + [len(name) for name, _, _, _ in run.robots])
        print(f"{'robot':{width}}    x [m]    y [m]  yaw [rad]  front [m/s]  left [m/s]"
              "  turn [rad/s]  stalled")
        for name, (x, y, yaw), (front, left, turn), stalled in run.robots:
            print(f"{name:{width}} {x:8.3f} {y:8.3f} {yaw:10.3f} {front:12.3f} {left:11.3f} "
                  f"{turn:13.3f}  {'yes' if stalled else 'no'}")


class Frame(gdb.Command):
    """Select the innermost frame of your own code: the call of Playpen in which the program stands.

It passes over functions of Playpen and of libraries without source files here.
Page: playpen doc debugging"""

    def __init__(self):
        super().__init__("playpen-frame", gdb.COMMAND_USER)

    def invoke(self, argument, from_tty):
        require_no_argument(argument, "playpen-frame")
        try:
            frame = gdb.newest_frame()
        except gdb.error:
            raise gdb.GdbError("the program does not run")
        while frame is not None and not self.is_users(frame):
            frame = frame.older()
        if frame is None:
            raise gdb.GdbError("this thread runs no code that was compiled with -g")
        frame.select()
        gdb.execute("frame")

    @staticmethod
    def is_users(frame):
        symtab = frame.find_sal().symtab
        library = os.path.basename(gdb.solib_name(frame.pc()) or "")
        return (symtab is not None and os.path.isfile(symtab.fullname())
                and not library.startswith("libplaypen")
                and not (frame.name() or "").startswith(NAMESPACES))


def keep_state():
    """Without `playpen run`: provides the memory for the state of the run."""
    if variable_for_program("PLAYPEN_STATE") or gdb.selected_inferior().pid:
        return
    file = os.memfd_create("playpen-run", os.MFD_CLOEXEC)
    os.ftruncate(file, SIZE)
    os.pwrite(file, struct.pack("<Q", MAGIC), 0)
    gdb.execute(f"set environment PLAYPEN_STATE = /proc/{os.getpid()}/fd/{file}")


Time()
Robots()
Frame()
keep_state()
print("Simulated time stands still at breakpoints. playpen-time, playpen-robots and playpen-frame "
      "show the run; 'run' starts it.")
