#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Neighbours mirrored in the tangent plane, where the ground bends.

A layer of n spacings lies in a hollow of radius R (in spacings; below zero: on a crest) under the
pressure p = (n - d)(1 + s/10), s along the bed. Pair sums as in the engine: h = 1.3 dx, image at
r' = r_ij + 2 d_j n_i, |r'|^2 = max(r^2 + 4 d_i d_j, (d_i + d_j)^2). Against them stands the layer
mirrored in the cylinder itself: every image at the radius R + d, volumes scaled with it. Printed is
the difference of the push per length of bed, over the normal push: along the normal, and along
the bed. Usage: mirror_on_bends.py
"""
import numpy as np

H = 1.3
C = 105 / (16 * np.pi * H**5) / 0.9789
HALF, WIDTH = 14, 3


def layer(n, radius):
    """Arc length, place across, distance to the bed of every grain, each [m], flattened."""
    s, y, d = np.meshgrid(np.arange(-HALF, HALF) + 0.5, np.arange(-WIDTH, WIDTH + 1),
                          np.arange(n) + 0.5, indexing="ij")
    return s.ravel(), y.ravel(), d.ravel(), (radius - d.ravel()) / radius


def place(s, y, d, radius):
    a, r = s / radius, radius - d
    return np.stack([r * np.sin(a), y, radius - r * np.cos(a)], 1)


def push(n, radius, exact):
    s, y, d, volume = layer(n, radius)
    x = place(s, y, d, radius)
    normal = np.stack([-np.sin(s / radius), 0 * s, np.cos(s / radius)], 1)
    tangent = np.stack([normal[:, 2], 0 * s, -normal[:, 0]], 1)
    pressure = (n - d) * (1 + 0.1 * s)
    inner = np.flatnonzero((y == 0) & (np.abs(s) < 9))
    mirrored = place(s, y, -d, radius)
    grown = volume * (radius + d) / (radius - d) if exact else volume
    out = np.zeros(2)
    for i in inner:
        r = x[i] - x
        if exact:
            away = x[i] - mirrored
            r2 = (away**2).sum(1)
        else:
            away = r + 2 * d[:, None] * normal[i]
            r2 = np.maximum((r**2).sum(1) + 4 * d[i] * d, (d[i] + d) ** 2)
        t = np.maximum(0, 1 - np.sqrt(r2) / (2 * H))
        f = C * volume[i] * grown * t**3 * (pressure[i] + pressure)
        total = (f[:, None] * away).sum(0)
        out += total @ normal[i], total @ tangent[i]
    return out / 18


def main():
    for n in (3, 4, 8):
        for radius in (1e6, 100, 50, 20, 10, -10, -20, -50, -100):
            if abs(radius) < 2 * n:
                continue
            plane, curved = push(n, radius, False), push(n, radius, True)
            off = (plane - curved) / curved[0]
            print(f"{n} layers, R {radius:9.0f} dx: normal {off[0]:+.4f}, along {off[1]:+.5f}")


if __name__ == "__main__":
    main()
