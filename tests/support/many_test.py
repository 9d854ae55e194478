#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tests commands on many files (--out-dir): the same bytes whatever the number of threads, runs that
are killed or interrupted and go on with --resume, memory that does not grow with the number of files,
and the bar on a terminal."""

import argparse
import json
import os
import pathlib
import pty
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest

NUM_FILES = 60
STATUS = ".kinefile-status"
bin_folder = None
is_sanitized = False


def tree(folder):
    """The files of a folder and their bytes, by relative path."""
    return {str(path.relative_to(folder)): path.read_bytes()
            for path in sorted(folder.rglob("*")) if path.is_file()}


def outputs(folder):
    """Without what is the command's own."""
    return {name: data for name, data in tree(folder).items()
            if not pathlib.Path(name).name.startswith(".kinefile-")}


class Many(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="kinefile-many."))
        cls.inputs = cls.folder / "in"
        for i in range(NUM_FILES):
            place = cls.inputs / f"take{i % 3}"
            place.mkdir(parents=True, exist_ok=True)
            subprocess.run([bin_folder / "make_walk", place / f"walk{i}.bvh", str(100 + 7 * i), "30"],
                           check=True)
        (cls.inputs / "take1" / "broken.bvh").write_text("HIERARCHY\nROOT\n")
        cls.plain = cls.folder / "plain"
        cls.words = ["convert", "in", "--recursive", "--to", "amc", "--quiet"]
        cls.run_command(cls, [*cls.words, "--out-dir", "plain", "--jobs", "1"])
        cls.expected = outputs(cls.plain)

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def run_command(self, words, **options):
        return subprocess.run([bin_folder / "kinefile", *map(str, words)], cwd=self.folder,
                              capture_output=True, text=True, **options)

    def start(self, words):
        return subprocess.Popen([bin_folder / "kinefile", *map(str, words)], cwd=self.folder,
                                stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    def new_folder(self):
        return pathlib.Path(tempfile.mkdtemp(dir=self.folder))

    def test_bytes_and_messages_do_not_depend_on_the_number_of_jobs(self):
        self.assertEqual(len(self.expected), 2 * NUM_FILES)
        said, statuses = set(), set()
        for jobs in (1, 2, 7):
            out = self.new_folder()
            done = self.run_command([w for w in self.words if w != "--quiet"] +
                                    ["--out-dir", out, "--jobs", jobs])
            self.assertEqual(done.returncode, 5, done.stderr)
            self.assertEqual(outputs(out), self.expected)
            said.add(done.stderr.replace(str(out), "OUT"))
            statuses.add((out / STATUS).read_text())
        self.assertEqual(len(said), 1)
        self.assertEqual(len(statuses), 1)

    def test_a_killed_run_leaves_whole_files_and_goes_on(self):
        random.seed(7)
        began = time.monotonic()
        self.run_command([*self.words, "--out-dir", self.new_folder(), "--jobs", "2"])
        whole = time.monotonic() - began
        for force in ([], ["--force"]):
            out = self.new_folder()
            for _ in range(4):
                running = self.start([*self.words, "--out-dir", out, "--jobs", "2", "--resume", *force])
                time.sleep(random.uniform(0.1, 0.7) * whole)
                running.kill()
                running.wait()
                for name, data in outputs(out).items():
                    self.assertEqual(data, self.expected[name], name)
            done = self.run_command([*self.words, "--out-dir", out, "--resume", "--json"])
            self.assertEqual(done.returncode, 5, done.stderr)
            self.assertEqual(outputs(out), self.expected)
            self.assertEqual(set(tree(out)), {*self.expected, STATUS})
            told = json.loads(done.stdout)
            self.assertEqual(told["written"] + told["up_to_date"], NUM_FILES)
            self.assertEqual(told["failed"], 1)

    def test_an_interrupted_run_leaves_nothing_temporary_and_goes_on(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            out = self.new_folder()
            running = self.start([*self.words, "--out-dir", out, "--jobs", "2"])
            while len(outputs(out)) < 10 and running.poll() is None:
                time.sleep(0.002)
            running.send_signal(number)
            self.assertEqual(running.wait(timeout=60), -number)
            left = outputs(out)
            self.assertLess(len(left), 2 * NUM_FILES)
            self.assertEqual([n for n in tree(out) if n not in left], [STATUS])
            for name, data in left.items():
                self.assertEqual(data, self.expected[name], name)
            done = self.run_command([*self.words, "--out-dir", out, "--resume"])
            self.assertEqual(done.returncode, 5, done.stderr)
            self.assertEqual(outputs(out), self.expected)

    def test_what_changed_is_made_again(self):
        out = self.new_folder()
        inputs = self.folder / "changing"
        shutil.copytree(self.inputs / "take0", inputs)
        words = ["convert", "changing", "--to", "amc", "--out-dir", out, "--resume", "--json", "-q"]

        def written(extra=(), code=0):
            done = self.run_command([*words, *extra])
            self.assertEqual(done.returncode, code, done.stderr)
            return [pathlib.Path(line["file"]).name for line in json.loads(done.stdout)["files"]
                    if line["result"] == "written"]

        self.assertEqual(len(written()), NUM_FILES // 3)
        self.assertEqual(written(), [])
        # Another time, or another content of the same size and time.
        os.utime(inputs / "walk0.bvh", (1, 1))
        self.assertEqual(written(), ["walk0.bvh"])
        state = os.stat(inputs / "walk3.bvh")
        text = (inputs / "walk3.bvh").read_text()
        (inputs / "walk3.bvh").write_text(text.replace("Head", "Haed"))
        os.utime(inputs / "walk3.bvh", ns=(state.st_atime_ns, state.st_mtime_ns))
        self.assertEqual(written(), ["walk3.bvh"])
        # An output that is gone is made again; one that somebody changed is not replaced.
        (out / "walk6.asf").unlink()
        self.assertEqual(written(), ["walk6.bvh"])
        (out / "walk9.amc").write_text("mine")
        self.assertEqual(written(code=5), [])
        self.assertEqual((out / "walk9.amc").read_text(), "mine")
        self.assertEqual(written(["--force"]), ["walk9.bvh"])
        # Other options, and a companion that changed.
        self.assertEqual(len(written(["--decimals", "3"])), NUM_FILES // 3)
        back = ["edit", out, "scale=2", "--out-dir", self.folder / "back", "--resume", "--json", "-q"]
        self.assertEqual(json.loads(self.run_command(back).stdout)["written"], NUM_FILES // 3)
        self.assertEqual(json.loads(self.run_command(back).stdout)["written"], 0)
        (out / "walk0.asf").write_text((out / "walk0.asf").read_text() + "# changed\n")
        self.assertEqual(json.loads(self.run_command(back).stdout)["written"], 1)

    def test_names_may_have_any_bytes(self):
        place = os.fsencode(self.folder) + b"/odd"
        os.mkdir(place)
        for name in (b"tab\there.bvh", b"line\nend.bvh", b"back\\slash.bvh", b"\x93\xfa.bvh"):
            shutil.copy(self.inputs / "take0" / "walk0.bvh", os.path.join(place, name))
        words = ["convert", "odd", "--to", "csv", "--out-dir", "odd_out", "--resume", "--json"]
        counts = [json.loads(self.run_command(words).stdout)["written"] for _ in range(2)]
        self.assertEqual(counts, [4, 0])
        self.assertEqual(len(os.listdir(self.folder / "odd_out")), 5)

    def test_memory_does_not_grow_with_the_number_of_files(self):
        if is_sanitized:
            self.skipTest("a sanitizer keeps what is freed")
        source = self.folder / "small.bvh"
        subprocess.run([bin_folder / "make_walk", source, "60", "30"], check=True)
        for i in range(1000):
            for count in (100, 1000):
                if i < count:
                    (self.folder / f"small{count}").mkdir(exist_ok=True)
                    os.link(source, self.folder / f"small{count}" / f"{i}.bvh")

        def peak(count):
            process = self.start(["convert", f"small{count}", "--to", "csv", "--jobs", "4", "-q",
                                  "--out-dir", self.new_folder()])
            _, status, usage = os.wait4(process.pid, 0)
            process.returncode = os.waitstatus_to_exitcode(status)
            self.assertEqual(process.returncode, 0)
            return usage.ru_maxrss
        few, many = peak(100), peak(1000)
        self.assertLess(many, few + 4096, f"kB: {few} for 100 files, {many} for 1000")

    def test_a_bar_is_on_a_terminal_alone(self):
        os.mkfifo(self.folder / "slow.bvh")
        text = (self.inputs / "take0" / "walk0.bvh").read_text()

        def write_late():
            time.sleep(1.3)
            (self.folder / "slow.bvh").write_text(text)

        words = ["convert", "slow.bvh", "in/take0", "--to", "csv"]
        for has_terminal in (True, False):
            writer = threading.Thread(target=write_late)
            writer.start()
            ours, theirs = pty.openpty() if has_terminal else os.pipe()
            running = subprocess.Popen([bin_folder / "kinefile", *words, "--out-dir", self.new_folder()],
                                       cwd=self.folder, stderr=theirs)
            os.close(theirs)
            said = b""
            try:
                while piece := os.read(ours, 4096):
                    said += piece
            except OSError:  # the other end of a terminal is closed
                pass
            os.close(ours)
            writer.join()
            self.assertEqual(running.wait(), 0, said)
            self.assertEqual(b"of 21 files" in said, has_terminal, said)
            self.assertEqual(b"\x1b[K" in said, has_terminal, said)
            self.assertIn(b"21 files: 21 written, 0 up to date, 0 failed", said)


def main():
    global bin_folder, is_sanitized
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--bin", required=True)
    parser.add_argument("--sanitized", action="store_true")
    options, rest = parser.parse_known_args()
    bin_folder = pathlib.Path(options.bin).resolve()
    is_sanitized = options.sanitized
    unittest.main(argv=[sys.argv[0], *rest])


main()
