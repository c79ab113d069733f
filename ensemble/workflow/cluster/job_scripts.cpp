// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/cluster/job_scripts.hpp"

#include "engine/core/error.hpp"
#include "ensemble/workflow/cluster/shard_layout.hpp"
#include "ensemble/workflow/cluster/shard_plan.hpp"

#include <fmt/core.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace sturz::workflow {
namespace {

/// A value in a line that begins with #SBATCH, of which `%` is a part of file names.
std::string directive(const std::string& name, const std::string& value) {
  const bool plain = std::none_of(value.begin(), value.end(), [](char c) {
    return static_cast<unsigned char>(c) < 0x20 || c == '"' || c == '\\';
  });
  require(plain,
          fmt::format("'{}' cannot stand in a script of Slurm (it holds a quote, a backslash "
                      "or a control character). Choose another name.",
                      value));
  return fmt::format("#SBATCH --{}=\"{}\"\n", name, value);
}

std::string file_pattern(const std::string& folder, const std::string& name) {
  std::string escaped;
  for (const char c : folder) escaped += c == '%' ? std::string("%%") : std::string(1, c);
  return escaped + "/" + name;
}

/// Before the time limit [s]: the program stops within seconds, Slurm looks twice a minute.
int warning_s(double limit_s) {
  return static_cast<int>(std::clamp(std::floor(limit_s / 2), 1.0, 60.0));
}

// Signals go to this shell alone (B:) and are handed on. `wait` comes back when one arrives, and
// is asked again for the program's own end.
constexpr const char* body = R"bash(
stopped= child=
tell() {
  stopped=$1
  if [ -n "$child" ]; then kill -USR1 "$child" 2>/dev/null; fi
}
trap 'tell limit' USR1
trap 'tell cancel' TERM

echo "$(date -u +%FT%TZ) ${SLURM_JOB_ID:-} on ${SLURMD_NODENAME:-}, started ${SLURM_RESTART_COUNT:-0} times before"
"${command[@]}" &
child=$!
if [ -n "$stopped" ]; then kill -USR1 "$child" 2>/dev/null; fi
code=127 over=
while [ -z "$over" ] && [ "$code" -gt 126 ]; do
  kill -0 "$child" 2>/dev/null || over=1
  wait "$child"
  now=$?
  if [ "$now" -ne 127 ]; then code=$now; fi
done

# 138: USR1 came before the program could listen
if [ "$stopped" = limit ] && { [ "$code" -eq 3 ] || [ "$code" -eq 138 ]; }; then
  if [ "${SLURM_RESTART_COUNT:-0}" -ge "$most_restarts" ]; then
    echo "stopped at the time limit for the ${SLURM_RESTART_COUNT}th time: does a single member take longer? See --time."
  else
    echo "stopped at the time limit; goes on in another turn"
    scontrol requeue "$SLURM_JOB_ID"
  fi
fi
exit "$code"
)bash";

}  // namespace

std::string job_script(const ScriptRequest& r) {
  const bool merges = r.shards.empty();
  const Submission& s = r.submission;
  const double limit_s = merges ? s.asked.maps_s : s.asked.shard_s;
  std::string text = "#!/bin/bash\n";
  text += merges ? "# The maps, once every shard has ended one way or another.\n"
                 : "# One shard of the ensemble per task; written by `sturz submit`.\n";
  text += directive("job-name", merges ? s.merge_name() : s.name);
  if (!merges) {
    std::string tasks = ranges_text(r.shards);
    if (r.options.at_a_time > 0) tasks += fmt::format("%{}", r.options.at_a_time);
    text += directive("array", tasks);
  }
  text += directive("chdir", r.work_folder);
  text += directive("output",
                    file_pattern(r.folder.logs().string(), merges ? "maps.txt" : "shard_%a.txt"));
  text += "#SBATCH --open-mode=append\n#SBATCH --requeue\n#SBATCH --ntasks=1\n";
  text += fmt::format("#SBATCH --cpus-per-task={}\n", s.asked.cores);
  text += fmt::format("#SBATCH --mem={}\n",
                      memory_text(merges ? s.asked.maps_bytes : s.asked.shard_bytes));
  text += fmt::format("#SBATCH --time={}\n", time_limit_text(limit_s));
  text += fmt::format("#SBATCH --signal=B:USR1@{}\n", warning_s(limit_s));
  if (!r.options.partition.empty()) text += directive("partition", r.options.partition);
  if (!r.options.account.empty()) text += directive("account", r.options.account);
  for (const std::string& more : r.options.sbatch) {
    require(more.starts_with("-") && more.find('\n') == std::string::npos,
            fmt::format("--sbatch {} (an option of sbatch begins with a dash).", more));
    text += fmt::format("#SBATCH {}\n", more);
  }
  std::vector<std::string> words;
  for (const std::string& word : r.command) words.push_back(shell_word(word));
  text += fmt::format("\ncommand=({})\nmost_restarts=50\n", fmt::join(words, " "));
  // Where jobs are not bound to their cores, a member would take all of the machine.
  if (!merges) text += "export OMP_THREAD_LIMIT=1\n";
  return text + body;
}

}  // namespace sturz::workflow
