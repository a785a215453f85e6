#!/usr/bin/env python3
# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
"""Runs the tests of MORSE's own suite, unmodified, against `playpen serve`.

Usage: run.py PLAYPEN MORSE [NAME ...]
       run.py PLAYPEN MORSE --one FILE TEST    (one test; the last line is its result as JSON)

Each test has a process of its own. MORSE is a checkout of MORSE's source; its tests are imported as
they are. builder.py stands in for morse.builder, and this program for morse.testing.testing. With names, only test files that contain
one of them run. Prints a table in Markdown; its end status is 0.

MORSE_SUITE_TIME in the environment is the pace of simulated time, such as 0.5; MORSE_SUITE_VERBOSE=1
prints what failed.
"""
import glob
import importlib.util
import json
import inspect
import os
import re
import signal
import subprocess
import sys
import tempfile
import threading
import traceback
import types
import unittest
import warnings

warnings.simplefilter("ignore", DeprecationWarning)  # asyncore, which pymorse uses
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import builder  # noqa: E402

PLAYPEN, MORSE = sys.argv[1:3]
ONLY = sys.argv[3:]
PATIENCE_S = float(os.environ.get("PLAYPEN_TEST_PATIENCE_S", 120))


class MorseTestCase(unittest.TestCase):
    """setUp builds the scene of setUpEnv and starts `playpen serve` with it."""

    def setUp(self):
        self.process = None
        self.folder = tempfile.TemporaryDirectory()
        scene = builder.Scene()
        self.setUpMw()
        self.setUpEnv()
        world = builder.write_world(scene, self.folder.name)
        command = [PLAYPEN, "serve", world, "--tcp-port", "4000", "--stream-port", "60000",
                   "--out", os.path.join(self.folder.name, "out")]
        if "MORSE_SUITE_TIME" in os.environ:
            command += ["--time", os.environ["MORSE_SUITE_TIME"]]
        if scene.environment.sync_port:
            command += ["--sync-port", str(scene.environment.sync_port)]
        self.process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                        text=True, bufsize=1)
        self.log = ""
        for line in self.process.stdout:
            self.log += line
            if re.search(r"127\.0\.0\.1:4000", line):
                break
        else:
            raise RuntimeError("playpen serve did not start:\n" + self.log)
        self.reader = threading.Thread(target=self._read, daemon=True)
        self.reader.start()

    def _read(self):
        for line in self.process.stdout:
            self.log += line

    def tearDown(self):
        if self.process is not None:
            self.process.kill()
            self.process.wait()
            self.process.stdout.close()
        self.folder.cleanup()
        self.tearDownMw()

    def setUpMw(self):
        pass

    def tearDownMw(self):
        pass


class MorseMoveTestCase(MorseTestCase):
    """The two assertions of MORSE's class of this name."""

    def assertAlmostEqualPosition(self, morse, wanted, precision):
        pose = morse.robot.pose.get()
        for key, value in zip(("x", "y", "z", "yaw", "pitch", "roll"), wanted):
            self.assertAlmostEqual(pose[key], value, delta=precision)

    def assertAlmostEqualPositionThenFix(self, morse, wanted, precision):
        self.assertAlmostEqualPosition(morse, wanted, precision)
        morse.deactivate("robot.motion")
        morse.activate("robot.teleport")
        morse.robot.teleport.publish({"x": wanted[0], "y": wanted[1], "z": wanted[2] + 0.01,
                                      "yaw": wanted[3], "pitch": wanted[4], "roll": wanted[5]})
        morse.sleep(0.1)
        morse.deactivate("robot.teleport")
        morse.activate("robot.motion")
        morse.sleep(0.1)


class MorseBuilderFailureTestCase(MorseTestCase):
    pass


def stand_in():
    """Puts the modules that tests import from MORSE into sys.modules."""
    def module(name, members):
        made = types.ModuleType(name)
        made.__dict__.update(members)
        made.__path__ = []
        sys.modules[name] = made

    names = {n: v for n, v in vars(builder).items() if not n.startswith("_")}
    names.pop("os"), names.pop("json"), names.pop("inspect")
    module("morse", {})
    for name in ("", ".actuators", ".sensors", ".robots", ".environment"):
        module("morse.builder" + name, names)
    module("morse.testing", {})
    module("morse.testing.testing", {
        "MorseTestCase": MorseTestCase, "MorseMoveTestCase": MorseMoveTestCase,
        "MorseBuilderFailureTestCase": MorseBuilderFailureTestCase,
        "testlogger": __import__("logging").getLogger("morse.tests"),
        "main": lambda *_, **__: None})
    module("morse.testing.exceptions", {"MorseTestingError": RuntimeError})


def repair_pymorse():
    """Replaces a function of pymorse that cannot work: its dir() of a component raises TypeError."""
    import pymorse.pymorse as library

    def get_publisher_streams(self):
        for name in self.robots:
            for component in getattr(self, name).values():
                if type(component) is library.Component and "publish" in vars(component):
                    yield component.stream

    library.Morse.get_publisher_streams = get_publisher_streams


def tests_of(path):
    """The test methods of a file, without those of imported classes."""
    spec = importlib.util.spec_from_file_location(os.path.basename(path)[:-3], path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    loader = unittest.TestLoader()
    loader.testMethodPrefix = "test"
    for value in list(vars(module).values()):
        if inspect.isclass(value) and issubclass(value, MorseTestCase) and \
                value.__module__ == module.__name__:
            yield from loader.loadTestsFromTestCase(value)


def first_line(error):
    """The assertion that failed, and where."""
    frames = [f for f in traceback.extract_tb(error.__traceback__) if MORSE in f.filename]
    place = "line %d: " % frames[-1].lineno if frames else ""
    code = frames[-1].line + ": " if frames else ""
    return (place + code + str(error).strip().split("\n")[0]).replace("|", "\\|")[:200]


def run(test):
    """Returns ["pass", "fail" or "n/a", reason]."""
    try:
        test.setUp()
        try:
            getattr(test, test._testMethodName)()
            return ["pass", ""]
        finally:
            test.tearDown()
    except builder.NotApplicable as error:
        return ["n/a", str(error)]
    except BaseException as error:  # pylint: disable=broad-except
        if os.environ.get("MORSE_SUITE_VERBOSE"):
            traceback.print_exc()
            print(getattr(test, "log", ""))
        return ["fail", first_line(error)]


def run_apart(path, name):
    """Runs a test in a process of its own."""
    command = [sys.executable, os.path.abspath(__file__), PLAYPEN, MORSE, "--one", path, name]
    # A session of its own, so that its server ends with it.
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True,
                               start_new_session=True)
    try:
        output, _ = process.communicate(timeout=PATIENCE_S)
        if os.environ.get("MORSE_SUITE_VERBOSE"):
            print(output)
        return json.loads(output.strip().split("\n")[-1])
    except subprocess.TimeoutExpired:
        return ["fail", "it ended without a result within %g s" % PATIENCE_S]
    except ValueError:
        return ["fail", "it ended without a result"]
    finally:
        try:
            os.killpg(process.pid, signal.SIGKILL)
        except ProcessLookupError:
            pass
        process.wait()


def main():
    stand_in()
    if ONLY[:1] == ["--one"]:
        repair_pymorse()
        path, name = ONLY[1:3]
        result = [run(test) for test in tests_of(path) if test._testMethodName == name][0]
        print(json.dumps(result), flush=True)
        os._exit(0)  # pymorse's threads may still wait
    counts = {"pass": 0, "fail": 0, "n/a": 0}
    print("| file | test | result | reason |\n|---|---|---|---|")
    for path in sorted(glob.glob(os.path.join(MORSE, "testing", "base", "*.py"))):
        file = os.path.basename(path)[:-3]
        if ONLY and not any(word in file for word in ONLY):
            continue
        for test in tests_of(path):
            name = test._testMethodName
            result, reason = run_apart(path, name)
            counts[result] += 1
            print("| %s | %s | %s | %s |" % (file, name, result, reason), flush=True)
    print("\n%d tests: %d pass, %d fail, %d are not applicable" %
          (sum(counts.values()), counts["pass"], counts["fail"], counts["n/a"]), flush=True)


if __name__ == "__main__":
    main()
