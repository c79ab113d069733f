// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/sensitivity/sensitivity.hpp"

#include "engine/core/error.hpp"
#include "ensemble/censoring/scalar_censoring.hpp"
#include "ensemble/sensitivity/index_maps.hpp"
#include "ensemble/workflow/folder/finished_folder.hpp"
#include "ensemble/workflow/folder/folder_members.hpp"
#include "ensemble/workflow/folder/saved_design.hpp"
#include "io/files/text_files.hpp"
#include "io/netcdf/netcdf_layers.hpp"
#include "scenarios/schema/suggest.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

namespace sturz::workflow {
namespace {

/// What a hazard map is made of, and what a back-analysis looks at.
constexpr const char* usual_results[] = {"runout_m",        "crown_to_toe_ratio", "reached_area_m2",
                                         "deposit_area_m2", "max_speed_m_s",      "max_thickness_m",
                                         "max_pressure_pa", "volume_growth"};

const ScalarInfo& scalar_named(const std::string& name) {
  const auto table = scalar_table();
  const auto found =
      std::find_if(table.begin(), table.end(), [&](const ScalarInfo& s) { return name == s.name; });
  if (found != table.end()) return *found;
  std::vector<std::string> names;
  for (const ScalarInfo& s : table) names.emplace_back(s.name);
  const std::string near = nearest_name(name, names);
  throw SetupError(fmt::format("{} is no result of a member{}. Columns of members.csv are.", name,
                               near.empty() ? "" : fmt::format(" (did you mean {}?)", near)));
}

/// Results of every row of the design; a row without a valid member is not known at all.
std::vector<Observation> column_of(const MemberStore& store, double MemberScalars::*field,
                                   std::size_t n_rows) {
  std::vector<Observation> column(n_rows, {nan_d, Known::not_at_all});
  for (const MemberSummary& m : store.members()) {
    if (!is_valid(m.outcome)) continue;
    const double value = m.scalars.*field;
    column[static_cast<std::size_t>(m.member)] = {
        value, std::isnan(value) ? Known::not_at_all : known(field, m.scalars, m.censoring)};
  }
  return column;
}

void add_ranks(ResultSensitivity& r, const DesignTable& design,
               std::span<const Observation> column) {
  for (std::size_t k = 0; k < design.keys.size(); ++k) {
    std::vector<double> key;
    for (const auto& row : design.values) key.push_back(row[k]);
    r.ranks.push_back(rank_agreement(key, column));
  }
}

/// \param dependent the distributions are correlated: coordinates of the cube are not the keys'
void add_indices(ResultSensitivity& r, const DesignTable& design, bool dependent,
                 std::span<const Observation> column, bool by_emulator) {
  if (design.design == Design::morris) {
    r.morris = morris_measures(design.unit_cube, column);
  } else if (design.design == Design::saltelli) {
    r.direct = sobol_indices(design.unit_cube, column);
    if (!r.direct) r.why_not = "fewer than 8 whole sets of fully known members, or no variance";
  } else if (dependent) {
    r.why_not =
        "ensemble.correlation is set (shares of values that depend on one another have no meaning)";
  } else if (design.unit_cube.empty()) {
    r.why_not = "the members of a table are no sample of the distributions";
  } else if (by_emulator) {
    try {
      r.emulated = emulated_indices(r.name, design.unit_cube, column, design.seed);
    } catch (const SetupError& problem) {
      r.why_not = problem.what();
    }
  }
}

ResultSensitivity one_result(std::string name, std::string unit, const DesignTable& design,
                             bool dependent, std::span<const Observation> column,
                             bool by_emulator) {
  ResultSensitivity r;
  r.name = std::move(name);
  r.unit = std::move(unit);
  r.n_exact = std::count_if(column.begin(), column.end(),
                            [](const Observation& o) { return o.known == Known::exactly; });
  r.n_censored = static_cast<std::int64_t>(column.size()) - r.n_exact;
  add_ranks(r, design, column);
  add_indices(r, design, dependent, column, by_emulator);
  return r;
}

std::string share_cells(const std::vector<Share>& shares, std::size_t k) {
  if (shares.empty()) return ",,,";
  return fmt::format(",{},{},{}", shares[k].value, shares[k].lower, shares[k].upper);
}

std::string morris_cells(const std::vector<MorrisMeasure>& morris, std::size_t k) {
  if (morris.empty()) return ",,,,,";
  const MorrisMeasure& m = morris[k];
  return fmt::format(",{},{},{},{},{}", m.mean, m.mean_absolute, m.mean_absolute_error, m.deviation,
                     m.n);
}

std::string csv_of(const Sensitivity& all) {
  std::string text =
      "result,unit,key,members_known,members_cut_off,kendall_tau,morris_mu,morris_mu_star,"
      "morris_mu_star_error,morris_sigma,morris_effects,sobol_method,sobol_first,"
      "sobol_first_lower,sobol_first_upper,sobol_total,sobol_total_lower,sobol_total_upper,"
      "sobol_sets,emulator_q2\n";
  for (const ResultSensitivity& r : all.results)
    for (std::size_t k = 0; k < all.keys.size(); ++k) {
      const SobolIndices* s = r.direct ? &*r.direct : r.emulated ? &r.emulated->indices : nullptr;
      text += fmt::format("{},{},{},{},{},{}", r.name, r.unit, all.keys[k], r.n_exact, r.n_censored,
                          r.ranks[k].tau);
      text += morris_cells(r.morris, k);
      text += r.direct ? ",direct" : r.emulated ? ",emulator" : ",";
      text += s != nullptr ? share_cells(s->first, k) + share_cells(s->total, k) : ",,,,,,";
      text += s != nullptr ? fmt::format(",{}", s->n_sets) : ",";
      text += r.emulated ? fmt::format(",{}\n", r.emulated->emulator.q2) : ",\n";
    }
  return text;
}

std::filesystem::path maps_file(const FinishedFolder& finished) {
  return finished.folder.root / "sensitivity.nc";
}

/// sensitivity.nc: indices of each cell.
std::filesystem::path write_index_maps(const FinishedFolder& finished, const DesignTable& design,
                                       const MemberStore& store, CancelFlag cancel) {
  IndexMapRequest request;
  request.keys = design.keys;
  request.n_rows = design.n_members();
  request.thickness_m = finished.scenario.hazard.thickness_m;
  request.cancel = cancel;
  std::filesystem::path file = maps_file(finished);
  LayersFileWriter writer(file);
  make_index_maps(store, request, writer);
  cancel.check();
  writer.commit();
  return file;
}

/// A result that no member has, or all alike, has no sensitivity.
bool says_something(std::span<const Observation> column) {
  double least = INFINITY, most = -INFINITY;
  for (const Observation& o : column)
    if (o.known == Known::exactly) {
      least = std::min(least, o.value);
      most = std::max(most, o.value);
    }
  return most > least;
}

}  // namespace

Sensitivity sensitivity_of(const SensitivityRequest& request, Observer& observer,
                           CancelFlag cancel) {
  const FinishedFolder finished = open_finished(request.folder, observer);
  const std::string where = request.folder.string();
  require(finished.manifest.kind == "ensemble",
          where + " holds a single run (what matters is asked of an ensemble).");
  const DesignTable design = saved_design(finished.folder, finished.manifest, finished.scenario);
  require(!design.keys.empty(), where +
                                    ": no value of its scene is uncertain (nothing can matter). "
                                    "Give a key a distribution.");
  require(
      !request.maps || design.design == Design::saltelli,
      fmt::format("{}: --maps needs the sets of ensemble.design: saltelli, this is {} (each cell "
                  "compares members of which one value differs). Compute such an ensemble, "
                  "about a hundred sets.",
                  where, to_string(design.design)));
  const MemberStore store = members_of(finished.folder, finished.manifest, design, {}, cancel);
  warn_of_problems(store, "It counts as missing.", observer);
  if (const std::string missing = what_is_missing(store, design.n_members()); !missing.empty())
    observer.warning(where + ": " + missing + "; what matters is told from the others.");
  Sensitivity all;
  all.design = design.design;
  all.keys = design.keys;
  all.units = design.units;
  const bool usual = request.results.empty();
  const bool dependent = !finished.scenario.ensemble.correlation.empty();
  const std::vector<std::string> names =
      usual ? std::vector<std::string>(std::begin(usual_results), std::end(usual_results))
            : request.results;
  for (const std::string& name : names) {
    cancel.check();
    const ScalarInfo& scalar = scalar_named(name);
    const auto column = column_of(store, scalar.field, design.values.size());
    if (usual && !says_something(column)) continue;
    all.results.push_back(
        one_result(scalar.name, scalar.units, design, dependent, column, request.emulate));
  }
  require(!all.results.empty(),
          where + ": no result of its members is known and differs between them.");
  all.file = finished.folder.root / "sensitivity.csv";
  std::filesystem::remove(maps_file(finished));
  write_text_atomic(all.file, csv_of(all));
  if (request.maps) all.maps = write_index_maps(finished, design, store, cancel);
  return all;
}

}  // namespace sturz::workflow
