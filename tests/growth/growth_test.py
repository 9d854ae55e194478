#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""How the work of parsers and commands grows with their input: instructions, which valgrind counts, at
two sizes. Work that grows with the power 1.25 or more fails. With --sizes, processor time and memory are
measured instead, for a table:  growth_test.py --kinefile K --sizes 4000 64000"""

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
    for fault in faults:
        print(f"FAULT {fault}")
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
