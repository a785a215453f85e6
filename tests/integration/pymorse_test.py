#!/usr/bin/python3
# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
"""MORSE's own client library, unmodified, against `playpen serve`.

Usage: pymorse_test.py PLAYPEN REPOSITORY

Ends with status 77 (ctest: skipped) if this Python has no pymorse.
"""
import base64
import json
import math
import os
import re
import socket
import struct
import subprocess
import sys
import tempfile
import threading
import unittest
import warnings

warnings.simplefilter("ignore", DeprecationWarning)  # asyncore, which pymorse uses
try:
    import pymorse
except ImportError as error:
    print("skipped: %s %s cannot import pymorse (Debian's python3-morse-simulator): %s"
          % (sys.executable, sys.version.split()[0], error))
    sys.exit(77)

PLAYPEN, REPOSITORY = sys.argv[1:3]
WORLD = os.path.join(REPOSITORY, "worlds/examples/remote.json")
# Anything that takes longer hangs; the test measures nothing.
TIMEOUT = float(os.environ.get("PLAYPEN_TEST_PATIENCE_S", 900))


class Server:
    """`playpen serve` on ports that are free."""

    def __init__(self, *options, world=None, stream_port=0):
        self.folder = tempfile.TemporaryDirectory()
        path = WORLD
        if world is not None:
            path = os.path.join(self.folder.name, "world.json")
            with open(path, "w", encoding="utf-8") as file:
                json.dump(world, file)
        self.process = subprocess.Popen(
            [PLAYPEN, "serve", path, "--tcp-port", "0", "--stream-port", str(stream_port),
             "--out", self.folder.name, *options],
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, bufsize=1)
        self.log = ""
        self.port = None
        for line in self.process.stdout:
            self.log += line
            found = re.search(r"127\.0\.0\.1:(\d+)", line)
            if found:
                self.port = int(found.group(1))
                break
        if self.port is None:
            raise RuntimeError("playpen serve did not start:\n" + self.log)
        # Without this thread the server would wait for room in the pipe.
        self.reader = threading.Thread(target=self._read)
        self.reader.start()

    def _read(self):
        for line in self.process.stdout:
            self.log += line

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.stop()

    def stop(self):
        if self.process.poll() is None:
            self.process.terminate()
        try:
            status = self.process.wait(TIMEOUT)
        except subprocess.TimeoutExpired:
            self.process.kill()
            status = self.process.wait()
        self.reader.join()
        self.process.stdout.close()
        self.folder.cleanup()
        return status


def wait_for(condition, simu):
    """Lets simulated time pass until a condition holds."""
    for _ in range(1000):
        if condition():
            return True
        simu.sleep(0.1)
    return False


def close(simu):
    # Waiting for publishers fails in pymorse 1.4 itself: dir() of a component calls its
    # lazy_init().
    simu.close(cancel_async_services=True, wait_publishers=False)


class Paced(unittest.TestCase):
    """At ten times the pace of the clock, as MORSE would run."""

    def setUp(self):
        self.server = Server("--time", "10")
        self.simu = pymorse.Morse("localhost", self.server.port)

    def tearDown(self):
        close(self.simu)
        self.server.stop()

    def test_objects_are_built_from_details(self):
        simu = self.simu
        self.assertEqual(simu.robots, ["r1", "r2"])
        self.assertEqual(simu.rpc("simulation", "list_robots"), ["r1", "r2"])
        self.assertIn("pose", simu.r1)
        self.assertNotIn("sonar", simu.r2)
        self.assertTrue(hasattr(simu.r1.pose, "subscribe"))
        self.assertFalse(hasattr(simu.r1.pose, "publish"))
        self.assertTrue(hasattr(simu.r1.motion, "publish"))
        self.assertTrue(callable(simu.r1.pen.set_line))
        self.assertIn("r1.laser", simu.streams())
        self.assertGreater(simu.get_stream_port("r1.laser"), 0)
        self.assertRaises(pymorse.MorseServiceFailed, simu.get_stream_port, "r1.pen")

    def test_streams_are_read(self):
        simu = self.simu
        poses = []
        simu.r2.pose.subscribe(poses.append)
        scan = simu.r2.laser.get(TIMEOUT)
        self.assertEqual(len(scan["range_list"]), 682)
        self.assertEqual(len(scan["point_list"]), 682)
        pose = simu.r2.pose.get(TIMEOUT)
        self.assertAlmostEqual(pose["x"], 0.8)
        self.assertAlmostEqual(pose["y"], 2.2)
        self.assertTrue(wait_for(lambda: len(poses) >= 3, simu))
        times = [pose["timestamp"] for pose in poses]
        self.assertAlmostEqual(times[1] - times[0], 0.1)
        properties = simu.r1.robot_properties.get(TIMEOUT)
        self.assertEqual(properties["name"], "r1")
        for name in ("battery", "collision", "increments", "infrared", "odometry", "proximity",
                     "sonar", "way"):
            self.assertIn("timestamp", simu.r1[name].get_local_data().result(TIMEOUT), name)
        self.assertIn("vx", simu.r1.odometry.get(TIMEOUT))
        self.assertIn("dS", simu.r1.way.get(TIMEOUT))

    def test_motion_commands_are_published(self):
        simu = self.simu
        simu.r1.motion.publish({"v": 0.0, "w": 1.0})
        self.assertTrue(
            wait_for(lambda: (simu.r1.odometry.get(TIMEOUT) or {}).get("wz") == 1.0, simu))
        simu.r1.motion.stop().result(TIMEOUT)
        simu.sleep(0.5)
        self.assertEqual(simu.r1.odometry.get_local_data().result(TIMEOUT)["wz"], 0.0)
        simu.r1.motion.set_speed(0.2, 0.0).result(TIMEOUT)
        self.assertTrue(wait_for(
            lambda: simu.r1.odometry.get_local_data().result(TIMEOUT)["vx"] != 0.0, simu))

    def test_goto_runs_to_its_end(self):
        simu = self.simu
        self.assertEqual(simu.r1.waypoint.goto(1.6, 1.3, 0.0, 0.1, 0.5).result(TIMEOUT), "Arrived")
        self.assertEqual(simu.r1.waypoint.get_status().result(TIMEOUT), "Arrived")
        simu.sleep(0.2)
        pose = simu.r1.pose.get_local_data().result(TIMEOUT)
        self.assertLess(math.hypot(pose["x"] - 1.6, pose["y"] - 1.3), 0.1)

    def test_goto_is_cancelled(self):
        simu = self.simu
        simu.rpc("simulation", "set_object_dynamics", "r1", False)  # or it might arrive before
        goto = simu.r1.waypoint.goto(1.6, 1.0, 0.0)
        self.assertTrue(wait_for(
            lambda: simu.r1.waypoint.get_status().result(TIMEOUT) == "Transit", simu))
        self.assertTrue(goto.running())
        goto.cancel()
        self.assertRaises(pymorse.MorseServicePreempted, goto.result, TIMEOUT)
        self.assertEqual(simu.r1.waypoint.get_status().result(TIMEOUT), "Stop")

    def test_goto_is_preempted(self):
        simu = self.simu
        simu.rpc("simulation", "suspend_dynamics")
        first = simu.r1.waypoint.goto(1.6, 1.0, 0.0)
        self.assertTrue(wait_for(
            lambda: simu.r1.waypoint.get_status().result(TIMEOUT) == "Transit", simu))
        second = simu.r1.waypoint.goto(1.2, 1.0, 0.0, 0.1)
        self.assertRaises(pymorse.MorseServicePreempted, first.result, TIMEOUT)
        simu.rpc("simulation", "restore_dynamics")
        self.assertEqual(second.result(TIMEOUT), "Arrived")

    def test_wrong_arguments_are_errors(self):
        simu = self.simu
        self.assertRaises(TypeError, simu.r1.motion.set_speed(1.0).result, TIMEOUT)
        self.assertRaises(pymorse.MorseServiceFailed, simu.r1.waypoint.goto().result, TIMEOUT)
        self.assertRaises(TypeError, simu.rpc, "time", "sleep", 1.0, 2.0)
        self.assertRaises(pymorse.MorseServiceFailed, simu.r1.motion.set_speed("a", 0.0).result,
                          TIMEOUT)
        self.assertRaises(pymorse.MorseServiceFailed, simu.rpc, "r1.pose", "nothing")
        self.assertRaises(pymorse.MorseServiceFailed, simu.activate, "nobody.nothing")

    def test_sleep_passes_simulated_time(self):
        before = self.simu.time()
        self.simu.sleep(2.0)
        # Both are whole steps, but their floating-point difference is not.
        self.assertGreaterEqual(self.simu.time() - before, 2.0 - 1e-9)

    def test_pen_draws_and_reads_back(self):
        pen = self.simu.r1.pen
        pen.set_pixel(3, 4, 10, 20, 30).result(TIMEOUT)
        self.assertEqual(pen.get_pixel(3, 4).result(TIMEOUT), [10, 20, 30, 255])
        width, height = pen.resize_canvas(20, 10).result(TIMEOUT)
        self.assertEqual([width, height], [20, 10])
        image = [i % 256 for i in range(width * height * 3)]
        pen.set_image_data(image).result(TIMEOUT)
        self.assertEqual(pen.get_image_data().result(TIMEOUT), image)
        pen.update_image_data([[0, 0, 1, 2, 3], [19, 9, 4, 5, 6]]).result(TIMEOUT)
        self.assertEqual(pen.get_pixel(19, 9).result(TIMEOUT), [4, 5, 6, 255])
        pen.save_image_copy("drawing").result(TIMEOUT)
        self.assertTrue(os.path.exists(os.path.join(self.server.folder.name, "drawing.png")))

    def test_reset_restores_everything(self):
        simu = self.simu
        simu.sleep(0.2)  # until there is a reading
        simu.r1.motion.set_speed(0.3, 0.0).result(TIMEOUT)
        simu.r1.pen.set_pixel(3, 4, 10, 20, 30).result(TIMEOUT)
        self.assertTrue(wait_for(
            lambda: simu.r1.pose.get_local_data().result(TIMEOUT)["x"] > 0.85, simu))
        simu.reset()
        simu.sleep(0.5)
        self.assertAlmostEqual(simu.r1.pose.get_local_data().result(TIMEOUT)["x"], 0.8)
        self.assertEqual(simu.r1.pen.get_pixel(3, 4).result(TIMEOUT), [0, 0, 0, 0])

    def test_quit_ends_the_server(self):
        simu = self.simu
        simu.rpc("simulation", "quit")
        self.assertEqual(self.server.process.wait(TIMEOUT), 0)
        self.assertTrue(os.path.exists(os.path.join(self.server.folder.name, "report.json")))


class Lockstep(unittest.TestCase):
    """Time passes only while somebody waits for it, so a run is repeatable to the bit."""

    def run_once(self):
        with Server("--time", "lockstep") as server:
            simu = pymorse.Morse("localhost", server.port)
            try:
                simu.r1.motion.set_speed(0.3, 0.4).result(TIMEOUT)
                simu.sleep(1.5)
                turned = simu.r1.pose.get_local_data().result(TIMEOUT)
                arrived = simu.r1.waypoint.goto(1.8, 1.5, 0.0).result(TIMEOUT)
                simu.sleep(0.1)
                end = simu.r1.pose.get_local_data().result(TIMEOUT)
                return turned, arrived, end, simu.time()
            finally:
                close(simu)

    def test_runs_are_equal(self):
        first = self.run_once()
        self.assertEqual(first[0]["timestamp"], 1.5)
        self.assertEqual(first[1], "Arrived")
        self.assertEqual(first, self.run_once())


class Space(unittest.TestCase):
    """MORSE's components of space, at ten times the pace of the clock."""

    WORLD = {
        "arena": {"size": [20, 20], "origin": [-10, -10],
                  "obstacles": [{"name": "box", "center": [0, 5], "tags": ["Object"]},
                                {"name": "cup", "center": [1, -1], "size": [0.1, 0.1],
                                 "portable": True, "tags": ["Graspable"]},
                                {"name": "wall", "center": [5, 0], "size": [0.2, 4],
                   "height": 1}]},
        "robots": [
            {"name": "robot", "model": "omni", "pose": {"x": 0, "y": 0}, "elevation": {"z": 0.5},
             "devices": {
                 "laser": None,
                 "ptu": {"type": "ptz", "tilt_max_deg": 90, "pan_max_deg": 180, "z": 1.0},
                 "gyro": {"type": "gyroscope", "on": "ptu"}, "posture": {"of": "ptu"},
                 "arm": {"type": "actarray", "joints": [{"name": "one"}, {"name": "two"}]},
                 "joints": {"type": "posture", "of": "arm"},
                 "orientation": {}, "teleport": {}, "velocity": {}, "proximity": {"range": 20},
                 "barometer": {}, "go": {"type": "destination"},
                 "hand": {"distance": 2, "angle_deg": 120}, "light": {"type": "blinkenlight"},
                 "camera": {"image": [8, 6]},
                 "depth": {"type": "depth_camera", "image": [8, 6], "range_min": 1}}},
            {"name": "hidden", "pose": {"x": 8, "y": 0}, "tags": ["friend"]},
            {"name": "near", "pose": {"x": -3, "y": 0}}]}

    def setUp(self):
        self.server = Server("--time", "10", world=self.WORLD)
        self.simu = pymorse.Morse("localhost", self.server.port)
        self.simu.sleep(0.5)  # all sensors have readings then

    def tearDown(self):
        close(self.simu)
        self.server.stop()

    def test_a_head_carries_its_sensors(self):
        ptu = self.simu.robot.ptu
        ptu.set_pan_tilt(0.5, 0.25).result(TIMEOUT)
        self.assertEqual(ptu.get_pan_tilt().result(TIMEOUT), [0.5, 0.25])
        self.assertTrue(wait_for(
            lambda: abs(ptu.gyro.get_local_data().result(TIMEOUT)["yaw"] - 0.5) < 1e-6, self.simu))
        gyro = ptu.gyro.get_local_data().result(TIMEOUT)
        self.assertAlmostEqual(gyro["pitch"], 0.25)
        self.assertAlmostEqual(ptu.posture.get(TIMEOUT)["tilt"], 0.25)
        ptu.look_at_object("box").result(TIMEOUT)
        pan, tilt = ptu.get_pan_tilt().result(TIMEOUT)
        self.assertAlmostEqual(pan, math.pi / 2)
        self.assertAlmostEqual(tilt, math.atan2(1.5, 5))  # 1.5 m over the floor: down
        with self.assertRaises(pymorse.MorseServiceFailed):
            ptu.look_at_object("nothing").result(TIMEOUT)

    def test_an_arm_moves_by_names(self):
        arm = self.simu.robot.arm
        self.assertEqual(arm.get_joints().result(TIMEOUT), ["one", "two"])
        arm.set_rotation("two", 0.5).result(TIMEOUT)
        self.assertTrue(wait_for(
            lambda: arm.joints.get_local_data().result(TIMEOUT).get("two") == 0.5, self.simu))
        arm.rotate("one", 0.25).result(TIMEOUT)
        self.assertTrue(wait_for(
            lambda: abs(arm.joints.get_local_data().result(TIMEOUT)["one"] - 0.25) < 1e-9,
            self.simu))
        self.assertEqual(set(arm.joints.get_joints_length().result(TIMEOUT)), {"one", "two"})
        for wrong in (arm.set_rotation("three", 0), arm.set_translation("one", 0)):
            with self.assertRaises(pymorse.MorseServiceFailed):
                wrong.result(TIMEOUT)

    def test_an_arm_follows_a_trajectory(self):
        arm = self.simu.robot.arm
        for wrong in ({"points": [{"position": [0, 0], "time_from_start": 1}]}, {},
                      {"points": [{"positions": [0], "time_from_start": 1}]}, {"points": []}):
            with self.assertRaises(pymorse.MorseServiceFailed):
                arm.trajectory(wrong).result(TIMEOUT)
        arm.trajectory({"points": [{"positions": [0.2, 0.1], "time_from_start": 0.5},
                                   {"positions": [0.4, -0.1], "time_from_start": 1.0}]}
                       ).result(TIMEOUT)
        self.assertTrue(wait_for(
            lambda: arm.joints.get_local_data().result(TIMEOUT)["one"] == 0.4, self.simu))
        waiting = arm.trajectory({"starttime": self.simu.time() + 1e6, "points": [
            {"positions": [0, 0], "time_from_start": 1}]})
        # A thread of pymorse sends the request, maybe after a call of cancel().
        self.assertTrue(wait_for(lambda: waiting.cancel() or waiting.done(), self.simu))
        self.assertRaises(pymorse.MorseServicePreempted, waiting.result, TIMEOUT)
        arm.rotate("one", 0.1).result(TIMEOUT)
        self.assertEqual(arm.get_IK_limits("one").result(TIMEOUT), [-math.pi / 2, math.pi / 2])
        self.assertEqual(arm.get_dofs().result(TIMEOUT)["one"], [False, False, True])

    def test_an_arm_reaches_for_a_target(self):
        arm = self.simu.robot.arm
        target = arm.list_IK_targets().result(TIMEOUT)[0]
        self.assertEqual(target, "ik_target.robot.arm.two")

        def turned_by(angle):
            joints = arm.joints.get_local_data().result(TIMEOUT)
            return abs(joints["one"] + joints["two"] - angle) < 0.01

        # Two links of 0.1 m that turn about upright axes: from ahead to the left, and back.
        arm.move_IK_target(target, [-0.2, 0.2, 0], [0, 0, math.pi / 2]).result(TIMEOUT)
        self.assertTrue(wait_for(lambda: turned_by(math.pi / 2), self.simu))
        arm.place_IK_target(target, [0.2, -0.2, 0], [0, 0, -math.pi / 2]).result(TIMEOUT)
        self.assertTrue(wait_for(lambda: turned_by(0), self.simu))
        for wrong in (arm.place_IK_target("nothing", [0, 0, 0]),
                      arm.place_IK_target(target, [0, 0]), arm.move_IK_target(target, "here")):
            with self.assertRaises(pymorse.MorseServiceFailed):
                wrong.result(TIMEOUT)

    def test_a_hand_takes_things(self):
        hand = self.simu.robot.hand
        self.assertIsNone(hand.release().result(TIMEOUT))
        self.assertEqual(hand.grab().result(TIMEOUT), "cup")
        self.assertEqual(hand.grab().result(TIMEOUT), "cup")
        self.assertTrue(hand.release().result(TIMEOUT))
        self.simu.robot.teleport.publish({"x": 5, "y": -8, "z": 0, "yaw": 0, "pitch": 0, "roll": 0})
        self.assertTrue(wait_for(lambda: hand.get(TIMEOUT)["near"] == "", self.simu))
        self.assertIsNone(hand.grab().result(TIMEOUT))

    def test_cameras_send_pictures(self):
        robot = self.simu.robot
        robot.camera.capture(2).result(TIMEOUT)
        picture = robot.camera.get(TIMEOUT)
        self.assertEqual((picture["width"], picture["height"]), (8, 6))
        self.assertEqual(len(base64.b64decode(picture["image"])), 8 * 6 * 4)
        points = base64.b64decode(robot.depth.get(TIMEOUT)["points"])
        self.assertGreater(len(points), 0)
        for x, y, z in struct.iter_unpack("fff", points):
            self.assertGreaterEqual(z, 1)
            self.assertLessEqual(z, 12)
        with self.assertRaises(pymorse.MorseServiceFailed):
            robot.camera.capture(0).result(TIMEOUT)

    def test_a_robot_goes_straight_to_its_destination(self):
        robot = self.simu.robot
        robot.go.publish({"x": -1, "y": 1, "z": 2.5})
        self.assertTrue(wait_for(lambda: robot.pose.get(TIMEOUT)["z"] > 1.5, self.simu))
        pose = robot.pose.last()
        self.assertAlmostEqual(pose["x"], -pose["y"], places=2)
        self.assertAlmostEqual(pose["yaw"], 0, places=4)

    def test_a_light_is_toggled(self):
        self.assertTrue(self.simu.robot.light.toggle().result(TIMEOUT))
        self.assertTrue(self.simu.robot.light.toggle(True).result(TIMEOUT))

    def test_height_and_inclination_are_values(self):
        robot = self.simu.robot
        robot.orientation.publish({"yaw": 0.5, "pitch": 0.25, "roll": -0.125})
        self.assertTrue(wait_for(lambda: robot.pose.get(TIMEOUT)["roll"] == -0.125, self.simu))
        self.assertEqual(robot.pose.last()["pitch"], 0.25)
        robot.teleport.publish({"x": 1, "y": 1, "z": 100.5, "yaw": 0, "pitch": 0, "roll": 0})
        self.assertTrue(wait_for(lambda: robot.pose.get(TIMEOUT)["z"] == 100.5, self.simu))
        self.assertTrue(wait_for(
            lambda: abs(robot.barometer.get(TIMEOUT)["pressure"] - 100129.0) < 1.0, self.simu))

    def test_a_robot_drives_to_the_side(self):
        robot = self.simu.robot
        robot.motion.set_speed(0.0, 0.5, 0.0).result(TIMEOUT)
        self.assertTrue(wait_for(
            lambda: abs(robot.velocity.get(TIMEOUT)["linear_velocity"][1] - 0.5) < 1e-6, self.simu))
        robot.motion.publish({"x": 0.0, "y": 0.0, "w": 0.0})
        self.assertTrue(wait_for(
            lambda: robot.velocity.get(TIMEOUT)["linear_velocity"][1] == 0.0, self.simu))

    def test_robots_see_each_other(self):
        simu = self.simu
        ask = lambda *names: simu.rpc("communication", "distance_and_view", *names)
        self.assertEqual(ask("robot", "near")[1], True)
        self.assertEqual(ask("robot", "hidden")[1], False)
        self.assertAlmostEqual(ask("near", "hidden")[0], 11.0)
        self.assertRaises(pymorse.MorseServiceFailed, ask)
        self.assertRaises(pymorse.MorseServiceFailed, ask, "robot", "nobody")
        simu.robot.proximity.set_tracked_tag("friend").result(TIMEOUT)
        self.assertTrue(wait_for(
            lambda: list(simu.robot.proximity.get(TIMEOUT)["near_objects"]) == ["hidden"], simu))


class RawStreams(unittest.TestCase):
    """Programs that know the ports of the streams, such as MORSE's socket_v_omega_client.py."""

    def test_ports_are_open_from_the_start(self):
        with socket.socket() as probe:  # a port that is likely to have free ones behind it
            probe.bind(("127.0.0.1", 0))
            first = probe.getsockname()[1]
        world = {"arena": {"size": [10, 10]}, "robots": [
            {"name": "robot", "model": "omni", "pose": {"x": 5, "y": 5}}]}
        with Server("--time", "10", "--open-streams", stream_port=first, world=world) as server:
            simu = pymorse.Morse("localhost", server.port)
            self.addCleanup(close, simu)
            ports = simu.rpc("simulation", "get_all_stream_ports")
            self.assertEqual(min(ports.values()), first)
            self.assertEqual([name for name, port in sorted(ports.items(), key=lambda i: i[1])],
                             simu.rpc("simulation", "list_streams"))
            address = "127.0.0.1"
            with socket.create_connection((address, ports["robot.motion"]), TIMEOUT) as motion, \
                    socket.create_connection((address, ports["robot.pose"]), TIMEOUT) as pose:
                motion.sendall(b'{"x": 0.2, "y": 0.0, "w": 0.0}\n')
                with pose.makefile() as lines:
                    for line in lines:
                        if json.loads(line)["x"] > 5.1:
                            break


class Guide(unittest.TestCase):
    """The Python programs of docs/remote.md."""

    def test_programs_run(self):
        with open(os.path.join(REPOSITORY, "docs/remote.md"), encoding="utf-8") as page:
            programs = re.findall(r"<!-- pymorse: (\S+) -->\n```python\n(.*?)```", page.read(),
                                  re.DOTALL)
        self.assertGreaterEqual(len(programs), 1)
        for name, text in programs:
            with self.subTest(name), Server("--time", "10") as server:
                program = os.path.join(server.folder.name, name)
                with open(program, "w", encoding="utf-8") as file:
                    file.write(text.replace("4000", str(server.port)))
                done = subprocess.run([sys.executable, "-W", "ignore", program], timeout=TIMEOUT,
                                      text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
                self.assertEqual(done.returncode, 0, done.stdout)
                self.assertIn("robots: ['r1', 'r2']", done.stdout)
                self.assertIn("arrived: Arrived", done.stdout)
                self.assertIn("drawn: [255, 0, 0, 255]", done.stdout)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:], verbosity=2)
