#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Holds the includes of src/, cli/, wasm/, include/ and examples/ to the table of layers in
docs/design/layers.md: an include that is not in this table does not exist. Looks for names of
formats outside src/formats/: what a format is, its own struct says."""

import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent

# Layer: the layers that it may include. Public headers belong to a layer each, see PUBLIC.
_BELOW_OPERATIONS = ["base", "simd", "math", "rotation", "model", "kinematics"]
OPERATIONS = ["retime", "edit", "shape", "flow", "robot", "servo"]

LAYERS = {
    "base": [],
    "simd": ["base"],
    "math": ["base", "simd"],
    "rotation": ["base", "simd", "math"],
    "text": ["base", "simd"],
    "model": ["base", "math"],
    "format": _BELOW_OPERATIONS + ["text"],
    "registry": ["base", "text", "math", "model", "format"],
    "kinematics": ["base", "simd", "math", "rotation", "model"],
    "retime": _BELOW_OPERATIONS,
    "edit": _BELOW_OPERATIONS + ["retime"],
    "shape": _BELOW_OPERATIONS,
    "flow": ["base", "model"],
    "robot": _BELOW_OPERATIONS,
    "servo": _BELOW_OPERATIONS + ["flow", "robot"],
    "io": ["base", "text", "model", "registry"],
    "document": _BELOW_OPERATIONS + OPERATIONS + ["text", "registry", "io"],
    "all": _BELOW_OPERATIONS + OPERATIONS + ["format", "registry", "document", "io"],
    "wasm": _BELOW_OPERATIONS + OPERATIONS + ["format", "registry", "document", "io", "all"],
    "cli": _BELOW_OPERATIONS + OPERATIONS + ["format", "registry", "document", "io", "all"],
}

# The layer that declares what a public header has.
PUBLIC = {
    "array": "base", "byte_source": "base", "function_ref": "base", "kept": "base", "option": "base", "threads": "base",
     "diagnostics": "base", "result": "base", "version": "base", "math": "math",
    "frame_source": "model", "skeleton": "model", "visual_shape": "model", "timeline": "model", "clip": "model", "motion": "model",
    "world_poses": "model", "body_motion": "model", "document": "model", "format": "model", "bvh": "model", "choreonoid": "model", "csv": "model", "npz": "model",
    "robovie": "model",
    "pose_table": "model", "joint_map": "model", "pose_flow": "model", "robot_project": "model",
    "servo_map": "model",
    "kinematics": "kinematics", "compare": "kinematics", "joint_rotation": "kinematics",
    "anomalies": "kinematics", "joint_curves": "kinematics", "limits": "kinematics", "evidence": "kinematics",
    "retime": "retime", "edit": "edit", "shape": "shape", "flow": "flow", "robot": "robot",
    "servo": "servo", "operation": "model", "process": "document", "batch": "document", "convert": "document",
    "check": "document", "marks": "document", "place": "document", "info": "document", "fk": "document",
    "differences": "document", "run": "document", "retime_documents": "document", "io": "io", "kinefile": "all",
}

# Third-party headers that public headers may show, and what only some layers may use.
PUBLIC_THIRD_PARTY = ("Eigen/", "tl/expected.hpp")
ONLY_IN = {"hwy/": ("simd",), "fast_float/": ("text", "simd"), "CLI/": ("cli",), "nlohmann/": ("cli", "wasm"),
           "zlib.h": ("cli",)}
DISK_HEADERS = ("fstream", "filesystem", "cstdio", "fcntl.h", "unistd.h", "sys/stat.h")

FORMAT_NAMES = ("bvh", "asf", "amc", "choreonoid", "robovie", "body", "wrl", "urdf", "hrpsys",
                "csv", "json", "mjcf", "npz", "gltf")
FORMAT_NAME = re.compile('"(' + "|".join(FORMAT_NAMES) + ')"')
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]', re.M)


def layer_of_file(path):
    """The layer and, for a format, its own folder."""
    parts = path.relative_to(ROOT).parts
    if parts[0] == "include":
        return PUBLIC[path.stem], None
    if parts[0] == "wasm":
        return "wasm", None
    if parts[0] in ("cli", "examples"):
        return "cli", None
    if parts[1] == "formats":
        is_format = len(parts) > 3
        return ("format", parts[2]) if is_format else \
            ("registry" if parts[2] == "registry.cpp" else "format", None)
    return parts[1], None


def faults_of(path):
    layer, own_format = layer_of_file(path)
    for bracket, name in INCLUDE.findall(path.read_text()):
        if name.startswith("kinefile/"):
            target = PUBLIC.get(pathlib.PurePath(name).stem)
            if target is None:
                yield f"{name} is not in the table of public headers"
                continue
        elif bracket == '"' and layer not in ("cli", "wasm"):
            parts = name.split("/")
            target = parts[0]
            if target == "formats":
                target = "format"
                is_other = len(parts) > 2 and own_format is not None and parts[1] != own_format
                if is_other:
                    yield f"a format includes another: {name}"
        else:
            for prefix, only in ONLY_IN.items():
                if name.startswith(prefix) and layer not in only:
                    yield f"{name} belongs to {' and '.join(only)}"
            if bracket == "<" and name in DISK_HEADERS and layer not in ("io", "cli"):
                yield f"only io touches the disk: {name}"
            if path.is_relative_to(ROOT / "include") and "/" in name and not \
                    name.startswith(PUBLIC_THIRD_PARTY):
                yield f"a public header shows {name}"
            continue
        if target != layer and target not in LAYERS[layer]:
            yield f"{layer} may not include {target}: {name}"


def named_formats_of(path):
    """Names of formats in string literals of a file that is to know none."""
    relative = path.relative_to(ROOT).as_posix()
    if relative.startswith(("src/formats/", "examples/")):
        return
    for line in path.read_text().splitlines():
        code = line.split("//")[0]
        for name in FORMAT_NAME.findall(code):
            yield f"names the format {name}: {line.strip()}"


def main():
    folders = ("include", "src", "cli", "wasm", "examples")
    paths = [p for folder in folders for p in sorted((ROOT / folder).rglob("*.?pp"))]
    faults = [f"{path.relative_to(ROOT)}: {fault}" for path in paths
              for check in (faults_of, named_formats_of) for fault in check(path)]
    print("\n".join(faults) if faults else f"{len(paths)} files keep to the layers")
    return 1 if faults else 0


sys.exit(main())
