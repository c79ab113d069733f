// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/folder/opened_ensemble.hpp"

#include "engine/core/error.hpp"
#include "ensemble/workflow/folder/folder_members.hpp"
#include "ensemble/workflow/folder/input_check.hpp"
#include "ensemble/workflow/folder/saved_design.hpp"
#include "ensemble/workflow/folder/scene_identity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace sturz::workflow {
namespace {

std::string place_text(const Grid& g) {
  return fmt::format("{} x {} cells of {:g} m, north-west corner {:.10g}, {:.10g}", g.n_cols,
                     g.n_rows, g.cell_m, g.west_m, g.north_m);
}

/// Shares of members are probabilities where members are a sample of the distributions.
void require_sample(const DesignTable& design, const std::string& where, Observer& observer) {
  require(design.design != Design::morris,
          where +
              ": ensemble.design = morris (its members are steps through the distributions, no "
              "sample of them: shares of them are no probabilities). Compute the ensemble with "
              "sobol, latin_hypercube or monte_carlo.");
  if (design.design == Design::saltelli)
    observer.warning(where +
                     ": ensemble.design = saltelli (members of a set share values: intervals of "
                     "probabilities and standard errors are too narrow).");
}

bool same_number(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

/// What of two assets of one place differs, or empty text.
std::string difference(const Asset& a, const Asset& b) {
  if (a.name != b.name)
    return fmt::format("'{}' and '{}' in the same place of the list", a.name, b.name);
  if (a.wkb != b.wkb || a.cells != b.cells) return fmt::format("'{}' lies elsewhere", a.name);
  if (a.vulnerability_class != b.vulnerability_class)
    return fmt::format("'{}' is of another class", a.name);
  if (!same_number(a.value, b.value)) return fmt::format("'{}' has another value", a.name);
  return {};
}

bool same_curve(const DamageCurve& a, const DamageCurve& b) {
  return a.name == b.name && a.intensity == b.intensity &&
         std::equal(a.points.begin(), a.points.end(), b.points.begin(), b.points.end(),
                    [](const DamageCurve::Point& p, const DamageCurve::Point& q) {
                      return p.intensity == q.intensity && p.damage == q.damage;
                    });
}

std::string difference(const Assets& a, const Assets& b) {
  if (a.list.size() != b.list.size())
    return fmt::format("{} and {} assets", a.list.size(), b.list.size());
  if (a.value_unit != b.value_unit || a.has_values != b.has_values)
    return "other units of their values";
  for (std::size_t i = 0; i < a.list.size(); ++i)
    if (std::string what = difference(a.list[i], b.list[i]); !what.empty()) return what;
  if (!std::equal(a.curves.begin(), a.curves.end(), b.curves.begin(), b.curves.end(), same_curve))
    return "other vulnerability curves";
  return {};
}

}  // namespace

OpenedEnsemble open_ensemble(const std::filesystem::path& folder, Observer& observer,
                             CancelFlag cancel) {
  OpenedEnsemble opened;
  opened.finished = open_finished(folder, observer);
  const FinishedFolder& finished = opened.finished;
  const std::string where = folder.string();
  require(finished.manifest.kind == "ensemble",
          fmt::format("{} holds no ensemble but a {} (an ensemble is needed). Name the folder that "
                      "`sturz ensemble` wrote, of a region that of one source.",
                      where, finished.manifest.kind));
  require(
      finished.inputs != nullptr,
      fmt::format("{}: its input files cannot be read (they say where the ground is known). Put "
                  "the files back where scenario.yaml names them.",
                  where));
  require(finished.changed.empty(),
          fmt::format("{}: its members were computed from other inputs. Take these changes back:{}",
                      where, as_lines(finished.changed)));
  require_own_scenario(finished.folder, finished.manifest, finished.scenario);
  opened.design = saved_design(finished.folder, finished.manifest, finished.scenario);
  require_sample(opened.design, where, observer);
  opened.members = std::make_unique<const MemberStore>(
      members_of(finished.folder, finished.manifest, opened.design, {}, cancel));
  warn_of_problems(*opened.members, "It counts as missing.", observer);
  const auto& members = opened.members->members();
  require(std::any_of(members.begin(), members.end(),
                      [](const MemberSummary& m) { return is_valid(m.outcome); }),
          fmt::format("{} has no valid member (nothing can be said of its scene). Run `sturz "
                      "ensemble` again.",
                      where));
  if (const auto missing = what_is_missing(*opened.members, opened.design.n_members());
      !missing.empty())
    observer.warning(where + ": " + missing + "; the others are used.");
  return opened;
}

void require_same_maps(std::span<const OpenedEnsemble> ensembles) {
  const Grid& first = ensembles.front().members->grid();
  for (const OpenedEnsemble& other : ensembles.subspan(1)) {
    const Grid& grid = other.members->grid();
    require(
        grid.same_place(first) && grid.crs_wkt == first.crs_wkt,
        fmt::format("{} and {}: their maps do not lie on the same cells ({}; {}{}). Compute both "
                    "on one terrain with one hazard.cell_size_m.",
                    ensembles.front().name(), other.name(), place_text(first), place_text(grid),
                    grid.crs_wkt == first.crs_wkt ? "" : "; other coordinate systems"));
  }
}

std::shared_ptr<const Assets> common_assets(std::span<const OpenedEnsemble> ensembles) {
  const auto& first = ensembles.front().finished.inputs->assets;
  for (const OpenedEnsemble& other : ensembles.subspan(1)) {
    const auto& own = other.finished.inputs->assets;
    std::string what;
    if ((own == nullptr) != (first == nullptr))
      what = "only one of their scenes has `assets`";
    else if (own != nullptr)
      what = difference(*first, *own);
    require(what.empty(),
            fmt::format("{} and {}: their assets differ ({}). Give both scenario.yaml "
                        "the same `assets`; no member is computed again for it.",
                        ensembles.front().name(), other.name(), what));
  }
  return first;
}

void require_free_of_results(const std::filesystem::path& folder) {
  require(!std::filesystem::exists(OutputFolder{folder}.manifest()),
          fmt::format("{} holds results of `sturz ensemble` or `sturz run` (they would be mixed). "
                      "Choose another folder with --out.",
                      folder.string()));
}

}  // namespace sturz::workflow
