#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Prints what `llvm-cov export -summary-only` says of each format, one row a folder of src/formats, and of the
parsers that they share."""

import collections
import json
import sys

PLACES = {"src/formats/": None, "src/text/yaml/": "(YAML)", "src/text/xml.cpp": "(XML)"}


def reader_of(path):
    for place, name in PLACES.items():
        _, found, rest = path.rpartition(place)
        if found:
            return name or (rest.split("/")[0] if "/" in rest else "(shared)")
    return None


def main():
    sums = collections.defaultdict(lambda: [0, 0, 0, 0])
    for file in json.load(sys.stdin)["data"][0]["files"]:
        reader = reader_of(file["filename"])
        if reader is None:
            continue
        regions, lines = file["summary"]["regions"], file["summary"]["lines"]
        for name in (reader, "all"):
            for i, count in enumerate((regions["covered"], regions["count"], lines["covered"], lines["count"])):
                sums[name][i] += count
    total = sums.pop("all")
    print(f"{'FORMAT':<12}{'REGIONS':>15}{'':>8}{'LINES':>15}")
    for name, (regions, all_regions, lines, all_lines) in [*sorted(sums.items()), ("all", total)]:
        print(f"{name:<12}{f'{regions}/{all_regions}':>15}{regions / all_regions:>8.1%}"
              f"{f'{lines}/{all_lines}':>15}{lines / all_lines:>8.1%}")


main()
