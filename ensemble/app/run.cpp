// SPDX-License-Identifier: Apache-2.0
// sturz run: one member, with the median of every distribution.
#include "engine/core/error.hpp"
#include "ensemble/app/commands.hpp"
#include "ensemble/app/cores.hpp"
#include "ensemble/app/exit_codes.hpp"
#include "ensemble/app/interrupt.hpp"
#include "ensemble/app/peak_layers.hpp"
#include "ensemble/app/progress_bar.hpp"
#include "ensemble/app/report_page.hpp"
#include "ensemble/app/scene.hpp"
#include "ensemble/app/version.hpp"
#include "io/files/atomic_file.hpp"
#include "io/members/member_file.hpp"
#include "io/members/particle_frames.hpp"
#include "io/netcdf/netcdf_layers.hpp"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>

namespace sturz::app {
namespace {

std::string command_text(const RunOptions& o) {
  std::string text = "run " + o.scenario;
  for (const std::string& set : o.set) text += " --set " + set;
  return text;
}

MemberResult compute(const RunOptions& options, const Scene& scene, const OutputFolder& folder,
                     Console& console) {
  const int threads = options.threads > 0 ? options.threads : available_cores();
  Simulation simulation = assemble(scene.medians, scene.inputs, 0, threads);
  RunControl control;
  control.max_wall_s = scene.medians.numerics.max_wall_time_s;
  control.on_progress = [&console](const Progress& p) {
    console.progress(member_bar(p, console.columns()));
    return !interrupt_flag().load();
  };
  std::filesystem::remove_all(folder.particles());  // of an earlier run
  std::optional<ParticleFrameWriter> frames;
  if (options.particles_every_s) {
    frames.emplace(folder.particles());
    control.frame_every_s = *options.particles_every_s;
    control.on_frame = [&frames](const ParticleFrame& frame) { frames->write(frame); };
  }
  MemberResult result = simulation.run(control);
  console.clear_progress();
  return result;
}

nlohmann::ordered_json as_json(const NamedSeconds& times) {
  nlohmann::ordered_json out = nlohmann::ordered_json::object();
  for (const auto& [name, seconds] : times) out[name] = seconds;
  return out;
}

/// "grain stress 1.25 s; base 0.31 s", for a text attribute.
std::string as_text(const NamedSeconds& times) {
  std::string text;
  for (const auto& [name, seconds] : times)
    text += fmt::format("{}{} {:.6g} s", text.empty() ? "" : "; ", name, seconds);
  return text;
}

MemberSummary summary_of(const MemberResult& r) {
  return {r.member,   r.outcome,    r.reason,  r.formulation, r.binding_limit,
          r.warnings, r.state_hash, r.scalars, r.window,      r.effect_seconds};
}

void write_results(const OutputFolder& folder, const Manifest& manifest, const Scene& scene,
                   const MemberResult& result) {
  write_member(folder.members(), result);
  LayerStack peaks = peak_layers(result);
  peaks.attributes = {
      {"title", scene.scenario.title.empty() ? "Landslide run" : scene.scenario.title},
      {"source", fmt::format("sturz {} ({})", version, git_commit)},
      {"history", fmt::format("{} sturz {}", manifest.started, manifest.command)},
      {"outcome", std::string(to_string(result.outcome))},
      {"formulation", result.formulation},
      {"computing_time_by_effect", as_text(result.effect_seconds)}};
  write_layers(folder.peaks_nc(), peaks, result.history);
  const MemberSummary summary = summary_of(result);
  PageContent page;
  page.peaks = &peaks;
  page.elevation = scene.inputs.elevation.get();
  page.members = {&summary, 1};
  page.run = &result;
  write_page(folder, manifest, scene.medians, page);
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
      print_line("parted",
                 share_text(s.parted_fraction) + " of mass and time (states not asked for)",
                 console);
    return;
  }
  const double parted = s.transition_fraction + s.dilute_fraction + s.ultradilute_fraction;
  std::string text = "dense " + share_text(1 - parted);
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

void print_summary(const MemberResult& r, const OutputFolder& folder, Console& console) {
  const MemberScalars& s = r.scalars;
  nlohmann::ordered_json scalars = nlohmann::ordered_json::object();
  for (const ScalarInfo& scalar : scalar_table()) scalars[scalar.name] = s.*scalar.field;
  console.event(nlohmann::ordered_json{{"event", "done"},
                                       {"outcome", to_string(r.outcome)},
                                       {"reason", r.reason},
                                       {"state_hash", fmt::format("{:016x}", r.state_hash)},
                                       {"scalars", scalars},
                                       {"effect_seconds", as_json(r.effect_seconds)},
                                       {"pass_seconds", as_json(r.pass_seconds)},
                                       {"folder", folder.root.string()}}
                    .dump());
  const auto line = [&console](const char* name, const std::string& value) {
    print_line(name, value, console);
  };
  console.say(fmt::format("{}{}{} after {:.1f} s of flow", to_string(r.outcome),
                          r.reason.empty() ? "" : ": ", r.reason, s.end_time_s));
  line("runout", fmt::format("{:.1f} m (front {:.1f} m, centre of mass {:.1f} m, drop {:.1f} m)",
                             s.runout_m, s.front_travel_m, s.com_travel_m, s.drop_m));
  line("area", fmt::format("{} m2 reached, {} m2 deposit", grouped(s.reached_area_m2),
                           grouped(s.deposit_area_m2)));
  line("largest speed", fmt::format("{:.1f} m/s (mean of the mass {:.1f} m/s)", s.max_speed_m_s,
                                    s.max_mean_speed_m_s));
  line("largest thickness",
       fmt::format("{:.2f} m (deposit {:.2f} m)", s.max_thickness_m, s.max_deposit_m));
  line("largest energy", fmt::format("{:.1f} kJ/m2, pressure {:.1f} kPa", s.max_energy_j_m2 / 1e3,
                                     s.max_pressure_pa / 1e3));
  print_states(r, console);
  line("particles",
       fmt::format("{:.0f}, {:.1f} layers at release", s.n_particles, s.release_layers));
  line("conservation", fmt::format("mass {:.1e}, energy {:.2e} of what was released", s.mass_error,
                                   s.energy_residual));
  line("computing", fmt::format("{} steps in {} ({:.2g} M particle updates/s)", grouped(s.n_steps),
                                duration_text(s.wall_s),
                                s.n_steps * s.n_particles / (1e6 * std::max(s.wall_s, 1e-9))));
  print_effects(r, console);
  console.say(fmt::format("Results are in {}: report.html, peaks.nc", folder.root.string()));
}

}  // namespace

int run_command(const RunOptions& options, Console& console) {
  const auto begin = std::chrono::steady_clock::now();
  const Scene scene = load_scene(options.scenario, options.set);
  OutputFolder folder{options.out.empty() ? default_folder(options.scenario) + "_run"
                                          : options.out};
  holds_results(folder, "run");  // refuses a folder of anything else
  Manifest manifest = manifest_of(scene, "run", command_text(options));
  manifest.members = 1;
  make_folder(folder.root);
  manifest.write(folder.manifest());
  save_scenario(folder, scene.medians);
  console.log_to(folder.log().string());
  for (const std::string& warning : scene.description.warnings) console.warn(warning);
  for (const std::string& note : scene.inputs.notes) console.note(note);

  watch_for_interrupts();
  const MemberResult result = compute(options, scene, folder, console);
  if (result.outcome == Outcome::cancelled) {
    console.warn("interrupted; nothing is kept. Run the same command again.");
    return interrupted;
  }
  manifest.compute_s =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  manifest.write(folder.manifest());
  write_results(folder, manifest, scene, result);
  print_summary(result, folder, console);
  if (is_valid(result.outcome)) return ok;
  console.error(fmt::format("the member is not valid: {}", result.reason));
  return too_many_failed;
}

}  // namespace sturz::app
