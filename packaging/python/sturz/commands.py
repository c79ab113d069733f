# SPDX-License-Identifier: Apache-2.0
"""The commands of the program as functions: a scene in, results as objects out."""
from __future__ import annotations

import os
import subprocess
import weakref
from collections import deque
from pathlib import Path
from threading import Thread
from typing import Any, Mapping, Sequence

from .errors import MembersFailed, ScenarioError, SturzError
from .program import FAILED_MEMBERS, Child, Ended, _words_of, call, program, set_options
from .progress import ProgressLike, listener
from .results import CalibrationResults, EnsembleResults, Results, RunResults
from .scenario import SceneLike, as_file, name_of, no_option



def describe(scene: SceneLike, *, values: Mapping[str, Any] | None = None) -> dict[str, Any]:
    """What a scene is and what it will take, from a trial of a second; nothing is kept.

    Args:
        scene: a `Scenario`, its dictionary, or a file.
        values: replace those of the scene, by dotted keys.

    Raises:
        ScenarioError: with every problem of the scene and its files.
    """
    with as_file(scene) as file:
        return call(["describe", file, "--json", *set_options(values)]).last


def check(scene: SceneLike, *, values: Mapping[str, Any] | None = None) -> None:
    """Raises ScenarioError with everything that is wrong with a scene and its files."""
    try:
        from .simulation import Simulation
        Simulation(scene, values=values)
    except ImportError:  # built without the module: the program tries it for a second
        describe(scene, values=values)


def _ended(ended: Ended, results: Results) -> Any:
    results.done, results.warnings = ended.last, ended.warnings
    if ended.code == FAILED_MEMBERS:
        raise MembersFailed("\n".join(ended.errors) or "too many members failed", results)
    return results


def _options(**given: Any) -> list[str]:
    """``--some-name value`` for what is given, ``--some-name`` for True."""
    words = []
    for name, value in given.items():
        option = "--" + name.replace("_", "-")
        if value is True:
            words.append(option)
        elif value is not None and value is not False:
            words += [option, str(value)]
    return words


def run(scene: SceneLike, out: str | os.PathLike[str] | None = None, *,
        values: Mapping[str, Any] | None = None, threads: int | None = None,
        particles_every_s: float | None = None, replace: bool = False,
        progress: ProgressLike = False) -> RunResults:
    """One member, with the median of every distribution.

    Args:
        scene: a `Scenario`, its dictionary, or a file.
        out: folder of the results; default ``out/NAME_run``.
        values: replace those of the scene, by dotted keys.
        threads: of the member; default: all cores.
        particles_every_s: frames for ParaView, this many simulated seconds apart.
        replace: the run of another scene in that folder too.
        progress: a function that hears every event.

    Raises:
        ScenarioError: what is wrong with the scene or the folder.
        MembersFailed: the member came to no end that means anything; it holds the results.
        KeyboardInterrupt: after Ctrl-C; nothing is kept then.
    """
    folder = Path(out) if out is not None else Path("out") / f"{name_of(scene)}_run"
    with as_file(scene) as file:
        ended = call(["run", file, "--json", "-o", no_option(folder), *set_options(values),
                      *_options(threads=threads, particles=particles_every_s, replace=replace)],
                     listener(progress))
    return _ended(ended, RunResults(folder))


def ensemble(scene: SceneLike, out: str | os.PathLike[str] | None = None, *,
             members: int | None = None, workers: int | None = None,
             values: Mapping[str, Any] | None = None,
             posterior: str | os.PathLike[str] | None = None,
             until_converged: float | None = None, at_most: int | None = None,
             retry_failed: bool = False, progress: ProgressLike = None) -> EnsembleResults:
    """Many members and the hazard maps. The same call goes on where an earlier one stopped.

    Args:
        scene: a `Scenario`, its dictionary, or a file.
        out: folder of the results; default ``out/NAME``.
        members: how many, instead of the scene's number.
        workers: members at a time; default: all cores.
        values: replace those of the scene, by dotted keys.
        posterior: folder of a calibration whose values are drawn.
        until_converged: stop when no half width of P(reached) is larger than this.
        at_most: members under that rule.
        retry_failed: compute failed members again.
        progress: True for a bar, False for none, None for a bar on terminals and in notebooks, or a
            function that hears every event (``start``, ``member``, ``look``, ``done``, ...).

    Raises:
        ScenarioError: what is wrong with the scene or the folder.
        MembersFailed: more members failed than the scene allows; it holds the results.
        KeyboardInterrupt: after Ctrl-C; finished members are kept.
    """
    folder = Path(out) if out is not None else Path("out") / name_of(scene)
    with as_file(scene) as file:
        ended = call(["ensemble", file, "--json", "-o", no_option(folder), *set_options(values),
                      *_options(members=members, workers=workers, posterior=posterior,
                                until_converged=until_converged, at_most=at_most,
                                retry_failed=retry_failed)], listener(progress))
    return _ended(ended, EnsembleResults(folder))


def calibrate(scene: SceneLike, out: str | os.PathLike[str] | None = None, *,
              members: int | None = None, workers: int | None = None,
              values: Mapping[str, Any] | None = None, method: str | None = None,
              discrepancy: float | None = None, active: int | None = None,
              check_best: bool = True, progress: ProgressLike = None) -> CalibrationResults:
    """An ensemble and what the scene's ``observation`` says of its uncertain values.

    Args:
        scene, out, members, workers, values, progress: as for `ensemble`.
        method: ``weights`` of the members or chains on an ``emulator``; default: by their number.
        discrepancy: what the model cannot do, as a share of the observed value.
        active: rounds of more members where the emulator knows the posterior least.
        check_best: compute the member at the best fit.

    Raises:
        ScenarioError, MembersFailed, KeyboardInterrupt: as `ensemble`.
    """
    folder = Path(out) if out is not None else Path("out") / name_of(scene)
    with as_file(scene) as file:
        ended = call(["calibrate", file, "--json", "-o", no_option(folder), *set_options(values),
                      *_options(members=members, workers=workers, method=method,
                                discrepancy=discrepancy, active=active, no_check=not check_best)],
                     listener(progress))
    return _ended(ended, CalibrationResults(folder))


def _extend(events: deque[dict[str, Any]], child: Child) -> None:
    events.extend(child.events())


class Server:
    """A scene that samplers of other programs evaluate over UM-Bridge; see `serve`."""

    def __init__(self, child: Child, first: dict[str, Any]):
        self._child = child
        self.url: str = first["url"]  #: for ``umbridge.HTTPModel(url, "sturz")``
        self.inputs: list[dict[str, Any]] = first["inputs"]  #: key, units, distribution, median
        self.outputs: list[dict[str, Any]] = first["outputs"]  #: name, units, meaning
        #: the last that it said, among it a warning for each question that it refused
        self.events: deque[dict[str, Any]] = deque(maxlen=100)
        # Read to the end, or the server would wait for room in the pipe.
        self._reader = Thread(target=_extend, args=(self.events, child), daemon=True)
        self._reader.start()
        # A server that nobody stopped would hold its port after the script has ended.
        weakref.finalize(self, child.stop, True)

    def stop(self) -> int:
        """Ends it in order. Returns its exit code, 0 when all was well."""
        code = self._child.stop(True)
        self._reader.join()
        self._child.close()
        return code

    def __enter__(self) -> "Server":
        return self

    def __exit__(self, *_: object) -> None:
        self.stop()


def serve(scene: SceneLike, *, port: int = 0, workers: int | None = None,
          outputs: Sequence[str] | None = None, censored: str | None = None,
          values: Mapping[str, Any] | None = None) -> Server:
    """Serves a scene on this machine for programs that speak UM-Bridge, until it is stopped.

    Args:
        scene: a `Scenario`, its dictionary, or a file.
        port: 0 for any free one.
        workers: members at a time; default: all cores.
        outputs: scalars of members, or "censored" (1 where a member's end was not seen); default: the
            usual ones.
        censored: "error" (default) or "value": what a client gets for a number that is only a bound,
            because mass left the raster or still moved at the end.
        values: replace those of the scene, by dotted keys.

    Raises:
        ScenarioError: what is wrong with the scene, or the port is taken.
    """
    with as_file(scene) as file:
        child = Child(["serve", file, "--umbridge", "--json", "--port", str(port), *set_options(values),
                       *_options(workers=workers, outputs=",".join(outputs) if outputs else None,
                                 censored=censored)])
        try:
            for event in child.events():
                if event.get("event") == "serving":
                    return Server(child, event)
        except BaseException:  # Ctrl-C while it reads the scene
            child.stop()
            child.close()
            raise
    child.stop()
    text = _words_of(child.said())
    child.close()
    raise ScenarioError(text)


def cases() -> dict[str, str]:
    """Shipped cases: name and what they are; `copy_case` puts one into a folder."""
    done = subprocess.run([program(), "cases"], capture_output=True, text=True, check=True)
    words = [line.strip().split(maxsplit=1) for line in done.stdout.splitlines() if line.startswith("  ")]
    return {name: rest[0] if rest else "" for name, *rest in words}


def copy_case(name: str, to: str | os.PathLike[str]) -> Path:
    """A shipped case in a folder of its own; returns its scenario file."""
    done = subprocess.run([program(), "cases", name, "-o", no_option(to)], capture_output=True, text=True,
                          check=False)
    if done.returncode != 0:
        raise SturzError(_words_of(done.stderr))
    return Path(to) / "scenario.yaml"
