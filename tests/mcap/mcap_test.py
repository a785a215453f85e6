#!/usr/bin/env python3
# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
"""Reads an MCAP files of runs with the Python library of the format's authors.

usage: mcap_test.py PLAYPEN MCAP_SAMPLE LOGGING_PROGRAM WORLD... [--keep FOLDER]

Compares every number with what the runs themselves wrote: all readings with its log, poses with
trajectory.csv, collisions and events with report.json, printed lines with program.log. The library
is installed from PyPI into a temporary folder; without a network, the test is skipped.
"""

import argparse
import csv
import json
import pathlib
import subprocess
import sys
import tempfile
import venv

LIBRARY = "mcap==1.2.2"
SECONDS = 30


def library_in(folder):
    """Installs the library; returns the path of its Python, or None and the reason."""
    venv.create(folder, with_pip=True)
    python = folder / "bin" / "python"
    made = subprocess.run([python, "-m", "pip", "install", "--quiet", "--disable-pip-version-check",
                           "--retries", "1", LIBRARY], capture_output=True, text=True)
    lines = made.stderr.strip().splitlines()
    return (python, "") if made.returncode == 0 else (None, lines[-1] if lines else "pip failed")


def close(a, b, limit):
    return abs(float(a) - float(b)) <= limit


def check_readings(log, messages):
    """Each reading of the log is in the file, number by number, and the file has no others."""
    lines = [json.loads(line) for line in log.read_text().splitlines()[1:]]
    found = {(topic, message["seq"]): (message, entry)
             for topic, all_of_it in messages.items() for message, entry in all_of_it
             if "seq" in message}
    begin, end = lines[0]["t"], lines[-1]["t"]
    devices = set()
    for line in lines:
        robot, device = line.pop("robot"), line.pop("device")
        line.pop("type")
        devices.add(f"/{robot}/{device}")
        message, entry = found[f"/{robot}/{device}", line["seq"]]
        assert message == line, f"{device}: {message} instead of {line}"
        assert entry.publish_time == line["t"]
        assert entry.log_time >= entry.publish_time
    # The log begins with the step after SetWriteState().
    between = [key for key, (message, entry) in found.items()
               if key[0] in devices and begin <= entry.log_time <= end]
    assert len(between) == len(lines) > 500, (len(between), len(lines))
    print(f"{len(lines)} readings of {len(devices)} devices are equal")


def check_poses(trajectory, messages):
    rows = list(csv.DictReader(trajectory.read_text().splitlines()))
    count = 0
    for row in rows:
        for message, entry in messages[f"/{row['robot']}/true_pose"]:
            if not close(entry.log_time / 1e9, row["time"], 1e-6):
                continue
            assert all(close(message[key], row[key], 1e-6) for key in ("x", "y", "yaw")), (row, message)
            count += 1
    assert count == len(rows) > 100, (count, len(rows))
    print(f"{count} poses are equal")


def check_scans(messages):
    scans = [(topic, message) for topic, all_of_it in messages.items()
             if topic.endswith("/scan") for message, _ in all_of_it]
    for topic, message in scans:
        time = 10**9 * message["timestamp"]["sec"] + message["timestamp"]["nsec"]
        reading = [one for one, _ in messages[topic[:-len("/scan")]] if one["t"] == time]
        assert len(reading[0]["ranges"]) == len(message["ranges"])
        assert all(map(lambda a, b: close(a, b, 5.001e-5), reading[0]["ranges"], message["ranges"]))
    assert scans
    print(f"{len(scans)} scans are equal")


def check_happenings(report, printed, messages):
    robots = report["robots"]
    collisions = messages.get("/arena/collisions", [])
    assert len(collisions) == sum(robot["collisions"] for robot in robots)
    events = [message["number"] for message, _ in messages.get("/arena/events", [])]
    assert events == [event["number"] for event in report.get("events", [])]
    lines = [message["message"] for message, _ in messages["/program/log"]]
    # After the run, playpen prints its report.
    of_program = [line for line in printed.read_text().splitlines() if line.startswith("at ")]
    assert lines == of_program and len(lines) > 50
    print(f"{len(collisions)} collisions, {len(events)} events and {len(lines)} lines are equal")
    return len(collisions), len(events)


def check(folder):
    """Runs in the environment that has the library."""
    file = folder / "run.mcap"
    from mcap.reader import NonSeekingReader, make_reader  # pylint: disable=import-error
    messages = {}
    with open(file, "rb") as stream:
        reader = make_reader(stream, validate_crcs=True)
        summary = reader.get_summary()
        last = 0
        for schema, channel, entry in reader.iter_messages():
            assert schema.encoding == "jsonschema" and channel.message_encoding == "json"
            assert json.loads(schema.data)["type"] == "object"
            assert entry.log_time >= last
            last = entry.log_time
            messages.setdefault(channel.topic, []).append((json.loads(entry.data), entry))
    count = sum(len(all_of_it) for all_of_it in messages.values())
    assert summary.statistics.message_count == count
    assert len(summary.chunk_indexes) == summary.statistics.chunk_count > 1
    with open(file, "rb") as stream:  # also checks the data section's checksum
        assert count == sum(1 for _ in NonSeekingReader(stream, validate_crcs=True).iter_messages())
    check_readings(folder / "readings.jsonl", messages)
    check_poses(folder / "trajectory.csv", messages)
    check_scans(messages)
    return check_happenings(json.loads((folder / "report.json").read_text()),
                            folder / "program.log", messages)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("playpen")
    parser.add_argument("sample")
    parser.add_argument("program")
    parser.add_argument("worlds", nargs="+")
    parser.add_argument("--keep", type=pathlib.Path, help="write the runs and the files here")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as temporary:
        python, reason = library_in(pathlib.Path(temporary) / "library")
        if python is None:
            print(f"skipped: {LIBRARY} cannot be installed: {reason}")
            return 77
        folders = []
        for world in arguments.worlds:
            folder = (arguments.keep or pathlib.Path(temporary)) / pathlib.Path(world).stem
            folder.mkdir(parents=True)
            with open(folder / "program.log", "wb") as printed:  # as a grader does
                subprocess.run([arguments.playpen, "run", world, "--out", folder, "--",
                                arguments.program, str(SECONDS)], check=True, stdout=printed)
            subprocess.run([arguments.sample, folder, folder / "run.mcap"], check=True)
            folders.append(folder)
        subprocess.run([python, __file__, "--check", *folders], check=True)
    print("passed")
    return 0


if __name__ == "__main__":
    if sys.argv[1:2] == ["--check"]:
        collision_count, event_count = map(sum, zip(*map(check, map(pathlib.Path, sys.argv[2:]))))
        assert collision_count > 0 and event_count > 0
    else:
        sys.exit(main())
