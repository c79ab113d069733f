// SPDX-License-Identifier: Apache-2.0
// Design, correlation and hazard thresholds.
#include "scenarios/checks/combination_checks.hpp"
#include "scenarios/schema/dam_fields.hpp"
#include "scenarios/schema/number_text.hpp"
#include "scenarios/schema/suggest.hpp"
#include "scenarios/schema/value_text.hpp"
#include "scenarios/schema/zone_fields.hpp"

#include <Eigen/Eigenvalues>

#include <algorithm>

namespace sturz {
namespace {

using Problems = std::vector<Problem>;
const char* const correlation_path = "ensemble.correlation";

/// Place of `path` among the uncertain keys, or -1 and a problem.
int place(const std::string& path, const std::string& pair, const std::vector<std::string>& keys,
          Problems& problems) {
  const auto found = std::find(keys.begin(), keys.end(), path);
  if (found != keys.end()) return static_cast<int>(found - keys.begin());
  const std::string near = nearest_name(path, keys);
  problems.push_back(
      {correlation_path, std::string(correlation_path) + ": " + pair + " (" + path +
                             " is not an uncertain value of this scenario). " +
                             (near.empty() ? "Give it a distribution or remove the pair."
                                           : "Did you mean " + near + "?")});
  return -1;
}

/// The keys that a correlation may name. A scene whose values are all fixed (one member of an
/// ensemble) keeps the correlation it was drawn with: there every key that could be uncertain will
/// do.
std::vector<std::string> keys_to_correlate(const Scenario& s) {
  std::vector<std::string> keys;
  for (const auto& key : uncertain_keys(s)) keys.push_back(key.path);
  if (!keys.empty()) return keys;
  for (const auto& key : schema())
    if (key.kind == ValueKind::uncertain) keys.push_back(key.path);
  for (std::size_t i = 0; i < s.terrain.dams.size(); ++i)
    for (const DamField& field : dam_fields) keys.push_back(dam_path(i, field));
  for (std::size_t i = 0; i < s.basal.zones.size(); ++i)
    for (const ZoneField& field : zone_fields) keys.push_back(zone_path(i, field));
  return keys;
}

void check_correlation(const Scenario& s, Problems& problems) {
  if (s.ensemble.correlation.empty()) return;
  const auto keys = keys_to_correlate(s);
  const auto n = static_cast<Eigen::Index>(keys.size());
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Identity(n, n);
  bool complete = true;
  const auto add = [&](const std::string& text) {
    problems.push_back({correlation_path, std::string(correlation_path) + ": " + text});
    complete = false;
  };
  for (const auto& [pair, rho] : s.ensemble.correlation) {
    const auto slash = pair.find('/');
    if (slash == std::string::npos || pair.find('/', slash + 1) != std::string::npos) {
      add(quoted_text(pair) + " (must be two keys, key/key).");
      continue;
    }
    const int i = place(pair.substr(0, slash), pair, keys, problems);
    const int j = place(pair.substr(slash + 1), pair, keys, problems);
    complete = complete && i >= 0 && j >= 0;
    if (i < 0 || j < 0) continue;
    if (i == j)
      add(pair + " (a value with itself).");
    else if (!(rho > -1 && rho < 1))
      add(pair + " = " + number_text(rho) + " (must be above -1 and below 1).");
    else if (matrix(i, j) != 0)
      add(pair + " (this pair stands there twice, in both orders).");
    else
      matrix(i, j) = matrix(j, i) = rho;
  }
  if (!complete) return;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(matrix, Eigen::EigenvaluesOnly);
  if (!(solver.eigenvalues()(0) > 1e-10))
    add(value_text(s.ensemble.correlation) +
        " (no set of values can be correlated like this: the matrix is not positive definite). "
        "Bring some of them nearer to 0.");
}

/// A design whose rows belong together in sets: how many make one set, 1 where each stands alone.
int rows_of_a_set(const Scenario& s) {
  const int keys = static_cast<int>(uncertain_keys(s).size());
  if (keys == 0) return 1;  // a member of such a design
  if (s.ensemble.design == Design::morris) return keys + 1;
  return s.ensemble.design == Design::saltelli ? keys + 2 : 1;
}

void check_sets(const Scenario& s, Problems& problems) {
  const int set = rows_of_a_set(s), members = s.ensemble.members;
  if (set == 1) return;
  const std::string design(to_string(s.ensemble.design));
  if (!s.ensemble.correlation.empty())
    problems.push_back({correlation_path, std::string(correlation_path) + " (design is " + design +
                                              ", which moves one value at a time: shares of "
                                              "values that depend on one another have no "
                                              "meaning). Remove it or use another design."});
  if (members > 0 && members % set != 0)
    problems.push_back({"ensemble.members", "ensemble.members = " + std::to_string(members) +
                                                " (design " + design + " takes sets of " +
                                                std::to_string(set) + " members for " +
                                                std::to_string(set - (design == "morris" ? 1 : 2)) +
                                                " uncertain values). Use " +
                                                std::to_string((members / set + 1) * set) + "."});
}

void check_rising(const std::vector<double>& levels, const char* path, Problems& problems) {
  if (std::adjacent_find(levels.begin(), levels.end(),
                         [](double a, double b) { return !(a < b); }) != levels.end())
    problems.push_back({path, std::string(path) + " = " + value_text(levels) +
                                  " (every number must be above the one before)."});
}

/// A multilevel ensemble needs to know when it has enough.
void check_target(const Scenario& s, Problems& problems) {
  const EnsembleSpec& e = s.ensemble;
  if (!e.estimator && (e.target || !e.levels.empty() || e.pilot))
    problems.push_back(
        {"ensemble.estimator",
         "ensemble.estimator (missing: target, levels and pilot are for multilevel). "
         "Set it to multilevel, or to plain, which takes no notice of them."});
  if (e.estimator.value_or(Estimator::plain) != Estimator::multilevel) return;
  const TargetSpec t = e.target.value_or(TargetSpec{});
  const bool errors = t.relative_error > 0 || t.map_error > 0;
  if (!errors && !(t.core_hours > 0))
    problems.push_back({"ensemble.target",
                        "ensemble.target (missing: estimator is multilevel, whose numbers of "
                        "members follow from what is to be reached). Give relative_error, "
                        "map_error or core_hours."});
  if (errors && t.core_hours > 0)
    problems.push_back({"ensemble.target.core_hours",
                        "ensemble.target.core_hours (with errors to reach: the computing time "
                        "follows from them). Keep the one or the other."});
  if (s.release.each_feature)
    problems.push_back(
        {"ensemble.estimator",
         "ensemble.estimator: multilevel (release.each_feature makes many sources, and "
         "each is an ensemble of its own). Use plain."});
}

}  // namespace

void check_ensemble(const Scenario& s, Problems& problems) {
  const auto& e = s.ensemble;
  const bool table = e.design == Design::table;
  if (table && e.table.empty())
    problems.push_back({"ensemble.table",
                        "ensemble.table (missing: design is table). Name a CSV "
                        "file with one row per member."});
  if (!table && !e.table.empty())
    problems.push_back({"ensemble.table", "ensemble.table (design is " +
                                              std::string(to_string(e.design)) +
                                              "). Remove it or set design: table."});
  if (table && !e.correlation.empty())
    problems.push_back({correlation_path, std::string(correlation_path) +
                                              " (a table holds its values as they are). Remove "
                                              "it."});
  else
    check_correlation(s, problems);
  check_sets(s, problems);
  check_target(s, problems);
}

void check_hazard(const Scenario& s, Problems& problems) {
  const auto& h = s.hazard;
  check_rising(h.thickness_m, "hazard.thickness_m", problems);
  check_rising(h.speed_m_s, "hazard.speed_m_s", problems);
  check_rising(h.energy_kj_m2, "hazard.energy_kj_m2", problems);
  check_rising(h.pressure_kpa, "hazard.pressure_kpa", problems);
  check_rising(h.quantiles, "hazard.quantiles", problems);
  if (std::find(h.quantiles.begin(), h.quantiles.end(), 1.0) != h.quantiles.end())
    problems.push_back({"hazard.quantiles", "hazard.quantiles = " + value_text(h.quantiles) +
                                                " (every level must be below 1)."});
}

}  // namespace sturz
