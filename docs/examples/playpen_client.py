# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
"""Drives robots of a `playpen serve` from Python, step by step. Needs NumPy.

Session       sends speeds, and gets scans and poses as arrays, in one message each way
PlaypenError  why the server refuses something, or cannot be reached

Run it to see the speed of a trivial policy: python3 playpen_client.py [HOST [PORT [ROBOT...]]]
docs/protocol.md defines the messages, docs/many_simulations.md compares this with other ways.
"""
import json
import socket
import struct
import sys
import time

import numpy as np


class PlaypenError(Exception):
    """`id` is a name of docs/protocol.md, such as "access/denied"; "connection": no server (any more)."""

    def __init__(self, id, message):
        super().__init__(f"{message} [{id}]")
        self.id = id


def head(major, count):
    """The first bytes of an item in CBOR (RFC 8949)."""
    size = 1
    while size < 8 and count >> 8 * size:
        size *= 2
    return (bytes([major << 5 | count]) if count < 24 else
            bytes([major << 5 | 23 + size.bit_length()]) + count.to_bytes(size, "big"))


def encode(value):
    """A value as CBOR: None, bool, int, float, str, lists, dicts, and arrays as doubles."""
    if value is None or isinstance(value, bool):
        return {None: b"\xf6", True: b"\xf5", False: b"\xf4"}[value]
    if isinstance(value, int):
        return head(0, value) if value >= 0 else head(1, -1 - value)
    if isinstance(value, float):
        return struct.pack(">Bd", 0xfb, value)
    if isinstance(value, str):
        return head(3, len(value.encode())) + value.encode()
    if isinstance(value, (list, tuple)):
        return head(4, len(value)) + b"".join(map(encode, value))
    if isinstance(value, dict):
        return head(5, len(value)) + b"".join(encode(key) + encode(item) for key, item in value.items())
    return head(6, 86) + head(2, 8 * np.size(value)) + np.asarray(value, "<f8").tobytes()


def decode(data, at=0):
    """The value of the item at a place of a message, and the place after it."""
    first, at = data[at], at + 1
    major, count = first >> 5, first & 31
    if count > 23 and major != 7:
        size = 1 << count - 24
        count, at = int.from_bytes(data[at:at + size], "big"), at + size
    if major < 2:
        return (count if major == 0 else -1 - count), at
    if major < 4:
        content = data[at:at + count]
        return (content if major == 2 else content.decode()), at + count
    if major == 6:  # the tag of doubles, the only one in the protocol
        numbers, at = decode(data, at)
        return np.frombuffer(numbers, "<f8"), at
    if major == 7:
        if count in (26, 27):
            layout = ">f" if count == 26 else ">d"
            return struct.unpack_from(layout, data, at)[0], at + struct.calcsize(layout)
        return {20: False, 21: True}.get(count), at
    items = []
    for _ in range(count if major == 4 else 2 * count):
        item, at = decode(data, at)
        items.append(item)
    return (items if major == 4 else dict(zip(items[::2], items[1::2]))), at


def frame(message):
    """A message with its length, as on the wire."""
    message = encode(message)
    return struct.pack(">I", len(message)) + message


class Session:
    """Robots of a server. step() sets these arrays and numbers of R robots with B beams each:

    scans [R, B]   ranges, the rightmost beam first [m]
    poses [R, 3]   x [m], y [m], yaw [rad], of the device `pose` or `odometry`
    twists [R, 2]  speed ahead [m/s], turn rate [rad/s]
    time           simulated time [s]; finished: whether the run is over

    Each step gives new arrays. `with Session(...) as session:` closes the connection at the end.
    """

    def __init__(self, host="127.0.0.1", port=4000, robots=None, tokens=(), pose="pose", timeout=60.0):
        """robots: names, None for all. tokens: of server and robots. timeout: of an answer [s]."""
        self.peer, self.timeout = f"{host}:{port}", timeout
        try:
            self.socket = socket.create_connection((host, port), timeout)
        except (OSError, OverflowError) as error:  # such as the port 70000
            raise PlaypenError("connection", f"no server at {self.peer}: {error}") from error
        self.socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self.file = self.socket.makefile("rb", 1 << 18)
        try:
            self.guarded(self.hello, [tokens] if isinstance(tokens, str) else list(tokens))
            self.select(robots, pose)
        except BaseException:
            self.close()
            raise

    def close(self, *_):
        self.file.close()
        self.socket.close()

    def __enter__(self):
        return self

    __exit__ = close

    def hello(self, tokens):
        hello = {"version": 1, "encoding": "cbor", "tokens": tokens, "name": "playpen_client.py"}
        self.socket.sendall(f"1 playpen hello {json.dumps([hello])}\n".encode())
        answer = self.file.readline().decode().split(" ", 2)
        if len(answer) < 3:
            raise PlaypenError("connection", f"{self.peer} does not answer as a Playpen server does")
        self.welcome = json.loads(answer[2])
        if answer[1] != "SUCCESS":  # a server that is full gives a text
            raise PlaypenError(*(self.welcome.split(": ", 1) if isinstance(self.welcome, str) else
                                 (self.welcome["error"], self.welcome["message"])))

    def select(self, names, pose):
        """Chooses the robots, and the numbers that each step gives."""
        known = {robot["name"]: {device["type"]: device for device in reversed(robot["devices"])}
                 for robot in self.welcome["robots"]}  # the first device of each type
        self.robots = list(known) if names is None else [names] if isinstance(names, str) else list(names)
        numbers, motions = [], []
        for name in self.robots:
            if name not in known:
                raise PlaypenError("robot", f"there is no robot {name!r}; this world has {', '.join(known)}")
            for type in ("laser", pose, "motion"):
                if type not in known[name]:
                    raise PlaypenError("robot", f"robot {name!r} has no device of type {type!r}")
            laser, place, motion = (known[name][type]["device"] for type in ("laser", pose, "motion"))
            numbers += [{"device": laser, "keys": ["ranges"]},
                        {"device": place, "keys": ["x", "y", "yaw", "v", "omega"]}]
            motions.append(motion)
        if len({known[name]["laser"]["properties"]["beams"] for name in self.robots}) != 1:
            raise PlaypenError("robot", "expected one or more robots whose lasers have equally many beams")
        self.request("select", numbers=numbers, motions=motions)
        self.step_alone = frame({"id": 1, "do": "step"})
        twists = np.zeros((len(motions), 2))
        message = frame({"id": 1, "do": "step", "twists": twists})
        self.step_head = message[:len(message) - twists.nbytes]

    def step(self, actions=None):
        """Drives the robots until each has a new scan and pose, which it stores.

        actions: [R, 2], speed ahead [m/s] and turn rate [rad/s], None: as before. Motors have limits.
        """
        message = self.step_alone
        if actions is not None:
            actions = np.asarray(actions, "<f8")
            if actions.shape != (len(self.robots), 2):
                raise ValueError(f"actions: expected shape {(len(self.robots), 2)}, found {actions.shape}")
            message = self.step_head + actions.tobytes()
        answer = self.exchange(message)
        rows = answer["numbers"].reshape(len(self.robots), -1)
        self.scans, self.poses, self.twists = rows[:, :-5], rows[:, -5:-2], rows[:, -2:]
        self.time, self.finished = 1e-9 * answer["t"], answer["finished"]

    def request(self, do, **keys):
        """Makes any request of docs/protocol.md. Returns the answer."""
        return self.exchange(frame({"id": 1, "do": do, **keys}))

    def exchange(self, message):
        return self.guarded(self.send_and_receive, message)

    def receive(self, size):
        data = self.file.read(size)
        if len(data) < size:
            raise EOFError("the server has ended the connection")
        return data

    def send_and_receive(self, message):
        if self.file.closed:
            raise EOFError("this session is closed")
        self.socket.sendall(message)
        while True:
            answer = decode(self.receive(int.from_bytes(self.receive(4), "big")))[0]
            if "error" in answer:
                raise PlaypenError(answer["error"], answer["message"])
            if "id" in answer:
                return answer
            if answer["event"] == "bye":
                raise PlaypenError("connection", answer.get("message", f"{self.peer} has left"))

    def guarded(self, action, *arguments):
        """Closes the session after an interruption: the next step would take the late answer for its own."""
        try:
            return action(*arguments)
        except PlaypenError:
            raise
        except socket.timeout as error:
            self.close()
            raise PlaypenError("connection", f"{self.peer} has not answered for {self.timeout} s") from error
        except (OSError, EOFError, IndexError, ValueError, struct.error) as error:
            self.close()
            raise PlaypenError("connection", f"{self.peer}: {error}") from error
        except BaseException:  # such as Ctrl-C
            self.close()
            raise


def roam(scans):
    """A trivial policy for all robots: drive on; if something is near ahead, turn."""
    middle, side = scans.shape[1] // 2, scans.shape[1] // 6
    near = scans[:, middle - side:middle + side:side // 6].min(axis=1) < 0.3
    return np.where(near[:, None], (0.0, 1.5), (0.3, 0.0))


def main():
    host, port, *robots = sys.argv[1:] + ["127.0.0.1", "4000"][len(sys.argv) - 1:]
    with Session(host, int(port), robots or None) as session:
        session.step()
        start, decisions = time.process_time(), 0
        while decisions < 20000 and not session.finished:
            session.step(roam(session.scans))
            decisions += len(session.robots)
        speed = decisions / (time.process_time() - start)
        print(f"robots: {len(session.robots)}, beams: {session.scans.shape[1]}, "
              f"simulated: {session.time:.0f} s, "
              f"decisions per second of the client's processor time: {speed:.0f}")


if __name__ == "__main__":
    try:
        main()
    except PlaypenError as error:
        sys.exit(f"playpen_client.py: {error}")
