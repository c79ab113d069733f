# SPDX-License-Identifier: Apache-2.0
"""Plane-strain prototype of full stress whose smoothing kernel and particles may be flattened.

Scheme: docs/physics.md B.1 to B.5, decisions 0011 and 0018, with neighbours mirrored in the bed (S1)
in place of the closed form of B.10. Left out: mu(I) (constant friction), drag at rest, states.
A metric A = R^T diag(1/hx^2, 1/hz^2) R per particle, turned with the bed, measures distances:
q^2 = r.A r, grad W = -C t^3 A r. SI units; arrays are (N,) per particle, (N, K) per pair.
"""
import numpy as np

RHO, G9 = 1500.0, 9.81
SKIN = 0.3  # of the neighbour lists, in smoothing lengths


def lattice_constant():
    """C hx hz for which sum V r (x) grad W is the identity on a lattice of spacing h/1.3."""
    k = np.arange(-3, 4) / 1.3
    x, z = np.meshgrid(k, k)
    t = np.maximum(0, 1 - 0.5 * np.hypot(x, z))
    return 1 / np.sum(t**3 * x * x / 1.69)


class Plane:
    """The half space z > 0; gravity points down a slope."""

    def __init__(self, slope_deg=0.0):
        a = np.radians(slope_deg)
        self.gravity = (G9 * np.sin(a), -G9 * np.cos(a))
        self.flat = True

    def at(self, x, z):
        return z, np.zeros_like(x), np.ones_like(x)


class Bend:
    """Ground that turns by an angle on an arc: slope to level (turn < 0) or level to slope (> 0)."""

    def __init__(self, turn_deg, radius):
        self.beta, self.radius, self.hollow = np.radians(abs(turn_deg)), radius, turn_deg < 0
        self.gravity, self.flat = (0.0, -G9), False

    def at(self, x, z):
        """Distance and unit normal (N,) each."""
        r, b = self.radius, self.beta
        side = -1.0 if self.hollow else 1.0  # of the sloping part along x
        angle = np.clip(np.arctan2(side * x, side * z + r), 0, b)
        # Normal of both kinds: (sin, cos) of the angle, as the slope falls towards +x.
        nx, nz = np.sin(angle), np.cos(angle)
        fx, fz = side * r * np.sin(angle), side * r * (np.cos(angle) - 1)
        return (x - fx) * nx + (z - fz) * nz, nx, nz

    def place(self, s, d):
        """Points at path s from the level end of the arc (positive on the slope side) and height d."""
        r, b, side = self.radius, self.beta, -1.0 if self.hollow else 1.0
        s = np.asarray(s, float)
        angle = np.clip(s / r, 0, b)
        fx, fz = side * r * np.sin(angle), side * r * (np.cos(angle) - 1)
        rest = np.where(s < 0, s, np.maximum(s - r * b, 0)) * side
        return (fx + rest * np.cos(angle) + d * np.sin(angle),
                fz - rest * np.sin(angle) + d * np.cos(angle))


class Flow:
    """mu, bed_mu: friction inside (tau <= mu p) and of the bed; period: along x, or None"""

    def __init__(self, x, z, dx, dz, bed, mu, bed_mu, c0, period=None, alpha=0.1, viscosity="central",
                 bonded=False):
        self.x, self.z, self.dx, self.dz, self.bed = x.astype(float), z.astype(float), dx, dz, bed
        self.hx, self.hz, self.mu, self.bed_mu, self.c0 = 1.3 * dx, 1.3 * dz, mu, bed_mu, c0
        self.period, self.alpha, self.kind, self.bonded = period, alpha, viscosity, bonded
        n = self.n = len(x)
        self.v0, self.mass = dx * dz, RHO * dx * dz
        self.vx, self.vz, self.px, self.pz = np.zeros((4, n))
        self.e, self.sxx, self.szz, self.syy, self.sxz = np.zeros((5, n))
        self.acting, self.carried = np.ones(n), np.zeros(n)
        self.shear_ratio = 3 * (1 - 0.6) / (2 * 1.3)
        self.bulk = RHO * c0 * c0 / (1 + 4 / 3 * self.shear_ratio)
        self.shear = self.shear_ratio * self.bulk
        self.dt = 0.25 * self.hz / (1.1 * c0)
        self.const = lattice_constant()
        self.depth = max(np.ptp(z), dz)
        self.spring = 10 * G9 * self.depth / dz**2
        self.eta = self.uniform_shear_viscosity()
        self.built, self.steps = None, 0
        self.work = dict(created=0.0, viscous=0.0, bed=0.0, plastic=0.0, other=0.0)

    # Stress at the start -------------------------------------------------------------------------
    def load(self, sigma_zz, ratio_xx, ratio_yy, ratio_xz):
        """Compressive sigma_zz (N,) and the other components as shares of it."""
        p = sigma_zz * (1 + ratio_xx + ratio_yy) / 3
        self.e = p / self.bulk
        self.sxx, self.szz = p - ratio_xx * sigma_zz, p - sigma_zz
        self.syy, self.sxz = p - ratio_yy * sigma_zz, ratio_xz * sigma_zz

    # Metric --------------------------------------------------------------------------------------
    def metric(self, nx, nz):
        """A of each particle by the normal of its ground: xx, xz, zz."""
        a, b = 1 / self.hx**2, 1 / self.hz**2
        return a * nz * nz + b * nx * nx, (b - a) * nx * nz, a * nx * nx + b * nz * nz

    def wrap(self, r):
        return r if self.period is None else r - self.period * np.round(r / self.period)

    def uniform_shear_viscosity(self):
        """What the artificial viscosity is in shear along the bed, on a lattice [Pa s]."""
        k = np.arange(-3, 4)
        x, z = (c.ravel() for c in np.meshgrid(k * self.dx, k * self.dz))
        t = np.maximum(0, 1 - 0.5 * np.hypot(x / self.hx, z / self.hz))
        w = self.const / (self.hx * self.hz) * self.v0 * t**3
        if self.kind == "central":
            pull = x * z / (x * x + z * z + 0.01 * self.hz**2) * x / self.hz**2
        else:
            ax = x / self.hx**2
            pull = ax * z / ((x / self.hx)**2 + (z / self.hz)**2 + 0.01) * ax
        return 0.5 * self.alpha * self.c0 * self.hz * RHO * np.sum(w * pull * z)

    # Neighbours ----------------------------------------------------------------------------------
    def candidates(self):
        """Ordered pairs (i, j), i == j included, that are near enough along x."""
        reach = (2 + SKIN) * max(self.hx, self.hz)
        if self.period is not None:
            i, j = np.divmod(np.arange(self.n**2), self.n)
            return i, j
        order = np.argsort(self.x, kind="stable")
        xs = self.x[order]
        count = np.searchsorted(xs, xs + reach, side="right") - np.arange(self.n)
        a = np.repeat(np.arange(self.n), count)
        b = a + np.arange(len(a)) - np.repeat(np.cumsum(count) - count, count)
        i, j = order[a], order[b]
        other = i != j
        return np.concatenate([i, j[other]]), np.concatenate([j, i[other]])

    def table(self, i, j):
        """Rows of neighbours (N, K), filled up with the index of the particle that is nowhere."""
        order = np.lexsort((j, i))
        i, j = i[order], j[order]
        count = np.bincount(i, minlength=self.n)
        out = np.full((self.n, max(1, count.max())), 2 * self.n)
        out[i, np.arange(len(i)) - np.repeat(np.cumsum(count) - count, count)] = j
        return out

    def images(self):
        d, nx, nz = self.bed.at(self.x, self.z)
        self.d, self.nx, self.nz = d, nx, nz
        self.all_x = np.concatenate([self.x, self.x - 2 * d * nx, [1e9]])
        self.all_z = np.concatenate([self.z, self.z - 2 * d * nz, [1e9]])
        self.a = self.metric(nx, nz)
        if not self.bed.flat:
            self.all_a = [np.concatenate([c, c, [1.0]]) for c in self.a]

    def find(self):
        self.images()
        i, j = self.candidates()
        rows = []
        for shift in (0, self.n):
            rx, rz = self.wrap(self.x[i] - self.all_x[j + shift]), self.z[i] - self.all_z[j + shift]
            xx, xz, zz = (0.5 * (c[i] + c[j]) for c in self.a)
            near = xx * rx * rx + 2 * xz * rx * rz + zz * rz * rz < (2 + SKIN)**2
            if shift == 0:
                near &= i != j
            rows.append(self.table(i[near], j[near] + shift))
        self.lists = rows
        self.built = self.x.copy(), self.z.copy()

    def stale(self):
        if self.built is None:
            return True
        ux, uz = self.x - self.built[0], self.z - self.built[1]
        if self.bed.flat:
            ux, uz = (ux - ux.mean()) / self.hx, (uz - uz.mean()) / self.hz
        else:
            ux, uz = ux / self.hz, uz / self.hz
        return np.max(ux * ux + uz * uz) > (0.5 * SKIN)**2

    # Sums ----------------------------------------------------------------------------------------
    def pairs(self, nb):
        """r, A r and V_j C t^3 of a table of neighbours."""
        rx, rz = self.wrap(self.x[:, None] - self.all_x[nb]), self.z[:, None] - self.all_z[nb]
        if self.bed.flat:
            ax, az = rx / self.hx**2, rz / self.hz**2
            scale = self.const / (self.hx * self.hz)
        else:
            xx, xz, zz = (0.5 * (own[:, None] + c[nb]) for own, c in zip(self.a, self.all_a))
            ax, az = xx * rx + xz * rz, xz * rx + zz * rz
            scale = self.const * np.sqrt(xx * zz - xz * xz)
        t = np.maximum(0, 1 - 0.5 * np.sqrt(rx * ax + rz * az))
        return rx, rz, ax, az, t * t * t * self.all_v[nb] * scale

    def pressure(self):
        """Of grains that only press, or of a bonded solid that also pulls."""
        return self.bulk * (self.e if self.bonded else np.maximum(0, self.e))

    def mirrored(self, f):
        return np.concatenate([f, f, [0.0]])

    def mirror_state(self, vx, vz):
        """Images: velocity and stress reflected in the bed (it slips), volume as it is."""
        nx, nz, zero = self.nx, self.nz, [0.0]
        vn = vx * nx + vz * nz
        self.all_vx = np.concatenate([vx, vx - 2 * vn * nx, zero])
        self.all_vz = np.concatenate([vz, vz - 2 * vn * nz, zero])
        p, left = self.pressure(), 1 - self.carried
        s = self.force_stress = left * self.sxx - p, left * self.szz - p, left * self.sxz
        cc, ss = nz * nz - nx * nx, -2 * nx * nz  # reflection: [[cc, ss], [ss, -cc]]
        gxx = cc * cc * s[0] + 2 * cc * ss * s[2] + ss * ss * s[1]
        gzz = ss * ss * s[0] - 2 * cc * ss * s[2] + cc * cc * s[1]
        gxz = cc * ss * (s[0] - s[1]) + (ss * ss - cc * cc) * s[2]
        self.all_s = [np.concatenate([a, b, zero]) for a, b in zip(s, (gxx, gzz, gxz))]
        self.all_v = self.mirrored(self.v0 / (1 + np.maximum(self.e, -0.02)))
        self.all_f = self.mirrored(self.acting)

    def sums(self, nb, vx, vz):
        """Stress force, viscous force (times rho), velocity gradient and moment matrix."""
        rx, rz, ax, az, w = self.pairs(nb)
        ux, uz = vx[:, None] - self.all_vx[nb], vz[:, None] - self.all_vz[nb]
        dx, dz = w * ax, w * az
        sxx, szz, sxz = (own[:, None] + c[nb] for own, c in zip(self.force_stress, self.all_s))
        total = lambda a, b: np.einsum("nk,nk->n", a, b)
        force = -total(sxx, dx) - total(sxz, dz), -total(sxz, dx) - total(szz, dz)
        k = self.alpha * self.c0 * self.hz * RHO * 0.5 * (self.acting[:, None] + self.all_f[nb])
        if self.kind == "central":
            q = k * w * (ux * rx + uz * rz) / (rx * rx + rz * rz + 0.01 * self.hz**2) / self.hz**2
            drag = -total(q, rx), -total(q, rz)
        else:
            q = k * w * (ux * ax + uz * az) / (rx * ax + rz * az + 0.01)
            drag = -total(q, ax), -total(q, az)
        grad = total(ux, dx), total(ux, dz), total(uz, dx), total(uz, dz)
        moment = total(rx, dx), total(rx, dz), total(rz, dx), total(rz, dz)
        return force, drag, grad, moment, (rx, rz, dx, dz, w)

    @staticmethod
    def inverse(m):
        """Of the moment matrix, the identity where it is poor (B.3); det and trace know no metric."""
        xx, xz, zx, zz = m
        det, half = xx * zz - xz * zx, 0.5 * (xx + zz)
        least = half - np.sqrt(np.maximum(0, half * half - det))
        good = (det > 0.15) & (least > 0.2)
        inv = 1 / np.where(good, det, 1)
        whole = (zz * inv, 1), (-xz * inv, 0), (-zx * inv, 0), (xx * inv, 1)
        return [np.where(good, a, b) for a, b in whole]

    @staticmethod
    def times(g, b):
        """Sum of u (x) dW over -r (x) dW: both have the same sign, so L = g b."""
        return (g[0] * b[0] + g[1] * b[2], g[0] * b[1] + g[1] * b[3],
                g[2] * b[0] + g[3] * b[2], g[2] * b[1] + g[3] * b[3])

    def diffused(self, nb, own, m):
        """Density diffusion (B.2), the particle's own linear part taken off; real neighbours only."""
        rx, rz, dx, dz, w = own
        de = self.mirrored(self.e)[nb] - self.e[:, None]
        de[nb == 2 * self.n] = 0
        b = self.inverse(m)
        gx, gz = -np.einsum("nk,nk->n", de, dx), -np.einsum("nk,nk->n", de, dz)
        ex, ez = gx * b[0] + gz * b[2], gx * b[1] + gz * b[3]
        linear = de + rx * ex[:, None] + rz * ez[:, None]
        linear[nb == 2 * self.n] = 0
        return 0.2 * self.c0 / self.hz * np.einsum("nk,nk->n", w, linear)

    # Step ----------------------------------------------------------------------------------------
    def step(self):
        if self.stale():
            self.find()
        else:
            self.images()
        dt = self.dt
        vx, vz = (2 * self.vx - self.px, 2 * self.vz - self.pz) if self.steps else (self.vx, self.vz)
        self.mirror_state(vx, vz)
        real = self.sums(self.lists[0], vx, vz)
        image = self.sums(self.lists[1], vx, vz)
        density = RHO * (1 + np.maximum(self.e, -0.02))
        fx, fz = ((real[0][c] + image[0][c]) / density for c in (0, 1))
        qx, qz = ((real[1][c] + image[1][c]) / density for c in (0, 1))
        wall = [(image[0][c] + image[1][c]) / density for c in (0, 1)]
        gradient = self.times([a + b for a, b in zip(real[2], image[2])],
                              self.inverse([a + b for a, b in zip(real[3], image[3])]))
        diffusion = self.diffused(self.lists[0], real[4], real[3])
        self.px, self.pz = self.vx, self.vz
        gx, gz = self.bed.gravity
        kick_x, kick_z = self.vx + dt * (fx + qx + gx), self.vz + dt * (fz + qz + gz)
        mx, mz = 0.5 * (self.vx + kick_x), 0.5 * (self.vz + kick_z)
        pair_work = self.mass * dt * np.sum(fx * mx + fz * mz)
        self.work["viscous"] += self.mass * dt * np.sum(qx * mx + qz * mz)
        self.vx, self.vz = self.contact(kick_x, kick_z, wall)
        self.work["created"] += pair_work + self.update(gradient, diffusion)
        self.x, self.z = self.x + dt * self.vx, self.z + dt * self.vz
        self.steps += 1

    def contact(self, vx, vz, wall):
        """Spring at half a spacing and Coulomb friction on every normal impulse (B.10)."""
        dt, nx, nz = self.dt, self.nx, self.nz
        vn = vx * nx + vz * nz
        overlap = np.maximum(0, 0.5 * self.dz - self.d)
        push = np.maximum(0, self.spring * overlap - 0.6 * np.sqrt(self.spring) * vn)
        push = np.where(overlap > 0, push, 0)
        self.load_of_bed = np.maximum(0, push + wall[0] * nx + wall[1] * nz)  # per mass
        impulse = dt * self.load_of_bed
        vn2 = vn + dt * push
        tx, tz = vx - vn * nx, vz - vn * nz
        speed = np.hypot(tx, tz)
        keep = np.maximum(0, 1 - self.bed_mu * impulse / np.maximum(speed, 1e-30))
        self.work["bed"] += 0.5 * self.mass * np.sum(speed**2 * (1 - keep**2))
        self.work["other"] += 0.5 * self.mass * np.sum(vn**2 - vn2**2)
        return keep * tx + vn2 * nx, keep * tz + vn2 * nz

    def update(self, gradient, diffusion):
        """Density and stress to the next level. Returns the stress power times dt [J]"""
        dt, lxx, lxz, lzx, lzz = self.dt, *gradient
        trace, old = lxx + lzz, self.force_stress
        self.e = np.maximum(self.e + dt * (diffusion - (1 + self.e) * trace), -0.2)
        p = self.pressure()
        turn = dt * (lxz - lzx)  # twice the angle of the spin, exact rotation
        mean, half = 0.5 * (self.sxx + self.szz), 0.5 * (self.sxx - self.szz)
        c, s = np.cos(turn), np.sin(turn)
        half, sxz = half * c + self.sxz * s, self.sxz * c - half * s
        third, g2 = trace / 3, 2 * self.shear * dt
        txx, tzz = mean + half + g2 * (lxx - third), mean - half + g2 * (lzz - third)
        tyy, txz = self.syy - g2 * third, sxz + 0.5 * g2 * (lxz + lzx)
        trial = np.sqrt(0.5 * (txx**2 + tzz**2 + tyy**2) + txz**2)
        tau = trial if self.bonded else np.where(self.e > -0.02, np.minimum(trial, self.mu * p), 0)
        scale = tau / np.maximum(trial, 1e-30)
        eta = np.where(self.e < 0, 0, self.eta / (self.shear * dt))
        ratio = eta * (trial - tau) / (tau + 1e-6)
        self.acting = np.where(ratio > 0.1, np.maximum(0.02, 0.1 / np.maximum(ratio, 1e-30)), 1)
        self.carried = np.minimum(1, ratio * self.acting)
        self.sxx, self.szz, self.syy, self.sxz = scale * txx, scale * tzz, scale * tyy, scale * txz
        left = 1 - self.carried
        now = left * self.sxx - p, left * self.szz - p, left * self.sxz
        power = lxx * (old[0] + now[0]) + lzz * (old[1] + now[1]) + (lxz + lzx) * (old[2] + now[2])
        self.work["plastic"] += self.mass / RHO * np.sum((trial - tau) / self.shear * 0.5 * (trial + tau))
        return 0.5 * self.mass / RHO * dt * np.sum(power)

    def run(self, end):
        while self.steps * self.dt < end - 1e-12:
            self.step()
        return self

    # Measures ------------------------------------------------------------------------------------
    def kinetic(self):
        return 0.5 * self.mass * np.sum(self.vx**2 + self.vz**2)

    def potential(self):
        gx, gz = self.bed.gravity
        return -self.mass * np.sum(gx * self.x + gz * self.z)

    def nearest(self):
        """Distance to the nearest neighbour in units of the spacing that the metric knows (N,)."""
        self.find()
        self.mirror_state(self.vx, self.vz)
        rx, rz, ax, az, _ = self.pairs(self.lists[0])
        return 1.3 * np.min(np.sqrt(rx * ax + rz * az), axis=1)
