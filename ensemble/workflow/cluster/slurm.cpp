// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/cluster/slurm.hpp"

#include "engine/core/error.hpp"
#include "scenarios/schema/number_text.hpp"

#include <fmt/core.h>
#include <fmt/format.h>

#include <limits>
#include <sstream>

namespace sturz::workflow {
namespace {

std::string without_line_end(std::string text) {
  while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
  return text;
}

int number_or_zero(const std::string& text) {
  const auto value = parse_integer(text);
  return value && *value > 0 && *value < std::numeric_limits<int>::max() ? static_cast<int>(*value)
                                                                         : 0;
}

}  // namespace

std::string Slurm::ask(const std::vector<std::string>& words) const {
  const Ran ran = run_(words);
  require(ran.found,
          fmt::format("{} is not here (Slurm is asked through its own commands). Run this on a "
                      "login node of the cluster, or write the scripts alone with --dry-run.",
                      words.front()));
  require(ran.exit_code == 0, fmt::format("{} failed with exit code {}: {}", words.front(),
                                          ran.exit_code, without_line_end(ran.err + ran.out)));
  return ran.out;
}

void Slurm::require_there() const { ask({"sbatch", "--version"}); }

int Slurm::largest_task() const {
  std::istringstream lines(ask({"scontrol", "show", "config"}));
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("MaxArraySize")) continue;
    const std::size_t value = line.find_first_of("0123456789");
    if (value != std::string::npos)
      return number_or_zero(without_line_end(line.substr(value))) - 1;  // tasks count from 0
  }
  return 1000;  // Slurm's own default
}

std::string Slurm::submit(const std::vector<std::string>& sbatch_words) const {
  std::vector<std::string> words{"sbatch", "--parsable"};
  words.insert(words.end(), sbatch_words.begin(), sbatch_words.end());
  const std::string said = ask(words);
  const std::string job = without_line_end(said.substr(0, said.find(';')));  // "12;cluster"
  require(number_or_zero(job) > 0,
          fmt::format("sbatch said '{}' (a job number was expected). See squeue.", said));
  return job;
}

std::vector<QueuedTask> Slurm::queued(std::span<const std::string> names) const {
  const std::string said = ask({"squeue", "--noheader", "--array", "--format=%F|%K|%j|%T",
                                fmt::format("--name={}", fmt::join(names, ","))});
  std::vector<QueuedTask> all;
  std::istringstream lines(said);
  for (std::string line; std::getline(lines, line);) {
    QueuedTask task;
    std::string number;
    std::istringstream fields(line);
    if (std::getline(fields, task.job, '|') && std::getline(fields, number, '|') &&
        std::getline(fields, task.name, '|') && std::getline(fields, task.state)) {
      task.task = number_or_zero(number);
      if (task.state != "COMPLETING") all.push_back(task);  // over, its node is cleaned up
    }
  }
  return all;
}

void Slurm::release(const std::string& job) const { ask({"scontrol", "release", job}); }

void Slurm::cancel(std::span<const std::string> jobs) const {
  if (jobs.empty()) return;
  std::vector<std::string> words{"scancel"};
  words.insert(words.end(), jobs.begin(), jobs.end());
  run_(words);
}

}  // namespace sturz::workflow
