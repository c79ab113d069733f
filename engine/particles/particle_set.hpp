// SPDX-License-Identifier: Apache-2.0
/// One set of particles (grains or fluid) as a structure of arrays, with fields that effects add.
#pragma once

#include "engine/particles/field.hpp"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>
#include <vector>

namespace sturz {

/// Particles in storage order, which changes when neighbours are sorted and when particles come
/// and go; `id` never does. A particle is followed by its id.
struct ParticleSet {
  std::vector<double> x, y, z;     ///< position [m], map coordinates
  std::vector<double> vx, vy, vz;  ///< velocity at the last half step [m/s]
  std::vector<double> mass;        ///< [kg]; constant where no bed is taken along
  std::vector<std::uint32_t> id;   ///< stable number of a particle, 0..n_created()-1

  std::size_t size() const { return x.size(); }
  /// How many particles there have ever been: ids are never given twice.
  std::size_t n_created() const { return n_created_; }
  /// Adds n particles at rest with new ids behind the others; fields get their initial values.
  /// \return storage index of the first of them
  std::size_t grow(std::size_t n);

  /// Adds a field of its initial value; the reference stays valid for the life of the set.
  Field& add(const FieldKey&);
  Flags& add(const FlagKey&);
  bool has(const FieldKey& key) const { return find(key) != nullptr; }
  bool has(const FlagKey& key) const { return find(key) != nullptr; }
  /// nullptr when no effect added it.
  Field* find(const FieldKey&);
  const Field* find(const FieldKey&) const;
  Flags* find(const FlagKey&);
  const Flags* find(const FlagKey&) const;
  /// Of a field that must be there. \throws std::logic_error naming it when it is not
  std::vector<std::vector<double>>& components(const FieldKey&);
  const std::vector<std::vector<double>>& components(const FieldKey&) const;
  std::vector<double>& scalar(const FieldKey& key) { return components(key)[0]; }
  const std::vector<double>& scalar(const FieldKey& key) const { return components(key)[0]; }
  std::vector<std::uint8_t>& flags(const FlagKey&);
  const std::vector<std::uint8_t>& flags(const FlagKey&) const;
  /// Names of all fields, in the order in which they were added.
  std::vector<const char*> field_names() const;

  /// Reorders everything so that the new particle i is the old particle order[i].
  void permute(std::span<const std::uint32_t> order);
  /// Keeps the particles with keep[i] != 0, in order.
  void compact(std::span<const std::uint8_t> keep);

  /// Memory of all arrays per particle [bytes].
  std::size_t bytes_per_particle() const;

 private:
  std::deque<Field> fields_;
  std::deque<Flags> flags_;
  std::size_t n_created_ = 0;
  std::vector<double> scratch_;
  std::vector<std::uint32_t> scratch_id_;
  std::vector<std::uint8_t> scratch_flag_;
};

}  // namespace sturz
