# SPDX-License-Identifier: Apache-2.0
# %% [markdown]
# # sturz from Python
# A hazard map, a member in this process, a back-analysis and a server for samplers, in seconds, on a
# slope that needs no file. Editors that know `# %%` show the parts as cells; `python3 tutorial.py`
# runs them all and checks what they say.

# %% The package lies beside the program
import json
import tempfile
import urllib.request
import warnings
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import sturz

warnings.simplefilter("ignore", sturz.SturzWarning)  # a toy has much to be warned of
out = Path(tempfile.mkdtemp(prefix="sturz-"))
print("program:", sturz.program())

# %% A scene is a dictionary
# Blocks and keys are those of scenario files. Any number may be a distribution in its place.
scene = sturz.Scenario({
    "title": "slide on a plane",
    "terrain": {"synthetic": {"plane": {"cell_size_m": 4, "slope_deg": 25, "length_m": 300, "width_m": 100}}},
    "release": {"box": {"x_m": [-130, -105], "y_m": [-12, 12]}, "thickness_m": 4},
    "grains": {"density_kg_m3": 2600, "solid_fraction": 0.6},
    "basal": {"friction_coefficient": {"uniform": [0.45, 0.7]},
              "turbulent_coefficient_m_s2": {"log_uniform": [200, 1500]}},
    "numerics": {"spacing_m": 4, "end_time_s": 60},
    "ensemble": {"design": "sobol", "members": 32, "seed": 1},
    "hazard": {"cell_size_m": 4, "thickness_m": [0.5, 1], "speed_m_s": [5], "energy_kj_m2": [10],
               "pressure_kpa": [10]},
})
print(sturz.explain("numerics.spacing_m")["description"])

# %% What is wrong with a scene comes as one exception, each problem with its key
try:
    sturz.check(scene.with_values({"basal.fricton_coefficient": 0.3, "numerics.spacing_m": -4}))
    raise SystemExit("that scene should have been refused")
except sturz.ScenarioError as error:
    for problem in error.problems:
        print(f"{problem.key}: {problem.right}")
    assert set(error.keys) == {"basal.fricton_coefficient", "numerics.spacing_m"}

# %% What will be computed, and how long it takes
plan = sturz.describe(scene)
print(plan["formulation"], "with", plan["n_particles"], "columns,", plan["members"], "members")

# %% The hazard map
# On a terminal or in a notebook a bar shows how far it is. Ctrl-C is safe: the same call goes on.
results = sturz.ensemble(scene, out / "map")
members = results.members  # pandas
columns = ["basal.friction_coefficient", "runout_m", "max_speed_m_s"]
print(members[columns].describe().loc[["min", "50%", "max"]])
with results.hazard as hazard:  # xarray
    reached = hazard.probability_of_reach
    print("cells that every member reaches:", int((reached == 1).sum()), "of", int((reached > 0).sum()))
print("for people:", results.page)

# %% Outlines for the map of somebody else
outlines = results.outlines([0.05, 0.5, 0.95])  # geopandas
outlines.to_file(out / "outlines.gpkg", driver="GPKG")
print(outlines[["level", "area_m2"]])
assert outlines.area_m2.is_monotonic_decreasing

# %% A member in this process
# The scene is read once; then each member costs its computing time and nothing else. Maps are the
# engine's own arrays.
simulation = sturz.Simulation(scene)
print("arguments:", simulation.units)
member = simulation.run({"basal.friction_coefficient": 0.5})
thickness = member.peaks["peak_thickness"]  # numpy, not a copy
print(member, thickness.shape, thickness.dtype)
same = sturz.run(scene, out / "one", values={"basal.friction_coefficient": 0.5})
assert same.state_hash == member.state_hash  # bit for bit what the command computes

# %% ... and many of them, for a sampler of your own
frictions = [0.45 + 0.02 * k for k in range(10)]
computed = [simulation.run({"basal.friction_coefficient": friction}) for friction in frictions]
runouts = [each.scalars["runout_m"] for each in computed]
print([round(runout) for runout in runouts])
assert runouts[0] > runouts[-1]

# %% What an observation says of the friction
observed = scene.with_values(observation={"runout_m": {"value": member.scalars["runout_m"], "sd": 5}})
found = sturz.calibrate(observed, out / "back", members=32, check_best=False)
posterior = found.posterior["basal.friction_coefficient"]
print(f"friction {posterior.mean():.2f} +- {posterior.std():.2f}, it was 0.5")

# %% A server for samplers of other programs (UM-Bridge)
# QUEENS, PyApprox, tinyDA, Dakota and others speak it: umbridge.HTTPModel(server.url, "sturz"). With the
# least friction the slide still moves after 60 s, and its runout is only a lower bound. The server refuses
# to give bounds for values; here they are asked for, with a mark.
with sturz.serve(scene, workers=2) as server:
    def evaluate(friction):
        question = {"name": "sturz", "input": [[friction, 500]],
                    "config": {"outputs": ["runout_m", "censored"], "censored": "value"}}
        request = urllib.request.Request(server.url + "/Evaluate", json.dumps(question).encode())
        with urllib.request.urlopen(request) as answer:
            return json.load(answer)["output"][0]

    with ThreadPoolExecutor(8) as pool:
        served = list(pool.map(evaluate, frictions))
expected = [simulation.run([friction, 500]) for friction in frictions]
assert [runout for runout, _ in served] == [each.scalars["runout_m"] for each in expected]  # again the same
assert [bool(mark) for _, mark in served] == [each.censored != "none" for each in expected]
print("served", len(served), "members,", int(sum(mark for _, mark in served)), "of them bounds")
print("Results are in", out)
