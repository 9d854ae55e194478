#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs the commands in Markdown files and compares what they print.

A block fenced as ```console is a transcript: lines `$ command` are run by sh in a folder of their
own a file, with the programs of --bin on the path and walk.bvh (a walk of 60 frames) in it, for
documents our other examples, too; what follows is what they print, stdout and stderr together, and
`=> N` the exit code if it is not 0.
A line `...` stands for any lines. `$DATA` is the folder of real files: a block that uses it is
skipped, by name, where there is none; so is one that says numpy where no python3 has it. --accept writes what was printed into the files."""

import argparse
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
BLOCK = re.compile(r"(^```console\n)(.*?)(^```$)", re.M | re.S)


def files_of(kind):
    if kind == "cli":
        return sorted((ROOT / "tests" / "cli").glob("*.md"))
    return [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted((ROOT / "docs").rglob("*.md"))]


def commands_of(block):
    """Pairs of a command and the text that should follow it."""
    pairs = []
    for line in block.splitlines():
        if line.startswith("$ "):
            pairs.append([line[2:], []])
        elif pairs:
            pairs[-1][1].append(line)
    return [(command, "\n".join(lines)) for command, lines in pairs]


def run(command, folder, environment):
    if environment["NUMPY_PYTHON"]:
        command = 'python3() { "$NUMPY_PYTHON" "$@"; }\n' + command
    done = subprocess.run(["sh", "-c", command], cwd=folder, env=environment, text=True,
                          stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, timeout=300)
    text = done.stdout.rstrip("\n")
    if done.returncode != 0:
        text += f"\n=> {done.returncode}" if text else f"=> {done.returncode}"
    return text


def matches(expected, found):
    pattern = r"\n".join(".*" if line == "..." else re.escape(line)
                         for line in expected.split("\n"))
    return re.fullmatch(pattern, found, re.S) is not None


def examples():
    """The example files that documents speak of: not the sources of programs."""
    sources = (".cpp", ".hpp", "CMakeLists.txt")
    return [p for p in sorted((ROOT / "examples").iterdir()) if not p.name.endswith(sources)]


def python_with_numpy():
    """A python3 that has NumPy, the one on the path first; nothing if there is none."""
    for python in ("python3", "/usr/bin/python3"):
        try:
            done = subprocess.run([python, "-c", "import numpy, sys; print(sys.executable)"],
                                  text=True, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
        except FileNotFoundError:
            continue
        if done.returncode == 0:
            return done.stdout.strip()
    return ""


def missing_for(block, environment):
    """What a block needs that is not there."""
    if "$DATA" in block and not environment.get("DATA"):
        return "the folder KINEFILE_TEST_DATA with real files"
    if "numpy" in block and not environment.get("NUMPY_PYTHON"):
        return "NumPy (python3-numpy)"
    return ""


def check_file(path, environment, accept):
    """Runs the transcripts of a file; returns (commands run, faults, why each skipped block is)."""
    text = path.read_text()
    num_run, faults, skipped = 0, [], []
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run(["make_walk", "walk.bvh", "60", "30"], cwd=folder, env=environment,
                       check=True)
        if ROOT / "tests" not in path.parents:
            for example in examples():
                shutil.copy(example, folder)
        pieces, end = [], 0
        for block in BLOCK.finditer(text):
            pieces.append(text[end:block.start(2)])
            end = block.end(2)
            if missing := missing_for(block[2], environment):
                skipped.append(missing)
                pieces.append(block[2])
                continue
            lines = []
            for command, expected in commands_of(block[2]):
                found = run(command, folder, environment)
                num_run += 1
                if not matches(expected, found) and not accept:
                    faults.append(f"{path.relative_to(ROOT)}: $ {command}\n-- expected\n"
                                  f"{expected}\n-- found\n{found}\n")
                keep = matches(expected, found)
                lines.append(f"$ {command}\n" + (f"{shown}\n" if (shown := expected if keep
                                                                  else found) else ""))
            pieces.append("".join(lines))
        pieces.append(text[end:])
    if accept:
        path.write_text("".join(pieces))
    return num_run, faults, skipped


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("kind", choices=["cli", "docs"])
    parser.add_argument("--bin", required=True)
    parser.add_argument("--accept", action="store_true")
    options = parser.parse_args()
    environment = dict(os.environ, LC_ALL="C.UTF-8", NO_COLOR="1", COLUMNS="80")
    environment["PATH"] = f"{pathlib.Path(options.bin).resolve()}:{environment['PATH']}"
    environment["FIXTURES"] = str(ROOT / "tests" / "formats")
    data = environment.get("KINEFILE_TEST_DATA", "")
    environment["DATA"] = str(pathlib.Path(data).resolve()) if os.path.isdir(data) else ""
    environment["NUMPY_PYTHON"] = python_with_numpy()
    total, all_faults = 0, []
    for path in files_of(options.kind):
        num_run, faults, skipped = check_file(path, environment, options.accept)
        total += num_run
        all_faults += faults
        for missing in sorted(set(skipped)):
            print(f"{path.relative_to(ROOT)}: {skipped.count(missing)} blocks skipped, since "
                  f"{missing} is not there")
    print("\n".join(all_faults) if all_faults else f"{total} commands print what is written")
    return 1 if all_faults or total == 0 else 0


sys.exit(main())
