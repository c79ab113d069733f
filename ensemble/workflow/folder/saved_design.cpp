// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/folder/saved_design.hpp"

#include "engine/core/error.hpp"
#include "io/files/text_files.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace sturz::workflow {
namespace fs = std::filesystem;

namespace {

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
  return with_table(scenario, [&](const DesignTable& rows) {
    return table_design(scenario, rows.keys, rows.values);
  });
}

std::int64_t rows_of_table(const Scenario& scenario) {
  return with_table(scenario, [](const DesignTable& rows) { return rows.n_members(); });
}

DesignTable saved_design(const OutputFolder& folder) {
  require(
      fs::exists(folder.design()),
      fmt::format("{} is missing (it says what each member is). Take it from a backup, or start "
                  "in another folder.",
                  folder.design().string()));
  try {
    return from_csv(read_text(folder.design()));
  } catch (const SetupError& problem) {
    throw SetupError(fmt::format("{}: {}", folder.design().string(), problem.what()));
  }
}

DesignTable continued_design(const OutputFolder& folder, const DesignTable& wanted) {
  DesignTable saved = saved_design(folder);
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
