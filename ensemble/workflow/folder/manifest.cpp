// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/folder/manifest.hpp"

#include "engine/core/error.hpp"
#include "ensemble/workflow/folder/stop_rule_json.hpp"
#include "ensemble/workflow/version.hpp"
#include "io/files/plain_text.hpp"
#include "io/files/text_files.hpp"

#include <fmt/chrono.h>
#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <chrono>
#include <utility>

namespace sturz::workflow {
namespace fs = std::filesystem;
using json = nlohmann::ordered_json;

void Manifest::write(const fs::path& file) {
  version = workflow::version;
  git_commit = workflow::git_commit;
  compiler = workflow::compiler;
  build_type = workflow::build_type;
  json inputs_json = json::array(), builds_json = json::array();
  for (const InputIdentity& input : inputs)
    inputs_json.push_back({{"role", input.role},
                           {"file", input.file},
                           {"shape", input.shape},
                           {"parts", input.parts}});
  for (const Build& build : builds)
    builds_json.push_back({{"version", build.version}, {"git_commit", build.git_commit}});
  json all = {{"kind", kind},
              {"program",
               {{"name", "sturz"},
                {"version", version},
                {"git_commit", git_commit},
                {"compiler", compiler},
                {"build_type", build_type}}},
              {"started", started},
              {"updated", utc_now()},
              {"command", command},
              {"design", design},
              {"seed", seed},
              {"members", members},
              {"shards", shards},
              {"spacing_m", spacing_m},
              {"inputs", inputs_json},
              {"description", description},
              {"notes", notes},
              {"warnings", warnings},
              {"compute_s", compute_s},
              {"scenario_hash", scenario_hash},
              {"scene_hash", scene_hash},
              {"design_hash", design_hash},
              {"design_hash_before", design_hash_before},
              {"computed_by", builds_json},
              {"hazard_hash", hazard_hash},
              {"maps_of", maps_of},
              {"censored", censored}};
  if (stop) all["stop_rule"] = stop_json(*stop);
  // Names of files are bytes, and JSON is UTF-8: what is not is replaced.
  write_text_atomic(file, all.dump(2, ' ', false, json::error_handler_t::replace) + "\n");
}

namespace {

[[noreturn]] void not_a_manifest(const fs::path& file, const std::string& why) {
  throw SetupError(
      fmt::format("{}: not a manifest that sturz wrote ({}). Use another folder, or "
                  "take the file from a backup.",
                  file.string(), why));
}

/// The library would make any number of 1e300 or -1.
template <class T>
T whole(const fs::path& file, const json& all, const char* key) {
  const json& value = all.at(key);
  const bool fits = value.is_number_unsigned()
                        ? std::in_range<T>(value.get<std::uint64_t>())
                        : value.is_number_integer() && std::in_range<T>(value.get<std::int64_t>());
  if (!fits) not_a_manifest(file, fmt::format("{} is {}", key, value.dump()));
  return value.get<T>();
}

/// Versions before kept a checksum of the file's bytes: known by name only.
InputIdentity identity_from(const json& input) {
  InputIdentity identity;
  identity.file = input.at("file").get<std::string>();
  if (input.contains("checksum")) return identity;
  identity.role = input.at("role").get<std::string>();
  identity.shape = input.at("shape").get<std::string>();
  identity.parts = input.at("parts").get<std::map<std::string, std::string>>();
  return identity;
}

std::optional<StopRecord> stop_from(const fs::path& file, const json& all) {
  if (!all.contains("stop_rule")) return std::nullopt;
  const json& rule = all.at("stop_rule");
  StopRecord stop;
  stop.wanted_half_width = rule.at("wanted_half_width").get<double>();
  const json& half_width = rule.at("half_width");
  stop.last.found.half_width = half_width.is_null() ? nan_d : half_width.get<double>();
  const auto at = rule.at("looked_at").get<std::string>();
  for (const LookedAt which :
       {LookedAt::uncertain_cells, LookedAt::reached_cells, LookedAt::no_cell, LookedAt::asset})
    if (at == to_string(which)) stop.last.found.at = which;
  stop.last.found.n_cells = whole<std::int64_t>(file, rule, "cells");
  stop.last.n_members = whole<std::int64_t>(file, rule, "members");
  stop.last.found.n_valid = whole<std::int64_t>(file, rule, "valid");
  stop.n_looks = whole<std::int64_t>(file, rule, "looks");
  stop.at_most = whole<std::int64_t>(file, rule, "at_most");
  if (!rule.contains("asset")) return stop;
  stop.asset = rule.at("asset").get<std::string>();
  stop.last.found.n_not_known = whole<std::int64_t>(file, rule, "not_known");
  return stop;
}

}  // namespace

Manifest Manifest::read(const fs::path& file) {
  Manifest m;
  try {
    const json all = json::parse(read_text(file));
    m.kind = all.at("kind").get<std::string>();
    m.version = all.at("program").at("version").get<std::string>();
    m.git_commit = all.at("program").at("git_commit").get<std::string>();
    m.compiler = all.at("program").at("compiler").get<std::string>();
    m.build_type = all.at("program").at("build_type").get<std::string>();
    m.started = all.at("started").get<std::string>();
    m.command = all.at("command").get<std::string>();
    m.design = all.at("design").get<std::string>();
    m.seed = whole<std::uint64_t>(file, all, "seed");
    m.members = whole<std::int64_t>(file, all, "members");
    m.spacing_m = all.at("spacing_m").get<double>();
    for (const auto& input : all.at("inputs")) m.inputs.push_back(identity_from(input));
    m.description = all.at("description").get<std::vector<std::string>>();
    m.notes = all.at("notes").get<std::vector<std::string>>();
    m.warnings = all.at("warnings").get<std::vector<std::string>>();
    m.compute_s = all.at("compute_s").get<double>();
    m.hazard_hash = all.at("hazard_hash").get<std::string>();
    // The first versions did not write these.
    m.scenario_hash = all.value("scenario_hash", "");
    m.scene_hash = all.value("scene_hash", "");
    m.design_hash = all.value("design_hash", "");
    m.design_hash_before = all.value("design_hash_before", "");
    m.maps_of = all.value("maps_of", "");
    for (const auto& build : all.value("computed_by", json::array()))
      m.builds.push_back(
          {build.at("version").get<std::string>(), build.at("git_commit").get<std::string>()});
    m.censored = all.value("censored", "");
    if (all.contains("shards")) m.shards = whole<int>(file, all, "shards");
    if (m.shards < 0) not_a_manifest(file, "shards is below zero");
    m.stop = stop_from(file, all);
  } catch (const json::exception& problem) {
    not_a_manifest(file, problem.what());
  }
  return m;
}

std::vector<std::pair<std::string, std::string>> Manifest::lines() const {
  std::vector<std::pair<std::string, std::string>> out = {
      {"program", fmt::format("sturz {} ({})", version, git_commit)},
      {"compiler", fmt::format("{}, {}", compiler, build_type)},
      {"started", started},
      {"command", command},
      {"spacing", fmt::format("{} m", spacing_m)}};
  if (builds.size() > 1) {
    std::string all;
    for (const Build& build : builds) all += (all.empty() ? "" : ", ") + build_text(build);
    out.emplace_back("members computed by", all);
  }
  if (kind != "run") {
    out.emplace_back("design", fmt::format("{}, {} members, seed {}", design, members, seed));
    if (!weighting.empty()) out.emplace_back("weighting", weighting);
    if (stop) out.emplace_back("stop rule", stop_text(*stop));
    if (!censored.empty()) out.emplace_back("cut off", censored);
    out.emplace_back("hash of the maps", hazard_hash);
  }
  for (const InputIdentity& input : inputs)
    out.emplace_back("input " + input.file, identity_text(input));
  for (auto& [name, text] : out) {
    name = as_utf8(name);
    text = as_utf8(text);
  }
  return out;
}

std::string build_text(const Build& build) {
  return fmt::format("sturz {} ({})", build.version, build.git_commit);
}

Build this_build() { return {workflow::version, workflow::git_commit}; }

std::string utc_now() {
  const auto now = std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now());
  return fmt::format("{:%Y-%m-%dT%H:%M:%S}Z",
                     fmt::gmtime(std::chrono::system_clock::to_time_t(now)));
}

}  // namespace sturz::workflow
