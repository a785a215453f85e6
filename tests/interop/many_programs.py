#!/usr/bin/env python3
# Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
"""Compiles and runs all Player programs below a folder, with Playpen and with the real client library.

  many_programs.py --prefix DIR --build DIR --programs DIR --out DIR [OPTIONS]

A program is a C or C++ source with a main() that includes a header of Player's client libraries, with the other sources
of its folder if it needs them. It is compiled with the real headers and libraries and with Playpen's. It runs for some
simulated seconds with `playpen run`, in the world of its folder or of a folder above, else in a shipped world with the
devices that it uses. If it drives there, the program with the real library runs against `playpen serve` with the same
world in real time; each server has a network of its own (unshare -n), because programs name their port.

Results: OUT/results.jsonl, a line for each program, and a summary.
"""
import argparse
import collections
import concurrent.futures
import glob
import hashlib
import json
import os
import re
import shlex
import shutil
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
# Shipped worlds by what a program names, in this order.
WORLDS = (("Scorpion|scorpion", "scorpion"), ("SetCarlike|carlike", "car"), ("GripperProxy|playerc_gripper", "pioneer_gripper"),
          ("ActArrayProxy|playerc_actarray", "pioneer_arm"), ("BumperProxy|playerc_bumper", "roomba_room"),
          ("FiducialProxy|BlobfinderProxy|playerc_fiducial|playerc_blobfinder", "pioneer"), ("IrProxy|playerc_ir_", "office"),
          ("LaserProxy|playerc_laser", "pioneer_laser"), ("SonarProxy|playerc_sonar", "cave"),
          ("RangerProxy|playerc_ranger", "stage_simple"), ("", "open_field"))


def run(command, seconds, folder=None, environment=None):
    """(exit code, all output); the code is None after a timeout."""
    process = subprocess.Popen(command, cwd=folder, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                               env=environment, start_new_session=True)
    try:
        output, _ = process.communicate(timeout=seconds)
        return process.returncode, output[-20000:].decode("utf-8", "replace")
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, 9)
        output, _ = process.communicate()
        return None, output[-20000:].decode("utf-8", "replace")


def read(path):
    with open(path, encoding="latin-1") as file:
        return file.read()


def says(output):
    """What matters of a program's output: errors and warnings, else its last line."""
    lines = [line.strip() for line in output.split("\n") if line.strip()]
    wrong = [line for line in lines if re.search(r"rror|warning: |terminate|no device|there is no|ended with|never", line)]
    return " | ".join(dict.fromkeys(wrong[:4] or lines[-1:]))[:400]


def programs_below(folder, skip):
    found, seen = [], set()
    for root, folders, files in os.walk(folder):
        folders.sort()
        for name in sorted(files):
            path = os.path.join(root, name)
            if not name.endswith((".cc", ".cpp", ".c", ".cxx")) or (skip and re.search(skip, path)):
                continue
            text = read(path)
            if not re.search(r"\bmain\s*\(", text) or not re.search(r"playerc|PlayerClient", text):
                continue
            key = hashlib.sha1(re.sub(r"\s+", " ", text).encode()).digest()
            if key not in seen:
                seen.add(key)
                found.append(path)
    return found


class Runner:
    def __init__(self, arguments):
        self.arguments = arguments
        self.out = os.path.abspath(arguments.out)
        prefix, build = os.path.abspath(arguments.prefix), os.path.abspath(arguments.build)
        self.playpen = build + "/bin/playpen"
        environment = dict(os.environ, PKG_CONFIG_PATH=prefix + "/lib/pkgconfig:" + prefix + "/lib64/pkgconfig")
        flags = subprocess.run(["pkg-config", "--cflags", "--libs", "playerc++", "playerc"], stdout=subprocess.PIPE, check=True,
                               env=environment).stdout.decode()
        self.flags = {
            "real": shlex.split(flags) + ["-Wl,-rpath," + prefix + "/lib:" + prefix + "/lib64"],
            "playpen": ["-I" + ROOT + "/libplayerlike/include", "-I" + build + "/libplayerlike/include",
                        build + "/libplayerlike/libplaypen_playerlike.so", "-Wl,-rpath," + build + "/libplayerlike:" + build +
                        "/libsim", "-Wl,-rpath-link," + build + "/libsim"]}

    def compile(self, source, side, target):
        """The options with which the program compiles; else the first error."""
        c = source.endswith(".c")
        folder = os.path.dirname(source)
        others = [path for path in sorted(glob.glob(os.path.join(folder, "**/*"), recursive=True))
                  if path.endswith((".c",) if c else (".cc", ".cpp", ".cxx")) and path != source and
                  not re.search(r"\bmain\s*\(", read(path))]
        error = ""
        for sources in ([source], [source] + others):
            for options in ([[]] if c else [[], ["-std=gnu++98"], ["-std=gnu++14", "-fpermissive"]]):
                command = ["gcc" if c else "g++", "-w", *options, "-I" + folder, *sources, "-o", target, *self.flags[side],
                           "-lm", "-pthread"]
                code, output = run(command, 300, folder)
                if code == 0:
                    return {"options": " ".join(options), "sources": len(sources)}
                if not error:
                    error = next((line for line in output.split("\n") if "error" in line or "undefined reference" in line),
                                 output[-200:])
                if "undefined reference" in output and "error:" not in output:
                    break  # other options do not help
            if "undefined reference" not in output or not others or len(others) > 30:
                break
        return {"error": error.strip()[:300]}

    def worlds(self, source):
        """Worlds to try: those of the program's folder or of one above, then shipped ones."""
        found = []
        folder, top = os.path.dirname(source), os.path.abspath(self.arguments.programs)
        for _ in range(3):
            for pattern in ("*.cfg", "*.world", "*/*.cfg"):
                found += [path for path in sorted(glob.glob(os.path.join(glob.escape(folder), pattern)))
                          if pattern == "*.world" or re.search(r"worldfile", read(path))]
            folder = os.path.dirname(folder)
            if found or folder == top:
                break
        stem = os.path.splitext(os.path.basename(source))[0]
        found.sort(key=lambda path: os.path.splitext(os.path.basename(path))[0] != stem)
        text = read(source)
        for header in glob.glob(os.path.join(glob.escape(os.path.dirname(source)), "*.h*")):
            text += read(header)
        shipped = [name for pattern, name in WORLDS if re.search(pattern, text)]
        return found[:2] + shipped[:1] + ["stage_simple", "cave"]

    def path_m(self, folder):
        """Metres that all robots have driven, by the report."""
        try:
            with open(os.path.join(folder, "report.json"), encoding="utf-8") as file:
                report = json.load(file)
        except (OSError, ValueError):
            return None
        return sum(robot.get("path_length", 0.0) for robot in report.get("robots", []))

    def program(self, source):
        arguments = self.arguments
        name = os.path.relpath(source, os.path.abspath(arguments.programs))
        place = os.path.join(self.out, "runs", re.sub(r"[^\w.+-]", "_", name))
        os.makedirs(place, exist_ok=True)
        record = {"program": name}
        for side in ("real", "playpen"):
            record[side] = self.compile(source, side, os.path.join(place, side))
        if "error" in record["playpen"]:
            return record
        folder = os.path.dirname(source)
        best = None
        for world in dict.fromkeys(self.worlds(source)):
            out = os.path.join(place, "run")
            shutil.rmtree(out, ignore_errors=True)
            code, output = run([self.playpen, "run", world, "--duration", str(arguments.seconds), "--out", out, "--",
                                os.path.join(place, "playpen")], arguments.timeout, folder)
            result = {"world": world if os.sep not in world else os.path.relpath(world, folder), "exit": code,
                      "path": self.path_m(out), "says": says(output)}
            if best is None or (result["path"] or 0.0) > (best["path"] or 0.0):
                best = result
            if (result["path"] or 0.0) >= 0.2:
                break
        record["run"] = best
        if "error" in record["real"] or (best["path"] or 0.0) < 0.2:
            return record
        out = os.path.join(place, "serve")
        shutil.rmtree(out, ignore_errors=True)
        script = ("ip link set lo up; %s serve %s --time real --clients 1 --duration %s --tcp-port 0 --player-port 6665 --out %s "
                  ">%s.log 2>&1 & server=$!; for i in $(seq 100); do grep -q 127.0.0.1:6665 %s.log && break; sleep 0.1; done; "
                  "timeout %s %s; wait $server" % (
                      shlex.quote(self.playpen), shlex.quote(world), arguments.seconds, shlex.quote(out), shlex.quote(out),
                      shlex.quote(out), arguments.seconds + 10, shlex.quote(os.path.join(place, "real"))))
        code, output = run(["unshare", "-n", "bash", "-c", script], arguments.timeout + arguments.seconds, folder)
        record["served"] = {"exit": code, "path": self.path_m(out), "says": says(output)}
        return record


def summary(records):
    count = collections.Counter()
    lines = []
    for record in records:
        count["programs"] += 1
        real, ours = "error" not in record["real"], "error" not in record["playpen"]
        count["compile with the real headers"] += real
        count["compile with Playpen"] += ours
        if ours:
            count["compile with Playpen and no option"] += record["playpen"]["options"] == ""
        if real and not ours:
            lines.append("compiles with the real headers only: %s: %s" % (record["program"], record["playpen"]["error"]))
        if ours and not real:
            count["compile with Playpen only"] += 1
        drives = (record.get("run", {}).get("path") or 0.0) >= 0.2
        count["drive with Playpen"] += drives
        if ours and not drives:
            lines.append("does not drive: %s in %s: %s" % (record["program"], record["run"]["world"],
                                                           record["run"]["says"]))
        served = record.get("served")
        if served:
            count["run with the real library"] += 1
            off = abs((served["path"] or 0.0) - record["run"]["path"])
            count["run with the real library, path within 0.5 m"] += off <= 0.5
            if off > 0.5:
                lines.append("differs: %s in %s: %.2f m here, %s with the real library" % (
                    record["program"], record["run"]["world"], record["run"]["path"], served["path"]))
    return ["%6d %s" % (value, key) for key, value in sorted(count.items())] + lines


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--prefix", required=True, help="as for build_peers.sh")
    parser.add_argument("--build", required=True, help="build folder of Playpen, with shared libraries")
    parser.add_argument("--programs", required=True, help="folder of programs")
    parser.add_argument("--out", required=True)
    parser.add_argument("--skip", default="", help="regular expression of paths to leave out")
    parser.add_argument("--only", default="", help="regular expression of paths to take")
    parser.add_argument("--seconds", type=float, default=20.0, help="simulated time of a run")
    parser.add_argument("--timeout", type=float, default=60.0, help="of a run [s]")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    arguments = parser.parse_args()
    os.makedirs(arguments.out, exist_ok=True)
    runner = Runner(arguments)
    sources = [path for path in programs_below(os.path.abspath(arguments.programs), arguments.skip)
               if re.search(arguments.only, path)]
    records = []
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool, open(
            os.path.join(arguments.out, "results.jsonl"), "w", encoding="utf-8") as file:
        for record in pool.map(runner.program, sources):
            records.append(record)
            file.write(json.dumps(record) + "\n")
            file.flush()
    text = "\n".join(summary(records)) + "\n"
    with open(os.path.join(arguments.out, "summary.txt"), "w", encoding="utf-8") as file:
        file.write(text)
    sys.stdout.write(text)


if __name__ == "__main__":
    main()
