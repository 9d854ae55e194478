#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""What `kinefile` leaves behind when the machine fails: calls of the system that fail one by one
(inject.cpp), signals at any moment, files that change while they are read, limits of size and memory,
streams that are closed, full or slow. Whatever happens, the files that a command writes are all new or
all old, nothing temporary stays, no signal kills that was not sent, and the exit code tells.

The moments of signals come from a seed. --seconds S goes on with other seeds for that long."""

import argparse
import errno
import os
import pathlib
import random
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
EXAMPLES = ROOT / "examples"
options = None

BVH = """HIERARCHY
ROOT Hips
{
  OFFSET 0 0 0
  CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
  JOINT Chest
  {
    OFFSET 0 10 0
    CHANNELS 3 Zrotation Xrotation Yrotation
    End Site
    {
      OFFSET 0 10 0
    }
  }
}
MOTION
Frames: %d
Frame Time: 0.01
"""


def bvh(num_frames):
    rows = (f"{i % 7} 90.5 {i % 11} 1 {i % 13} 3 4 {i % 17} 6\n" for i in range(num_frames))
    return BVH % num_frames + "".join(rows)


class Job:
    """A command with files to write, and what these were before."""

    def __init__(self, name, words, outputs, has_old):
        self.name, self.words, self.outputs, self.has_old = name, words, outputs, has_old


JOBS = [
    Job("file", ["convert", "walk.bvh", "out.csv"], ["out.csv"], False),
    Job("file over old", ["convert", "walk.bvh", "out.csv", "--force"], ["out.csv"], True),
    Job("pair", ["convert", "walk.bvh", "out.amc"], ["out.asf", "out.amc"], False),
    Job("pair over old", ["convert", "walk.bvh", "out.amc", "--force"], ["out.asf", "out.amc"], True),
    Job("pair, half old", ["convert", "walk.bvh", "out.amc", "--force"], ["out.asf", "out.amc"], "amc"),
    Job("set", ["convert", "bow.seq", "h", "--to", "hrpsys"], ["h.pos", "h.waist", "h.hip"], False),
    Job("set over old", ["convert", "bow.seq", "h", "--to", "hrpsys", "--force"],
        ["h.pos", "h.waist", "h.hip"], True),
    Job("large", ["fk", "large.bvh", "-o", "out.csv", "--frames", "0:9"], ["out.csv"], False),
]
CALLS = ["open", "read", "pread", "write", "fsync", "rename", "link", "linkat", "close", "flock", "fchmod",
         "fchown", "fstat", "stat", "lstat"]
FAULTS = {"EIO": errno.EIO, "ENOSPC": errno.ENOSPC, "EINTR": errno.EINTR, "EAGAIN": errno.EAGAIN,
          "EPERM": errno.EPERM, "short": "short"}
# These are no faults: what was begun is done again, or goes on.
HARMLESS = {("open", "EINTR"), ("read", "EINTR"), ("write", "EINTR"), ("fsync", "EINTR"),
            ("write", "short"), ("read", "short"), ("pread", "EIO"), ("pread", "EINTR"),
            ("pread", "short"), ("close", "EIO"), ("close", "ENOSPC"),
            ("close", "EINTR"), ("flock", "EIO"), ("fchmod", "EPERM"), ("fchown", "EPERM")}


def faults_of(call):
    if call in ("read", "pread", "write"):
        return ["EIO", "ENOSPC", "EINTR", "short"]
    if call in ("link", "linkat", "fchmod", "fchown"):
        return ["EIO", "EPERM"]
    if call in ("open", "fsync", "close"):
        return ["EIO", "ENOSPC", "EINTR"]
    return ["EIO"]


class Folder(unittest.TestCase):
    """A folder with the inputs, for each test."""

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="kinefile-faults."))
        self.addCleanup(shutil.rmtree, self.folder)
        (self.folder / "walk.bvh").write_text(bvh(20))
        # Large enough to be read piece by piece.
        (self.folder / "large.bvh").write_text(bvh(45_000))
        shutil.copy(EXAMPLES / "bow.seq", self.folder)
        self.inputs = {"walk.bvh", "large.bvh", "bow.seq"}

    def run_command(self, words, env=None, **more):
        more = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, **more}
        return subprocess.run([options.kinefile, *words], cwd=self.folder, timeout=60,
                              env={**os.environ, **(env or {})}, **more)

    def others(self, outputs=()):
        """The files that should not be there."""
        return sorted({path.name for path in self.folder.iterdir()} - self.inputs - set(outputs))

    def put_old(self, job):
        for name in job.outputs:
            path = self.folder / name
            path.unlink(missing_ok=True)
            if job.has_old is True or (job.has_old and name.endswith(job.has_old)):
                path.write_text(f"old {name}")

    def state(self, job):
        return {name: (self.folder / name).read_bytes() if (self.folder / name).exists() else None
                for name in job.outputs}


class InjectedFaults(Folder):
    def check_run(self, job, call, number, fault, env, new):
        self.put_old(job)
        old = self.state(job)
        log = self.folder.parent / (self.folder.name + ".log")
        log.unlink(missing_ok=True)
        plan = f"{call}:{number}:{FAULTS[fault]}"
        done = self.run_command(job.words, {"LD_PRELOAD": options.inject, "KINEFILE_FAULT": plan,
                                            "KINEFILE_FAULT_LOG": str(log), **env})
        has_happened = log.exists()
        log.unlink(missing_ok=True)
        what = f"{job.name}, {plan} {fault} {env}: {done.returncode}, {done.stderr.decode()}"
        self.assertIn(done.returncode, (0, 3), what)
        if has_happened and (call, fault) in HARMLESS:
            self.assertEqual(done.returncode, 0, what)
        if done.returncode == 3:
            self.assertRegex(done.stderr.decode(), r"error\[IO00\d\]", what)
        self.assertEqual(self.state(job), new if done.returncode == 0 else old, what)
        self.assertEqual(self.others(job.outputs), [], what)
        return has_happened

    def test_each_call_that_fails_leaves_all_new_or_all_old(self):
        num_runs = 0
        for job in JOBS:
            self.put_old(job)
            done = self.run_command(job.words)
            self.assertEqual(done.returncode, 0, done.stderr)
            new = self.state(job)
            self.assertEqual([name for name, bytes_ in new.items() if bytes_ is None], [])
            for env in ({}, {"KINEFILE_NO_TMPFILE": "1"}):
                for call in CALLS:
                    for fault in faults_of(call):
                        number = 1
                        while self.check_run(job, call, number, fault, env, new):
                            number += 1
                        num_runs += number
            for name in job.outputs:
                (self.folder / name).unlink(missing_ok=True)
        print(f"{num_runs} runs with a call that failed")

    def test_where_there_are_no_links_files_are_written_all_the_same(self):
        for job in JOBS:
            self.put_old(job)
            done = self.run_command(job.words)
            new = self.state(job)
            self.put_old(job)
            done = self.run_command(job.words, {
                "LD_PRELOAD": options.inject, "KINEFILE_NO_TMPFILE": "1",
                "KINEFILE_FAULT": f"link:-1:{errno.EPERM}"})
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(self.state(job), new)
            self.assertEqual(self.others(job.outputs), [])
            for name in job.outputs:
                (self.folder / name).unlink()

    def test_a_file_that_cannot_be_put_back_is_told(self):
        job = JOBS[3]
        self.put_old(job)
        done = self.run_command(job.words, {"LD_PRELOAD": options.inject,
                                            "KINEFILE_FAULT": f"rename:-2:{errno.EIO}"})
        self.assertEqual(done.returncode, 3)
        self.assertIn(b"new, and could not be put back: 'out.asf'", done.stderr)
        self.assertEqual(self.others(job.outputs), [])


class Killed(Folder):
    """Signals at moments that a seed gives."""

    def setUp(self):
        super().setUp()
        (self.folder / "long.bvh").write_text(bvh(40_000))
        self.inputs.add("long.bvh")

    def seconds_of(self, words):
        started = time.monotonic()
        self.assertEqual(self.run_command(words).returncode, 0)
        return time.monotonic() - started

    def kill_at(self, words, moment, number, env):
        process = subprocess.Popen([options.kinefile, *words], cwd=self.folder,
                                   env={**os.environ, **env}, stderr=subprocess.PIPE)
        time.sleep(moment)
        process.send_signal(number)
        process.communicate(timeout=60)
        return process.returncode

    def test_a_signal_leaves_no_temporary_file(self):
        job = Job("pair", ["convert", "long.bvh", "out.amc", "--force"], ["out.asf", "out.amc"], True)
        self.put_old(job)
        whole = self.seconds_of(job.words)
        new = self.state(job)
        rng = random.Random(options.seed)
        for i in range(options.num_signals):
            number = rng.choice([signal.SIGTERM, signal.SIGINT, signal.SIGHUP])
            env = rng.choice([{}, {"LD_PRELOAD": options.inject, "KINEFILE_NO_TMPFILE": "1"}])
            self.put_old(job)
            old = self.state(job)
            code = self.kill_at(job.words, rng.uniform(0, whole), number, env)
            what = f"seed {options.seed}, run {i}: {number}, {code}, {env}"
            self.assertIn(code, (0, -number), what)
            self.assertIn(self.state(job), (old, new), what)
            self.assertEqual(self.others(job.outputs), [], what)

    def start_writing(self, words):
        """Starts a command that has a temporary file by its name, and waits until it has."""
        env = {**os.environ, "LD_PRELOAD": options.inject, "KINEFILE_NO_TMPFILE": "1"}
        process = subprocess.Popen([options.kinefile, *words], cwd=self.folder, env=env)
        while not self.others(["out.csv"]):
            self.assertIsNone(process.poll(), "it ended before it was seen to write")
        return process

    def test_the_next_run_removes_what_a_killed_one_left(self):
        words = ["convert", "long.bvh", "out.csv", "--force"]
        num_left = 0
        for _ in range(max(4, options.num_signals // 10)):
            process = self.start_writing(words)
            process.kill()
            process.wait()
            num_left += len(self.others(["out.csv"]))
            self.assertEqual(self.run_command(words).returncode, 0)
            self.assertEqual(self.others(["out.csv"]), [])
        self.assertGreater(num_left, 0, "no run was killed while it had a temporary file")

    def test_the_file_of_a_neighbour_that_lives_is_not_touched(self):
        words = ["convert", "long.bvh", "out.csv", "--force"]
        neighbour = self.start_writing(words)
        neighbour.send_signal(signal.SIGSTOP)
        theirs = self.others(["out.csv"])
        self.assertEqual(self.run_command(words).returncode, 0)
        self.assertEqual(self.others(["out.csv"]), theirs)
        neighbour.send_signal(signal.SIGCONT)
        self.assertEqual(neighbour.wait(), 0)
        self.assertEqual(self.others(["out.csv"]), [])

    def test_a_file_that_changes_while_it_is_read_is_an_error(self):
        # Some megabytes, each read in one call that is slow: most moments are within one. UTF-8 would
        # be read by pieces, and again as a whole when it has changed.
        (self.folder / "long.bvh").write_text(bvh(100_000), encoding="utf-16")
        slow = {**os.environ, "LD_PRELOAD": options.inject, "KINEFILE_FAULT": "read:-1:slow"}
        size = (self.folder / "long.bvh").stat().st_size
        rng = random.Random(options.seed)
        num_told = 0
        for i in range(options.num_truncations):
            shutil.copy(self.folder / "long.bvh", self.folder / "taken.bvh")
            process = subprocess.Popen([options.kinefile, "info", "taken.bvh"], cwd=self.folder,
                                       env=slow, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
            time.sleep(rng.uniform(0, 0.2))
            os.truncate(self.folder / "taken.bvh", rng.randrange(size))
            told = process.communicate(timeout=60)[1]
            # 1: it was truncated before it was opened, and ends in a row.
            self.assertIn(process.returncode, (0, 1, 3), f"seed {options.seed}, run {i}: {told}")
            if process.returncode == 3:
                self.assertIn(b"the file changed while it was read", told)
                num_told += 1
        self.assertGreater(num_told, 0)
        print(f"{options.num_truncations} truncations, {num_told} while the file was read")


class Limits(Folder):
    def setUp(self):
        super().setUp()
        (self.folder / "long.bvh").write_text(bvh(20_000))
        self.inputs.add("long.bvh")

    def limited(self, words, limit, size):
        return self.run_command(words, preexec_fn=lambda: resource.setrlimit(limit, (size, size)))

    def test_a_file_that_may_not_grow_is_an_error(self):
        for words in (["convert", "long.bvh", "out.csv"], ["convert", "long.bvh", "out.amc"]):
            for size in (0, 1000, 100_000):
                done = self.limited(words, resource.RLIMIT_FSIZE, size)
                self.assertEqual(done.returncode, 3, done.stderr)
                self.assertIn(b"error[IO003]: cannot write: File too large", done.stderr)
                self.assertEqual(self.others(), [])

    def test_memory_that_ends_is_an_error(self):
        for megabytes in (30, 40, 50, 60, 80, 100):
            done = self.limited(["convert", "long.bvh", "out.csv", "--force"], resource.RLIMIT_AS,
                                megabytes << 20)
            # 127: the program's loader itself has too little
            self.assertIn(done.returncode, (0, 3, 127), done.stderr)
            self.assertEqual(self.others(["out.csv"]), [])

    def test_names_may_be_as_long_as_the_system_allows(self):
        for length in (200, 244, 250, 255):
            name = "a" * (length - 4) + ".csv"
            for env in ({}, {"LD_PRELOAD": options.inject, "KINEFILE_NO_TMPFILE": "1"}):
                for _ in range(2):  # new, and over the old one
                    done = self.run_command(["convert", "walk.bvh", name, "--force"], env)
                    self.assertEqual(done.returncode, 0, done.stderr)
                    self.assertEqual(self.others([name]), [])
                (self.folder / name).unlink()

    def test_a_link_that_leads_nowhere_yet_stays_a_link(self):
        (self.folder / "link.csv").symlink_to("target.csv")
        done = self.run_command(["convert", "walk.bvh", "link.csv", "--force"])
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertTrue((self.folder / "link.csv").is_symlink())
        self.assertIn(b"Hips", (self.folder / "target.csv").read_bytes())

    def test_owner_and_rights_stay_where_they_can(self):
        out = self.folder / "out.csv"
        out.write_text("old")
        out.chmod(0o640)
        is_root = os.geteuid() == 0
        if is_root:
            os.chown(out, 1234, 2345)
        self.assertEqual(
            self.run_command(["convert", "walk.bvh", "out.csv", "--force"]).returncode, 0)
        self.assertEqual(out.stat().st_mode & 0o777, 0o640)
        if is_root:
            self.assertEqual((out.stat().st_uid, out.stat().st_gid), (1234, 2345))

    def test_other_names_of_a_replaced_file_keep_the_old_content(self):
        out = self.folder / "out.csv"
        out.write_text("old")
        os.link(out, self.folder / "other.csv")
        self.assertEqual(
            self.run_command(["convert", "walk.bvh", "out.csv", "--force"]).returncode, 0)
        self.assertEqual((self.folder / "other.csv").read_text(), "old")


class Streams(Folder):
    WORDS = [["convert", "walk.bvh", "-", "--to", "csv"], ["info", "walk.bvh"], ["--version"],
             ["--help"], ["fk", "walk.bvh"], ["formats"], ["check", "walk.bvh", "--json"],
             ["edit", "--help"], ["--generate", "man"]]

    def test_output_that_does_not_arrive_is_an_error(self):
        for words in self.WORDS:
            with open("/dev/full", "wb") as full:
                done = self.run_command(words, stdout=full)
            self.assertEqual(done.returncode, 3, words)
            self.assertIn(b"error[IO003]: cannot write: No space left on device", done.stderr)
            closed = self.run_command(words, preexec_fn=lambda: os.close(1), stdout=None)
            self.assertEqual(closed.returncode, 3, words)
            self.assertIn(b"error[IO003]: cannot write: Bad file descriptor", closed.stderr)

    def test_closed_streams_never_become_files(self):
        words = ["convert", "walk.bvh", "out.csv", "--force"]
        self.assertEqual(self.run_command(words).returncode, 0)
        right = (self.folder / "out.csv").read_bytes()
        for closed in ([0], [1], [2], [0, 1], [0, 2], [1, 2], [0, 1, 2]):
            done = self.run_command(words, stdin=None, stdout=None, stderr=None,
                                    preexec_fn=lambda: [os.close(stream) for stream in closed])
            self.assertEqual(done.returncode, 0, closed)
            self.assertEqual((self.folder / "out.csv").read_bytes(), right)

    def test_a_slow_reader_that_does_not_block_gets_everything(self):
        (self.folder / "long.bvh").write_text(bvh(20_000))
        for words in (["convert", "long.bvh", "-", "--to", "csv"], ["fk", "long.bvh"]):
            right = self.run_command(words).stdout
            reading, writing = os.pipe()
            os.set_blocking(writing, False)
            process = subprocess.Popen([options.kinefile, *words], cwd=self.folder, stdout=writing)
            os.close(writing)
            time.sleep(0.3)
            with os.fdopen(reading, "rb") as stream:
                self.assertEqual(stream.read(), right)
            self.assertEqual(process.wait(), 0)

    def test_a_slow_writer_that_does_not_block_is_read_to_the_end(self):
        text = (self.folder / "walk.bvh").read_bytes()
        right = self.run_command(["fk", "walk.bvh"]).stdout
        reading, writing = os.pipe()
        os.set_blocking(reading, False)
        process = subprocess.Popen([options.kinefile, "fk", "-"], cwd=self.folder, stdin=reading,
                                   stdout=subprocess.PIPE)
        os.close(reading)
        with os.fdopen(writing, "wb", buffering=0) as stream:
            for start in range(0, len(text), 400):
                stream.write(text[start:start + 400])
                time.sleep(0.02)
        self.assertEqual(process.communicate()[0], right)


def main():
    global options
    parser = argparse.ArgumentParser()
    parser.add_argument("--kinefile", required=True)
    parser.add_argument("--inject", required=True, help="the library that makes calls fail")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--num-signals", type=int, default=40)
    parser.add_argument("--num-truncations", type=int, default=40)
    parser.add_argument("--seconds", type=float, default=0, help="goes on with other seeds")
    parser.add_argument("tests", nargs="*")
    options = parser.parse_args()
    options.kinefile = os.path.abspath(options.kinefile)
    options.inject = os.path.abspath(options.inject)
    end = time.monotonic() + options.seconds
    while True:
        done = unittest.main(argv=[sys.argv[0], *options.tests], exit=False).result
        if not done.wasSuccessful():
            sys.exit(1)
        if time.monotonic() >= end:
            return
        options.seed += 1
        print(f"seed {options.seed}", flush=True)


if __name__ == "__main__":
    main()
