#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tests commands on a motion of two gigabytes, which they read block by block: their memory stays
below 200 MB, and every frame is there."""

import argparse
import json
import os
import pathlib
import resource
import subprocess
import sys
import tempfile
import unittest
import zipfile

FILE_BYTES = 2 << 30
PART_BYTES = 300 << 20
MOST_RESIDENT_BYTES = 200 << 20
MOST_ADDRESS_BYTES = 1 << 30
ROWS_PER_BLOCK = 4000
bin_folder = None

HEAD = """HIERARCHY
ROOT hips
{
  OFFSET 0 0 0
  CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
"""
JOINT = """JOINT joint%d
{
  OFFSET 0 10 0
  CHANNELS 3 Zrotation Xrotation Yrotation
"""
END = "End Site\n{\nOFFSET 0 10 0\n}\n"
NUM_JOINTS = 20


def rows_of_block():
    """Rows that count, so that a frame that is missing or twice shows."""
    rows = []
    for i in range(ROWS_PER_BLOCK):
        angles = " ".join(f"{(i * 37 + k * 11) % 1800 / 10 - 90:.4f}" for k in range(NUM_JOINTS * 3))
        rows.append(f"{i} {90 + i % 7} {i / 8} 0.5 1.25 -2.125 {angles}\n")
    return "".join(rows)


def write_motion(path, num_bytes):
    """Returns the number of frames."""
    block = rows_of_block().encode()
    num_blocks = num_bytes // len(block) + 1
    hierarchy = HEAD + "".join(JOINT % k for k in range(NUM_JOINTS)) + END + "}\n" * (NUM_JOINTS + 1)
    counts = f"MOTION\nFrames: {num_blocks * ROWS_PER_BLOCK}\nFrame Time: 0.01\n"
    with open(path, "wb") as file:
        file.write((hierarchy + counts).encode())
        for _ in range(num_blocks):
            file.write(block)
    return num_blocks * ROWS_PER_BLOCK


def limit_memory():
    resource.setrlimit(resource.RLIMIT_AS, (MOST_ADDRESS_BYTES, MOST_ADDRESS_BYTES))


class Long(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory(prefix="kinefile-long.")
        cls.motion = pathlib.Path(cls.folder.name) / "long.bvh"
        cls.num_frames = write_motion(cls.motion, FILE_BYTES)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def lines_of(self, words):
        """Runs the command, with its output line by line, and looks at its memory."""
        command = [bin_folder / "kinefile", *words]
        with subprocess.Popen(command, stdout=subprocess.PIPE, preexec_fn=limit_memory) as process:
            yield from process.stdout
            _, status, usage = os.wait4(process.pid, 0)
            process.returncode = os.waitstatus_to_exitcode(status)
        self.assertEqual(process.returncode, 0, words)
        self.assertLess(usage.ru_maxrss * 1024, MOST_RESIDENT_BYTES, words)

    def test_fk(self):
        rows = self.lines_of(["fk", self.motion, "--joints", "hips", "--frames", "0::10"])
        self.assertEqual(next(rows), b"frame,time,joint,x,y,z\n")
        frame = 0
        for row in rows:
            found, _, _, x, _ = row.split(b",", 4)
            self.assertEqual((int(found), float(x)), (frame, frame % ROWS_PER_BLOCK))
            frame += 10
        self.assertLess(self.num_frames - 10, frame)

    def test_fk_to_arrays(self):
        out = pathlib.Path(self.folder.name) / "poses.npz"
        words = ["fk", self.motion, "--rotations", "--joints", "hips,joint7", "-o", out]
        self.assertEqual(list(self.lines_of(words)), [])
        with zipfile.ZipFile(out) as archive:
            sizes = {entry.filename: entry.file_size - 128 for entry in archive.infolist()}
        out.unlink()
        self.assertEqual(sizes["positions.npy"], self.num_frames * 2 * 3 * 8)
        self.assertEqual(sizes["rotations.npy"], self.num_frames * 2 * 4 * 8)
        self.assertEqual(sizes["times.npy"], self.num_frames * 8)

    def test_convert(self):
        frame = -1
        block = rows_of_block().encode().split(b"\n")[:-1]
        for row in self.lines_of(["convert", self.motion, "-", "--to", "csv", "--decimals", "0"]):
            if frame >= 0 and frame % 100 == 0:
                expected = block[frame % ROWS_PER_BLOCK].split(b" ", 1)[0]
                self.assertEqual(row.split(b",", 2)[1], expected)
            frame += 1
        self.assertEqual(frame, self.num_frames)

    def test_resample(self):
        is_row = False
        frame = 0
        for row in self.lines_of(["resample", self.motion, "--fps", "10", "--decimals", "1"]):
            if is_row and 10 * frame < self.num_frames:
                expected = 10 * frame % ROWS_PER_BLOCK
                self.assertEqual(float(row.split(b" ", 1)[0]), expected)
            frame += is_row
            is_row = is_row or row.startswith(b"Frame Time:")
        self.assertEqual(frame, (self.num_frames - 1 + 9) // 10 + 1)

    def test_convert_many_to_amc(self):
        """Files in a batch are read block by block, too, and hashed; AMC has a skeleton beside it."""
        folder = pathlib.Path(self.folder.name)
        part, block = folder / "part.bvh", folder / "block.bvh"
        num_frames = write_motion(part, PART_BYTES)
        self.assertEqual(write_motion(block, 0), ROWS_PER_BLOCK)
        words = ["convert", part, block, "--to", "amc", "--out-dir", folder / "out"]
        words += ["--json"]
        self.assertEqual(json.loads(b"".join(self.lines_of(words)))["written"], 2)
        again = json.loads(b"".join(self.lines_of([*words, "--resume"])))
        self.assertEqual(again["up_to_date"], 2)
        self.assertEqual((folder / "out/part.asf").read_bytes(), (folder / "out/block.asf").read_bytes())
        expected = (folder / "out/block.amc").read_bytes().replace(b"block.asf", b"part.asf")
        found = 0
        with open(folder / "out/part.amc", "rb") as file:
            begin = file.read(len(expected))
            self.assertEqual(begin, expected)
            before, piece = b"", begin
            while piece:
                found += (before[-5:] + piece).count(b"\nroot ")
                before, piece = piece, file.read(1 << 24)
        self.assertEqual(found, num_frames)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--bin", type=pathlib.Path, required=True, help="the build's folder")
    options, rest = parser.parse_known_args()
    bin_folder = options.bin
    unittest.main(argv=[sys.argv[0], *rest])
