// SPDX-License-Identifier: Apache-2.0
#include "ensemble/app/cluster/task_shard.hpp"

#include "engine/core/error.hpp"
#include "ensemble/workflow/folder/process_identity.hpp"
#include "scenarios/schema/number_text.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cstdlib>

namespace sturz::app {
namespace {

constexpr long long most_shards = 1000000;

std::string environment(const char* name) {
  const char* value = std::getenv(name);
  return value ? value : "";
}

/// The shard that the task of a scheduler computes.
long long task_shard(long long n, int first_task) {
  for (const char* name : {"HQ_TASK_ID", "SLURM_ARRAY_TASK_ID"}) {
    const std::string value = environment(name);
    if (value.empty()) continue;
    const long long k = parse_integer(value).value_or(-1) - first_task + 1;
    require(k >= 1 && k <= n,
            fmt::format("--shard auto/{}: {} is {} (tasks {} to {} compute shards 1 to {}). Make "
                        "the array {}-{}, or say with --first-task where it begins.",
                        n, name, value, first_task, first_task + n - 1, n, first_task,
                        first_task + n - 1));
    return k;
  }
  throw SetupError(fmt::format(
      "--shard auto/{}: neither SLURM_ARRAY_TASK_ID nor HQ_TASK_ID is set (this is no task of an "
      "array). Give the number itself, such as --shard 1/{}.",
      n, n));
}

}  // namespace

workflow::Shard shard_of(const std::string& text, int first_task) {
  if (text.empty()) return {};
  const std::size_t slash = std::min(text.find('/'), text.size());
  const std::string which = text.substr(0, slash);
  const long long n = parse_integer(text.substr(std::min(slash + 1, text.size()))).value_or(0);
  const bool is_auto = which == "auto" && n >= 1 && n <= most_shards;
  const long long k = is_auto ? task_shard(n, first_task) : parse_integer(which).value_or(0);
  require(k >= 1 && k <= n && n <= most_shards,
          fmt::format("--shard {} (must be K/N with 1 <= K <= N, such as 2/8, or auto/N).", text));
  return {static_cast<int>(k), static_cast<int>(n)};
}

void tell_scheduler_job() {
  std::string job, restarts;
  if (const std::string id = environment("HQ_JOB_ID"); !id.empty()) {
    job = fmt::format("hq/{}/{}/{}", environment("HQ_SERVER_UID"), id, environment("HQ_TASK_ID"));
    restarts = environment("HQ_INSTANCE_ID");
  } else if (const std::string slurm = environment("SLURM_JOB_ID"); !slurm.empty()) {
    job = fmt::format("slurm/{}/{}", environment("SLURM_CLUSTER_NAME"), slurm);
    restarts = environment("SLURM_RESTART_COUNT");
  }
  if (!job.empty()) workflow::this_process_is_of(job, parse_integer(restarts).value_or(0));
}

}  // namespace sturz::app
