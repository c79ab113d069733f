# SPDX-License-Identifier: Apache-2.0
"""Members in this process, at the speed of arrays: nothing is written, maps are not copied."""
from __future__ import annotations

import os
from functools import cached_property
from typing import TYPE_CHECKING, Any, Callable, Mapping, Sequence

from .errors import Missing, ScenarioError
from .program import set_options
from .results import need
from .scenario import SceneLike, as_file

if TYPE_CHECKING:
    import numpy
    import xarray


def _module() -> Any:
    """The compiled module. Threads that wait must sleep, which its OpenMP reads once, now."""
    os.environ.setdefault("OMP_WAIT_POLICY", "passive")
    try:
        import _sturz
    except ImportError as missing:
        raise Missing("Members in this process need the module _sturz, which this Python has not "
                      f"({missing}). Start the script with sturz-python, build the module for any "
                      "python3 (-DSTURZ_PYTHON_MODULE=ON, with pybind11-dev and python3-dev), or use "
                      "sturz.run.") from missing
    return _sturz


class Member:
    """One finished member. Its maps are the engine's own arrays, read-only; each of them keeps the
    whole result alive, also when the member itself is gone."""

    def __init__(self, result: Any):
        self._result = result

    @property
    def outcome(self) -> str:
        """``settled``, ``out_of_time``, ``left_terrain``, ``diverged``, ``failed``, ``cancelled``."""
        return self._result.outcome

    @property
    def valid(self) -> bool:
        """True for the first three outcomes; a failed member is no exception, it says its `reason`."""
        return self._result.valid

    @property
    def reason(self) -> str:
        """One sentence where the outcome needs one."""
        return self._result.reason

    @property
    def censored(self) -> str:
        """Whether its end was seen: ``none``, ``left_terrain``, ``still_moving``, ..."""
        return self._result.censored

    @property
    def formulation(self) -> str:
        """``depth_averaged`` or ``full_stress``."""
        return self._result.formulation

    @property
    def state_hash(self) -> str:
        """Of all bits of the particles at the end; that of `sturz.run` with the same values."""
        return self._result.state_hash

    @cached_property
    def scalars(self) -> dict[str, float]:
        """Runout, area, speeds and whatever else is one number, units in the names."""
        return self._result.scalars

    @cached_property
    def peaks(self) -> "dict[str, numpy.ndarray]":
        """Maps over the window that the flow touched, [rows, columns] from north-west, float32."""
        return self._result.peaks

    @property
    def window(self) -> tuple[int, int, int, int]:
        """First row and column of the window on the grid, its rows and columns."""
        return self._result.window

    @property
    def grid(self) -> dict[str, Any]:
        """The whole grid of the maps: ``n_rows, n_cols, west_m, north_m, cell_m, crs_wkt``."""
        return self._result.grid

    def dataset(self) -> "xarray.Dataset":
        """The maps with their coordinates, over the window, without a copy."""
        xarray, numpy = need("xarray", "Maps with coordinates"), need("numpy", "Maps")
        grid, (row0, col0, n_rows, n_cols) = self.grid, self.window
        x = grid["west_m"] + (col0 + 0.5 + numpy.arange(n_cols)) * grid["cell_m"]
        y = grid["north_m"] - (row0 + 0.5 + numpy.arange(n_rows)) * grid["cell_m"]
        maps = {}
        for name, plane in self.peaks.items():
            long_name, units, _ = self._result.layer_infos[name]
            maps[name] = (("y", "x"), plane, {"long_name": long_name, "units": units})
        return xarray.Dataset(maps, {"x": ("x", x, {"units": "m"}), "y": ("y", y, {"units": "m"})},
                              {"outcome": self.outcome, "crs_wkt": grid["crs_wkt"]})

    def __repr__(self) -> str:
        return f"Member({self.outcome}, runout {self.scalars.get('runout_m', float('nan')):.1f} m)"


class Simulation:
    """A scene that is read once and computed as often as wanted, at any of its uncertain values.

    Args:
        scene: a `Scenario`, its dictionary, or a file.
        values: replace those of the scene for good, by dotted keys.
        threads: of each member; default: all cores over the members that run at a time.
        workers: members at a time, when several threads of Python call `run`; more wait. Default 1.

    Raises:
        ScenarioError: with every problem of the scene and its files.
        Missing: in a Python without the module; the text says what to do.

    Reading a scene holds Python's lock; `run` does not, so threads of Python compute side by side.
    """

    def __init__(self, scene: SceneLike, *, values: Mapping[str, Any] | None = None,
                 threads: int | None = None, workers: int | None = None):
        self._sturz = _module()
        overrides = set_options(values)[1::2]
        with as_file(scene) as file:
            try:
                self._evaluator = self._sturz.Evaluator(file, overrides, threads or 0, workers or 1)
            except self._sturz.SetupError as problem:
                raise ScenarioError(str(problem)) from None
        #: uncertain keys in the order of the scene, each with its unit
        self.units: dict[str, str] = dict(self._evaluator.keys)
        #: what `run` takes where nothing else is given
        self.medians: dict[str, float] = dict(zip(self.units, self._evaluator.medians))
        self.warnings: list[str] = list(self._evaluator.warnings)

    @property
    def keys(self) -> list[str]:
        """The uncertain keys: the arguments of `run`."""
        return list(self.units)

    def run(self, values: Mapping[str, float] | Sequence[float] | None = None, *,
            on_progress: Callable[[dict[str, Any]], Any] | None = None) -> Member:
        """One member.

        Args:
            values: by dotted keys, the median where one is missing; or one for each of `keys`.
            on_progress: hears about five times a second of simulated time, front, speed; may return
                False to end the member (``cancelled``).

        Raises:
            ScenarioError: for a value outside its key's range, or that fits nothing.
            KeyboardInterrupt: after Ctrl-C, within a fifth of a second.
        """
        numbers = self._numbers(values)
        try:
            return Member(self._evaluator.run(numbers, on_progress))
        except self._sturz.SetupError as problem:
            raise ScenarioError(str(problem)) from None

    def _numbers(self, values: Mapping[str, float] | Sequence[float] | None) -> list[float]:
        if values is None:
            return list(self.medians.values())
        if not isinstance(values, Mapping):
            return [float(value) for value in values]
        unknown = [key for key in values if key not in self.units]
        if unknown:
            known = ", ".join(self.keys) or "nothing is"
            raise ScenarioError(f"{unknown[0]} (not uncertain in this scene: {known}). Give it a "
                                "distribution there, or set it when the scene is read.")
        return [float(values.get(key, median)) for key, median in self.medians.items()]


