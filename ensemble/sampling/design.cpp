// SPDX-License-Identifier: Apache-2.0
#include "ensemble/sampling/design.hpp"

#include "engine/core/error.hpp"
#include "ensemble/sampling/copula.hpp"
#include "ensemble/sampling/marginal.hpp"
#include "ensemble/sampling/unit_cube.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace sturz {
namespace {

DesignTable empty_design(std::span<const UncertainKey> keys, const EnsembleSpec& spec) {
  DesignTable table;
  for (const UncertainKey& key : keys) {
    table.keys.push_back(key.path);
    table.units.push_back(key.units);
  }
  table.design = spec.design;
  table.seed = spec.seed;
  return table;
}

std::vector<Marginal> marginals_of(std::span<const UncertainKey> keys) {
  std::vector<Marginal> marginals;
  marginals.reserve(keys.size());
  for (const UncertainKey& key : keys) marginals.emplace_back(key.distribution, key.path);
  return marginals;
}

std::string list_of(std::span<const std::string> words) {
  return words.empty() ? "none" : fmt::format("{}", fmt::join(words, ", "));
}

/// Place of each of the scenario's keys among the user's columns.
std::vector<std::size_t> match_columns(std::span<const std::string> keys,
                                       std::span<const std::string> columns) {
  for (const std::string& column : columns) {
    require(std::count(columns.begin(), columns.end(), column) == 1,
            fmt::format("ensemble.table: column '{}' stands twice (each key has one column). "
                        "Remove one of them.",
                        column));
    require(std::find(keys.begin(), keys.end(), column) != keys.end(),
            fmt::format("ensemble.table: column '{}' is not an uncertain key of the scenario "
                        "(those are: {}). Give that key a distribution or remove the column.",
                        column, list_of(keys)));
  }
  std::vector<std::size_t> place;
  for (const std::string& key : keys) {
    const auto found = std::find(columns.begin(), columns.end(), key);
    require(found != columns.end(),
            fmt::format("ensemble.table: no column '{}' (the scenario gives that key a "
                        "distribution; columns are: {}). Add the column or fix the key's value.",
                        key, list_of(columns)));
    place.push_back(static_cast<std::size_t>(found - columns.begin()));
  }
  return place;
}

void check_value(const UncertainKey& key, const Marginal& marginal, double value, std::size_t row) {
  const auto where = [&] { return fmt::format("ensemble.table: row {}, {}", row + 1, key.path); };
  require(std::isfinite(value),
          fmt::format("{} is not a finite number. Fill in the cell.", where()));
  if (const auto info = key_of_number(key.path))
    require(value >= info->min && value <= info->max,
            fmt::format("{} = {} (must be {}{}). Check the unit of the column.", where(), value,
                        range_text(*info), info->units == "1" ? "" : " " + info->units));
  require(value >= marginal.lower() && value <= marginal.upper(),
          fmt::format("{} = {} (outside {} .. {}, the support of the distribution that the "
                      "scenario gives). Widen the distribution or correct the table.",
                      where(), value, marginal.lower(), marginal.upper()));
}

/// A posterior comes from another scene, maybe of another site: words for what the scene lacks.
void require_posterior_fits(std::span<const UncertainKey> keys, const DesignTable& posterior) {
  for (std::size_t c = 0; c < posterior.keys.size(); ++c) {
    double least = std::numeric_limits<double>::infinity(), most = -least;
    for (const std::vector<double>& row : posterior.values) {
      least = std::min(least, row.at(c));
      most = std::max(most, row.at(c));
    }
    const std::string rows =
        fmt::format("the posterior's values lie in {:.6g} .. {:.6g}", least, most);
    const auto key = std::find_if(keys.begin(), keys.end(), [&](const UncertainKey& k) {
      return k.path == posterior.keys[c];
    });
    require(key != keys.end(),
            fmt::format("{} is one number in this scene, so that nothing that was learnt of it can "
                        "be used ({}). Give it the distribution that it was calibrated with.",
                        posterior.keys[c], rows));
    const Marginal marginal(key->distribution, key->path);
    require(least >= marginal.lower() && most <= marginal.upper(),
            fmt::format("{}: this scene's distribution ends at {:.6g} and {:.6g} ({}). Give it the "
                        "distribution that it was calibrated with.",
                        key->path, marginal.lower(), marginal.upper(), rows));
  }
}

}  // namespace

DesignTable draw_design(const Scenario& scenario) {
  return draw_design(uncertain_keys(scenario), scenario.ensemble);
}

DesignTable draw_design(std::span<const UncertainKey> keys, const EnsembleSpec& spec) {
  require(spec.members > 0,
          fmt::format("ensemble.members = {} (an ensemble needs at least one member). Give the "
                      "number of members.",
                      spec.members));
  DesignTable table = empty_design(keys, spec);
  table.unit_cube =
      draw_unit_cube(spec.design, static_cast<std::size_t>(spec.members), keys.size(), spec.seed);
  table.values = values_at(keys, spec, table.unit_cube);
  return table;
}

std::vector<std::vector<double>> values_at(std::span<const UncertainKey> keys,
                                           const EnsembleSpec& spec,
                                           const std::vector<std::vector<double>>& cube) {
  const std::vector<Marginal> marginals = marginals_of(keys);
  const Copula copula(empty_design(keys, spec).keys, spec.correlation);
  std::vector<std::vector<double>> all;
  all.reserve(cube.size());
  for (const std::vector<double>& row : cube) {
    std::vector<double> values = copula.apply(row);
    for (std::size_t k = 0; k < values.size(); ++k) values[k] = marginals[k].quantile(values[k]);
    all.push_back(std::move(values));
  }
  return all;
}

DesignTable table_design(const Scenario& scenario, std::span<const std::string> columns,
                         const std::vector<std::vector<double>>& rows) {
  const std::vector<UncertainKey> keys = uncertain_keys(scenario);
  DesignTable table = empty_design(keys, scenario.ensemble);
  table.design = Design::table;
  const std::vector<std::size_t> place = match_columns(table.keys, columns);
  const std::vector<Marginal> marginals = marginals_of(keys);
  const int wanted = scenario.ensemble.members;
  const std::size_t n = wanted > 0 ? static_cast<std::size_t>(wanted) : rows.size();
  require(n > 0, "ensemble.table: no rows (each row is a member). Add rows.");
  require(n <= rows.size(),
          fmt::format("ensemble.members = {} but ensemble.table has {} rows (each row is a "
                      "member). Add rows or lower the number of members.",
                      wanted, rows.size()));
  for (std::size_t r = 0; r < n; ++r) {
    require(rows[r].size() == columns.size(),
            fmt::format("ensemble.table: row {} has {} values for {} columns (each column needs "
                        "one). Correct the row.",
                        r + 1, rows[r].size(), columns.size()));
    std::vector<double> values;
    for (std::size_t k = 0; k < keys.size(); ++k) {
      values.push_back(rows[r][place[k]]);
      check_value(keys[k], marginals[k], values.back(), r);
    }
    table.values.push_back(std::move(values));
  }
  return table;
}

std::vector<std::string> keys_without_column(const Scenario& scenario, const DesignTable& table) {
  std::vector<std::string> without;
  for (const UncertainKey& key : uncertain_keys(scenario))
    if (std::find(table.keys.begin(), table.keys.end(), key.path) == table.keys.end())
      without.push_back(key.path);
  return without;
}

DesignTable with_prior_columns(const Scenario& scenario, DesignTable table) {
  const std::vector<UncertainKey> keys = uncertain_keys(scenario);
  require_posterior_fits(keys, table);
  // A column of its own for every key: those of the posterior's were its coordinates.
  const auto cube =
      draw_unit_cube(Design::sobol, table.values.size(), keys.size(), scenario.ensemble.seed);
  const std::vector<std::string> without = keys_without_column(scenario, table);
  for (std::size_t k = 0; k < keys.size(); ++k) {
    if (std::find(without.begin(), without.end(), keys[k].path) == without.end()) continue;
    const Marginal marginal(keys[k].distribution, keys[k].path);
    table.keys.push_back(keys[k].path);
    table.units.push_back(keys[k].units);
    for (std::size_t i = 0; i < table.values.size(); ++i)
      table.values[i].push_back(marginal.quantile(cube[i][k]));
  }
  table.unit_cube.clear();
  return table;
}

Scenario member_scenario(const Scenario& scenario, const DesignTable& design, std::int64_t member) {
  require(member >= 0 && member < design.n_members(),
          fmt::format("member {} is not in the design table (it has members 0 .. {}). Ask for one "
                      "of those.",
                      member, design.n_members() - 1));
  const std::vector<double>& row = design.values[static_cast<std::size_t>(member)];
  Scenario numbers = scenario;
  for (std::size_t k = 0; k < design.keys.size(); ++k)
    numbers = with_value(std::move(numbers), design.keys[k], row[k]);
  return numbers;
}

Scenario median_scenario(const Scenario& scenario) {
  Scenario numbers = scenario;
  for (const UncertainKey& key : uncertain_keys(scenario))
    numbers =
        with_value(std::move(numbers), key.path, Marginal(key.distribution, key.path).median());
  return numbers;
}

}  // namespace sturz
