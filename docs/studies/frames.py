# SPDX-License-Identifier: Apache-2.0
"""Reads the ParaView frames that `sturz run --particles` writes."""
import re

import numpy as np

KINDS = {"Float32": "<f4", "Float64": "<f8", "UInt32": "<u4", "Int64": "<i8"}


def frame(path, names):
    """Time [s] and the named arrays of one frame, a row a particle; vectors have three columns."""
    head, _, tail = path.read_bytes().partition(b'<AppendedData encoding="raw">')
    tail, text = tail[tail.index(b"_") + 1:], head.decode()
    arrays = []
    for name in names:
        kind, components, at = re.search(rf'type="(\w+)" Name="{name}" NumberOfComponents="(\d)"[^>]*offset="(\d+)"', text).groups()
        size = int(np.frombuffer(tail, "<u8", 1, int(at))[0])
        values = np.frombuffer(tail[int(at) + 8:int(at) + 8 + size], KINDS[kind])
        arrays.append(values.reshape(-1, 3) if components == "3" else values)
    return float(re.search(r'Name="TimeValue"[^>]*>([^<]+)<', text)[1]), arrays


def frames(folder, liquid=False):
    """All frames of the grains, or of the liquid, in the order of time: paths."""
    return sorted(folder.glob("particles_liquid_*.vtp" if liquid else "particles_[0-9]*.vtp"))
