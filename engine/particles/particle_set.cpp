// SPDX-License-Identifier: Apache-2.0
#include "engine/particles/particle_set.hpp"

#include "engine/core/error.hpp"

#include <algorithm>
#include <array>
#include <string>

namespace sturz {
namespace {

using Columns = std::array<std::vector<double> ParticleSet::*, 7>;
constexpr Columns fixed_columns{&ParticleSet::x,   &ParticleSet::y,  &ParticleSet::z,
                                &ParticleSet::vx,  &ParticleSet::vy, &ParticleSet::vz,
                                &ParticleSet::mass};

/// The entry of a deque of fields or flags with this key; nullptr when there is none.
template <class Entries, class Key>
auto* entry_of(Entries& entries, const Key& key) {
  const auto found = std::find_if(entries.begin(), entries.end(),
                                  [&](const auto& entry) { return entry.key == &key; });
  return found == entries.end() ? nullptr : &*found;
}

template <class Entry, class Key>
Entry& required(Entry* entry, const Key& key) {
  if (entry == nullptr)  // the text only then: a step must not ask for memory
    expect(false, (std::string("a set has the field ") + key.name).c_str());
  return *entry;
}

template <class T>
void permute_column(std::vector<T>& column, std::vector<T>& scratch,
                    std::span<const std::uint32_t> order) {
  scratch.resize(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) scratch[i] = column[order[i]];
  column.swap(scratch);
}

template <class T>
void compact_column(std::vector<T>& column, std::span<const std::uint8_t> keep) {
  std::size_t n = 0;
  for (std::size_t i = 0; i < keep.size(); ++i)
    if (keep[i]) column[n++] = column[i];
  column.resize(n);
}

}  // namespace

std::size_t ParticleSet::grow(std::size_t n) {
  const std::size_t first = size(), all = first + n;
  for (auto column : fixed_columns) (this->*column).resize(all, 0.0);
  for (std::size_t i = first; i < all; ++i) id.push_back(static_cast<std::uint32_t>(n_created_++));
  for (auto& field : fields_)
    for (auto& c : field.component) c.resize(all, field.key->initial);
  for (auto& flags : flags_) flags.value.resize(all, flags.key->initial);
  return first;
}

Field& ParticleSet::add(const FieldKey& key) {
  expect(!has(key), "a field is added once");
  fields_.push_back({&key, {}});
  fields_.back().component.assign(key.components, std::vector<double>(size(), key.initial));
  return fields_.back();
}

Flags& ParticleSet::add(const FlagKey& key) {
  expect(!has(key), "a field is added once");
  flags_.push_back({&key, std::vector<std::uint8_t>(size(), key.initial)});
  return flags_.back();
}

Field* ParticleSet::find(const FieldKey& key) { return entry_of(fields_, key); }
const Field* ParticleSet::find(const FieldKey& key) const { return entry_of(fields_, key); }
Flags* ParticleSet::find(const FlagKey& key) { return entry_of(flags_, key); }
const Flags* ParticleSet::find(const FlagKey& key) const { return entry_of(flags_, key); }

std::vector<std::vector<double>>& ParticleSet::components(const FieldKey& key) {
  return required(find(key), key).component;
}
const std::vector<std::vector<double>>& ParticleSet::components(const FieldKey& key) const {
  return required(find(key), key).component;
}
std::vector<std::uint8_t>& ParticleSet::flags(const FlagKey& key) {
  return required(find(key), key).value;
}
const std::vector<std::uint8_t>& ParticleSet::flags(const FlagKey& key) const {
  return required(find(key), key).value;
}

std::vector<const char*> ParticleSet::field_names() const {
  std::vector<const char*> names;
  for (const auto& field : fields_) names.push_back(field.key->name);
  for (const auto& flags : flags_) names.push_back(flags.key->name);
  return names;
}

void ParticleSet::permute(std::span<const std::uint32_t> order) {
  expect(order.size() == size(), "an order has one entry per particle");
  for (auto column : fixed_columns) permute_column(this->*column, scratch_, order);
  for (auto& field : fields_)
    for (auto& c : field.component) permute_column(c, scratch_, order);
  for (auto& flags : flags_) permute_column(flags.value, scratch_flag_, order);
  permute_column(id, scratch_id_, order);
}

void ParticleSet::compact(std::span<const std::uint8_t> keep) {
  expect(keep.size() == size(), "a mask has one entry per particle");
  for (auto& field : fields_)
    for (auto& c : field.component) compact_column(c, keep);
  for (auto& flags : flags_) compact_column(flags.value, keep);
  for (auto column : fixed_columns) compact_column(this->*column, keep);
  compact_column(id, keep);
}

std::size_t ParticleSet::bytes_per_particle() const {
  std::size_t columns = fixed_columns.size();
  for (const auto& field : fields_) columns += field.component.size();
  return columns * sizeof(double) + sizeof(std::uint32_t) + flags_.size();
}

}  // namespace sturz
