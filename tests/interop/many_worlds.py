#!/usr/bin/env python3
# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
"""Compares Playpen with real Stage in all worlds below a folder.

  many_worlds.py --prefix DIR --build DIR (--worlds DIR | --random N [--seed S]) --out DIR [OPTIONS]

In each world the first robot drives blindly and along walls, in Playpen (playpen_drive.cc) and in Stage (stage_drive.cc);
compare_stage.cc compares the ranges at random places and where robots stop that drive into something. With --random
the worlds are those of random_world.py. Controllers and cameras are removed from the worlds, as in compare_stage.sh.

Results: OUT/results.jsonl, a line for each world, and a summary. Worlds of equal text count once; worlds of Gazebo are left
out. The same seed gives the same result.
"""
import argparse
import collections
import concurrent.futures
import glob
import hashlib
import json
import math
import os
import re
import shutil
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
CONTROLLERS = ("blind", "wall")


def strip(text):
    """Robots must stay where they are put, and Stage's cameras do not work without its window."""
    text = re.sub(rb'(?m)^([^#\n]*)\bctrl\s+"[^"]*"', rb"\1", text)
    return re.sub(rb"(?m)^([^#\n]*)\bcamera\s*\((?:[^()]|\([^()]*\))*\)", rb"\1", text)


def run(command, folder, seconds, environment=None):
    """(exit code, standard output, last line of the errors); the code is None after a timeout."""
    try:
        done = subprocess.run(command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=seconds,
                              env=environment, check=False)
    except subprocess.TimeoutExpired:
        return None, "", "timeout"
    errors = done.stderr.decode("utf-8", "replace").strip().split("\n")
    return done.returncode, done.stdout.decode("utf-8", "replace"), errors[-1]


def copy_worlds(source, target):
    """Copies a tree with stripped worlds. Returns the paths of the distinct worlds of Stage."""
    worlds, seen = [], set()
    for folder, folders, files in os.walk(source):
        folders.sort()
        into = os.path.join(target, os.path.relpath(folder, source))
        for name in sorted(files):
            if not name.endswith((".world", ".inc", ".cfg", ".png", ".pgm", ".pnm", ".ppm", ".pbm", ".jpg", ".jpeg", ".bmp",
                                  ".gif", ".xpm", ".def")):
                continue
            os.makedirs(into, exist_ok=True)
            with open(os.path.join(folder, name), "rb") as file:
                content = file.read()
            if name.endswith((".world", ".inc")):
                text = strip(content)
                if name.endswith(".world") and not re.search(rb"<\?xml|<sdf|<world|<gazebo|#VRML", content):
                    key = hashlib.sha1(re.sub(rb"\s+", b" ", content)).digest()
                    if key not in seen:
                        seen.add(key)
                        worlds.append(os.path.normpath(os.path.join(into, name)))
                content = text
            with open(os.path.join(into, name), "wb") as file:
                file.write(content)
    return worlds


def parse_drives(text):
    """Records of the controllers by name."""
    records, record = {}, {}
    robots = 0
    for line in text.split("\n"):
        words = line.split()
        if not words:
            continue
        if words[0] == "robots":
            robots = int(words[1])
        elif words[0] == "controller":
            record = records[words[1]] = {"at": [], "stalls": []}
        elif words[0] == "at":
            record["at"].append([float(word) for word in words[1:]])
        elif words[0] == "stall":
            record["stalls"].append({"at": [float(word) for word in words[1:5]], "sight": words[5],
                                     "ahead": float(words[6]), "partner": " ".join(words[7:])})
        elif words[0] == "end":
            record["path"], record["count"] = float(words[4]), int(words[5])
    return records if robots > 0 else {}


def parse_comparison(text):
    record = {"beams": 0, "agree": 0, "hits": 0, "hits_agree": 0, "drive_m": 0.0}
    for line in text.split("\n"):
        found = re.match(r"all: (\d+) beams, [\d.]+ % agree, [\d.]+ % without.*others: (\d+) only in Stage, (\d+) only in "
                         r"Playpen, (\d+) farther, (\d+) nearer, (\d+) of other devices", line)
        if found:
            record["beams"] = int(found[1])
            others = [int(found[i]) for i in range(2, 7)]
            record.update(zip(("missed", "extra", "farther", "nearer", "other_device"), others))
            record["agree"] = record["beams"] - sum(others)
        found = re.match(r".* hits: (\d+), (\d+) agree", line)
        if found:
            record["hits"] += int(found[1])
            record["hits_agree"] += int(found[2])
        found = re.match(r".* drives: \d+, ends at most ([\d.]+) mm", line)
        if found:
            record["drive_m"] = max(record["drive_m"], 0.001 * float(found[1]))
    record["differences"] = [line.strip() for line in text.split("\n") if line.startswith(("  ", "other device"))][:20]
    return record


class Runner:
    def __init__(self, arguments):
        self.arguments = arguments
        self.out = os.path.abspath(arguments.out)
        self.build = os.path.abspath(arguments.build)
        self.bin = os.path.join(self.out, "bin")
        os.makedirs(self.bin, exist_ok=True)
        prefix = os.path.abspath(arguments.prefix)
        self.environment = dict(os.environ, STAGEPATH=os.path.join(prefix, "share/stage/worlds"))
        flags = subprocess.run(["pkg-config", "--cflags", "stage"], stdout=subprocess.PIPE, check=True, env=dict(
            os.environ, PKG_CONFIG_PATH=prefix + "/lib/pkgconfig:" + prefix + "/lib64/pkgconfig")).stdout.decode().split()
        for program in ("stage_drive", "stage_scans"):
            subprocess.run(["g++", "-std=gnu++14", "-O1", "-fpermissive", "-fno-access-control", "-w", *flags, HERE + "/" + program + ".cc", "-o",
                            self.bin + "/" + program, "-L" + prefix + "/lib", "-L" + prefix + "/lib64", "-lstage",
                            "-Wl,-rpath," + prefix + "/lib:" + prefix + "/lib64"], check=True)
        flags = subprocess.run(["pkg-config", "--cflags", "eigen3"], stdout=subprocess.PIPE, check=True).stdout.decode().split()
        for program in ("playpen_drive", "compare_stage"):
            subprocess.run(["g++", "-std=c++20", "-O1", *flags, "-I" + ROOT + "/libsim/include", HERE + "/" + program + ".cc",
                            "-o", self.bin + "/" + program, self.build + "/libsim/libplaypen_sim.so",
                            "-Wl,-rpath," + self.build + "/libsim"], check=True)

    def world(self, path):
        arguments = self.arguments
        folder, name = os.path.split(path)
        record = {"world": os.path.relpath(path, os.path.join(self.out, "worlds")), "playpen": {}, "stage": {}}
        for side, program in (("playpen", "playpen_drive"), ("stage", "stage_drive")):
            code, output, error = run([self.bin + "/" + program, name, str(arguments.seconds)], folder, arguments.timeout,
                                      self.environment)
            if code == 0:
                record[side] = parse_drives(output)
            else:
                record[side + "_error"] = error if code in (1, None) else "ends with %s: %s" % (code, error)
        if "playpen_error" in record or "stage_error" in record:
            return record
        scans = os.path.join(folder, name + ".scans")
        code, output, error = run([self.bin + "/stage_scans", name, str(arguments.poses), "1"], folder, arguments.timeout,
                                  self.environment)
        if code == 0 and "\npose" in output:
            with open(scans, "w", encoding="utf-8") as file:
                file.write(output)
            code, output, error = run([self.bin + "/compare_stage", name, scans, "--list", "12"], folder, arguments.timeout,
                                      self.environment)
            if code == 0:
                record["comparison"] = parse_comparison(output)
            else:
                record["comparison_error"] = error
        return record


def blind(drive):
    return sum(stall["sight"] == "blind" for stall in drive.get("stalls", []))


def apart(ours, theirs):
    """Greatest distance of the places until one of the robots stalls [m]."""
    until = min([stall["at"][0] for drive in (ours, theirs) for stall in drive["stalls"]], default=1e9)
    return max([math.hypot(a[1] - b[1], a[2] - b[2]) for a, b in zip(ours["at"], theirs["at"]) if a[0] <= until], default=0.0)


def summary(records):
    lines = []
    count = collections.Counter()
    errors = collections.defaultdict(list)
    sums = collections.Counter()
    for record in records:
        count["worlds"] += 1
        if "playpen_error" in record:
            count["not loaded by Playpen"] += 1
            errors[re.sub(r"^\S*?: ", "", re.sub(r"[^\s\"]*/", "", record["playpen_error"]))[:100]].append(record["world"])
            count["not loaded by Playpen, but by Stage"] += "stage_error" not in record
            continue
        count["not loaded by Stage, but by Playpen"] += "stage_error" in record
        for controller in CONTROLLERS:
            ours = record["playpen"].get(controller, {})
            theirs = record["stage"].get(controller)
            if not ours:
                count[controller + ": no robot"] += 1
                continue
            count[controller + ": drives"] += 1
            count[controller + ": stalls"] += bool(ours["stalls"])
            if not any(stall["sight"] != "no_beam" for stall in ours["stalls"]):
                continue
            count[controller + ": stalls, with a beam ahead"] += 1
            if blind(ours):
                count[controller + ": stalls at something unseen"] += 1
                if theirs is None:
                    count[controller + ": unseen, Stage does not load it"] += 1
                elif blind(theirs):
                    count[controller + ": unseen, in Stage too"] += 1
                else:
                    count[controller + ": unseen, not in Stage"] += 1
        if record["playpen"].get("blind", {}).get("at") and record["stage"].get("blind", {}).get("at"):
            count["blind: compared with Stage"] += 1
            off = apart(record["playpen"]["blind"], record["stage"]["blind"])
            count["blind: until the first stall within 0.1 m of Stage"] += off <= 0.1
        comparison = record.get("comparison")
        count["not compared: error"] += "comparison_error" in record
        if comparison:
            count["ranges compared"] += 1
            count["ranges compared, all agree"] += comparison["agree"] == comparison["beams"]
            sums.update({key: value for key, value in comparison.items() if isinstance(value, int)})
    lines += ["%6d %s" % (value, key) for key, value in sorted(count.items())]
    if sums["beams"]:
        lines.append("beams: %d, %.2f %% agree; %s" % (
            sums["beams"], 100.0 * sums["agree"] / sums["beams"],
            ", ".join("%d %s" % (sums[key], key) for key in ("missed", "extra", "farther", "nearer", "other_device"))))
    if sums["hits"]:
        lines.append("robots that drive into something: %d, %.2f %% stop within a step of Stage" % (
            sums["hits"], 100.0 * sums["hits_agree"] / sums["hits"]))
    for error, worlds in sorted(errors.items(), key=lambda item: -len(item[1])):
        lines.append("%4d x %s (%s)" % (len(worlds), error, worlds[0]))
    return lines


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--prefix", required=True, help="as for build_peers.sh")
    parser.add_argument("--build", required=True, help="build folder of Playpen, with shared libraries")
    parser.add_argument("--worlds", help="folder of worlds")
    parser.add_argument("--random", type=int, help="number of random worlds instead")
    parser.add_argument("--seed", type=int, default=1, help="of the random worlds")
    parser.add_argument("--out", required=True)
    parser.add_argument("--seconds", type=float, default=60.0, help="simulated time of a drive")
    parser.add_argument("--poses", type=int, default=20, help="places of a world at which ranges are compared")
    parser.add_argument("--timeout", type=float, default=60.0, help="of each program [s]")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--only", default="", help="worlds whose path contains this")
    arguments = parser.parse_args()
    shutil.rmtree(os.path.join(arguments.out, "worlds"), ignore_errors=True)
    os.makedirs(arguments.out, exist_ok=True)
    source = arguments.worlds
    if arguments.random:
        source = os.path.join(arguments.out, "random")
        shutil.rmtree(source, ignore_errors=True)
        subprocess.run([sys.executable, HERE + "/random_world.py", "--worlds", str(arguments.random), "--seed",
                        str(arguments.seed), "--out", source], check=True)
    if not source or not glob.glob(os.path.join(source, "**/*.world"), recursive=True):
        parser.error("--worlds DIR with worlds, or --random N is needed")
    runner = Runner(arguments)
    worlds = [path for path in copy_worlds(os.path.abspath(source), os.path.join(runner.out, "worlds"))
              if arguments.only in path]
    records = []
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool, open(
            os.path.join(arguments.out, "results.jsonl"), "w", encoding="utf-8") as file:
        for record in pool.map(runner.world, worlds):
            records.append(record)
            file.write(json.dumps(record) + "\n")
            file.flush()
    text = "\n".join(summary(records)) + "\n"
    with open(os.path.join(arguments.out, "summary.txt"), "w", encoding="utf-8") as file:
        file.write(text)
    sys.stdout.write(text)


if __name__ == "__main__":
    main()
