// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/machine.hpp"

#include "engine/effects/fused_sweep.hpp"
#include "ensemble/app/version.hpp"

#include <fmt/core.h>
#include <malloc.h>
#include <sched.h>
#include <stdlib.h>

#include <ctime>
#include <fstream>

namespace sturz::bench {
namespace {

std::string processor() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  return "unknown processor";
}

std::string now_utc() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text;
}

}  // namespace

nlohmann::ordered_json machine_facts() {
  return {{"processor", processor()},
          {"cores", available_cores()},
          {"instruction_set", std::string(to_string(best_instruction_set()))},
          {"date", now_utc()},
          {"compiler", app::compiler},
          {"build_type", app::build_type},
          {"commit", app::git_commit}};
}

double load_average() {
  double load = 0;
  return getloadavg(&load, 1) == 1 ? load : 0;
}

std::string load_warning(double load) {
  if (load < 0.5) return "";
  return fmt::format(
      "warning: the load is {:.2f}: others compute here too. Single-thread figures count this "
      "thread's own time and hold to about 20 %; figures by the wall clock do not hold.",
      load);
}

int available_cores() {
  cpu_set_t set;
  CPU_ZERO(&set);
  return sched_getaffinity(0, sizeof set, &set) == 0 ? CPU_COUNT(&set) : 1;
}

std::size_t heap_bytes() {
  const auto info = mallinfo2();
  return info.uordblks + info.hblkhd;
}

}  // namespace sturz::bench
