# SPDX-License-Identifier: Apache-2.0
"""Does it pay to flatten particles and smoothing kernel along the bed's normal?

usage: flattened_particles.py CASE [OUT.jsonl [LAYERS,...]]
CASE: lattice sheet load cap column bend swing steps
A row per run, printed and appended to OUT as JSON. Needs numpy; scheme in flattened_scheme.py.
`ratio` is dx/dz, `layers` those of dz in the greatest thickness.
"""
import json
import sys

import numpy as np
from flattened_scheme import G9, RHO, Bend, Flow, Plane, lattice_constant

OUT, ONLY = None, None
# Ratio dx/dz and how the artificial viscosity acts, see Flow.sums.
KINDS = ((1, "central"), (2, "central"), (3, "central"), (2, "gradient"), (3, "gradient"))


def chosen(layers):
    return [n for n in layers if ONLY is None or n in ONLY]


def row(**values):
    clean = {k: float(f"{v:.5g}") if isinstance(v, float) else v for k, v in values.items()}
    print(json.dumps(clean), flush=True)
    if OUT:
        with open(OUT, "a") as f:
            f.write(json.dumps(clean) + "\n")


def tan(deg):
    return float(np.tan(np.radians(deg)))


def fill(width, height, dx, dz, left):
    """Lattice points under height(x) along [left, left + width]."""
    columns = int(round(width / dx))
    x, z = np.meshgrid(left + (np.arange(columns) + 0.5) * dx, (np.arange(1000) + 0.5) * dz)
    inside = z < height(x)
    return x[inside], z[inside]


def books(flow, released):
    """Energy that pair forces and stress power do not agree on, and clumps."""
    near = flow.nearest()
    return dict(particles=flow.n, steps=flow.steps, created=flow.work["created"] / released,
                viscous=flow.work["viscous"] / released, clumps=float(np.mean(near < 0.5)),
                nearest=float(np.percentile(near, 1)))


# (a) ---------------------------------------------------------------------------------------------
def lattice():
    """Thrust of a lattice layer under hydrostatic pressure, and what a turned metric makes of it."""
    for ratio in (1, 2, 3):
        for layers in (1, 2, 3, 4, 6, 8):
            row(case="thrust", ratio=ratio, layers=layers, thrust=thrust(ratio, layers, 0),
                without_images=thrust(ratio, layers, 0, images=False))
        for turned in (10, 20, 30):
            low, high = interior_moment(ratio, turned)
            row(case="turned", ratio=ratio, turned=turned, thrust=thrust(ratio, 4, turned),
                pressure_gradient_low=low, pressure_gradient_high=high)
        for layers in (4, 8):
            for radius in (2, 4):
                row(case="arc", ratio=ratio, layers=layers, radius=radius,
                    **arc_at_rest(ratio, layers, radius))


def static_flow(ratio, layers, width=24, turned=0):
    dz = 1.0 / layers
    x, z = fill(width * ratio * dz, lambda x: 1 + 0 * x, ratio * dz, dz, 0)
    f = Flow(x, z, ratio * dz, dz, Plane(), 0, 0, 30.0, period=width * ratio * dz)
    if turned:
        a = np.radians(turned)
        true = f.metric
        f.metric = lambda nx, nz: true(nx + np.sin(a), nz - 1 + np.cos(a))
        f.bed.flat = False
    f.find()
    return f


def thrust(ratio, layers, turned, images=True):
    """Force of a pressure p(z) x per length, summed over the layers, of what it should be [-]."""
    f = static_flow(ratio, layers, turned=turned)
    f.mirror_state(f.vx, f.vz)
    p, total = 1 - f.z, 0.0
    for nb in f.lists[:2 if images else 1]:
        rx, _, ax, _, w = f.pairs(nb)
        total += np.sum(w * ax * rx * f.mirrored(p)[nb])
    return float(total / np.sum(p))


def interior_moment(ratio, turned):
    """Eigenvalues of the moment matrix inside a lattice that the metric is turned against."""
    a = np.radians(turned)
    k = np.arange(-12, 13)
    x, z = (c.ravel() for c in np.meshgrid(k * ratio / 1.3, k / 1.3))
    u, v = (x * np.cos(a) + z * np.sin(a)) / ratio, z * np.cos(a) - x * np.sin(a)
    w = lattice_constant() / 1.69 * np.maximum(0, 1 - 0.5 * np.hypot(u, v))**3
    m = np.array([[np.sum(w * u * u), np.sum(w * u * v)], [np.sum(w * u * v), np.sum(w * v * v)]])
    low, high = np.linalg.eigvalsh(m)
    return float(low), float(high)


def arc_at_rest(ratio, layers, radius):
    """Even pressure p over a hollow arc of 30 degrees: forces that should be none, in p/H."""
    dz, dx = 1.0 / layers, ratio / layers
    bed = Bend(-30, radius)
    # Each layer has its own even spacing: inside the arc it is shorter than the bed by 1 - d/R.
    s, d = [], []
    for layer in (np.arange(layers) + 0.5) * dz:
        along, arc = np.arange(-4 + dx / 2, 4 + radius, dx), (radius - layer) * np.radians(30)
        s.append(np.where(along < 0, along, np.where(along < arc, along * radius / (radius - layer),
                                                     along - arc + radius * np.radians(30))))
        d.append(0 * along + layer)
    s, d = np.concatenate(s), np.concatenate(d)
    x, z = bed.place(s, d)
    f = Flow(x, z, dx, dz, bed, 0, 0, 30.0)
    f.e += 1 / f.bulk
    f.find()
    f.mirror_state(f.vx, f.vz)
    force = [sum(a) for a in zip(*(f.sums(nb, f.vx, f.vz)[0] for nb in f.lists))]
    along = force[0] * f.nz - force[1] * f.nx
    inner = (s > -3 * dx) & (s < radius * 0.53 + 3 * dx) & (d < 1 - 2.6 * dz)
    if not inner.any():
        inner = (s > -3 * dx) & (s < radius * 0.53 + 3 * dx)
    normal = force[0] * f.nx + force[1] * f.nz
    return dict(along_rms=float(np.sqrt(np.mean(along[inner]**2))), along_mean=float(np.mean(along[inner])),
                normal_rms=float(np.sqrt(np.mean(normal[inner]**2))) if layers > 4 else None)


# (b) ---------------------------------------------------------------------------------------------
def sheet():
    """V1: periodic sheet of 1 m on 30 degrees over tan 25, acceleration over two seconds."""
    exact = G9 * (0.5 - tan(25) * np.cos(np.radians(30)))
    for ratio, kind in KINDS:
        for layers in chosen((1, 2, 3, 4, 6)):
            dz = 1.0 / layers
            x, z = fill(8 * ratio * dz, lambda x: 1 + 0 * x, ratio * dz, dz, 0)
            f = Flow(x, z, ratio * dz, dz, Plane(30), tan(35), tan(25), 31.0, period=8 * ratio * dz,
                     viscosity=kind)
            f.load(RHO * G9 * np.cos(np.radians(30)) * (1 - z), 0.5, 0.5, 0)
            start = f.potential()
            f.run(2)
            before, steps = f.vx.mean(), f.steps
            f.run(4)
            rate = (f.vx.mean() - before) / ((f.steps - steps) * f.dt)
            row(case="sheet", viscosity=kind, ratio=ratio, layers=layers, error=float(rate / exact - 1),
                **books(f, start - f.potential()))


# (c) ---------------------------------------------------------------------------------------------
def earth_pressure(mu, bed_mu):
    """Active K at the bed of a plane-strain cone tau = mu p, sin(phi) = mu (Savage and Hutter 1989)."""
    cos2 = 1 - mu * mu
    return 2 * (1 - np.sqrt(max(0, 1 - (1 + bed_mu**2) * cos2))) / cos2 - 1


def similarity(a, mass, k, end, slope):
    """Half-length at the end; mass/rho = (4/3) a h at any time."""
    rate, dt = 0.0, 1e-3
    for _ in range(int(round(end / dt))):
        rate += dt * 2 * k * G9 * np.cos(slope) * 0.75 * mass / RHO / (a * a)
        a += dt * rate
    return a


def cap_flow(ratio, layers, angle=30.0, speed=None, **options):
    """The parabola at rest, at active yield. Returns flow, half-length, K."""
    bed_mu, mu = tan(25), tan(angle)
    dz, dx, start = 4.0 / layers, 4.0 / layers * ratio, 80.0
    height = lambda x: 4 * (1 - (x / start)**2)
    x, z = fill(2 * np.ceil(start / dx) * dx, height, dx, dz, -np.ceil(start / dx) * dx)
    f = Flow(x, z, dx, dz, Plane(35), mu, bed_mu, speed or 10 * np.sqrt(4 * G9), **options)
    k = earth_pressure(mu, bed_mu)
    weight = RHO * G9 * np.cos(np.radians(35)) * np.maximum(0, height(x) - z)
    f.load(weight, k, 0.5 * (1 + k), bed_mu)
    return f, float(np.sqrt(5 * (np.var(x) + dx * dx / 12))), k


def load():
    """The bed's load over the weight above it, against the slope of the surface; seconds 1 to 5."""
    f, half, _ = cap_flow(1, 5, 25.0)
    f.run(1)
    total, steps = np.zeros(f.n), 0
    while f.steps * f.dt < 5:
        f.step()
        total, steps = total + f.load_of_bed, steps + 1
        if f.steps * f.dt < 3:
            place = f.x - f.x.mean()
    edges = np.linspace(-70, 70, 15)
    pressed, count = np.histogram(place, edges, weights=total / steps)[0], np.histogram(place, edges)[0]
    inner = slice(1, -1)
    slope = -8 * 0.5 * (edges[1:] + edges[:-1]) / half**2
    fit = np.polyfit(slope[inner], (pressed / (count * G9 * np.cos(np.radians(35))))[inner], 1)
    row(case="load", by_slope=float(fit[0]), expected=-tan(25), even=float(fit[1]))


def cap_run(ratio, layers, angle=30.0, end=10.0, speed=None, **options):
    f, first, k = cap_flow(ratio, layers, angle, speed, **options)
    slope, bed_mu, dx, released = np.radians(35), tan(25), f.dx, f.potential()
    f.run(end)
    spread = float(np.sqrt(5 * (np.var(f.x) + dx * dx / 12)))
    exact = float(similarity(first, f.n * f.mass, k, end, slope))
    travel = 0.5 * G9 * (np.sin(slope) - bed_mu * np.cos(slope)) * end**2
    centre, share = float(f.x.mean()), 0.8822  # 99 % of a parabola lie behind
    front = float(np.quantile(f.x, 0.99))
    row(case="cap", angle=angle, ratio=ratio, layers=layers, k=float(k), half=spread / exact - 1,
        growth=(spread - first) / (exact - first), x99=front / (travel + share * exact) - 1,
        front=float(f.x.max() + dx / 2 - centre) / exact - 1,
        tail=float(centre - f.x.min() + dx / 2) / exact - 1,
        centre=centre / travel - 1, **options, c0=float(f.c0), **books(f, released - f.potential()))


def cap():
    for layers in chosen((2, 3, 4, 6, 8, 12)):
        for angle in (30.0, 25.0):
            for ratio, kind in KINDS:
                cap_run(ratio, layers, angle, viscosity=kind)
    for ratio, kind in KINDS if chosen((4,)) else ():
        cap_run(ratio, 4, viscosity=kind, alpha=0.02)
        cap_run(ratio, 4, viscosity=kind, speed=188.0)


# (d) ---------------------------------------------------------------------------------------------
def column_run(aspect, ratio, layers, **options):
    """Both halves of a column 1 m high, half-width 1/aspect, over a bed of 0.5; grains of 0.45."""
    dz, dx, half = 1.0 / layers, ratio / layers, 1.0 / aspect
    count = max(1, int(round(2 * half / dx)))
    x, z = fill(count * dx, lambda x: 1 + 0 * x, dx, dz, -count * dx / 2)
    f = Flow(x, z, dx, dz, Plane(), 0.45, 0.5, 10 * np.sqrt(G9), **options)
    f.load(RHO * G9 * (1 - z), 0.43, 0.43, 0)
    released = f.potential()
    f.run(1.6)
    x0, rms = count * dx / 2, np.sqrt(np.var(f.x) + dx * dx / 12)
    middle = np.abs(f.x) < 0.1 + dx / 2
    row(case="column", **options, aspect=aspect, ratio=ratio, layers=layers, width=x0, rms=float(rms) / x0,
        x99=float(np.quantile(np.abs(f.x), 0.99)) / x0, front=float(np.max(np.abs(f.x)) + dx / 2) / x0,
        height=float(f.z[middle].max() + dz / 2), centre=float(f.z.mean()),
        speed=float(np.sqrt(2 * f.kinetic() / f.mass / f.n)),
        **books(f, released - f.potential()))


def column():
    for layers in chosen((4, 6, 8, 12, 16, 24)):
        for aspect in (0.5, 1.0):
            for ratio, kind in KINDS if layers < 24 else KINDS[:1]:
                column_run(aspect, ratio, layers, viscosity=kind)


# (e) ---------------------------------------------------------------------------------------------
def bend_run(turn, radius, ratio, layers, turning=True, **options):
    """A sheet of 8 x 1 m comes with 6 m/s over a bend of 30 degrees, down to level or over an edge.

    turning:   whether the metric turns with the ground, else it stays that of the start
    """
    dz, dx, hollow = 1.0 / layers, ratio / layers, turn < 0
    bed = Bend(turn, radius)
    columns, arc = int(round(8 / dx)), radius * np.radians(abs(turn))
    s, d = (c.ravel() for c in np.meshgrid((np.arange(columns) + 0.5) * dx, (np.arange(layers) + 0.5) * dz))
    s = arc + 0.5 + s if hollow else -0.5 - 8 + s
    x, z = bed.place(s, d)
    f = Flow(x, z, dx, dz, bed, tan(35), 0.3, 60.0, **options)
    if not turning:
        first = np.radians(30) if hollow else 0.0
        metric = f.metric
        f.metric = lambda nx, nz: metric(0 * nx + np.sin(first), 0 * nz + np.cos(first))
    _, nx, nz = bed.at(x, z)
    f.vx, f.vz = 6 * nz, -6 * nx
    weight = RHO * G9 * (np.cos(np.radians(30)) if hollow else 1.0)
    f.load(weight * (1 - d), 0.5, 0.5, 0)
    if hollow:  # the stress of the slope's frame, turned
        b = np.radians(30)
        mean, half = 0.5 * (f.sxx + f.szz), 0.5 * (f.sxx - f.szz)
        f.sxx, f.szz = mean + half * np.cos(2 * b), mean - half * np.cos(2 * b)
        f.sxz = -half * np.sin(2 * b)
    start, moving = f.potential(), f.kinetic()
    f.run(2.5)
    released = start - f.potential() + moving
    _, nx, nz = bed.at(f.x, f.z)
    near, fx = f.d, f.x
    row(case="bend", turn=turn, radius=radius, ratio=ratio, layers=layers, turning=turning, **options,
        centre=float(fx.mean()), fall=float(-f.z.mean()), rms=float(fx.std()),
        speed=float(np.mean(np.hypot(f.vx, f.vz))),
        thickness=float(np.quantile(near, 0.95) + dz / 2),
        lost=float(f.work["bed"] / released), **books(f, released))


def bend():
    for layers in chosen((4, 8, 12)):
        for turn in (-30, 30):
            for ratio, kind in KINDS if layers < 12 else KINDS[:1]:
                bend_run(turn, 2.0, ratio, layers, viscosity=kind)
                if ratio > 1 and layers == 8:
                    bend_run(turn, 2.0, ratio, layers, turning=False, viscosity=kind)


# (f) ---------------------------------------------------------------------------------------------
def swing():
    """A bonded disc turns once, metric fixed: what it keeps of spin and kinetic energy."""
    for ratio, kind in KINDS:
        dx, dz, rate = ratio / 8, 1 / 8, 1.0
        x, z = (c.ravel() for c in np.meshgrid(np.arange(-30, 31) * dx, (np.arange(-30, 30) + 0.5) * dz))
        inside = x * x + z * z < 1
        f = Flow(x[inside], z[inside] + 100, dx, dz, Plane(), 0, 0, 30.0, viscosity=kind, bonded=True)
        f.bed.gravity = (0.0, 0.0)
        f.vx, f.vz = rate * z[inside], -rate * x[inside]
        spin = lambda: np.sum((f.z - f.z.mean()) * f.vx - (f.x - f.x.mean()) * f.vz)
        first, energy = spin(), f.kinetic()
        for turned in (22.5, 45, 67.5, 90, 180):
            f.run(np.radians(turned) / rate)
            near = f.nearest()
            row(case="swing", ratio=ratio, viscosity=kind, turned=turned, spin=float(spin() / first),
                kinetic=float(f.kinetic() / energy), created=float(f.work["created"] / energy),
                viscous=float(f.work["viscous"] / energy), nearest=float(near.min()))
            if near.min() < 0.4:  # torn
                break


# (g) ---------------------------------------------------------------------------------------------
def steps():
    """Longest stable step of a layer at rest: what sound binds. Courant numbers of hz and hx."""
    for ratio, kind in KINDS:
        for courant in (0.25, 0.4, 0.5, 0.6, 0.75, 1.0):
            dz = 0.25
            x, z = fill(8 * ratio * dz, lambda x: 1 + 0 * x, ratio * dz, dz, 0)
            f = Flow(x, z, ratio * dz, dz, Plane(), 0.6, 0.5, 31.0, period=8 * ratio * dz, viscosity=kind)
            f.dt *= courant / 0.25
            f.load(RHO * G9 * (1 - z), 0.5, 0.5, 0)
            f.vx[::3] += 0.01
            largest = 0.0
            with np.errstate(all="ignore"):
                while f.steps * f.dt < 1 and largest < 100 and np.isfinite(f.vx).all():
                    f.step()
                largest = float(np.sqrt(np.mean(f.vx**2 + f.vz**2)))
            row(case="steps", viscosity=kind, ratio=ratio, courant_dz=courant, courant_dx=courant / ratio,
                speed=largest if np.isfinite(largest) else 1e9)


if __name__ == "__main__":
    OUT = sys.argv[2] if len(sys.argv) > 2 else None
    ONLY = [int(n) for n in sys.argv[3].split(",")] if len(sys.argv) > 3 else None
    globals()[sys.argv[1]]()
