#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""How many instructions whole jobs take, in all and by function, as valgrind counts them: on one
core, on the instruction sets up to AVX2. They hardly differ from run to run, and are held against
bench/instructions.csv: more than a twentieth above it fails. Another compiler makes other
instructions; the table is that of Debian 12's.

instructions.py FOLDER          compares those of a release build
instructions.py FOLDER --write  writes the table"""

import csv
import os
import pathlib
import re
import subprocess
import sys
import tempfile

TABLE = pathlib.Path(__file__).resolve().parent / "instructions.csv"
JOBS = {
    "read BVH": ["check", "walk.bvh"],
    "read AMC": ["check", "walk.amc"],
    "read CSV": ["check", "walk.csv"],
    "read .seq": ["check", "walk.seq"],
    "fk to CSV": ["fk", "walk.bvh", "-o", "out.csv"],
    "fk to NPZ": ["fk", "walk.bvh", "--rotations", "-o", "out.npz"],
    "BVH to CSV": ["convert", "walk.bvh", "out.csv"],
    "BVH to BVH, 6 decimals": ["convert", "walk.bvh", "out.bvh", "--decimals", "6"],
    "BVH to AMC": ["convert", "walk.bvh", "out.amc"],
    "resample": ["resample", "walk.bvh", "--fps", "50", "-o", "out.bvh"],
    "other order": ["convert", "walk.bvh", "out.bvh", "--order", "xyz"],
    "smooth": ["edit", "walk.bvh", "smooth=6", "-o", "out.bvh"],
    "mirror": ["edit", "walk.bvh", "mirror", "-o", "out.bvh"],
}
MOST_GROWTH = 1.05
NOISE = 2e6  # at its start, a library measures the clock
LEAST_SHARE = 0.05  # of the functions in the table
ALL = "(all)"


def plain_name(name):
    """A function's name without its parameters, and without where it is."""
    name = re.sub(r" \[.*\]$", "", name)
    depth = 0
    for i, character in enumerate(name):
        depth += {"<": 1, ">": -1}.get(character, 0)
        if character == "(" and depth == 0 and not name.startswith("(anonymous", i):
            name = name[:i]
            break
    return name.split(":", 1)[1] if re.match(r"[^: ]+:[^:]", name) else name


def count(kinefile, words, folder):
    """Instructions by function, and of all."""
    out = folder / "callgrind.out"
    subprocess.run(["valgrind", "--tool=callgrind", f"--callgrind-out-file={out}", kinefile, *words,
                    "--quiet"], cwd=folder, check=True, stdout=subprocess.DEVNULL,
                   stderr=subprocess.PIPE,
                   preexec_fn=lambda: os.sched_setaffinity(0, {min(os.sched_getaffinity(0))}))
    listed = subprocess.run(["callgrind_annotate", "--threshold=95", out], check=True,
                            stdout=subprocess.PIPE, text=True).stdout
    counts = {}
    for line in listed.splitlines():
        found = re.match(r"\s*([\d,]+) \(\s*[\d.]+%\)\s+(.*)", line)
        if found is None:
            continue
        name = ALL if found[2].startswith("PROGRAM TOTALS") else plain_name(found[2])
        counts[name] = counts.get(name, 0) + int(found[1].replace(",", ""))
    for path in folder.glob("out.*"):
        path.unlink()
    return counts


def lay_inputs(build, folder):
    kinefile = build / "kinefile"
    subprocess.run([build / "make_walk", "walk.bvh", "4000"], cwd=folder, check=True)
    for name in ("walk.amc", "walk.seq"):
        subprocess.run([kinefile, "convert", "walk.bvh", name, "--quiet"], cwd=folder, check=True)
    subprocess.run([kinefile, "convert", "walk.seq", "walk.csv", "--quiet"], cwd=folder, check=True)


def counted(build):
    with tempfile.TemporaryDirectory(prefix="kinefile-bench.") as name:
        folder = pathlib.Path(name)
        lay_inputs(build, folder)
        return {job: count(build / "kinefile", words, folder) for job, words in JOBS.items()}


def write_table(found):
    with open(TABLE, "w", newline="") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(["job", "function", "instructions"])
        for job, counts in found.items():
            for name, number in sorted(counts.items(), key=lambda item: -item[1]):
                if number >= LEAST_SHARE * counts[ALL]:
                    table.writerow([job, name, number])


def compare(found):
    """Prints the jobs' ratios to the table; whether any count is too large."""
    is_worse = False
    with open(TABLE, newline="") as file:
        for row in csv.DictReader(file):
            before = int(row["instructions"])
            now = found[row["job"]].get(row["function"], 0)
            grows = now > MOST_GROWTH * before + NOISE
            is_worse = is_worse or grows
            if row["function"] == ALL or grows:
                print(f"{row['job']:<28}{now / before:>6.3f}  {row['function'][:100]}"
                      f"{'  GROWS' if grows else ''}")
    return is_worse


def main():
    found = counted(pathlib.Path(sys.argv[1]).resolve())
    if "--write" in sys.argv:
        write_table(found)
        return 0
    print("instructions, as a multiple of those in bench/instructions.csv")
    return 1 if compare(found) else 0


if __name__ == "__main__":
    sys.exit(main())
