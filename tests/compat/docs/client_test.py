#!/usr/bin/env python3
# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
"""Runs docs/examples/playpen_client.py against `playpen serve`: its arrays equal those of the same run
in this process (by playpen_gym.py), and each error says what is wrong.

Usage: client_test.py EXAMPLES PLAYPEN WORLD TWO_ROBOTS; exit code 77 without NumPy.
PLAYPEN_BATCH_LIBRARY names the library of playpen_gym.py; without it, runs are not compared.
"""
import contextlib
import os
import re
import socket
import subprocess
import sys
import tempfile
import threading

try:
    import numpy as np
except ImportError:
    print("skipped: this Python has no numpy")
    sys.exit(77)

EXAMPLES, PLAYPEN, WORLD, TWO_ROBOTS = sys.argv[1:]
sys.path.insert(0, EXAMPLES)
import playpen_client  # noqa: E402
from playpen_client import PlaypenError, Session  # noqa: E402


def expect(holds, what):
    if not holds:
        sys.exit(f"client_test.py: not so: {what}")


def expect_error(call, kind, id, text):
    try:
        call()
    except kind as error:
        expect(text in str(error), f"'{error}' has '{text}'")
        expect(getattr(error, "id", None) == id, f"'{error}' has the id '{id}'")
    else:
        sys.exit(f"client_test.py: no error with '{text}'")


@contextlib.contextmanager
def served(world, *options):
    """A server; yields it and its port. Its results go to a folder of its own."""
    with tempfile.TemporaryDirectory() as out:
        server = subprocess.Popen([PLAYPEN, "serve", world, "--tcp-port", "0", "--time", "lockstep",
                                   "--out", out, "--log-level", "error", "--quiet", *options],
                                  stdout=subprocess.PIPE, text=True)
        try:
            found = re.match(r"listening on .*:(\d+)", server.stdout.readline())
            expect(found, "the server says where it listens")
            yield server, int(found[1])
        finally:
            server.terminate()
            server.communicate()


def numbers_in_cbor():
    for value in (0, 23, 24, 255, 256, 65535, 65536, 2**32, -1, -500, 1.5, "", "pose é", None, True,
                  {"a": [1, {"b": False}], "c": "x" * 300}):
        expect(playpen_client.decode(playpen_client.encode(value))[0] == value, f"{value!r} survives")
    doubles = np.array([0.1, -2.0])
    expect(np.array_equal(playpen_client.decode(playpen_client.encode(doubles))[0], doubles), "doubles do")
    expect_error(lambda: playpen_client.encode(2**64), OverflowError, None, "too big")


def same_run_as_in_this_process(port):
    import playpen_gym
    batch = playpen_gym.Batch(WORLD)
    with Session(port=port, robots="r1") as session:
        for i in range(40):
            action = [[0.2, 0.1 * (i % 7 - 3)]]
            session.step(action)
            batch.step([action], steps=10)
            expect(abs(session.time - batch.times[0]) < 1e-9, f"a decision lasts 0.1 s, in step {i}")
            expect(np.array_equal(session.poses, batch.poses[0]), f"poses are equal in step {i}")
            expect(np.array_equal(session.scans.astype(np.float32), batch.scans[0]),
                   f"scans are equal in step {i}")
    expect(session.scans.shape == (1, 682) and session.twists.shape == (1, 2), "a row for each robot")


def several_robots(port):
    with Session(port=port, robots=("r2", "r1")) as session, Session(port=port, pose="odometry") as all_of:
        expect(session.robots == ["r2", "r1"] and all_of.robots == ["r1", "r2"], "robots by name, or all")
        # Both take part in the lockstep from their first step on, so the second session must not wait.
        all_of.close()
        start = session.request("object_pose", name="r2")["pose"]
        for _ in range(10):
            session.step([[0.2, 0.0], [0.0, 1.0]])
        moved = np.hypot(session.poses[0, 0] - start["x"], session.poses[0, 1] - start["y"])
        expect(0.15 < moved < 0.25, f"the first robot drives 0.2 m, not {moved}")
        expect(abs(session.twists[1, 1] - 1.0) < 0.01, "the second one turns")
        for actions in ([[0.1, 0.0]], np.zeros((2, 3))):
            expect_error(lambda: session.step(actions), ValueError, None, "expected shape (2, 2), found")
        before = session.time
        session.step()
        expect(abs(session.time - before - 0.1) < 1e-9 and session.twists[1, 1] > 0.99,
               "without actions robots go on as before")
        expect_error(lambda: session.step([[np.nan, 0.0], [0.0, 0.0]]), PlaypenError, "protocol/number",
                     "not finite")
        expect_error(lambda: session.request("dance"), PlaypenError, "protocol/unknown-request", "no request")
        session.step(playpen_client.roam(session.scans))  # the connection still works


def refusals(port):
    def robots(*names, **options):
        Session(port=port, robots=names, **options)

    expect_error(lambda: robots("r7"), PlaypenError, "robot", "no robot 'r7'; this world has r1, r2")
    expect_error(lambda: robots("r1", pose="gps"), PlaypenError, "robot", "'r1' has no device of type 'gps'")
    expect_error(robots, PlaypenError, "robot", "expected one or more robots")


def tokens():
    with tempfile.TemporaryDirectory() as folder:
        with open(f"{folder}/tokens.json", "w", encoding="utf-8") as file:
            file.write('{"server": "open-sesame-open-sesame"}')
        os.chmod(f"{folder}/tokens.json", 0o600)
        with served(WORLD, "--token-file", f"{folder}/tokens.json") as (_, port):
            expect_error(lambda: Session(port=port), PlaypenError, "access/denied", "token")
            expect_error(lambda: Session(port=port, tokens=["wrong"]), PlaypenError, "access/denied", "token")
            for tokens in ("open-sesame-open-sesame", ["open-sesame-open-sesame"]):
                with Session(port=port, tokens=tokens) as session:
                    session.step([[0.0, 0.0]])


def other_servers():
    """A listener that closes at once, or says something else."""
    for answer, text in ((b"", "does not answer as a Playpen server"), (b"HTTP/1.1 400\r\n", "does not answer"),
                         (b'- FAILED "server/full: this server has all"\n', "has all [server/full]")):
        with socket.create_server(("127.0.0.1", 0)) as listener:
            def reply(listener=listener, answer=answer):
                connection, _ = listener.accept()
                with connection:
                    connection.recv(4096)
                    connection.sendall(answer)
            thread = threading.Thread(target=reply)
            thread.start()
            id = "server/full" if "full" in text else "connection"
            expect_error(lambda: Session(port=listener.getsockname()[1]), PlaypenError, id, text)
            thread.join()


def interruptions(port):
    """After one, the session is closed: no answer is taken for that of a later step."""
    for error in (KeyboardInterrupt(), socket.timeout()):
        session = Session(port=port, robots="r1")
        session.step([[0.1, 0.0]])

        class Interrupted:
            closed, close = False, staticmethod(session.file.close)

            def read(self, size, error=error):
                raise error
        session.file = Interrupted()
        kind, id = (PlaypenError, "connection") if isinstance(error, OSError) else (KeyboardInterrupt, None)
        expect_error(lambda: session.step([[0.1, 0.0]]), kind, id, "")
        expect(session.socket.fileno() == -1, f"the session is closed after {error!r}")


def cut_answers():
    """A message that ends too early is no answer, wherever it is cut."""
    answer = playpen_client.frame({"id": 1, "numbers": np.zeros(2), "finished": False, "t": 100000000})
    for size in range(len(answer)):
        ours, theirs = socket.socketpair()
        session = Session.__new__(Session)
        session.peer, session.timeout, session.socket = "peer", 5.0, ours
        session.file = ours.makefile("rb")
        with theirs:
            theirs.sendall(answer[:size])
            theirs.shutdown(socket.SHUT_WR)
            expect_error(lambda: session.send_and_receive(b""), EOFError, None, "has ended the connection")
        session.close()


def ends():
    with served(WORLD, "--duration", "0.25") as (_, port), Session(port=port) as session:
        session.step([[0.1, 0.0]])
        session.step([[0.1, 0.0]])
        expect_error(lambda: session.step([[0.1, 0.0]]), PlaypenError, "session/finished", "over")
    with served(WORLD) as (server, port):
        session = Session(port=port)
        session.step([[0.1, 0.0]])
        server.terminate()
        server.wait()
        expect_error(lambda: session.step([[0.1, 0.0]]), PlaypenError, "connection", "")
        session.close()
        expect_error(lambda: session.step([[0.1, 0.0]]), PlaypenError, "connection", "session is closed")
        expect_error(lambda: Session(port=port), PlaypenError, "connection", "no server at 127.0.0.1")


def main():
    numbers_in_cbor()
    if "PLAYPEN_BATCH_LIBRARY" in os.environ:
        with served(WORLD) as (_, port):
            same_run_as_in_this_process(port)
    with served(TWO_ROBOTS) as (_, port):
        refusals(port)
        several_robots(port)
        interruptions(port)
    tokens()
    other_servers()
    cut_answers()
    ends()


main()
