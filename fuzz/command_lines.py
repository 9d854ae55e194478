#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Random command lines of the sanitizers' build of `kinefile`: every command and every option that its help
names, operations, odd numbers, files that are broken, missing, folders, or named twice. Whatever the words
are, the command ends within ten seconds with an exit code of its table (0 to 4) and says why if it is not 0;
what it writes can be read. The words come from a seed and a number: --only N runs one of them again."""

import argparse
import concurrent.futures
import csv
import io
import json
import os
import pathlib
import random
import re
import shutil
import subprocess
import sys
import tempfile
import time
import zipfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
FOLDERS = ["fuzz/seeds", "examples"]
NUMBERS = ["0", "1", "2", "3", "7", "-1", "0.5", "25", "29.97", "1e-9", "1e-300", "1e9", "1e18", "1e300", "-0",
           "nan", "inf", "-inf", "2147483648", "-9223372036854775809", "99999999999999999999", "", " ", "0x10",
           "1,5", "1e", "--", "3.5.7", "\u0663"]
TEXTS = ["", "a", "Hips", "HIP", "link0", "Left Leg", "root", "x", "ZYX", "XXX", "-", "..", "/", "a:b", ":", "0:2",
         "2:0", "::2", "0:3:0", "-1:", "0:1", "1:2,2:4", "root=add,others=replace", "upper,lower", "a,,b",
         "\udcff\udcfe", "\u202e", "\x1b[2J", "%s%n", "A" * 5000, "0-5+12", "0=1", "64=-32768", "utf-16le", "m"]
GOOD_OUTPUTS = ["out.bvh", "out.asf", "out.amc", "out.seq", "out.txt", "out.csv", "out.json", "out.npz", "out.pos"]
OUTPUTS = ["out.html", "out.yaml", "out", "-", "", ".", "folder", "folder/out.bvh", "none/out.bvh", "n" * 300 + ".bvh",
           "a\nb.bvh", "\udcff.seq", "positions.bvh", "bow.seq", "/dev/full", "out.amc/"]
GOOD_OPERATIONS = ["trim=0:2", "trim=1:", "reverse", "speed=0.3", "speed=7", "mirror", "mirror=x", "scale=2", "up=z",
                   "in-place", "loop=2,blend=1", "loop=3", "append=positions.bvh", "append=bow.seq", "joints=Hips",
                   "rename=Hips:a", "smooth=6", "unwrap", "zmp=global", "zmp=root", "offset=0:3", "insert=0,poses.txt",
                   "delete=1", "merge=poses.txt,0-1"]
MOTIONS = ["positions.bvh", "bones.amc", "bow.seq", "snake.seq", "joints.csv", "whole.csv", "own_times.csv", "flow.csv",
           "blocks.txt", "poses.txt", "wave.txt", "set.pos", "still.bvh"]
OPERATIONS = ["trim", "reverse", "speed", "mirror", "scale", "up", "in-place", "loop", "append", "joints", "rename",
              "smooth", "unwrap", "zmp", "offset", "merge", "insert", "delete", "unheard"]
# A picture needs a browser, which is not what is tested.
LEFT_OUT = {"--help", "--version", "--png", "--out"}
SANITIZERS = {"ASAN_OPTIONS": "exitcode=99:detect_leaks=1:allocator_may_return_null=1",
              "UBSAN_OPTIONS": "exitcode=99:print_stacktrace=1", "NO_COLOR": "1"}
options = None


def run(words, folder, seconds=10):
    """Ends the command when it is late; stdin is a motion."""
    with open(folder / "positions.bvh", "rb") as stdin:
        return subprocess.run([options.kinefile, *words], cwd=folder, env={**os.environ, **SANITIZERS}, stdin=stdin,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=seconds)


def options_of_commands():
    """The options of each command with the words that they take, as its help says them."""
    found = {}
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "positions.bvh").touch()
        listed = run(["--help"], folder).stdout.decode()
        for command in re.findall(r"^  ([a-z-]+) {2,}", listed.partition("Subcommands:")[2], re.M):
            text = run([command, "--help"], folder).stdout.decode()
            lines = re.findall(r"^  (?:-\w,)?(--[\w-]+)(?: (\S+))?", text, re.M)
            found[command] = [(word, "" if kind in ("Needs:", "Excludes:") else kind) for word, kind in lines
                              if word not in LEFT_OUT]
    return found


def make_folder(folder):
    for source in FOLDERS:
        for path in sorted((ROOT / source).iterdir()):
            if path.suffix not in (".cpp", ".hpp", ".txt") or path.parent.name == "seeds" or path.name == "wave.txt":
                shutil.copyfile(path, folder / path.name)
    (folder / "empty.bvh").touch()
    (folder / "noise.seq").write_bytes(random.Random(1).randbytes(2000))
    (folder / "cut.bvh").write_bytes((folder / "positions.bvh").read_bytes()[:-20])
    (folder / "folder").mkdir()
    (folder / "map.yaml").write_text("HIP: a\nKNEE: b\n")


class Words:
    """The words of one command line."""

    def __init__(self, number, files, commands):
        self.random = random.Random(f"{options.seed} {number}")
        self.files, self.commands = files, commands

    def number(self):
        if self.random.random() < 0.3:
            return f"{self.random.gauss(0, 10 ** self.random.randint(-3, 6)):.6g}"
        return self.random.choice(NUMBERS)

    def file(self):
        if self.random.random() < 0.1:
            return self.random.choice(["missing.bvh", "folder", "-", "", "none/a.bvh", "/dev/null", "set", "n" * 300])
        return self.random.choice(MOTIONS if self.random.random() < 0.8 else self.files)

    def output(self):
        return self.random.choice(GOOD_OUTPUTS if self.random.random() < 0.8 else OUTPUTS)

    def value(self, option, kind):
        """What stands behind an option: mostly what it expects."""
        of_set = re.search(r"\{(.*)\}", kind)
        sure = self.random.random() < 0.8
        if option == "--out-dir":  # never outside of the folder
            return self.random.choice(["many", "many", "many/deep", "folder", ".", "", "positions.bvh", "a\nb"])
        if sure and of_set:
            return self.random.choice(of_set[1].split(","))
        if sure and "|" in kind:
            return self.random.choice(kind.split("|"))
        if sure and option == "--positions":
            return self.random.choice(["replace", "add", "auto", "root=add,others=replace"])
        if sure and option in ("--skeleton", "--project", "--servo-map", "--map", "--inputs", "--robot"):
            return self.random.choice(["robot.body", "leg.urdf", "leg.body", "bones.asf", "robot.rpj", "servos.yaml",
                                       "map.yaml", self.file()])
        if sure and kind.split(":")[0] in ("RATE", "N", "X", "UNITS", "SECONDS", "DEGREES", "FRAMES"):
            return self.random.choice(["0", "1", "2", "3", "25", "0.5"])
        return self.random.choice([self.number, self.text])()

    def text(self):
        return self.random.choice(TEXTS)

    def operation(self):
        if self.random.random() < 0.6:
            return self.random.choice(GOOD_OPERATIONS)
        name = self.random.choice(OPERATIONS)
        if self.random.random() < 0.2:
            return name
        parts = [self.random.choice([self.number, self.number, self.text, self.file])()
                 for _ in range(self.random.randint(1, 3))]
        word = name + "=" + self.random.choice(":,").join(parts)
        return word + self.random.choice(["", "", ",blend=" + self.number()])

    def positionals(self, command):
        if command == "convert":
            return [self.file(), self.output()]
        count = {"diff": 2, "align": 2, "formats": 0}.get(command, 1)
        words = [self.file() for _ in range(count)]
        if self.random.random() < 0.1:
            words.append(self.random.choice([words[0] if words else "a", self.file()]))
        if command == "edit":
            words += [self.operation() for _ in range(self.random.randint(1, 3))]
        return words

    def some_options(self, command):
        known = self.commands[command]
        return self.random.sample(known, k=min(len(known), self.random.choice([0, 0, 0, 1, 1, 2, 3])))

    def all(self):
        command = self.random.choice([*self.commands, *["convert", "edit"] * 6])
        words = self.positionals(command)
        for option, kind in self.some_options(command):
            words += [option] + ([self.value(option, kind)] if kind else [])
        if command in ("edit", "warp", "align", "resample", "keyframe", "run", "fk", "view", "servo-map") and (
                "--out-dir" not in words or self.random.random() < 0.1):
            words += ["-o", self.output()]
        if "--out-dir" in words:
            words += [self.random.choice(["folder", ".", self.file()])] if self.random.random() < 0.5 else []
            words += ["--to", self.random.choice(["bvh", "amc", "csv", "json", "npz"])] if "--to" not in words else []
        if "--skeleton" not in words and command != "servo-map" and self.random.random() < 0.2:
            words += ["--skeleton", self.random.choice(["robot.body", "leg.urdf", "bones.asf"])]
        if command == "keyframe":
            for option, value in (("--servo-map", "servos.yaml"), ("--skeleton", "robot.body"), ("--tolerance", "2")):
                words += [] if option in words else [option, value]
        if command == "resample" and "--fps" not in words:
            words += ["--fps", self.random.choice(["25", self.number()])]
        if command == "warp":
            words += ["--key", self.random.choice(["1:2", "0:0.5", "0:0,1:3,2:4", self.text()])]
        return [command, *(word.replace("\0", "") for word in words)]


def fault_of_table(text):
    rows = list(csv.reader(io.StringIO(text)))
    return len({len(row) for row in rows}) > 1 and "rows of different length"


def fault_of_file(path, folder, words):
    """What is wrong with a file that was written; nothing if it can be read."""
    data = path.read_bytes()
    name = str(path.relative_to(folder))
    asked = words[words.index("--to") + 1] if "--to" in words else ""
    if path.suffix == ".html":
        return b"</html>" not in data and "a page without an end"
    if asked == "json" or (not asked and path.suffix == ".json"):
        json.loads(data)
        return None
    if asked == "csv" or (not asked and path.suffix == ".csv"):
        return fault_of_table(data.decode())
    if asked == "npz" or (not asked and path.suffix == ".npz"):
        with zipfile.ZipFile(path) as archive:
            return archive.testzip()
    if path.suffix in (".yaml", ".dot") and not data.startswith((b"type:", b"{")):
        return None  # a servo map
    if path.suffix == ".txt" and b"_\0M\0" not in data and b"_MOTION_FORMAT" not in data:
        return None  # what was printed, in a file of this name
    given = [word for word in ("--lenient",) if word in words]
    if asked and not (asked == "amc" and path.suffix == ".asf"):
        given += ["--from", asked]
    done = run(["info", *given, "--", name], folder)
    return done.returncode != 0 and done.stderr.decode(errors="replace")


class Counts:
    num_lines = num_written = num_read_back = 0
    codes = {}
    faults = []


def run_one(number, files, commands):
    words = Words(number, files, commands).all()
    with tempfile.TemporaryDirectory(prefix="kinefile-lines.") as name:
        folder = pathlib.Path(name)
        make_folder(folder)
        before = {path: path.stat().st_mtime_ns for path in folder.rglob("*") if path.is_file()}
        try:
            done = run([os.fsencode(word) for word in words], folder)
            fault = fault_of_run(done)
        except subprocess.TimeoutExpired:
            return number, words, None, 0, ["more than ten seconds"]
        after = [path for path in folder.rglob("*") if path.is_file() and path.name != ".kinefile-status" and
                 path.stat().st_mtime_ns != before.get(path)]
        faults = [fault] if fault else []
        for path in after:
            if ".part" in path.name:
                faults.append(f"a temporary file stays: {path.name}")
            elif wrong := fault_of_file(path, folder, words):
                faults.append(f"{path.name!r} is written and not read: {wrong}")
        return number, words, done.returncode, len(after), faults


def fault_of_run(done):
    said = done.stderr.decode(errors="replace")
    if "Sanitizer" in said or "runtime error:" in said:
        return said
    if done.returncode not in range(6):
        return f"exit code {done.returncode}: {said}"
    return done.returncode > 1 and not said and "no word of what is wrong"


def main():
    global options
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--kinefile", required=True)
    parser.add_argument("--seed", default="1")
    parser.add_argument("--seconds", type=float, default=8)
    parser.add_argument("--only", type=int)
    parser.add_argument("--jobs", type=int, default=2)
    options = parser.parse_args()
    options.kinefile = str(pathlib.Path(options.kinefile).resolve())
    commands = options_of_commands()
    with tempfile.TemporaryDirectory() as name:
        make_folder(pathlib.Path(name))
        files = sorted(path.name for path in pathlib.Path(name).iterdir())
    numbers = [options.only] if options.only is not None else range(10 ** 9)
    end = time.monotonic() + options.seconds
    counts = Counts()
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        waiting, numbers = set(), iter(numbers)
        while True:
            while len(waiting) < options.jobs and (time.monotonic() < end or options.only is not None):
                number = next(numbers, None)
                if number is None:
                    break
                waiting.add(pool.submit(run_one, number, files, commands))
            if not waiting:
                break
            done, waiting = concurrent.futures.wait(waiting, return_when=concurrent.futures.FIRST_COMPLETED)
            for future in done:
                count(counts, *future.result())
    codes = ", ".join(f"{code}: {number}" for code, number in sorted(counts.codes.items()))
    print(f"command lines: {counts.num_lines} (exit codes {codes}), {counts.num_written} files written and read, "
          f"{len(counts.faults)} faults")
    sys.exit(1 if counts.faults else 0)


def count(counts, number, words, code, num_written, faults):
    counts.num_lines += 1
    counts.num_written += num_written
    counts.codes[str(code)] = counts.codes.get(str(code), 0) + 1
    for fault in faults:
        counts.faults.append(fault)
        print(f"--only {number} --seed {options.seed}: {words}\n{fault}", flush=True)
    if options.only is not None:
        print(words, code)


main()
