#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""How the work of parsers and commands grows with their input: instructions, which valgrind counts, at
two sizes. Work that grows with the power 1.25 or more fails. The main jobs take ten times the work, within
a twentieth, for ten times as many more frames, joints or files; and many files need no more memory than
some. With --sizes, processor time and memory are measured instead, for a table:
growth_test.py --kinefile K --sizes 4000 64000"""

import argparse
import concurrent.futures
import math
import os
import pathlib
import re
import resource
import shutil
import subprocess
import sys
import tempfile

import inputs

CASES = {
    "bvh joints": (inputs.bvh, "a.bvh"),
    "bvh frames": (lambda n: inputs.bvh(3, n), "a.bvh"),
    "asf bones": (inputs.asf, "a.asf"),
    "amc frames": (lambda n: inputs.amc(3, n), "a.amc", {"a.asf": lambda n: inputs.asf(3)}),
    "amc bones": (inputs.amc, "a.amc", {"a.asf": inputs.asf}),
    "seq joints": (inputs.seq, "a.seq"),
    "seq frames": (lambda n: inputs.seq(3, n), "a.seq"),
    "seq lists": (inputs.seq_of_lists, "a.seq"),
    "seq components": (inputs.seq_of_components, "a.seq"),
    "csv points": (inputs.csv_of_points, "a.csv"),
    "csv links": (inputs.csv_of_links, "a.csv"),
    "csv joints": (inputs.csv_of_joints, "a.csv"),
    "csv rows": (lambda n: inputs.csv_of_joints(3, n), "a.csv"),
    "hrpsys joints": (inputs.hrpsys, "a.pos"),
    "hrpsys rows": (lambda n: inputs.hrpsys(3, n), "a.pos"),
    "body links": (inputs.body, "a.body"),
    "body missing parts": (inputs.body_of_missing_parts, "a.body"),
    "urdf links": (inputs.urdf, "a.urdf"),
    "urdf mimics": (inputs.urdf_of_mimics, "a.urdf"),
    "urdf attributes": (inputs.urdf_of_attributes, "a.urdf"),
    "wrl joints": (inputs.wrl, "a.wrl"),
    "robovie blocks": (inputs.robovie, "a.txt"),
    "robovie project": (lambda n: inputs.robovie(3), "a.txt",
                        {"a.rpj": lambda n: inputs.project(), "sld.ini": inputs.project_sliders,
                         "rom.ini": inputs.project_motors, "pos.ini": inputs.project_poses,
                         "map.ini": inputs.project_sounds}),
    "servo map": (lambda n: inputs.seq(), "a.seq", {"servos.yaml": inputs.servo_map}),
    "joint map": (inputs.bvh, "a.bvh",
                  {"a.body": inputs.body, "map.yaml": inputs.joint_map}),
}
FLAT = "bvh joints"
LONG = "bvh frames"
PARTS = "seq components"
ROBOT = "seq joints"
# What else is done with them: the input's name takes the place of @.
COMMANDS = {
    FLAT: [["info", "@"], ["fk", "@"], ["convert", "@", "o.csv"], ["convert", "@", "o.amc"], ["convert", "@", "o.json"],
           ["convert", "@", "o.bvh"], ["diff", "@", "@"], ["edit", "@", "mirror", "-o", "o.bvh"],
           ["edit", "@", "scale=2", "-o", "o.bvh"], ["edit", "@", "up=z", "-o", "o.bvh"],
           ["edit", "@", "rename=j0:k0", "-o", "o.bvh"], ["edit", "@", "joints=Hips,j0", "-o", "o.bvh"],
           ["edit", "@", "append=@", "-o", "o.bvh"], ["edit", "@", "in-place", "-o", "o.bvh"],
           ["resample", "@", "--fps", "60", "-o", "o.bvh"], ["info", "@", "--tree"],
           ["view", "@", "-o", "o.html"]],
    LONG: [["info", "@"], ["fk", "@"], ["convert", "@", "o.csv"], ["convert", "@", "o.amc"], ["diff", "@", "@"],
           ["edit", "@", "smooth=6", "unwrap", "loop=2,blend=2", "-o", "o.bvh"],
           ["edit", "@", "reverse", "speed=0.9", "-o", "o.bvh"],
           ["warp", "@", "--key", "1:2", "-o", "o.bvh"], ["resample", "@", "--fps", "60", "-o", "o.bvh"]],
    "amc bones": [["convert", "@", "o.bvh"], ["fk", "@"]],
    "seq frames": [["convert", "@", "o.csv"], ["edit", "@", "reverse", "-o", "o.seq"]],
    PARTS: [["diff", "@", "@"], ["convert", "@", "o.seq"]],
    ROBOT: [["convert", "@", "o.csv"], ["diff", "@", "@"], ["convert", "@", "o", "--to", "hrpsys"]],
    "csv joints": [["convert", "@", "o.seq"]],
    "csv links": [["convert", "@", "o.json"], ["convert", "@", "o.seq"]],
    "body links": [["fk", "@", "--rest"]],
    "robovie project": [["check", "@", "--project", "a.rpj"]],
    "servo map": [["keyframe", "@", "--servo-map", "servos.yaml", "--tolerance", "1", "-o", "o.txt"]],
    "joint map": [["convert", "@", "o.seq", "--skeleton", "a.body", "--form", "joints", "--lenient",
                   "--map", "map.yaml"]],
    "robovie blocks": [["run", "@", "-o", "o.csv"], ["graph", "@"], ["edit", "@", "reverse", "-o", "o.txt"],
                       ["convert", "@", "o.json"]],
}
# Jobs whose work is in proportion to the frames or joints: so many, as many again, and ten times as many more.
PROPORTIONAL = {
    "many frames": ((lambda n: inputs.bvh(20, n), "a.bvh"), 8000,
                    [["check", "@"], ["fk", "@"], ["convert", "@", "o.bvh"]]),
    "many joints": ((lambda n: inputs.bvh(n, 600), "a.bvh"), 200, [["fk", "@"], ["convert", "@", "o.bvh"]]),
}
MOST_DEVIATION = 0.05
# These lack parts, or have more sliders than there are, which are errors as intended.
REFUSED = {"a.body", "servos.yaml"}
kSmall = 10
# What counts of instructions differ by from run to run: at its start, a library measures the clock.
NOISE = 2e6
options = None


def jobs():
    for name, case in CASES.items():
        yield name, case, ["check", "@"]
        for words in COMMANDS.get(name, []):
            yield name, case, words


def title_of(job):
    return f"{job[0]}: {' '.join(job[2])}"


def lay_inputs(folder, case, size):
    make, name, *others = case
    for path in folder.iterdir():
        path.unlink()
    (folder / name).write_text(make(size))
    for other, make_other in (others[0] if others else {}).items():
        (folder / other).write_text(make_other(size))
    return name, sum(path.stat().st_size for path in folder.iterdir())


def run_words(words, folder, before=(), **more):
    return subprocess.run([*before, options.kinefile, *words], cwd=folder, stdout=subprocess.DEVNULL,
                          stderr=subprocess.PIPE, **more)


def instructions(words, folder):
    counter = ["valgrind", "--tool=cachegrind", "--cache-sim=no", "--cachegrind-out-file=/dev/null"]
    done = run_words(words, folder, counter)
    found = re.search(r"I\s+refs:\s+([\d,]+)", done.stderr.decode(errors="replace"))
    if found is None:
        sys.exit(f"valgrind counted nothing: {done.stderr.decode(errors='replace')}")
    return int(found.group(1).replace(",", ""))


def fault_of_memory(words, folder, size):
    """Why the command takes more memory than its input allows; empty if it does not."""
    space = (256 << 20) + 80 * size
    process = subprocess.Popen([options.kinefile, *words], cwd=folder, stdout=subprocess.DEVNULL,
                               stderr=subprocess.PIPE,
                               preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (space, space)))
    told = process.stderr.read()
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    resident = usage.ru_maxrss << 10
    is_done = process.returncode == 0 or (process.returncode == 1 and REFUSED.intersection(words))
    if not is_done and b"MEM001" not in told:
        return f"{words}: exit code {process.returncode}: {told!r}", usage
    if not is_done:
        return f"{words}: more than 256 MB + 80 times the input of {size} bytes: {told!r}", usage
    if resident > (48 << 20) + 40 * size:
        return f"{words}: {resident >> 20} MB for an input of {size} bytes", usage
    return "", usage


def measure(job, sizes):
    """The least exponent of growth, the work at both sizes, and what is wrong with the memory."""
    with tempfile.TemporaryDirectory(prefix="kinefile-growth.") as folder:
        return measure_in(pathlib.Path(folder), job, sizes)


def measure_in(folder, job, sizes):
    _, case, words = job
    work, faults = [], []
    # What the command does whatever the input is, which is not growth, is that of a small input.
    for size in sizes if options.sizes else (kSmall, *sizes):
        path, num_bytes = lay_inputs(folder, case, size)
        num_bytes *= max(1, sum(word.endswith("@") for word in words))  # a file read twice
        named = [path if word == "@" else word.replace("=@", f"={path}") for word in words]
        fault, usage = fault_of_memory(named, folder, num_bytes)
        faults += [fault] if fault else []
        path, _ = lay_inputs(folder, case, size)
        work.append(usage.ru_utime + usage.ru_stime if options.sizes else instructions(named, folder))
    base = 0 if options.sizes else work.pop(0)
    grown = [max(own - base, 1e-9) for own in work]
    noise = 0 if options.sizes else NOISE
    exponent = math.log(max(grown[1] - noise, 1e-9) / (grown[0] + noise)) / math.log(sizes[1] / sizes[0])
    return exponent, grown, faults


def deviation(work):
    """How far ten times as much more is from ten times the work of as much again: of three counts."""
    return (work[2] - work[0]) / (work[1] - work[0]) / 10 - 1


def proportional_jobs():
    for name, (case, size, commands) in PROPORTIONAL.items():
        for words in commands:
            yield name, case, words, size


def measure_proportion(job):
    _, case, words, size = job
    sizes = (size, 2 * size, 11 * size)
    with tempfile.TemporaryDirectory(prefix="kinefile-growth.") as folder:
        work = []
        for size in sizes:
            path, _ = lay_inputs(pathlib.Path(folder), case, size)
            work.append(instructions([path if word == "@" else word for word in words], folder))
        return deviation(work), work


def convert_many(folder, count, run):
    """What converting so many files gives, by some way to run it."""
    folder = pathlib.Path(folder, str(count))
    folder.mkdir()
    text = inputs.bvh(5, 200)
    for i in range(count):
        (folder / f"{i}.bvh").write_text(text)
    return run(["convert", ".", "--to", "csv", "--out-dir", "out", "--jobs", "2"], folder)


def peak_memory(words, folder):
    process = subprocess.Popen([options.kinefile, *words], cwd=folder, stdout=subprocess.DEVNULL,
                               stderr=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    return usage.ru_maxrss << 10


def measure_files():
    """How far the work of many files is from being in proportion, and their memory from being the same."""
    sizes = (20, 40, 220)
    with tempfile.TemporaryDirectory(prefix="kinefile-growth.") as folder:
        work = [convert_many(folder, count, instructions) for count in sizes]
    with tempfile.TemporaryDirectory(prefix="kinefile-growth.") as folder:
        memory = [convert_many(folder, count, peak_memory) for count in (sizes[0], sizes[2])]
    return deviation(work), memory


def check_proportions(pool):
    faults = []
    wanted = [job for job in proportional_jobs() if options.only in title_of(job)]
    found = [(title_of(job), *result) for job, result in zip(wanted, pool.map(measure_proportion, wanted))]
    if options.only in "many files":
        off, memory = measure_files()
        found.append(("many files: convert", off, memory))
        # A thread more or less takes its stack.
        if memory[1] > 1.05 * memory[0] + (4 << 20):
            faults.append(f"many files: {memory[1] >> 10} kB, where few take {memory[0] >> 10} kB")
    for title, off, work in found:
        print(f"{100 * off:+5.1f} %  {work}  {title}", flush=True)
        if abs(off) > MOST_DEVIATION:
            faults.append(f"{title}: {100 * off:+.1f} % from ten times the work of a tenth")
    return faults


def main():
    global options
    parser = argparse.ArgumentParser()
    parser.add_argument("--kinefile", required=True)
    parser.add_argument("--sizes", type=int, nargs=2, help="measures times at these sizes")
    parser.add_argument("--only", default="", help="part of the name of a case")
    options = parser.parse_args()
    options.kinefile = os.path.abspath(options.kinefile)
    if options.sizes is None and shutil.which("valgrind") is None:
        sys.exit("valgrind, which counts instructions, is not there")
    faults = []
    sizes = options.sizes or (500, 2000)
    wanted = [job for job in jobs() if options.only in title_of(job)]
    # Times are measured one after the other.
    with concurrent.futures.ThreadPoolExecutor(1 if options.sizes else os.cpu_count()) as pool:
        for job, (exponent, work, wrong) in zip(wanted, pool.map(lambda job: measure(job, sizes), wanted)):
            print(f"{exponent:6.2f}  {work[0]:14.6g} {work[1]:14.6g}  {title_of(job)}", flush=True)
            # Below this work the growth is of what every command does.
            if exponent > 1.25 and work[1] > (0.3 if options.sizes else 5e6):
                faults.append(f"{title_of(job)}: grows with the power {exponent:.2f}")
            faults += wrong
        if not options.sizes:
            faults += check_proportions(pool)
    for fault in faults:
        print(f"FAULT {fault}")
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
