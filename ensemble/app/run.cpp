// SPDX-License-Identifier: Apache-2.0
// sturz run: one member, with the median of every distribution.
#include "ensemble/app/commands.hpp"
#include "ensemble/app/console/console_observer.hpp"
#include "ensemble/app/console/interrupt.hpp"
#include "ensemble/app/console/json_text.hpp"
#include "ensemble/app/exit_codes.hpp"
#include "ensemble/app/grammar.hpp"
#include "ensemble/app/score_text.hpp"
#include "ensemble/app/speed_cache.hpp"
#include "ensemble/censoring/scalar_censoring.hpp"
#include "ensemble/workflow/members/single_run.hpp"
#include "ensemble/workflow/readable.hpp"
#include "scenarios/schema/number_text.hpp"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sturz::app {
namespace {

struct Options {
  std::string scenario;
  std::string out;                          ///< folder; empty: out/<name of the scenario>_run
  std::vector<std::string> set;             ///< "key=value"
  int threads = 0;                          ///< 0: all cores available to the process
  std::optional<double> particles_every_s;  ///< frames for ParaView, simulated seconds apart
  bool replace = false;                     ///< the run of another scene in that folder too
};

using workflow::duration_text;
using workflow::grouped;
using workflow::measure;

std::string command_text(const Options& o) {
  std::string text = "run " + o.scenario;
  for (const std::string& set : o.set) text += " --set " + set;
  return text;
}

workflow::RunRequest request_of(const Options& o) {
  workflow::RunRequest request;
  request.scene = {o.scenario, o.set, speed_cache()};
  request.folder = o.out.empty() ? workflow::default_folder(o.scenario) + "_run" : o.out;
  request.threads = o.threads;
  request.particles_every_s = o.particles_every_s;
  request.command = command_text(o);
  request.replace = o.replace;
  return request;
}

nlohmann::ordered_json as_json(const NamedSeconds& times) {
  nlohmann::ordered_json out = nlohmann::ordered_json::object();
  for (const auto& [name, seconds] : times) out[name] = seconds;
  return out;
}

void print_line(const char* name, const std::string& value, Console& console) {
  console.say(fmt::format("  {:<22}{}", name, value));
}

/// "93 %", and the digits that a small share needs.
std::string share_text(double share) {
  return share >= 0.1 ? fmt::format("{:.0f} %", 100 * share) : fmt::format("{:.2g} %", 100 * share);
}

/// Shares of mass and time per state, or what a scene without states would have had for them.
void print_states(const MemberResult& r, Console& console) {
  const MemberScalars& s = r.scalars;
  if (!r.history.has_states) {
    if (!std::isnan(s.parted_fraction))
      print_line("dilated",
                 share_text(s.parted_fraction) + " of mass and time (states not asked for)",
                 console);
    return;
  }
  const double dilated = s.transition_fraction + s.dilute_fraction + s.ultradilute_fraction;
  std::string text = "dense " + share_text(1 - dilated);
  for (const auto& [name, share] :
       {std::pair("transition", s.transition_fraction), std::pair("dilute", s.dilute_fraction),
        std::pair("ultradilute", s.ultradilute_fraction)})
    if (share > 0) text += fmt::format(", {} {}", name, share_text(share));
  print_line("states", text + " (mass x time)", console);
  if (r.history.has_temperature)
    print_line("granular temperature",
               fmt::format("{:.3g} m2/s2 at most, {} of the largest speed squared",
                           s.max_granular_temperature_m2_s2, share_text(s.granular_ratio)),
               console);
}

/// The effects by what they cost, as shares of the computing time.
void print_effects(const MemberResult& r, Console& console) {
  NamedSeconds times = r.effect_seconds;
  std::stable_sort(times.begin(), times.end(),
                   [](const auto& a, const auto& b) { return a.second > b.second; });
  std::string text;
  for (const auto& [name, seconds] : times)
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", name,
                        share_text(seconds / std::max(r.scalars.wall_s, 1e-9)));
  print_line("where the time went", text, console);
}

using M = MemberScalars;

/// ">= 812 m" of a member that is cut off, "812 m so far" where the end may lie either way.
std::string as_known(const MemberResult& r, double MemberScalars::*field, const std::string& text) {
  if (std::isnan(r.scalars.*field)) return is_censored(r.censoring) ? "not known" : "none";
  switch (known(field, r.scalars, r.censoring)) {
    case Known::exactly:
      return text;
    case Known::at_least:
      return ">= " + text;
    case Known::not_at_all:
      break;
  }
  return text + " so far";
}

/// How far grains and liquid came that move at two velocities.
void print_phases(const MemberResult& r, Console& console) {
  if (std::isnan(r.scalars.solid_runout_m)) return;
  const auto far = [&r](double MemberScalars::*field) {
    return as_known(r, field, measure(r.scalars.*field) + " m");
  };
  print_line(
      "runout of each",
      fmt::format("grains {}, liquid {}; drag took {} of the energy", far(&M::solid_runout_m),
                  far(&M::liquid_runout_m),
                  as_known(r, &M::drag_loss_fraction, share_text(r.scalars.drag_loss_fraction))),
      console);
  const auto area = [&r](double MemberScalars::*field) {
    return as_known(r, field, grouped(r.scalars.*field) + " m2");
  };
  print_line("area of each",
             fmt::format("grains {}, liquid {}", area(&M::solid_reached_area_m2),
                         area(&M::liquid_reached_area_m2)),
             console);
  if (has_left(r.censoring))
    print_line(
        "left the terrain",
        fmt::format("{} of the grains, {} of the liquid", share_text(r.scalars.solid_lost_fraction),
                    share_text(r.scalars.liquid_lost_fraction)),
        console);
}

/// Pore pressure of a mixture.
void print_mixture(const MemberResult& r, Console& console) {
  if (!r.history.has_mixture) return;
  const auto share = [&r](double MemberScalars::*field) {
    return as_known(r, field, share_text(r.scalars.*field));
  };
  print_line("pore pressure",
             fmt::format("{} of the weight at most, {} at the end (mass mean)",
                         share(&M::max_pore_pressure_ratio), share(&M::end_pore_pressure_ratio)),
             console);
  print_line(
      "solid fraction",
      fmt::format(
          "{} at the end, {} of water given off and carried",
          as_known(r, &M::end_solid_fraction, fmt::format("{:.4f}", r.scalars.end_solid_fraction)),
          as_known(r, &M::end_film_m3, fmt::format("{:.3g} m3", r.scalars.end_film_m3))),
      console);
}

/// What the flow took of its bed.
void print_erosion(const MemberResult& r, Console& console) {
  const MemberScalars& s = r.scalars;
  if (std::isnan(s.eroded_volume_m3)) return;
  print_line(
      "erosion",
      fmt::format("{} of the bed, up to {} deep; by mass the flow grew {}",
                  as_known(r, &M::eroded_volume_m3, grouped(s.eroded_volume_m3) + " m3"),
                  as_known(r, &M::max_eroded_depth_m, measure(s.max_eroded_depth_m, 2) + " m"),
                  as_known(r, &M::volume_growth, fmt::format("{:.2f} times", s.volume_growth))),
      console);
}

/// What is cut off of the run, and what it warns of itself.
void warn_of_run(const workflow::RunStored& stored, Console& console) {
  std::string cut;
  for (const std::string& sentence : censoring_sentences(stored.censoring))
    cut += (cut.empty() ? "" : " ") + sentence;
  if (!cut.empty()) console.warn(cut);
  for (const MemberWarning& w : stored.warnings) console.warn(w.text);
}

void print_inflow(const MemberResult& r, Console& console) {
  if (std::isnan(r.scalars.inflow_volume_m3)) return;
  print_line("inflow", grouped(r.scalars.inflow_volume_m3) + " m3 entered", console);
}

/// Arrival and peak of each gauge; the files have the rest.
void print_gauges(const MemberResult& r, Console& console) {
  const bool cut = is_moving(r.censoring);
  const auto arrival = [&](double s) {
    if (!std::isnan(s)) return "after " + measure(s) + " s";
    return cut ? std::string("not reached so far") : std::string("never reached");
  };
  for (const PointSeries& p : r.gauges.points)
    print_line("gauge",
               p.name + ": " + arrival(p.arrival_s) +
                   (std::isnan(p.arrival_s)
                        ? ""
                        : fmt::format(", at most {} m and {} m/s", measure(p.thickness.value, 2),
                                      measure(p.speed.value))),
               console);
  for (const LineSeries& l : r.gauges.lines)
    print_line("gauge",
               l.name + ": " + arrival(l.arrival_s) +
                   (std::isnan(l.arrival_s) ? ""
                                            : fmt::format(", at most {:.3g} m3/s, {} m3 in all",
                                                          l.discharge.value, grouped(l.total_m3))),
               console);
}

/// The last line, so that a reader may stop there.
std::string done_event(const MemberResult& r, const workflow::RunStored& stored,
                       const workflow::OutputFolder& folder) {
  nlohmann::ordered_json scalars = nlohmann::ordered_json::object();
  for (const ScalarInfo& scalar : scalar_table())
    if (!scalar.sparse || !std::isnan(r.scalars.*scalar.field))
      scalars[scalar.name] = r.scalars.*scalar.field;
  nlohmann::ordered_json event{{"event", "done"},
                               {"outcome", to_string(r.outcome)},
                               {"censored", to_string(r.censoring)},
                               {"reason", r.reason},
                               {"state_hash", fmt::format("{:016x}", r.state_hash)},
                               {"scalars", scalars}};
  if (stored.scores) event["comparison"] = score_json(*stored.scores, 0);
  event["effect_seconds"] = as_json(r.effect_seconds);
  event["pass_seconds"] = as_json(r.pass_seconds);
  event["folder"] = folder.root.string();
  return json_text(event);
}

void print_summary(const MemberResult& r, const workflow::OutputFolder& folder, Console& console) {
  const MemberScalars& s = r.scalars;
  const auto line = [&console](const char* name, const std::string& value) {
    print_line(name, value, console);
  };
  console.say(fmt::format("{}{}{} after {:.1f} s of flow", to_string(r.outcome),
                          r.reason.empty() ? "" : ": ", r.reason, s.end_time_s));
  const auto far = [&r](double MemberScalars::*field) {
    return as_known(r, field, measure(r.scalars.*field) + " m");
  };
  const auto area = [&r](double MemberScalars::*field) {
    return as_known(r, field, grouped(r.scalars.*field) + " m2");
  };
  line("runout", fmt::format("{} (front {}, centre of mass {}, drop {})", far(&M::runout_m),
                             far(&M::front_travel_m), far(&M::com_travel_m), far(&M::drop_m)));
  line("crown to toe",
       fmt::format(
           "L {}, H {}, H/L {}", far(&M::crown_to_toe_length_m), far(&M::crown_to_toe_drop_m),
           as_known(r, &M::crown_to_toe_ratio,
                    fmt::format("{:.3f} ({:.1f} degrees)", s.crown_to_toe_ratio,
                                std::atan(s.crown_to_toe_ratio) * 180 / std::numbers::pi))));
  line("area",
       fmt::format("{} reached, {} deposit", area(&M::reached_area_m2), area(&M::deposit_area_m2)));
  const auto speed = [&r](double MemberScalars::*field) {
    return as_known(r, field, measure(r.scalars.*field) + " m/s");
  };
  const auto thick = [&r](double MemberScalars::*field) {
    return as_known(r, field, measure(r.scalars.*field, 2) + " m");
  };
  const auto thousands = [&r](double MemberScalars::*field, const char* unit) {
    return as_known(r, field, measure(r.scalars.*field / 1e3) + unit);
  };
  line("largest speed", fmt::format("{} (mean of the mass {})", speed(&M::max_speed_m_s),
                                    speed(&M::max_mean_speed_m_s)));
  line("largest thickness",
       fmt::format("{} (deposit {})", thick(&M::max_thickness_m), thick(&M::max_deposit_m)));
  line("largest energy", fmt::format("{}, pressure {}", thousands(&M::max_energy_j_m2, " kJ/m2"),
                                     thousands(&M::max_pressure_pa, " kPa")));
  print_states(r, console);
  print_mixture(r, console);
  print_phases(r, console);
  print_erosion(r, console);
  print_inflow(r, console);
  print_gauges(r, console);
  line(r.formulation == "depth_averaged" ? "columns" : "particles",
       fmt::format("{:.0f}, {:.1f} layers at release", s.n_particles, s.release_layers));
  // On level ground nothing is released that the residual could be a share of.
  line("conservation",
       fmt::format("mass {:.1e}, energy {}", s.mass_error,
                   s.energy_residual != 0
                       ? fmt::format("{:.2e} of what was released", s.energy_residual)
                       : "not measured (none was released by falling)"));
  line("computing", fmt::format("{} steps in {}, {} of CPU ({:.2g} M particle updates/s)",
                                grouped(s.n_steps), duration_text(s.wall_s), duration_text(s.cpu_s),
                                s.n_steps * s.n_particles / (1e6 * std::max(s.wall_s, 1e-9))));
  print_effects(r, console);
  std::error_code ignored;
  const bool gis = std::filesystem::exists(folder.peaks_project(), ignored);
  console.say(fmt::format("Results are in {}: report.html, peaks.nc{}", folder.root.string(),
                          gis ? ", peaks.qgz for QGIS" : ""));
}

int run(const Options& options, Console& console) {
  ConsoleObserver observer(console);
  workflow::SingleRun run = workflow::prepare_run(request_of(options), observer);
  for (const std::string& warning : run.scene.description.warnings) console.warn(warning);
  for (const std::string& note : run.scene.inputs.notes) console.note(note);

  const MemberResult result = workflow::compute_run(run, observer, interrupt_flag());
  console.clear_progress();
  if (result.outcome == Outcome::cancelled) {
    console.warn("interrupted; nothing is kept. Run the same command again.");
    interruption_told();
    return interrupted;
  }
  const workflow::RunStored stored = workflow::store_run(run, result);
  print_summary(result, run.folder, console);
  if (stored.scores)
    for (const auto& [name, text] : score_lines(*stored.scores, 0))
      print_line(name.c_str(), text, console);
  warn_of_run(stored, console);
  const bool valid = is_valid(result.outcome);
  if (!valid) console.error(fmt::format("the member is not valid: {}", result.reason));
  console.event(done_event(result, stored, run.folder));
  return valid ? ok : too_many_failed;
}

}  // namespace

void add_run(Grammar& grammar) {
  auto [parser, options] =
      add_command(grammar, "run", "Compute one member: medians of all distributions", run);
  add_scenario(parser, options.scenario, options.set);
  parser.add_option("-o,--out", options.out, "Folder of the results (default: out/NAME_run)")
      ->type_name("DIR");
  parser
      .add_option("--threads", options.threads, "Threads of this one member (default: all cores)")
      ->check(CLI::Range(1, 1024));
  parser
      .add_option("--particles", options.particles_every_s,
                  "Write particle frames for ParaView, this many simulated seconds apart")
      ->type_name("SECONDS")
      ->check([](const std::string& text) -> std::string {
        if (parse_number(text).value_or(0) > 0) return {};
        return text +
               " (must be seconds above 0, such as 0.5). Without --particles there are none.";
      });
  parser.add_flag("--replace", options.replace,
                  "Put the results in place of another scene's run in the folder");
  add_json(grammar, parser);
}

}  // namespace sturz::app
