#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""What hardening costs: the commands of two builds, turn by turn, and the ratio of the fastest runs'
processor time.  hardening.py HARDENED_FOLDER PLAIN_FOLDER"""

import pathlib
import resource
import subprocess
import sys
import tempfile

ROUNDS = 9
COMMANDS = {
    "reading and checking BVH": ["check", "walk.bvh"],
    "forward kinematics to CSV": ["fk", "walk.bvh", "-o", "out.csv", "--force"],
    "converting BVH to AMC": ["convert", "walk.bvh", "out.amc", "--force"],
    "warping time": ["warp", "walk.bvh", "--key", "100:150", "-o", "out.bvh", "--force"],
}


def processor_seconds(words, folder):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(words, cwd=folder, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def main():
    builds = [pathlib.Path(path).resolve() for path in sys.argv[1:3]]
    with tempfile.TemporaryDirectory(prefix="kinefile-bench.") as folder:
        subprocess.run([builds[0] / "make_walk", "walk.bvh", "8000"], cwd=folder, check=True)
        print("\nThe hardened build against the same without; below 1 is slower")
        for title, words in COMMANDS.items():
            rounds = [[processor_seconds([build / "kinefile", *words], folder) for build in builds]
                      for _ in range(ROUNDS)]
            fastest = [min(own) for own in zip(*rounds)]
            print(f"{title:<58}{fastest[1] / fastest[0]:.2f}")


if __name__ == "__main__":
    main()
