#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Every diagnostic code in the sources has its section in docs/errors.md, with a cause and a cure,
and the other way around. Every code that reading a file can give by default has a file in
tests/formats/FORMAT/invalid whose expected diagnostics show it."""

import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
CODE = re.compile(r"\b([A-Z]{3}[0-9]{3}|IO[0-9]{3})\b")

# The folder of each format's codes.
FOLDERS = {"BVH": "bvh", "ASF": "acclaim", "AMC": "acclaim", "SEQ": "choreonoid",
           "YML": "choreonoid", "BDY": "body", "URD": "urdf", "WRL": "wrl", "CSV": "csv",
           "HRP": "hrpsys", "RBV": "robovie", "RPJ": "robovie",
           "SVM": "servo_map"}

# Codes that no file alone brings about; the tests that show them.
NOT_BY_A_FILE = {
    "CSV014": "tests/formats/csv/flow_test.cpp",  # --degrees
    "CSV008": "tests/formats/csv/csv_test.cpp",  # --skeleton
    "CSV009": "tests/formats/csv/csv_test.cpp",
    "HRP005": "tests/formats/hrpsys/hrpsys_test.cpp",  # by a name
    "HRP008": "tests/formats/hrpsys/hrpsys_test.cpp",  # writing
    "HRP017": "tests/formats/hrpsys/hrpsys_test.cpp",  # writing
    "HRP011": "tests/formats/hrpsys/hrpsys_test.cpp",
    "HRP009": "tests/formats/hrpsys/hrpsys_test.cpp",  # of two files
    "CSV001": "tests/cli/convert.md",  # writing
    "AMC002": "tests/cli/acclaim.md",  # found beside the file
    "AMC003": "tests/formats/acclaim/dialects_test.cpp",  # --skeleton
    "AMC017": "tests/formats/acclaim/write_test.cpp",  # writing
    "ASF023": "tests/cli/acclaim.md",  # writing
    "ASF020": "tests/formats/acclaim/write_test.cpp",  # writing
    "SVM010": "tests/unit/unroll_test.cpp",  # a map and a motion
    "SVM011": "tests/unit/unroll_test.cpp",
    "SVM013": "tests/cli/keyframe.md",  # a robot project
    "SVM014": "tests/cli/keyframe.md",
    "SVM015": "tests/cli/keyframe.md",  # a flow with fewer sliders
    "SVM012": "tests/unit/unroll_test.cpp",
    "URD010": "tests/formats/robots/urdf_test.cpp",  # too large for a file here
    "WRL013": "tests/formats/robots/wrl_test.cpp",
    "BVH034": "tests/formats/bvh/positions_test.cpp",   # --positions auto
    "BVH036": "tests/formats/bvh/write_test.cpp",  # writing
    "BVH037": "tests/formats/bvh/write_test.cpp",  # writing
    "RBV043": "tests/formats/robovie/project_test.cpp",  # --project
    "RBV044": "tests/formats/robovie/project_test.cpp",  # --project
    "RBV045": "tests/formats/robovie/project_test.cpp",  # --project
    "RBV046": "tests/formats/robovie/project_test.cpp",  # --project
    "RBV047": "tests/formats/robovie/project_test.cpp",  # --max-speed
    "RBV052": "tests/formats/robovie/write_test.cpp",  # writing
    "RBV053": "tests/formats/robovie/write_test.cpp",  # writing
    "RPJ001": "tests/formats/robovie/project_test.cpp",  # projects
    "RPJ002": "tests/formats/robovie/project_test.cpp",  # projects
    "RPJ003": "tests/formats/robovie/project_test.cpp",  # projects
    "RPJ004": "tests/formats/robovie/project_test.cpp",  # projects
    "RPJ005": "tests/formats/robovie/project_test.cpp",  # projects
    "RPJ006": "tests/formats/robovie/project_test.cpp",  # projects
    "RPJ007": "tests/formats/robovie/project_test.cpp",  # projects
    "SEQ025": "tests/formats/choreonoid/write_test.cpp",  # writing
    "SEQ026": "tests/formats/choreonoid/write_test.cpp",  # writing
    "SEQ027": "tests/formats/choreonoid/write_test.cpp",  # writing
    "SEQ028": "tests/cli/time.md",  # writing
}


def main():
    faults = []
    sources = [p for folder in ("src", "cli") for p in (ROOT / folder).rglob("*.?pp")]
    used = {code for path in sources for code in CODE.findall(path.read_text())}
    text = (ROOT / "docs" / "errors.md").read_text()
    sections = dict(re.findall(r"^### ([A-Z]{2,3}[0-9]{3})[^\n]*\n(.*?)(?=^##|\Z)", text,
                               re.M | re.S))
    faults += [f"{code} is not in docs/errors.md" for code in sorted(used - sections.keys())]
    faults += [f"{code} of docs/errors.md is not used" for code in sorted(sections.keys() - used)]
    for code, section in sections.items():
        for word in ("Cause:", "Cure:"):
            if word not in section:
                faults.append(f"{code} in docs/errors.md has no '{word}'")
    for prefix, folder in FOLDERS.items():
        path = ROOT / "tests/formats" / folder / "invalid"
        shown = "".join(p.read_text() for p in path.glob("*.txt"))
        for code in sorted(c for c in used if c.startswith(prefix)):
            if code in NOT_BY_A_FILE:
                if code not in (ROOT / NOT_BY_A_FILE[code]).read_text():
                    faults.append(f"{code} has no test in {NOT_BY_A_FILE[code]}")
            elif f"[{code}]" not in shown:
                faults.append(f"{code} has no file in {path.relative_to(ROOT)}")
    print("\n".join(faults) if faults else f"{len(used)} codes are documented and tested")
    return 1 if faults else 0


sys.exit(main())
