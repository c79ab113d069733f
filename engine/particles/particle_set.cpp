// SPDX-License-Identifier: Apache-2.0
#include "engine/particles/particle_set.hpp"

#include "engine/core/error.hpp"

#include <array>

namespace sturz {
namespace {

using Columns = std::array<std::vector<double> ParticleSet::*, 7>;
constexpr Columns fixed_columns{&ParticleSet::x,   &ParticleSet::y,  &ParticleSet::z,
                                &ParticleSet::vx,  &ParticleSet::vy, &ParticleSet::vz,
                                &ParticleSet::mass};

}  // namespace

void ParticleSet::resize(std::size_t n) {
  const std::size_t old = size();
  for (auto column : fixed_columns) (this->*column).resize(n, 0.0);
  id.resize(n);
  for (std::size_t i = old; i < n; ++i) id[i] = static_cast<std::uint32_t>(i);
  for (auto& field : fields_)
    for (auto& c : field.component) c.resize(n, 0.0);
}

Field& ParticleSet::add_field(std::string name, int components) {
  expect(find_field(name) == nullptr, "a field is added once");
  fields_.push_back({std::move(name), {}});
  fields_.back().component.assign(components, std::vector<double>(size(), 0.0));
  return fields_.back();
}

Field* ParticleSet::find_field(std::string_view name) {
  for (auto& field : fields_)
    if (field.name == name) return &field;
  return nullptr;
}

const Field* ParticleSet::find_field(std::string_view name) const {
  return const_cast<ParticleSet*>(this)->find_field(name);
}

void ParticleSet::permute(std::span<const std::uint32_t> order) {
  expect(order.size() == size(), "an order has one entry per particle");
  scratch_.resize(size());
  auto apply = [&](std::vector<double>& column) {
    for (std::size_t i = 0; i < order.size(); ++i) scratch_[i] = column[order[i]];
    column.swap(scratch_);
  };
  for (auto column : fixed_columns) apply(this->*column);
  for (auto& field : fields_)
    for (auto& c : field.component) apply(c);
  scratch_id_.resize(size());
  for (std::size_t i = 0; i < order.size(); ++i) scratch_id_[i] = id[order[i]];
  id.swap(scratch_id_);
}

void ParticleSet::compact(std::span<const std::uint8_t> keep) {
  expect(keep.size() == size(), "a mask has one entry per particle");
  auto apply = [&](auto& column) {
    std::size_t n = 0;
    for (std::size_t i = 0; i < keep.size(); ++i)
      if (keep[i]) column[n++] = column[i];
    column.resize(n);
  };
  for (auto& field : fields_)
    for (auto& c : field.component) apply(c);
  for (auto column : fixed_columns) apply(this->*column);
  apply(id);
}

std::size_t ParticleSet::bytes_per_particle() const {
  std::size_t columns = fixed_columns.size();
  for (const auto& field : fields_) columns += field.component.size();
  return columns * sizeof(double) + sizeof(std::uint32_t);
}

}  // namespace sturz
