#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Fails when a source file includes a layer it must not see. Usage: include_order.py ROOT"""
import re, sys, pathlib
ALLOWED = {  # layer -> layers it may include besides itself ("" = any header of that layer)
    "engine/core": set(),
    "engine/terrain": {"engine/core"},
    "engine/laws": {"engine/core"},
    "engine/particles": {"engine/core", "engine/terrain"},
    "engine/neighbors": {"engine/core", "engine/particles"},
    "engine/effects": {"engine/core", "engine/terrain", "engine/laws", "engine/particles", "engine/neighbors"},
    "engine/simulation": {"engine/core", "engine/terrain", "engine/particles", "engine/neighbors", "engine/effects"},
    "scenarios": {"engine"}, "io": {"engine", "scenarios"}, "ensemble": {"engine", "scenarios"},
    "reports": {"engine", "scenarios", "ensemble"},
    "ensemble/app": {"engine", "scenarios", "io", "ensemble", "reports"},
}
EXTERNAL = {"gdal": {"io"}, "ogr": {"io"}, "cpl_": {"io"}, "netcdf": {"io"}, "yaml-cpp": {"io"}, "openturns": {"ensemble"}, "tbb/": {"ensemble"}, "oneapi/": {"ensemble"}, "omp.h": {"engine/core"},
            "CLI/": {"ensemble/app"}, "spdlog/": {"ensemble/app"}, "nlohmann/": {"io", "reports", "ensemble/app"},
            "iostream": {"ensemble/app"}, "cstdio": {"io", "ensemble/app"}, "fstream": {"io", "reports", "ensemble/app"}}
def layer(path):
    return max((l for l in ALLOWED if path == l or path.startswith(l + "/")), key=len, default=None)
def main(root):
    root, bad = pathlib.Path(root), []
    for f in sorted(p for p in root.rglob("*") if p.suffix in (".hpp", ".cpp", ".h", ".cc")):
        rel = f.relative_to(root).as_posix(); mine = layer(rel)
        if mine is None: continue
        for n, line in enumerate(f.read_text(errors="ignore").splitlines(), 1):
            m = re.match(r'\s*#\s*include\s*([<"])([^>"]+)', line)
            if not m: continue
            inc = m.group(2); theirs = layer(inc)
            if theirs and theirs != mine and not any(theirs == a or theirs.startswith(a + "/") for a in ALLOWED[mine]) or (theirs == "ensemble/app" and mine != "ensemble/app"):
                bad.append(f"{rel}:{n}: {mine} must not include {inc}")
            if mine == "engine/simulation" and theirs == "engine/effects" and not inc.endswith(("/step.hpp", "/state.hpp")):
                bad.append(f"{rel}:{n}: simulation knows only step.hpp and state.hpp, not {inc}")
            own = pathlib.PurePosixPath(rel).with_suffix(".hpp").as_posix()
            if mine == theirs == "engine/effects" and inc not in (own, "engine/effects/step.hpp", "engine/effects/state.hpp") and not inc.startswith(("engine/effects/terms/", "engine/effects/fused_sweep")):
                bad.append(f"{rel}:{n}: an effect must not include another effect ({inc})")
            for key, where in EXTERNAL.items():
                if inc.startswith(key) and mine not in where:
                    bad.append(f"{rel}:{n}: <{inc}> belongs to {sorted(where)}")
    print("\n".join(bad)); return 1 if bad else 0
sys.exit(main(sys.argv[1]))
