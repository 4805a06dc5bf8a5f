#!/usr/bin/env python3
"""Includes point one way. For each folder: what of ours its files may include (a folder, or a single header)."""
import pathlib
import re
import sys

ALLOWED = {
    "continuum/isa": [],
    "continuum/flow": ["continuum/errors.hpp"],
    "continuum/terrain": ["continuum/errors.hpp"],
    "continuum/mesh": ["continuum/flow", "continuum/terrain", "continuum/bytes.hpp", "continuum/errors.hpp"],
    "continuum/boundary": ["continuum/flow", "continuum/terrain", "continuum/mesh", "continuum/errors.hpp"],
    "continuum/scheme": ["continuum/isa", "continuum/flow", "continuum/terrain", "continuum/mesh", "continuum/boundary", "continuum/errors.hpp"],
    "continuum/noc": ["continuum/isa", "continuum/flow", "continuum/terrain", "continuum/mesh", "continuum/boundary", "continuum/scheme",
                      "continuum/flow_model.hpp", "continuum/bytes.hpp", "continuum/errors.hpp"],
    "continuum/exact": ["continuum/flow", "continuum/terrain"],
    "continuum": ["continuum"],
    "coupling/scene": ["continuum/mesh/most_levels.hpp"],
    "coupling/plan": ["coupling/scene", "coupling/engine/contact_law.hpp", "continuum"],
    "coupling/engine": [],
    "coupling/workers": ["coupling/checkpoint", "coupling/engine"],
    "coupling/checkpoint": [],
    "coupling/transfer": ["coupling/checkpoint", "continuum/solver.hpp", "continuum/terrain", "coupling/engine"],
    "coupling/loop": ["continuum", "coupling/checkpoint", "coupling/engine", "coupling/transfer", "coupling/scene", "coupling/plan"],
    "coupling/records": ["coupling/checkpoint", "coupling/loop/observer.hpp", "coupling/scene", "coupling/engine/grain_engine.hpp", "continuum/solver.hpp",
                         "continuum/terrain", "continuum/isa", "continuum/mesh/mpi_session.hpp"],
    "coupling/cases": ["coupling/checkpoint", "coupling/scene", "coupling/records"],
    "coupling/check": ["coupling/scene", "coupling/cases"],
    "coupling/study": ["coupling/scene", "coupling/plan", "coupling/loop", "coupling/records", "coupling/cases"],
    "coupling/calibration": ["coupling/scene", "coupling/engine", "coupling/cases", "coupling/records"],
    "app": ["continuum", "coupling"],
}


def folder_of(path):
    for folder in sorted(ALLOWED, key=len, reverse=True):
        if path.startswith(folder + "/"):
            return folder
    return None


def violations(root):
    for top in ("continuum", "coupling", "app"):
        for file in sorted((root / top).rglob("*.[ch]pp")):
            name = file.relative_to(root).as_posix()
            folder = folder_of(name)
            for number, line in enumerate(file.read_text().splitlines(), 1):
                found = re.match(r'\s*#include "(.+)"', line)
                if not found:
                    continue
                target = found.group(1)
                if not (root / target).exists():
                    continue  # a header made by the build
                allowed = ALLOWED[folder] + [folder]
                if not any(target == a or target.startswith(a + "/") for a in allowed):
                    yield f"{name}:{number}: {folder} must not include {target}"


if __name__ == "__main__":
    found = list(violations(pathlib.Path(sys.argv[1])))
    print("\n".join(found) if found else "includes point one way")
    sys.exit(1 if found else 0)
