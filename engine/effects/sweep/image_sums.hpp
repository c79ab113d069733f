// SPDX-License-Identifier: Apache-2.0
/// The neighbours of a grain mirrored in the ground (docs/physics.md B.10, ADR 0037).
///
/// With the plane under grain i and R = I - 2 n n^T, the image j' of a neighbour lies at
/// r' = r_ij + 2 d_j n, |r'|^2 = |r_ij|^2 + 4 d_i d_j, moves with R v_j (a bed that slips: the same
/// along it, the opposite normal to it) and carries R sigma_j R. Seen in the mirror this is the
/// image i' of the grain itself, at r'' = r_ij - 2 d_i n, among its real neighbours:
///   velocity gradient  R [Sum (R v_i - v_j) (x) d''] R      d'' = V_j t^3 r''
///   moment matrix      R [Sum r'' (x) d''] R
///   momentum           R [Sum sigma_j d''] + sigma_i R [Sum d''], artificial viscosity as in B.4
/// so no stress has to be turned in the loop, and if j' is in the support, j is in the list. Each
/// pair has the product of both grains' weights: force and gradient are adjoint on a plane,
/// and along it the pair's forces are opposite. t takes the greater of |r_ij|^2 + 4 d_i d_j and
/// (d_i + d_j)^2: both are symmetric in i and j on any ground, and on a plane the second is the
/// first without the distance along it.
#pragma once

#include "engine/effects/sweep/group_rows.hpp"

namespace sturz::STURZ_ISA {

/// v <- R v
inline void reflect(const Lanes n[3], Lanes& x, Lanes& y, Lanes& z) {
  const Lanes twice = Lanes::all(2) * fma(n[0], x, fma(n[1], y, n[2] * z));
  x = fnma(twice, n[0], x), y = fnma(twice, n[1], y), z = fnma(twice, n[2], z);
}

/// A group's distances to the ground, in units.
struct GroundRows {
  alignas(64) float distance[group_size], weight[group_size];
  float least;  ///< distance

  explicit GroundRows(const GroundRecord* first) : least(first[0].distance) {
    for (int n = 0; n < group_size; ++n) {
      distance[n] = first[n].distance, weight[n] = first[n].weight;
      least = distance[n] < least ? distance[n] : least;
    }
  }
};

/// The lanes' own images.
struct MirroredSelf {
  IntLanes x, y, z;                        ///< of the grains themselves
  Lanes n[3], distance, to_x, to_y, to_z;  ///< 2 d n
  Lanes vx, vy, vz;                        ///< R v

  MirroredSelf(const DenseSelf& i, const GroundRows& ground, const BoundaryView& wall, int lane,
               std::size_t at)
      : x(i.x), y(i.y), z(i.z), vx(i.vx), vy(i.vy), vz(i.vz) {
    n[0] = Lanes::load(wall.nx + at), n[1] = Lanes::load(wall.ny + at);
    n[2] = Lanes::load(wall.nz + at);
    distance = Lanes::load(ground.distance + lane);
    const Lanes twice = distance + distance;
    to_x = twice * n[0], to_y = twice * n[1], to_z = twice * n[2];
    reflect(n, vx, vy, vz);
  }
};

struct ImageSums {
  Lanes lxx, lxy, lxz, lyx, lyy, lyz, lzx, lzy, lzz;
  Lanes mxx, myy, mzz, mxy, myz, mzx;
  Lanes gx, gy, gz;
  Lanes ax, ay, az;

  void clear() {
    const Lanes o = Lanes::all(0);
    lxx = lxy = lxz = lyx = lyy = lyz = lzx = lzy = lzz = o;
    mxx = myy = mzz = mxy = myz = mzx = o;
    gx = gy = gz = ax = ay = az = o;
  }

  /// Adds one neighbour, as it is in the mirror. One beyond the reach of all lanes adds zero.
  /// \param viscosity  as in DenseSums::add
  void add(const MirroredSelf& i, const NeighborRecord& j, const GroundRecord& ground,
           const DenseScale& k, Lanes viscosity) {
    const Lanes ox = difference(i.x, j.x), oy = difference(i.y, j.y), oz = difference(i.z, j.z);
    const Lanes d = Lanes::all(ground.distance), sum = i.distance + d;
    const Lanes apart = fma(ox, ox, fma(oy, oy, oz * oz));
    const Lanes r2 = max(fma(i.distance, Lanes::all(4 * ground.distance), apart), sum * sum);
    if (!any_less(r2, Lanes::all(k.support * k.support))) return;
    const Lanes t = max(Lanes::all(0), fnma(sqrt(r2), Lanes::all(k.to_s), Lanes::all(1)));
    const Lanes w = t * t * t * Lanes::all(j.volume * ground.weight);
    const Lanes rx = ox - i.to_x, ry = oy - i.to_y, rz = oz - i.to_z;
    const Lanes dx = w * rx, dy = w * ry, dz = w * rz;
    const Lanes ux = i.vx - Lanes::all(j.vx), uy = i.vy - Lanes::all(j.vy);
    const Lanes uz = i.vz - Lanes::all(j.vz);

    lxx = fma(ux, dx, lxx), lxy = fma(ux, dy, lxy), lxz = fma(ux, dz, lxz);
    lyx = fma(uy, dx, lyx), lyy = fma(uy, dy, lyy), lyz = fma(uy, dz, lyz);
    lzx = fma(uz, dx, lzx), lzy = fma(uz, dy, lzy), lzz = fma(uz, dz, lzz);
    mxx = fma(rx, dx, mxx), myy = fma(ry, dy, myy), mzz = fma(rz, dz, mzz);
    mxy = fma(rx, dy, mxy), myz = fma(ry, dz, myz), mzx = fma(rz, dx, mzx);
    gx = gx + dx, gy = gy + dy, gz = gz + dz;

    const Lanes ur = fma(ux, rx, fma(uy, ry, uz * rz));
    const Lanes q = ur * viscosity / (r2 + Lanes::all(k.eta2));
    const Lanes sxy = Lanes::all(j.sxy), syz = Lanes::all(j.syz), szx = Lanes::all(j.szx);
    ax = fma(Lanes::all(j.sxx) + q, dx, fma(sxy, dy, fma(szx, dz, ax)));
    ay = fma(sxy, dx, fma(Lanes::all(j.syy) + q, dy, fma(syz, dz, ay)));
    az = fma(szx, dx, fma(syz, dy, fma(Lanes::all(j.szz) + q, dz, az)));
  }

  void scale(Lanes weight) {
    Lanes* const all[] = {&lxx, &lxy, &lxz, &lyx, &lyy, &lyz, &lzx, &lzy, &lzz, &mxx, &myy,
                          &mzz, &mxy, &myz, &mzx, &gx,  &gy,  &gz,  &ax,  &ay,  &az};
    for (Lanes* c : all) *c = weight * *c;
  }

  /// Turns the sums out of the mirror, in the weight of the lanes.
  void finish(const MirroredSelf& i, Lanes weight) {
    scale(weight);
    reflect(i.n, gx, gy, gz);
    reflect(i.n, ax, ay, az);
    reflect(i.n, lxx, lyx, lzx), reflect(i.n, lxy, lyy, lzy), reflect(i.n, lxz, lyz, lzz);
    reflect(i.n, lxx, lxy, lxz), reflect(i.n, lyx, lyy, lyz), reflect(i.n, lzx, lzy, lzz);
    Lanes myx = mxy, mzy = myz, mxz = mzx;
    reflect(i.n, mxx, myx, mzx), reflect(i.n, mxy, myy, mzy), reflect(i.n, mxz, myz, mzz);
    reflect(i.n, mxx, mxy, mxz), reflect(i.n, myx, myy, myz), reflect(i.n, mzx, mzy, mzz);
  }

  /// To what the real neighbours gave to gradient and moment.
  void add_to(DenseSums& s) const {
    s.lxx = s.lxx + lxx, s.lxy = s.lxy + lxy, s.lxz = s.lxz + lxz;
    s.lyx = s.lyx + lyx, s.lyy = s.lyy + lyy, s.lyz = s.lyz + lyz;
    s.lzx = s.lzx + lzx, s.lzy = s.lzy + lzy, s.lzz = s.lzz + lzz;
    s.mxx = s.mxx + mxx, s.myy = s.myy + myy, s.mzz = s.mzz + mzz;
    s.mxy = s.mxy + mxy, s.myz = s.myz + myz, s.mzx = s.mzx + mzx;
  }
};

/// n.M.n / 0.25 of the real neighbours, between 0 and 1.
inline Lanes ground_weight(const DenseSums& s, Lanes scale, const BoundaryView& wall,
                           std::size_t at) {
  const Lanes nx = Lanes::load(wall.nx + at), ny = Lanes::load(wall.ny + at);
  const Lanes nz = Lanes::load(wall.nz + at);
  const Lanes along = fma(s.mxx * nx, nx, fma(s.myy * ny, ny, s.mzz * nz * nz)) +
                      Lanes::all(2) * fma(s.mxy * nx, ny, fma(s.myz * ny, nz, s.mzx * nz * nx));
  const Lanes share = Lanes::all(4) * scale * along, one = Lanes::all(1);
  return select_less(share, one, max(share, Lanes::all(0)), one);
}

/// Calls body(j) for the records of a group's list whose images may be near it.
template <class Body>
inline void for_each_image(const NeighborView& view, std::size_t group, const GroundRows& ground,
                           const BoundaryView& wall, const DenseScale& k, Body&& body) {
  const float reach = k.support - ground.least;
  const std::uint32_t* begin = view.list(group);
  const std::uint32_t* end = begin + view.list_size(group);
  for (const std::uint32_t* j = begin; j != end; ++j)
    if (wall.ground[*j].distance < reach) body(*j);
}

/// The images of all neighbours of a group's lanes.
/// \param viscosity  of record j: the share of the artificial viscosity that acts
template <class Viscosity>
[[gnu::noinline]] inline ImageSums image_sums(const NeighborView& view, std::size_t group,
                                              const GroupRows& rows, const GroundRows& ground,
                                              int lane, const DenseScale& k,
                                              const BoundaryView& wall, Lanes own_viscosity,
                                              Viscosity viscosity) {
  const MirroredSelf self(self_of(rows, lane), ground, wall, lane, group * group_size + lane);
  ImageSums images;
  images.clear();
  const Lanes half = Lanes::all(0.5f * k.viscosity);
  for_each_image(view, group, ground, wall, k, [&](std::uint32_t j) {
    images.add(self, view.records[j], wall.ground[j], k,
               fma(half, Lanes::all(viscosity(j)), own_viscosity));
  });
  images.finish(self, Lanes::load(ground.weight + lane));
  return images;
}

}  // namespace sturz::STURZ_ISA
