#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""fuzz/make_seeds.py FOLDER: the inputs from which journey_fuzz makes its mutants, written into FOLDER. They
are the files of fuzz/seeds, examples/ and the fixtures of tests/formats, each with what lies beside it, as
fuzz/folder.hpp reads them; and real files, where the variable KINEFILE_TEST_DATA names their folder, cut to
8 KB. Real files get into no repository: FOLDER is below build/."""

import hashlib
import os
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
BORDER = b"\xfe\xfe\xfe\xfe"
MOST = 8 * 1024
DETECTED = 0  # by content and name; otherwise the number of a format
READ = (".bvh", ".asf", ".amc", ".seq", ".body", ".urdf", ".wrl", ".csv", ".pos", ".waist", ".zmp", ".txt", ".motion")
PARTS = (".waist", ".hip", ".zmp", ".pos")


def cut_bvh(data):
    """The first frames of a motion that is too long, and their count."""
    head, line, rows = data.partition(b"Frame Time:")
    if not line or len(head) > MOST - 1000:
        return data[:MOST]
    kept = rows[:MOST - len(head)].split(b"\n")[:-1]
    head = re.sub(rb"Frames:\s*\d+", b"Frames: %d" % (len(kept) - 1), head)
    return head + line + b"\n".join(kept) + b"\n"


def read(path):
    data = path.read_bytes()
    if len(data) <= MOST:
        return data
    return cut_bvh(data) if path.suffix == ".bvh" else data[:MOST].rpartition(b"\n")[0] + b"\n"


def names_in(data):
    """The file names that a text mentions."""
    return {name.decode() for name in re.findall(rb"[\w.-]+\.(?:asf|wrl|body|ini|yaml)", data)}


def beside(path, data):
    """The files that a file needs, by their names."""
    folder = path.parent
    wanted = names_in(data)
    if path.suffix == ".amc":
        wanted |= {one.name for one in folder.glob("*.asf") if path.stem.startswith(one.stem)}
    if path.suffix in PARTS:
        wanted |= {path.stem + part for part in PARTS}
    if path.suffix in (".txt", ".motion") and folder.name == "seeds":
        wanted |= {"robot.rpj", "sld.ini", "rom.ini", "pos.ini", "map.ini"}
    if path.suffix in (".seq", ".csv") and folder.name == "seeds":
        wanted.add("leg.body" if path.suffix == ".seq" else "leg.urdf")
    if path.name == "bow.seq":
        wanted.add("robot.body")
    return [one for name in sorted(wanted - {path.name}) if (one := folder / name).is_file()]


def sources():
    for folder in ("fuzz/seeds", "examples", "tests/formats", os.environ.get("KINEFILE_TEST_DATA", "")):
        if not folder:
            continue
        for path in sorted((ROOT / folder).rglob("*")):
            is_words = path.suffix == ".txt" and path.parent.name == "invalid"  # what check says
            if path.suffix in READ and path.is_file() and not is_words:
                yield path, folder == "fuzz/seeds"


def main():
    folder = pathlib.Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    count = 0
    for path, is_ours in sources():
        data = read(path)
        if path.suffix == ".txt" and b"_\x00M\x00O\x00" not in data and b"_MOTION_FORMAT" not in data:
            continue
        files = [(path.name, data)] + [(one.name, read(one)) for one in beside(path, data)]
        content = BORDER.join(name.encode() + b"\n" + bytes_ for name, bytes_ in files)[:2 * MOST]
        # Our own small ones leniently, too.
        for options in (0, 1) if is_ours else (0,):
            seed = bytes([options, DETECTED]) + content
            (folder / hashlib.sha1(seed).hexdigest()).write_bytes(seed)
            count += 1
    print(f"{count} seeds")


main()
