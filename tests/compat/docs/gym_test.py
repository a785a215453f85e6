#!/usr/bin/env python3
# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
"""Runs docs/examples/playpen_gym.py: arrays equal those of single simulations, errors are exceptions, and
the environment keeps to Gymnasium's rules, by Gymnasium's own checker if it is installed.

Usage: gym_test.py EXAMPLES WORLD; PLAYPEN_BATCH_LIBRARY names the library. Exit code 77 without NumPy."""
import sys

try:
    import numpy as np
except ImportError:
    print("skipped: this Python has no numpy")
    sys.exit(77)

sys.path.insert(0, sys.argv[1])
import playpen_gym  # noqa: E402


def expect(holds, what):
    if not holds:
        sys.exit(f"gym_test.py: not so: {what}")


def arrays(world):
    many = playpen_gym.Batch(world, simulations=5, threads=3, beams=180)
    expect(many.scans.shape == (5, 1, 180) and many.scans.dtype == np.float32, "scans are [N][R][B]")
    one = playpen_gym.Batch(world, simulations=1, threads=1, beams=180)
    poses = np.array([[[0.5, 0.4, 0.2 * i]] for i in range(5)])
    many.reset(poses=poses)
    one.reset(seeds=[3], poses=poses[2:3])
    for _ in range(50):
        many.step(playpen_gym.roam(many.scans), steps=3)
        one.step(playpen_gym.roam(one.scans), steps=3)
    expect(np.array_equal(many.poses[2], one.poses[0]), "a simulation of many equals a single one")
    expect(np.array_equal(many.scans[2], one.scans[0]), "its scan does, too")
    expect(not np.array_equal(many.poses[1], many.poses[2]), "the simulations differ")
    expect(not many.done.any() and np.allclose(many.times, 1.5), "1.5 s have passed")
    many.reset(mask=[0, 1, 0, 0, 0])
    expect(np.array_equal(many.times == 0, [False, True, False, False, False]), "the mask resets one")


def errors(world):
    batch = playpen_gym.Batch(world, simulations=2)
    for call, text in ((lambda: batch.step(np.full((2, 1, 2), np.nan)), "found NaN as the speed"),
                       (lambda: batch.step(np.zeros((3, 1, 2))), "expected shape (2, 1, 2)"),
                       (lambda: batch.step(np.zeros((1, 2, 2))), "found (1, 2, 2)"),
                       (lambda: batch.reset(mask=[1]), "mask: expected one for each of 2"),
                       (lambda: playpen_gym.Batch(world, simulations=0), "simulations: expected"),
                       (lambda: playpen_gym.Batch("none.json"), "none.json")):
        try:
            call()
        except ValueError as error:
            expect(text in str(error), f"'{error}' has '{text}'")
        else:
            sys.exit(f"gym_test.py: no error with '{text}'")


def episode(world):
    env = playpen_gym.ArenaEnv(world, seconds=5.0)
    history = []
    for _ in range(2):
        scan, info = env.reset(seed=4)
        expect(scan.shape == (36,) and scan.dtype == np.float32 and info == {}, "reset() gives a scan")
        total, truncated = 0.0, False
        while not truncated:
            scan, reward, terminated, truncated, _ = env.step(np.array([0.2, 0.4], np.float32))
            expect(not terminated, "a circle without a collision")
            total += reward
        history.append((total, scan.tolist()))
    expect(history[0] == history[1], "episodes with equal seeds are equal")
    expect(abs(history[0][0] - 0.5) < 0.02, f"5 s with 0.1 m/s are 0.5 m, not {history[0][0]}")
    terminated = False
    env.reset(seed=4)
    for _ in range(100):
        _, reward, terminated, _, _ = env.step(np.array([1.0, 0.0], np.float32))
        if terminated:
            break
    expect(terminated and reward < -0.9, "straight ahead ends in a collision")


def gymnasium_checker(world):
    if playpen_gym.Box is None:
        print("without Gymnasium's checker: gymnasium is not installed")
        return
    from gymnasium.utils.env_checker import check_env
    check_env(playpen_gym.ArenaEnv(world), skip_render_check=True)
    print("Gymnasium's checker has passed")


if __name__ == "__main__":
    for test in (arrays, errors, episode, gymnasium_checker):
        test(sys.argv[2])
