#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Fails when a source file includes a layer it must not see. Usage: include_order.py ROOT"""
import pathlib
import re
import sys

# layer -> layers it may include besides itself; a name stands for all its sub-folders too
ALLOWED = {
    "engine/core": set(),
    "engine/terrain": {"engine/core"},
    "engine/laws": {"engine/core"},
    "engine/particles": {"engine/core", "engine/terrain"},
    "engine/neighbors": {"engine/core", "engine/particles"},
    "engine/effects": {"engine/core", "engine/terrain", "engine/laws", "engine/particles",
                       "engine/neighbors"},
    "engine/simulation": {"engine/core", "engine/terrain", "engine/particles", "engine/neighbors",
                          "engine/effects"},
    "scenarios": {"engine"},
    "io": {"engine", "scenarios"},
    "ensemble": {"engine", "scenarios"},
    "reports": {"engine", "scenarios", "ensemble"},
    "ensemble/workflow": {"engine", "scenarios", "io", "ensemble", "reports"},
    "ensemble/app": {"engine", "scenarios", "io", "ensemble", "ensemble/workflow", "reports"},
    "ensemble/python": {"engine", "scenarios", "ensemble/workflow"},
}
# layers that their parents' users do not see by the parent's name
DOORS = {"ensemble/workflow", "ensemble/app", "ensemble/python"}

# family of effects -> families whose headers it may include, none unless it stands here; what lies
# in engine/effects itself, the tools of `motion` and the door of `sweep` are everybody's
FAMILIES = {
    "dense": {"kinetic/settings.hpp"},
    "kinetic": {"dense"},
    "isolated": {"dense"},
    "dilatancy": {"dense"},
    "liquid": {"dense"},
    "phases": {"columns"},
    "sweep": {"dense", "kinetic", "columns", "phases"},
}
EVERYBODYS = {"sweep/fused_sweep.hpp", "motion/losses.hpp", "motion/accounts.hpp",
              "motion/wrapping.hpp"}
SIMULATION_SEES = ("/step.hpp", "/state.hpp", "/moving_set.hpp", "/fields.hpp")

LIBRARIES = {
    "gdal": {"io"}, "ogr": {"io"}, "cpl_": {"io"}, "netcdf": {"io"}, "yaml-cpp": {"io"},
    "openssl/": {"io"}, "utf8": {"io"},
    "openturns": {"ensemble"}, "tbb/": {"ensemble"}, "oneapi/": {"ensemble"},
    "omp.h": {"engine/core"}, "CLI/": {"ensemble/app"}, "spdlog/": {"ensemble/app"},
    "httplib": {"ensemble/app"}, "pybind11/": {"ensemble/python"},
    "nlohmann/": {"io", "reports", "ensemble/workflow", "ensemble/app"},
    "iostream": {"ensemble/app"}, "cstdio": {"io", "ensemble/app"},
    "fstream": {"io", "reports", "ensemble/workflow", "ensemble/app"},
}


def layer(path):
    return max((l for l in ALLOWED if path == l or path.startswith(l + "/")), key=len, default=None)


def may_see(mine, theirs):
    if mine == theirs:
        return True
    if theirs in DOORS:
        return theirs in ALLOWED[mine]
    return any(theirs == a or theirs.startswith(a + "/") for a in ALLOWED[mine])


def family_problem(name, included):
    """What is wrong with one family of effects including another, or None."""
    mine = name.removeprefix("engine/effects/").split("/")
    theirs = included.removeprefix("engine/effects/")
    if "/" not in theirs:
        return None
    if len(mine) == 1:
        return f"engine/effects itself knows no family of effects ({included})"
    family = theirs.split("/")[0]
    if family == mine[0] or theirs in EVERYBODYS:
        return None
    allowed = FAMILIES.get(mine[0], set())
    if family in allowed or theirs in allowed:
        return None
    return f"effects/{mine[0]} must not include {included}"


def problems(name, text):
    mine = layer(name)
    for n, line in enumerate(text.splitlines(), 1):
        match = re.match(r'\s*#\s*include\s*([<"])([^>"]+)', line)
        if not match or mine is None:
            continue
        included = match.group(2)
        theirs = layer(included)
        if match.group(1) == '"' and (included.startswith((".", "tests/")) or "/" not in included):
            yield f"{name}:{n}: {included}: headers of the house are named from its root, tests not at all"
        if theirs and not may_see(mine, theirs):
            yield f"{name}:{n}: {mine} must not include {included}"
        if mine == "engine/simulation" and theirs == "engine/effects" and \
                not included.endswith(SIMULATION_SEES):
            yield f"{name}:{n}: simulation knows only {', '.join(SIMULATION_SEES)}, not {included}"
        if mine == theirs == "engine/effects" and (problem := family_problem(name, included)):
            yield f"{name}:{n}: {problem}"
        for library, where in LIBRARIES.items():
            if included.startswith(library) and mine not in where:
                yield f"{name}:{n}: <{included}> belongs to {sorted(where)}"


def main(root):
    root, bad = pathlib.Path(root), []
    for top in sorted({l.split("/")[0] for l in ALLOWED}):
        for path in sorted((root / top).rglob("*")):
            if path.suffix in (".hpp", ".cpp", ".h", ".cc") and "node_modules" not in path.parts:
                bad += problems(path.relative_to(root).as_posix(), path.read_text(errors="ignore"))
    print("\n".join(bad))
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
