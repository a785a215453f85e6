# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
"""Many simulations at once from Python, and a Gymnasium environment. Needs NumPy.

Batch     arrays for many simulations, by ctypes and the C interface (playpen_batch.h)
ArenaEnv  one robot that roams as far as it can without a collision

Run it to see the speed of a trivial policy: python3 playpen_gym.py [WORLD]
Gymnasium is not needed, but used if it is there. docs/many_simulations.md explains both classes.
"""
import ctypes as c
import os
import sys
import time

import numpy as np

try:
    import gymnasium
    Env, Box = gymnasium.Env, gymnasium.spaces.Box
except ImportError:
    Env, Box = object, None

lib = c.CDLL(os.environ.get("PLAYPEN_BATCH_LIBRARY", "libplaypen_batch.so"))
lib.playpen_batch_last_error.restype = c.c_char_p


class Array(c.Structure):
    _fields_ = [("data", c.c_void_p), ("size", c.c_size_t), ("simulation_stride", c.c_ssize_t),
                ("robot_stride", c.c_ssize_t)]


class Options(c.Structure):
    _fields_ = [("struct_size", c.c_size_t), ("simulations", c.c_int32), ("threads", c.c_int32),
                ("beams", c.c_int32), ("readings", c.c_int32), ("seeds", c.POINTER(c.c_uint64)),
                ("seed_count", c.c_size_t), ("robots", c.POINTER(c.c_char_p)),
                ("robot_count", c.c_size_t)]


class Observations(c.Structure):
    _fields_ = [("struct_size", c.c_size_t)] + [(name, Array) for name in (
        "poses", "twists", "scans", "clearances", "collisions", "done", "times")]


def check(status):
    if status != 0:
        raise ValueError(lib.playpen_batch_last_error().decode())


def array(values):
    return Array(values.ctypes.data if values.size > 0 else None, values.size, 0, 0)


class Batch:
    """Simulations of one world. step() and reset() fill the arrays poses [N, R, 3], twists [N, R, 3],
    scans [N, R, B], clearances [N, R], collisions [N, R], done [N] and times [N]."""

    def __init__(self, world="", simulations=1, threads=0, beams=0):
        options, self.handle = Options(c.sizeof(Options), simulations, threads, beams), c.c_void_p()
        check(lib.playpen_batch_create(os.fsencode(world), c.byref(options), c.byref(self.handle)))
        self.shape = n, r = simulations, lib.playpen_batch_robots(self.handle)
        self.poses, self.twists = np.zeros((n, r, 3)), np.zeros((n, r, 3))
        self.scans = np.zeros((n, r, lib.playpen_batch_beams(self.handle)), np.float32)
        self.clearances, self.collisions = np.zeros((n, r)), np.zeros((n, r), np.int32)
        self.done, self.times = np.zeros(n, np.bool_), np.zeros(n)
        self.out = Observations(c.sizeof(Observations), *(
            array(getattr(self, name)) for name, _ in Observations._fields_[1:]))
        self.observe()

    def close(self):
        lib.playpen_batch_destroy(self.handle)
        self.handle = c.c_void_p()

    __del__ = close

    def observe(self):
        check(lib.playpen_batch_observe(self.handle, c.byref(self.out)))

    def step(self, actions, steps=1):
        """actions: [N, R, 2], forward speed [m/s] and turn rate [rad/s]."""
        actions = np.ascontiguousarray(actions, np.float64)
        if actions.shape != self.shape + (2,):
            raise ValueError(f"actions: expected shape {self.shape + (2,)}, found {actions.shape}")
        check(lib.playpen_batch_step(self.handle, c.byref(array(actions)), steps, c.byref(self.out)))

    def reset(self, mask=None, seeds=None, poses=None):
        """mask, seeds: [N]; poses: [N, R, 3]."""
        mask, seeds, poses = (np.array([] if values is None else values, kind) for values, kind in (
            (mask, np.uint8), (seeds, np.uint64), (poses, np.float64)))
        m, s, p = array(mask), array(seeds), array(poses)
        check(lib.playpen_batch_reset(self.handle, c.c_void_p(m.data), c.c_size_t(m.size),
                                      c.c_void_p(s.data), c.c_size_t(s.size), c.byref(p)))
        self.observe()


class ArenaEnv(Env):
    """Observation: 36 ranges. Action: speed and turn rate, from -1 to 1. Reward: the way ahead in
    metres, and -1 for a collision, which ends the episode. A decision lasts 0.1 s."""
    metadata = {"render_modes": []}

    def __init__(self, world="", seconds=60.0):
        self.batch, self.seconds, self.render_mode = Batch(world, beams=36, threads=1), seconds, None
        if self.batch.scans.shape != (1, 1, 36):
            raise ValueError(f"{world}: expected one robot with a laser, found scans {self.batch.scans.shape}")
        if Box is not None:
            self.observation_space = Box(0.0, 5.0, (36,), np.float32)
            self.action_space = Box(-1.0, 1.0, (2,), np.float32)

    def reset(self, *, seed=None, options=None):
        if Env is not object:
            super().reset(seed=seed)
        self.batch.reset(seeds=None if seed is None else [seed])
        return self.batch.scans[0, 0].copy(), {}

    def step(self, action):
        self.batch.step(np.multiply(action, (0.5, 3.0)).reshape(1, 1, 2), steps=10)
        crashed = bool(self.batch.collisions[0, 0] > 0)
        late = bool(self.batch.done[0] or self.batch.times[0] >= self.seconds)
        reward = 0.1 * float(self.batch.twists[0, 0, 0]) - crashed
        return self.batch.scans[0, 0].copy(), reward, crashed, late, {}


def roam(scans):
    """A trivial policy for all robots: drive on; if something is near ahead, turn."""
    middle, side = scans.shape[2] // 2, scans.shape[2] // 6
    near = scans[:, :, middle - side:middle + side:side // 6].min(axis=2) < 0.3
    return np.stack([np.where(near, 0.0, 0.3), np.where(near, 1.5, 0.0)], axis=2)


def main():
    world = sys.argv[1] if len(sys.argv) > 1 else ""
    for beams in (0, 180):
        batch, start = Batch(world, simulations=256, beams=beams), time.process_time()
        for _ in range(200):
            batch.step(roam(batch.scans))
        speed = 200 * batch.shape[0] / (time.process_time() - start)
        print(f"{batch.scans.shape[2]} beams: {speed:.0f} decisions per second of processor time")
    env, total = ArenaEnv(world), 0.0
    scan, _ = env.reset(seed=1)
    for _ in range(600):
        scan, reward, terminated, truncated, _ = env.step(roam(scan.reshape(1, 1, 36))[0, 0] * (2, 0.3))
        total += reward
        if terminated or truncated:
            break
    print(f"an episode of {env.batch.times[0]:.1f} s: reward {total:.2f}")


if __name__ == "__main__":
    main()
