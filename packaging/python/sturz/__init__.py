# SPDX-License-Identifier: Apache-2.0
"""Landslide hazard maps from ensembles of simulations, driven from Python.

    import sturz

    scene = sturz.Scenario.read("scenario.yaml")       # or a dictionary
    results = sturz.ensemble(scene, "out/slope", members=64)
    results.hazard.probability_of_reach.plot()          # xarray
    results.members.runout_m.describe()                 # pandas
    results.outlines([0.05, 0.5])                       # geopandas

    member = sturz.Simulation(scene).run()              # in this process, nothing written
    member.peaks["peak_thickness"]                      # numpy, the engine's own array

The package lies beside the program ``sturz`` and calls it; set the environment variable STURZ to
another one. It needs nothing but Python itself; xarray, pandas and geopandas are imported where
results are looked at. See docs/python.md.
"""
from .commands import (Server, calibrate, cases, check, copy_case, describe, ensemble, run, serve)
from .errors import MembersFailed, Missing, Problem, ScenarioError, SturzError, SturzWarning
from .program import program
from .results import CalibrationResults, EnsembleResults, Results, RunResults, open_results
from .scenario import Scenario, explain, schema
from .simulation import Member, Simulation

__all__ = [
    "CalibrationResults", "EnsembleResults", "Member", "MembersFailed", "Missing", "Problem", "Results",
    "RunResults", "Scenario", "ScenarioError", "Server", "Simulation", "SturzError", "SturzWarning",
    "calibrate", "cases", "check", "copy_case", "describe", "ensemble", "explain", "open_results",
    "program", "run", "schema", "serve",
]
