// SPDX-License-Identifier: Apache-2.0
/// The design of an ensemble: which values each member gets, drawn whole before the first run.
///
///   unit cube (independent, u in (0,1))  --copula-->  dependent u  --quantile-->  value
///
/// Copula and quantile functions work row by row, so a row is a function of its unit-cube row
/// alone. The table that was drawn is saved and is the truth from then on: shards, resume and
/// merge read it and never draw again. Everything here is serial by nature (OpenTURNS keeps one
/// process-wide generator); draw before the workers start.
#pragma once

#include "scenarios/scenario.hpp"
#include "scenarios/schema/schema.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sturz {

/// One row per member, one column per uncertain key of the scenario (there may be none).
struct DesignTable {
  std::vector<std::string> keys;   ///< dotted scenario paths, [n_keys]
  std::vector<std::string> units;  ///< of each key, [n_keys]
  Design design = Design::table;
  std::uint64_t seed = 0;
  std::vector<std::vector<double>> unit_cube;  ///< [n_members][n_keys] before the copula; empty
                                               ///< for a user's table
  std::vector<std::vector<double>> values;     ///< [n_members][n_keys] in the key's unit
  /// It is a posterior's table: keys that it has no column for keep their prior.
  bool is_posterior = false;

  std::int64_t n_members() const { return static_cast<std::int64_t>(values.size()); }
  bool operator==(const DesignTable&) const = default;
};

/// Draws the table of scenario.ensemble (every design but `table`).
///   monte_carlo      independent rows; a longer table starts with the shorter one
///   latin_hypercube  one row in each of n equal slices of every key (of the independent columns:
///                    a key that depends on an earlier one through `correlation` is not sliced)
///   sobol            Sobol' points with a random digital shift of their top 32 bits; a longer
///                    table starts with the shorter one
///   morris           sets of one row per key and one more, see sampling/structured_cube.hpp
///   saltelli         sets of one row per key and two more; both go on set by set
/// The same seed gives the same bits.
/// \throws SetupError naming the key when members, a distribution or the correlation is unusable
DesignTable draw_design(const Scenario& scenario);
/// The same from its parts.
DesignTable draw_design(std::span<const UncertainKey> keys, const EnsembleSpec& spec);

/// Values of points of the unit cube, copula and quantile functions applied. \param cube
/// [n][n_keys] \return [n][n_keys] in the keys' units
std::vector<std::vector<double>> values_at(std::span<const UncertainKey> keys,
                                           const EnsembleSpec& spec,
                                           const std::vector<std::vector<double>>& cube);

/// The user's own table (`design: table`), already read: columns may come in any order and must
/// be the scenario's uncertain keys, no more and no fewer; each value must lie in the key's range
/// and in the support of the distribution that the scenario gives for it. With
/// ensemble.members > 0 the first so many rows are used.
/// \throws SetupError naming column and row (counted from 1)
DesignTable table_design(const Scenario& scenario, std::span<const std::string> columns,
                         const std::vector<std::vector<double>>& rows);

/// Keys of the scenario that a table has no column for.
std::vector<std::string> keys_without_column(const Scenario&, const DesignTable&);
/// The table with a column more for each of those, drawn from its own distribution by Sobol' points
/// of ensemble.seed, independent of all others; a longer table goes on with the same rows.
/// \throws SetupError naming the key when its distribution is unusable, or when the scene has none
/// for a column of the posterior, or one that its values do not fit into
DesignTable with_prior_columns(const Scenario&, DesignTable);

/// CSV text: `# name: value` lines (design, seed, units), then
/// `member,<key>...,unit_cube:<key>...`. Numbers survive the round trip bit by bit.
std::string to_csv(const DesignTable&);
/// Reads what to_csv wrote, a posterior.csv (`# posterior: ...`), or a user's plain table: a line
/// of keys and lines of numbers, an optional `member` column that counts 0, 1, 2, ..., comment
/// lines starting with #. \throws SetupError naming the line
DesignTable from_csv(std::string_view text);

/// The scene of numbers that member `member` computes.
/// \throws SetupError if the table has no such row
Scenario member_scenario(const Scenario& scenario, const DesignTable& design, std::int64_t member);
/// The scene with each distribution replaced by its median.
Scenario median_scenario(const Scenario& scenario);

}  // namespace sturz
