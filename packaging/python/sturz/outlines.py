# SPDX-License-Identifier: Apache-2.0
"""Outlines of cells of a map."""
from __future__ import annotations

from typing import Any

from .results import need


def cells_at_least(plane: Any, level: float) -> Any | None:
    """Union of the cells of a map [y, x] whose value is at least ``level``; None without any.

    Neighbours in a row are one box before the union: a map of a million cells takes seconds.
    """
    numpy = need("numpy", "Outlines")
    need("shapely", "Outlines")
    from shapely.geometry import box
    from shapely.ops import unary_union
    x, y = numpy.asarray(plane["x"], float), numpy.asarray(plane["y"], float)
    half = abs(x[1] - x[0]) / 2 if len(x) > 1 else abs(y[1] - y[0]) / 2
    # As the map's own numbers: 0.95 of a map in single precision is a little less. NaN is not.
    inside = numpy.asarray(plane) >= level
    boxes = []
    for row, north in zip(inside, y):
        edges = numpy.flatnonzero(numpy.diff(numpy.concatenate(([False], row, [False])).astype(int)))
        boxes += [box(x[first] - half, north - half, x[end - 1] + half, north + half)
                  for first, end in zip(edges[::2], edges[1::2])]
    return unary_union(boxes) if boxes else None
