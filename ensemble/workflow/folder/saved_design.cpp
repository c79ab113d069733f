// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/folder/saved_design.hpp"

#include "engine/core/error.hpp"
#include "ensemble/workflow/folder/scene_identity.hpp"
#include "io/files/text_files.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

namespace sturz::workflow {
namespace fs = std::filesystem;

namespace {

Scenario as_many(Scenario scenario, const DesignTable& design) {
  scenario.ensemble.members = static_cast<int>(design.n_members());
  return scenario;
}

/// ": member 3, basal.friction_coefficient = 0.9, drawn as 0.2"; empty where drawing it again does
/// not show it.
std::string first_change(const Scenario& scenario, const DesignTable& saved) {
  if (scenario.ensemble.design == Design::table) return "";
  const DesignTable drawn = draw_design(scenario);
  if (drawn.keys != saved.keys) return ": its columns are not those of the scenario";
  for (std::size_t i = 0; i < saved.values.size(); ++i)
    for (std::size_t k = 0; k < saved.keys.size(); ++k)
      if (saved.values[i][k] != drawn.values[i][k])
        return fmt::format(": member {}, {} = {}, drawn as {}", i, saved.keys[k],
                           saved.values[i][k], drawn.values[i][k]);
  return "";
}

/// What `use` makes of the rows of the user's table; its errors name the file.
template <class Use>
auto with_table(const Scenario& scenario, Use use) {
  fs::path file = scenario.ensemble.table;
  if (file.is_relative()) file = fs::path(scenario.directory) / file;
  try {
    return use(from_csv(read_text(file)));
  } catch (const SetupError& problem) {
    throw SetupError(fmt::format("{}: {}", file.string(), problem.what()));
  }
}

}  // namespace

DesignTable new_design(const Scenario& scenario) {
  if (scenario.ensemble.design != Design::table) return draw_design(scenario);
  return with_table(scenario, [&](DesignTable rows) {
    if (rows.is_posterior) rows = with_prior_columns(scenario, std::move(rows));
    return table_design(scenario, rows.keys, rows.values);
  });
}

std::vector<std::string> keys_from_prior(const Scenario& scenario) {
  if (scenario.ensemble.design != Design::table) return {};
  return with_table(scenario, [&](const DesignTable& rows) {
    return rows.is_posterior ? keys_without_column(scenario, rows) : std::vector<std::string>{};
  });
}

std::int64_t rows_of_table(const Scenario& scenario) {
  return with_table(scenario, [](const DesignTable& rows) { return rows.n_members(); });
}

DesignTable saved_design(const OutputFolder& folder, const Manifest& manifest,
                         const Scenario& scenario) {
  std::error_code ignored;
  require(
      fs::exists(folder.design(), ignored),
      fmt::format("{} is missing (it says what each member is). Take it from a backup, or start "
                  "in another folder.",
                  folder.design().string()));
  DesignTable saved;
  try {
    saved = from_csv(read_text(folder.design()));
  } catch (const SetupError& problem) {
    throw SetupError(fmt::format("{}: {}", folder.design().string(), problem.what()));
  }
  const Scenario as_drawn = as_many(scenario, saved);
  const std::string hash = design_hash(saved);
  const bool known =
      hash == manifest.design_hash || hash == manifest.design_hash_before;  // killed in growing
  const bool untouched = manifest.design_hash.empty()  // of a version that kept no hash
                             ? first_change(as_drawn, saved).empty()
                             : known;
  require(untouched,
          fmt::format("{} was changed after it was written{} (members and maps go by it). Take the "
                      "change back, or give your own rows as ensemble.table in another folder.",
                      folder.design().string(), first_change(as_drawn, saved)));
  return saved;
}

DesignTable continued_design(const OutputFolder& folder, const Manifest& manifest,
                             const Scenario& scenario, const DesignTable& wanted) {
  DesignTable saved = saved_design(folder, manifest, scenario);
  const std::int64_t had = saved.n_members(), now = wanted.n_members();
  const std::string where = folder.root.string();
  require(now >= had,
          fmt::format("{} holds an ensemble of {} members, {} are asked for (members are never "
                      "thrown away). Ask for {} or more, or choose another folder with --out.",
                      where, had, now, had));
  const bool same_rows =
      saved.keys == wanted.keys &&
      std::equal(saved.values.begin(), saved.values.end(), wanted.values.begin());
  if (now == had) {
    // A user's own table may have changed; a drawn one is what was saved, whatever would be drawn
    // today.
    require(wanted.design != Design::table || same_rows,
            fmt::format("{}: ensemble.table has other rows than the ensemble that was begun here. "
                        "Choose another folder with --out.",
                        where));
    return saved;
  }
  require(same_rows,
          fmt::format("{} holds {} members of design {}, and a table of {} does not begin with the "
                      "same rows (a {} design cannot grow). Use sobol or monte_carlo for ensembles "
                      "that shall grow, or choose another folder with --out.",
                      where, had, to_string(saved.design), now, to_string(saved.design)));
  return wanted;
}

}  // namespace sturz::workflow
