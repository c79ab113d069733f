// SPDX-License-Identifier: Apache-2.0
// sturz risk: maps and assets by year, from ensembles that come with frequencies.
#include "ensemble/workflow/risk/risk.hpp"

#include "ensemble/app/commands.hpp"
#include "ensemble/app/console/console_observer.hpp"
#include "ensemble/app/console/interrupt.hpp"
#include "ensemble/app/console/json_text.hpp"
#include "ensemble/app/exit_codes.hpp"
#include "ensemble/app/grammar.hpp"
#include "ensemble/workflow/folder/output_folder.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace sturz::app {
namespace {

struct Options {
  std::string file, out;
};

using Json = nlohmann::ordered_json;

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json json_of(const workflow::RiskMade& made) {
  Json scenarios = Json::array();
  for (const auto& s : made.scenarios)
    scenarios.push_back({{"folder", s.folder},
                         {"frequency_per_year", s.frequency_per_year},
                         {"valid_members", s.valid},
                         {"cut_off_members", s.cut_off}});
  Json done{{"event", "done"},
            {"maps", made.maps.string()},
            {"scenarios", std::move(scenarios)},
            {"return_periods_years", made.return_periods_years},
            {"highest_annual_rate", made.highest_rate}};
  if (made.n_assets == 0) return done;
  done["assets"] = made.assets_csv.string();
  done["number_of_assets"] = made.n_assets;
  done["expected_loss_per_year"] = number(made.total_loss.mean);
  done["expected_loss_standard_error_per_year"] = number(made.total_loss.standard_error);
  done["assets_without_loss"] = made.n_without_loss;
  done["value_unit"] = made.value_unit;
  return done;
}

std::string assets_text(const workflow::RiskMade& made, const char* least) {
  std::string text = fmt::format("{} assets", made.n_assets);
  if (!std::isfinite(made.total_loss.mean)) return text;
  text += fmt::format(": expected loss {}{:.4g} {} a year (standard error {:.2g})", least,
                      made.total_loss.mean, made.value_unit, made.total_loss.standard_error);
  if (made.n_without_loss > 0)
    text += fmt::format(
        "; without {} of them, whose loss is not known (beyond the known ground, "
        "no curve or no value)",
        made.n_without_loss);
  return text;
}

int risk(const Options& options, Console& console) {
  ConsoleObserver observer(console);
  const std::string out =
      options.out.empty() ? workflow::default_folder(options.file) : options.out;
  const workflow::RiskMade made =
      workflow::make_risk({options.file, out}, observer, interrupt_flag());
  bool cut_off = false;
  for (const auto& s : made.scenarios) {
    console.say(fmt::format("  {:g} a year  {} ({} valid members{})", s.frequency_per_year,
                            s.folder, s.valid,
                            s.cut_off > 0 ? fmt::format(", {} cut off", s.cut_off) : ""));
    cut_off = cut_off || s.cut_off > 0;
  }
  const char* least = cut_off ? "at least " : "";
  if (made.highest_rate > 0)
    console.say(fmt::format("  reached most often: {}{:.3g} times a year, once in {:.3g} years",
                            least, made.highest_rate, 1 / made.highest_rate));
  if (made.n_assets > 0) console.say("  " + assets_text(made, least));
  console.say("In " + out);
  console.event(json_text(json_of(made)));
  return ok;
}

}  // namespace

void add_risk(Grammar& grammar) {
  auto [parser, options] = add_command(
      grammar, "risk", "Hazard and loss by year, from ensembles with their frequencies", risk);
  parser.add_option("file", options.file, "Risk file: folders of ensembles, each with a frequency")
      ->type_name("FILE")
      ->required();
  parser
      .add_option("-o,--out", options.out, "Folder for the results (default: out/<name of FILE>)")
      ->type_name("DIR");
  add_remote(parser);
  add_json(grammar, parser);
}

}  // namespace sturz::app
