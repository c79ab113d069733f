// SPDX-License-Identifier: Apache-2.0
/// One set of particles (grains or fluid) as a structure of arrays, with fields that effects add.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sturz {

/// Values that an effect brings along: [components][n] doubles.
struct Field {
  std::string name;
  std::vector<std::vector<double>> component;
};

/// Particles in storage order, which changes when neighbours are sorted; `id` never does.
struct ParticleSet {
  std::vector<double> x, y, z;     ///< position [m], map coordinates
  std::vector<double> vx, vy, vz;  ///< velocity at the last half step [m/s]
  std::vector<double> mass;        ///< [kg], constant
  std::vector<std::uint32_t> id;   ///< stable number of a particle, 0..n_created-1

  std::size_t size() const { return x.size(); }
  /// Room for n particles at rest, numbered 0..n-1. Existing fields grow along.
  void resize(std::size_t n);

  /// Adds a field of zeros; the reference stays valid for the life of the set.
  Field& add_field(std::string name, int components);
  /// nullptr when no effect added it.
  Field* find_field(std::string_view name);
  const Field* find_field(std::string_view name) const;

  /// Reorders everything so that the new particle i is the old particle order[i].
  void permute(std::span<const std::uint32_t> order);
  /// Keeps the particles with keep[i] != 0, in order.
  void compact(std::span<const std::uint8_t> keep);

  /// Memory of all arrays per particle [bytes].
  std::size_t bytes_per_particle() const;

 private:
  std::deque<Field> fields_;
  std::vector<double> scratch_;
  std::vector<std::uint32_t> scratch_id_;
};

}  // namespace sturz
