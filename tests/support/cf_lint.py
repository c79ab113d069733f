#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Holds a netCDF file of maps against the CF conventions and this project's recipe.

Usage: cf_lint.py FILE...   Prints one finding per line; exit code 1 when there is any.
Units go through `udunits2` where it is installed, else through a table of SI symbols."""
import re
import shutil
import subprocess
import sys

import netCDF4
import numpy

NAME = re.compile(r"^[A-Za-z][A-Za-z0-9_]*$")
RELATIONS = {"greater_than", "greater_than_or_equal_to", "less_than", "less_than_or_equal_to"}
CELL_METHODS = {"point", "sum", "maximum", "median", "mid_range", "minimum", "mean", "mode",
                "range", "standard_deviation", "variance", "maximum_absolute_value",
                "minimum_absolute_value", "mean_absolute_value", "mean_of_upper_decile",
                "root_mean_square", "sum_of_squares"}
# CF-1.10, appendix F: name of the mapping -> parameters that it must have.
ORIGIN = {"latitude_of_projection_origin", "false_easting", "false_northing"}
GRID_MAPPINGS = {
    "transverse_mercator": ORIGIN | {"scale_factor_at_central_meridian",
                                     "longitude_of_central_meridian"},
    "lambert_conformal_conic": ORIGIN | {"standard_parallel", "longitude_of_central_meridian"},
    "albers_conical_equal_area": ORIGIN | {"standard_parallel", "longitude_of_central_meridian"},
    "lambert_azimuthal_equal_area": ORIGIN | {"longitude_of_projection_origin"},
    "azimuthal_equidistant": ORIGIN | {"longitude_of_projection_origin"},
    "stereographic": ORIGIN | {"longitude_of_projection_origin",
                               "scale_factor_at_projection_origin"},
    "oblique_mercator": ORIGIN | {"azimuth_of_central_line", "longitude_of_projection_origin",
                                  "scale_factor_at_projection_origin"},
    "polar_stereographic": ORIGIN | {"straight_vertical_longitude_from_pole"},
}
SYMBOLS = {"m", "s", "kg", "g", "A", "K", "mol", "cd", "rad", "sr", "Hz", "N", "Pa", "J", "W", "C",
           "V", "degree", "degrees", "degC", "min", "h", "d", "day", "percent", "%", "l", "t",
           "bar", "year", "metre", "meter", "second", "minute", "hour", "radian"}
PREFIXES = ("", "da", "Y", "Z", "E", "P", "T", "G", "M", "k", "h", "d", "c", "m", "u", "n", "p")


def known_symbol(symbol):
    return any(symbol == prefix + base for prefix in PREFIXES for base in SYMBOLS)


def valid_units(text):
    """True when UDUNITS would read the text as a unit."""
    if shutil.which("udunits2"):
        return subprocess.run(["udunits2", "-H", text, "-W", ""], capture_output=True,
                              check=False, stdin=subprocess.DEVNULL).returncode == 0
    if text in ("degrees_north", "degrees_east"):  # CF-1.10, 4.1 and 4.2
        return True
    for part in re.split(r"[ ./*]+", text.strip()):
        if re.fullmatch(r"[0-9.]+(e-?[0-9]+)?", part):
            continue
        match = re.fullmatch(r"([A-Za-z%]+)(?:(?:\^|\*\*)?(-?[0-9]+))?", part)
        if not match or not known_symbol(match.group(1)):
            return False
    return bool(text.strip())


def attribute(variable, name):
    return getattr(variable, name) if name in variable.ncattrs() else None


def lint_file(data):
    if data.data_model != "NETCDF4":
        yield f"format is {data.data_model}, not NETCDF4"
    if "CF-1.10" not in str(attribute(data, "Conventions")):
        yield "global attribute Conventions does not name CF-1.10"
    for name in ("title", "history", "source"):
        if not str(attribute(data, name) or "").strip():
            yield f"global attribute {name} is missing or empty"
    for name, dimension in data.dimensions.items():
        if dimension.isunlimited():
            yield f"dimension {name} is unlimited (cdo would read it as time)"
        if name not in data.variables:
            yield f"dimension {name} has no coordinate variable"
    for name in list(data.variables) + list(data.dimensions):
        if not NAME.match(name):
            yield f"{name}: not a CF name (letters, digits, underscores)"
    for name, variable in data.variables.items():
        for key in variable.ncattrs():
            if key != "_FillValue" and not NAME.match(key):
                yield f"{name}: attribute {key} has no CF name"


def lint_units(name, variable):
    units = attribute(variable, "units")
    if units is None:
        yield f"{name}: has no units"
    elif not valid_units(units):
        yield f"{name}: units '{units}' are not known to UDUNITS"


def lint_coordinate(name, variable):
    yield from lint_units(name, variable)
    if variable.dimensions != (name,):
        yield f"{name}: a coordinate variable has exactly the dimension of its name"
        return
    values = numpy.asarray(variable[:], dtype=float)
    steps = numpy.diff(values)
    if "_FillValue" in variable.ncattrs() or "missing_value" in variable.ncattrs():
        yield f"{name}: a coordinate variable must not have missing values"
    if not numpy.isfinite(values).all():
        yield f"{name}: holds values that are not finite"
    if not (steps > 0).all() and not (steps < 0).all():
        yield f"{name}: is not strictly monotonic"
    if not attribute(variable, "long_name") and not attribute(variable, "standard_name"):
        yield f"{name}: has neither long_name nor standard_name"
    if name in ("x", "y"):
        yield from lint_map_axis(name, variable, steps)
    relation = attribute(variable, "spp__relative_to_threshold")
    if name.endswith("threshold") and relation not in RELATIONS:
        yield f"{name}: spp__relative_to_threshold is {relation}, not one of {sorted(RELATIONS)}"


def lint_map_axis(name, variable, steps):
    # Local coordinates are of no projection, and CF has no standard name for them.
    projected = "crs" in variable.group().variables
    wanted = f"projection_{name}_coordinate" if projected else None
    if attribute(variable, "standard_name") != wanted:
        yield f"{name}: standard_name is not {wanted}"
    if attribute(variable, "units") not in ("m", "metre", "meter"):
        yield f"{name}: units are not metres"
    if attribute(variable, "axis") != name.upper():
        yield f"{name}: attribute axis is not {name.upper()}"
    if variable.dtype != numpy.float64:
        yield f"{name}: is {variable.dtype}, not float64 (map coordinates need the digits)"
    if len(steps) and not numpy.allclose(steps, steps.mean(), rtol=1e-6):
        yield f"{name}: is not evenly spaced"
    if len(steps) and (steps.mean() > 0) != (name == "x"):
        yield f"{name}: runs the wrong way (x eastward, y southward)"


def lint_map(name, variable, data, has_crs):
    yield from lint_units(name, variable)
    if not attribute(variable, "long_name") and not attribute(variable, "standard_name"):
        yield f"{name}: has neither long_name nor standard_name"
    if variable.dimensions[-2:] != ("y", "x"):
        yield f"{name}: dimensions {variable.dimensions} do not end in y, x"
    if attribute(variable, "standard_name") in ("latitude", "longitude"):
        return  # coordinates of cells (CF-1.10, 5.2) are not data on a grid, and miss nothing
    mapping = attribute(variable, "grid_mapping")
    if has_crs and mapping != "crs":
        yield f"{name}: grid_mapping is {mapping}, not crs"
    if mapping and mapping not in data.variables:
        yield f"{name}: grid_mapping names '{mapping}', which is not in the file"
    fill = attribute(variable, "_FillValue")
    if fill is None:
        yield f"{name}: has no _FillValue"
    elif numpy.issubdtype(variable.dtype, numpy.floating) and not numpy.isnan(fill):
        yield f"{name}: _FillValue is {fill}, not NaN"
    filters = variable.filters()
    if not (filters["zlib"] and filters["shuffle"] and filters["fletcher32"]):
        yield f"{name}: is not stored with shuffle, deflate and fletcher32"
    if filters["complevel"] != 1:
        yield f"{name}: deflate level is {filters['complevel']}, not 1"
    methods = attribute(variable, "cell_methods")
    if methods is not None:
        yield from lint_cell_methods(name, methods)
    if name.startswith("probability_of_") or "_exceedance" in name:
        yield from lint_probability(name, variable)


def lint_cell_methods(name, text):
    rest = re.sub(r"\([^)]*\)", "", text).strip()
    if not re.fullmatch(r"(?:(?:\w+: )+\w+(?: (?:within|over|where) \w+)*\s*)+", rest):
        yield f"{name}: cell_methods '{text}' is not of the form 'name: method'"
        return
    for method in re.findall(r": (\w+)(?!\w*:)", rest):
        if method not in CELL_METHODS:
            yield f"{name}: cell_methods '{text}': '{method}' is not a CF method"


def lint_probability(name, variable):
    if attribute(variable, "units") != "1":
        yield f"{name}: a probability has units 1"
    values = numpy.ma.masked_invalid(variable[:])
    if values.count() and (values.min() < 0 or values.max() > 1):
        yield f"{name}: probabilities reach from {values.min()} to {values.max()}"
    if name.endswith("_threshold") and not any(d.endswith("threshold")
                                               for d in variable.dimensions):
        yield f"{name}: has no threshold coordinate"


def lint_crs(variable):
    kind = attribute(variable, "grid_mapping_name")
    if kind is None:
        yield "crs: has no grid_mapping_name"
    elif kind not in GRID_MAPPINGS:
        yield f"crs: grid_mapping_name {kind} is not a projection of CF-1.10 known here"
    for name in sorted(GRID_MAPPINGS.get(kind, set()) | {"semi_major_axis", "inverse_flattening",
                                                         "crs_wkt", "GeoTransform"}):
        if attribute(variable, name) is None:
            yield f"crs: has no {name}"
    wkt = attribute(variable, "crs_wkt") or ""
    if not wkt.startswith(("PROJCRS[", "BOUNDCRS[")):
        yield "crs: crs_wkt is not the WKT2 of a projected system"
    if wkt.count("[") != wkt.count("]"):
        yield "crs: crs_wkt has unbalanced brackets"


def lint(path):
    """All findings of one file."""
    with netCDF4.Dataset(path) as data:
        data.set_auto_mask(False)
        yield from lint_file(data)
        has_crs = "crs" in data.variables
        if has_crs:
            yield from lint_crs(data.variables["crs"])
        maps = 0
        for name, variable in data.variables.items():
            if name in data.dimensions:
                yield from lint_coordinate(name, variable)
            elif variable.ndim >= 2:
                maps += 1
                yield from lint_map(name, variable, data, has_crs)
            elif name != "crs":
                yield from lint_units(name, variable)
        for name in ("x", "y"):
            if maps and name not in data.variables:
                yield f"{name}: the maps have no such coordinate"


def main(paths):
    if not paths:
        print(__doc__)
        return 2
    findings = [f"{path}: {finding}" for path in paths for finding in lint(path)]
    print("\n".join(findings) if findings else f"{len(paths)} file(s) without findings")
    return 1 if findings else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
