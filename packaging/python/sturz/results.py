# SPDX-License-Identifier: Apache-2.0
"""Results as objects: maps as xarray, tables as pandas, outlines and assets as geopandas.

Each of these packages is imported where it is first needed; without it everything else works.
"""
from __future__ import annotations

import csv
import importlib
import json
import os
from functools import cached_property
from itertools import takewhile
from pathlib import Path
from typing import TYPE_CHECKING, Any, Sequence

from .errors import Missing, SturzError

if TYPE_CHECKING:
    import geopandas
    import pandas
    import xarray

_DEBIAN = {"xarray": "python3-xarray", "netCDF4": "python3-netcdf4", "pandas": "python3-pandas",
           "geopandas": "python3-geopandas", "shapely": "python3-shapely", "numpy": "python3-numpy"}


def need(name: str, why: str) -> Any:
    """The module, or an error that says what to install.

    Raises:
        Missing: when it is not installed.
    """
    try:
        return importlib.import_module(name)
    except ImportError as missing:
        package = _DEBIAN.get(name.split(".")[0], name)
        raise Missing(f"{why} needs {name} (apt-get install {package}).") from missing


class Results:
    """A folder of results, of a run or an ensemble."""

    maps = ""  #: name of the file of maps

    def __init__(self, folder: str | os.PathLike[str], done: dict[str, Any] | None = None,
                 warnings: Sequence[str] = ()):
        self.folder = Path(folder)
        #: the program's last words: hashes, counts, scalars; empty for a folder that was opened
        self.done: dict[str, Any] = done or {}
        self.warnings: list[str] = list(warnings)

    def file(self, name: str) -> Path:
        """Path of a file in the folder. Raises SturzError when it is not there."""
        path = self.folder / name
        if not path.exists():
            raise SturzError(f"{path} (no such file: the call that makes it has not finished). "
                             "Run it again; it goes on where it stopped.")
        return path

    @property
    def page(self) -> Path:
        """The page for people: open it in any browser, it needs no network."""
        return self.file("report.html")

    @cached_property
    def manifest(self) -> dict[str, Any]:
        """Versions, seeds and hashes: what repeats the results bit for bit."""
        return json.loads(self.file("manifest.json").read_text(encoding="utf-8"))

    def _open(self, name: str) -> "xarray.Dataset":
        xarray = need("xarray", "Opening maps")
        need("netCDF4", "Opening maps")
        return xarray.open_dataset(self.file(name), engine="netcdf4", decode_coords="all",
                                   decode_times=False, decode_timedelta=False)

    def table(self, name: str) -> "pandas.DataFrame":
        """A CSV file of the folder, without the lines of comment at its beginning."""
        pandas, path = need("pandas", "Reading tables"), self.file(name)
        with open(path, encoding="utf-8", newline="") as lines:  # a name may hold a #
            head = sum(1 for _ in takewhile(lambda line: line.startswith("#"), lines))
        return pandas.read_csv(path, skiprows=head)

    def layer(self, name: str, layer: str | None = None) -> "geopandas.GeoDataFrame":
        """A layer of a vector file of the folder, such as ``assets.gpkg``."""
        return need("geopandas", "Reading vectors").read_file(self.file(name), layer=layer)

    @property
    def crs_wkt(self) -> str | None:
        """The coordinate system of the maps as WKT; None for a bare synthetic scene."""
        with self._open(self.maps) as maps:
            for name in ("crs", "spatial_ref"):
                if name in maps.variables:
                    return maps[name].attrs.get("crs_wkt") or None
        return None

    def __repr__(self) -> str:
        return f"{type(self).__name__}({str(self.folder)!r})"


class RunResults(Results):
    """One member."""

    maps = "peaks.nc"

    @property
    def outcome(self) -> str:
        """``settled``, ``out_of_time``, ``left_terrain``; a failed member says how it failed."""
        return self.done.get("outcome") or self._attributes["outcome"]

    @property
    def scalars(self) -> dict[str, float]:
        """Runout, area, speeds and whatever else is one number, units in the names."""
        if "scalars" not in self.done:
            raise SturzError("scalars come with the call that computed the run. Call run() again.")
        return {name: float("nan") if value is None else value
                for name, value in self.done["scalars"].items()}

    @property
    def state_hash(self) -> str:
        """Of all bits of the particles at the end."""
        return self.done["state_hash"]

    @property
    def peaks(self) -> "xarray.Dataset":
        """Largest thickness, speed, energy and pressure over time, arrival and deposit."""
        return self._open(self.maps)

    @cached_property
    def _attributes(self) -> dict[str, Any]:
        with self._open(self.maps) as maps:
            return dict(maps.attrs)


class EnsembleResults(Results):
    """An ensemble: members and the maps of them all."""

    maps = "hazard.nc"

    @property
    def hazard(self) -> "xarray.Dataset":
        """All maps: probabilities with bounds, quantiles, arrival; see the table of layers in the
        user guide. Read when it is looked at; close it when the file is to be written again."""
        return self._open(self.maps)

    @property
    def members(self) -> "pandas.DataFrame":
        """One row per member: drawn values, outcome, scalars."""
        return self.table("members.csv")

    def rows(self) -> list[dict[str, str]]:
        """The same without pandas: texts by column."""
        lines = self.file("members.csv").read_text(encoding="utf-8").splitlines()
        return list(csv.DictReader(line for line in lines if not line.startswith("#")))

    @property
    def hazard_hash(self) -> str:
        """Of all bits of all maps: equal for any number of workers, shards and interruptions."""
        return self.manifest["hazard_hash"]

    @property
    def assets(self) -> "geopandas.GeoDataFrame":
        """What each asset has to expect, where the scene has some."""
        return self.layer("assets.gpkg")

    def outlines(self, levels: Sequence[float] = (0.05, 0.5, 0.95),
                 layer: str = "probability_of_reach") -> "geopandas.GeoDataFrame":
        """Outlines of the cells where a map is at least each level, along the cells' edges.

        Args:
            levels: values of the map, for probabilities between 0 and 1.
            layer: a map of ``hazard`` with one plane.

        Returns:
            One row per level that any cell comes to: ``level``, ``area_m2``, ``geometry``.
        """
        geopandas = need("geopandas", "Outlines")
        from .outlines import cells_at_least
        with self._open(self.maps) as maps:
            plane = maps[layer]
            rows = [(level, shape) for level in levels
                    if (shape := cells_at_least(plane, level)) is not None]
        table = geopandas.GeoDataFrame({"level": [level for level, _ in rows]},
                                       geometry=[shape for _, shape in rows], crs=self.crs_wkt)
        table.insert(1, "area_m2", table.geometry.area)
        return table


class CalibrationResults(EnsembleResults):
    """An ensemble and what the observations say of its uncertain values."""

    @property
    def posterior(self) -> "pandas.DataFrame":
        """Rows of equal weight: what the values may be."""
        return self.table("posterior.csv")

    @cached_property
    def found(self) -> dict[str, Any]:
        """Every number of the calibration."""
        return json.loads(self.file("posterior.json").read_text(encoding="utf-8"))


def open_results(folder: str | os.PathLike[str]) -> Results:
    """The results of an earlier call, by their folder."""
    any_kind = Results(folder)
    kind = any_kind.manifest.get("kind")
    if kind == "run":
        return RunResults(folder)
    if (any_kind.folder / "posterior.json").exists():
        return CalibrationResults(folder)
    return EnsembleResults(folder)
