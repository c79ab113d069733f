// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/cluster/submission.hpp"

#include "engine/core/error.hpp"
#include "io/files/text_files.hpp"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <system_error>

namespace sturz::workflow {
using json = nlohmann::ordered_json;

std::optional<Submission> read_submission(const std::filesystem::path& file) {
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored)) return std::nullopt;
  try {
    const json all = json::parse(read_text(file));
    const json& asked = all.at("asked");
    Submission s;
    s.complete = all.at("complete").get<bool>();
    s.name = all.at("name").get<std::string>();
    s.since = all.at("since").get<std::string>();
    s.shards = all.at("shards").get<int>();
    s.jobs = all.at("jobs").get<std::vector<std::string>>();
    s.merge_job = all.at("merge_job").get<std::string>();
    s.asked = {asked.at("cores").get<int>(), asked.at("shard_s").get<double>(),
               asked.at("shard_bytes").get<double>(), asked.at("maps_s").get<double>(),
               asked.at("maps_bytes").get<double>()};
    return s;
  } catch (const json::exception& problem) {
    throw SetupError(
        fmt::format("{}: not a record that `sturz submit` wrote ({}). Look with "
                    "squeue whether its jobs still run, and delete it.",
                    file.string(), problem.what()));
  }
}

void write_submission(const std::filesystem::path& file, const Submission& s) {
  const json all = {{"what", "jobs that `sturz submit` made for this folder"},
                    {"complete", s.complete},
                    {"name", s.name},
                    {"since", s.since},
                    {"shards", s.shards},
                    {"jobs", s.jobs},
                    {"merge_job", s.merge_job},
                    {"asked",
                     {{"cores", s.asked.cores},
                      {"shard_s", s.asked.shard_s},
                      {"shard_bytes", s.asked.shard_bytes},
                      {"maps_s", s.asked.maps_s},
                      {"maps_bytes", s.asked.maps_bytes}}}};
  write_text_atomic(file, all.dump(2, ' ', false, json::error_handler_t::replace) + "\n");
}

}  // namespace sturz::workflow
