# SPDX-License-Identifier: Apache-2.0
"""Every study of docs/studies: which page it fills, which commands make it, and which sources it measures.

A page keeps its words. What a study's last command prints goes where the page says so (a line <!-- made by NAME -->), or is
the page (WHOLE), or lies beside it in docs/studies/printed (BESIDE), for pages whose words and tables are interwoven:
whoever remakes such a study carries the figures over. Commands with no page write theirs themselves (""). A study that no
command can make says why (by_hand). Sources are folders, files, or FOLDER/* for the files directly in it; that one of them
changed makes the study older than the code (scripts/studies_made.py).
"""
import pathlib
import typing

ROOT = pathlib.Path(__file__).resolve().parent.parent
STUDIES, BUILD, OUT = ROOT / "docs/studies", ROOT / "build/release", ROOT / "build/studies"
STURZ, BENCH = str(BUILD / "ensemble/app/sturz"), str(BUILD / "tests/bench/sturz_bench")
IMAGES, CASES = ROOT / "docs/images", ROOT / "scenarios/cases"
WHOLE, BESIDE, DATA = "whole ", "beside ", "folder of --data"


class Study(typing.NamedTuple):
    page: str          # where the last command's words go: PAGE, WHOLE PAGE, BESIDE PAGE, or "" (the commands write them)
    commands: tuple
    sources: tuple
    minutes: float = 0  # of CPU on the machine that made it, roughly; for --list
    also: tuple = ()    # more pages that rest on it
    by_hand: str = ""  # why no command makes it


def script(name, *arguments):
    return ["/usr/bin/python3", str(STUDIES / f"{name}.py"), *map(str, arguments)]


def hard(states, page):
    return [BENCH, "hard", "--full", "--states", states, "--markdown", str(STUDIES / page)]


def ctest(*arguments):
    return ["ctest", "--test-dir", str(BUILD), "--output-on-failure", *arguments]


SOLVER = ("engine/core", "engine/terrain", "engine/laws", "engine/particles", "engine/neighbors", "engine/simulation", "engine/effects/*",
          "engine/effects/bed", "engine/effects/motion", "engine/effects/sweep", "scenarios/assembly", "scenarios/shapes")
DENSE = (*SOLVER, "engine/effects/dense", "engine/effects/isolated")
STATES = (*DENSE, "engine/effects/kinetic")
COLUMNS = (*SOLVER, "engine/effects/columns")
WET = (*COLUMNS, "engine/effects/erosion")
LIQUID = (*SOLVER, "engine/effects/liquid")
COUPLED = (*DENSE, "engine/effects/liquid", "engine/effects/phases", "engine/effects/coupling", "engine/effects/dilatancy")
ENSEMBLE = ("ensemble/sampling", "ensemble/hazard", "ensemble/members", "ensemble/censoring")

MADE = {
    "verification": Study(WHOLE + "verification_table.md",
                          (ctest("-L", "^physics$"),
                           ["python3", str(ROOT / "scripts/verification_table.py"), str(BUILD / "tests/physics/results.csv")]),
                          ("engine", "scenarios/assembly", "scenarios/shapes", "tests/physics"), 10, ("verification.md", "grain_states.md", "liquid_among_grains.md")),
    "stability": Study("", (hard("dense", "stability.md"), hard("all", "stability_states.md")), (*STATES, "tests/hard/*", "tests/hard/cases"), 30,
                       ("stability.md", "stability_states.md", "stability_notes.md")),
    "stability_liquid": Study("stability_liquid.md", (script("random_mixtures", BUILD / "tests/hard/hard_mixtures_test", 300),),
                              (*COUPLED, "tests/hard/coupled"), 3),
    "error_against_seconds": Study("error_against_seconds.md",
                                   (script("error_against_seconds", "measure", STURZ, OUT / "ladder"),
                                    script("error_against_seconds", "show", OUT / "ladder/figures.json",
                                           STUDIES / "error_against_seconds_earlier.json", IMAGES / "error_against_seconds.png")), DENSE, 4),
    "cost_check": Study("error_against_seconds.md", (script("cost_check", STURZ, CASES, DATA, OUT / "cost_check"),),
                        (*WET, "ensemble/fidelity/*", "ensemble/workflow/fidelity"), 6),
    "beside_the_paper": Study("beside_the_paper.md", (script("beside_the_paper", STURZ, OUT / "paper"),),
                              (*STATES, "engine/effects/columns"), 2),
    "paper": Study("paper.md", (script("paper", STURZ, CASES, OUT / "paper_wet"),),
                   (*COUPLED, "scenarios/cases/shuicheng", "scenarios/cases/flume"), 30),
    "usgs_flume_3d": Study("usgs_flume_3d.md", (script("usgs_flume_3d", STURZ, CASES / "usgs_flume", OUT / "usgs_flume"),),
                           (*COUPLED, "engine/effects/columns", "scenarios/cases/usgs_flume"), 60),
    "who_is_right": Study("who_is_right.md", (script("who_is_right", BUILD / "tests/tools/energy_of", OUT / "who"),),
                          (*DENSE, "engine/effects/columns", "engine/effects/discrete"), 60),
    "formulations": Study("formulations.md", (script("formulations", STURZ, DATA, OUT / "formulations", IMAGES / "formulations.png"),),
                          (*DENSE, "engine/effects/columns"), 6),
    "strength_inside": Study("strength_inside.md",
                             (script("strength_inside", STURZ, DATA, OUT / "strength", "collapse", "pile", "slope", "s1000:4.5", "s1000:2.25"),),
                             DENSE, 5),
    "multilevel": Study("multilevel.md",
                        (script("multilevel", "members", STURZ, CASES, OUT / "multilevel"),
                         script("multilevel", "repeats", BUILD / "tests/tools/multilevel_repeats", OUT / "multilevel"),
                         script("multilevel", "show", OUT / "multilevel", IMAGES / "multilevel.png")),
                        (*DENSE, "engine/effects/columns", "ensemble/fidelity/multilevel", "ensemble/fidelity/valid_members.cpp", "ensemble/workflow/multilevel/decision.cpp",
                         "ensemble/workflow/multilevel/estimates.cpp", "tests/tools/multilevel_repeats.cpp", "tests/tools/stored_levels.hpp"), 130),
    "performance": Study("performance.md", (script("performance", BENCH, STURZ, OUT / "performance", IMAGES / "performance.png"),),
                         (*STATES, "engine/effects/columns", "ensemble/workflow/members", "tests/bench"), 11),
    "back_analysis": Study(BESIDE + "back_analysis.md",
                           tuple(script("back_analysis", STURZ, DATA, OUT / "back_analysis", what) for what in ("twins", "s1000", "full:32")),
                           (*WET, *ENSEMBLE, "ensemble/calibration", "ensemble/emulator", "ensemble/scores"), 20),
    "erosion": Study(BESIDE + "erosion.md",
                     (ctest("-R", "GrowingSheet"), script("erosion_s1000", STURZ, DATA, OUT / "erosion"),
                      script("slides_with_water_and_bed", STURZ, OUT / "slides", "zhangjiawan"), script("cost_of_blocks", STURZ, OUT / "blocks", 5)),
                     (*WET, "tests/physics/erosion_test.cpp"), 15),
    "wet_columns": Study(BESIDE + "wet_columns.md",
                         (script("plot_wet_columns", IMAGES / "wet_columns.png", STURZ),
                          script("usgs_flume", STURZ, CASES / "usgs_flume/scenario.yaml", OUT / "flume"),
                          script("slides_with_water_and_bed", STURZ, OUT / "slides", "shuicheng"),
                          *(script("hard_wet_members", BUILD / "tests/hard/hard_columns_test", ground, 0, 250) for ground in ("synthetic", "mountain")),
                          script("cost_of_blocks", STURZ, OUT / "blocks", 5)),
                         (*WET, "scenarios/cases/usgs_flume", "tests/physics/wet"), 20),
    "flattened_particles": Study(BESIDE + "flattened_particles.md",
                                 tuple(["env", "OPENBLAS_NUM_THREADS=1", *script("flattened_particles", case, OUT / "flattened.jsonl")]
                                       for case in ("lattice", "sheet", "load", "cap", "column", "bend", "swing", "steps")),
                                 (), 10),
    "forecasts": Study(BESIDE + "forecasts.md", (script("forecasts", STURZ, CASES, OUT / "forecasts"),),
                       ("ensemble/workflow/forecast", "ensemble/workflow/machine", "engine/simulation"), 15),
    "region": Study(BESIDE + "region.md",
                    (script("region", "make", DATA + "/marsicano_tinitaly", OUT / "region", 300),
                     [STURZ, "ensemble", str(OUT / "region/scenario.yaml"), "-o", str(OUT / "region/out"), "--workers", "2"],
                     script("region", "check", OUT / "region/out")),
                    (*ENSEMBLE, "ensemble/region", "ensemble/workflow/region"), 40),
    "risk_by_year": Study(BESIDE + "risk_by_year.md", (script("risk_by_year", STURZ, DATA, OUT / "risk", 200),),
                          ("ensemble/risk", "ensemble/assets", "ensemble/workflow/risk", "scenarios/risk", "scenarios/assets"), 15),
    "liquid": Study(BESIDE + "liquid.md",
                    (*(["env", "STURZ_LIQUID_FINE=1", str(BUILD / f"tests/physics/physics_{name}_test")] for name in ("dam_break", "rest", "impact")),
                     [BENCH, "liquid", "--pairs", "11"]), (*LIQUID, "tests/physics/liquid"), 30),
    "mirror_on_bends": Study(BESIDE, (script("mirror_on_bends"),), (), 1),
    "bookkeeping": Study("", (), ("engine/simulation", "engine/effects/columns"), 0, ("bookkeeping.md",),
                         "rests on samples of perf, read by eye"),
    "columns_at_walls": Study("", (), COLUMNS, 0, ("columns_at_walls.md",),
                              "its scenes were made by hand; ctest -R PileAtWall holds the part that is asserted"),
}


def pages_of(study):
    """Names of the pages in docs/studies that rest on a study."""
    own = study.page.removeprefix(WHOLE).removeprefix(BESIDE)
    return tuple(dict.fromkeys(name for name in (own, *study.also) if name.endswith(".md")))
