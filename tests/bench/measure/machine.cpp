// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/measure/machine.hpp"

#include "engine/effects/sweep/fused_sweep.hpp"
#include "ensemble/workflow/version.hpp"
#include "tests/bench/measure/clocks.hpp"

#include <fmt/core.h>
#include <malloc.h>
#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
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
          {"compiler", workflow::compiler},
          {"build_type", workflow::build_type},
          {"commit", workflow::git_commit}};
}

double load_average() {
  double load = 0;
  return getloadavg(&load, 1) == 1 ? load : 0;
}

std::string load_warning(double load) {
  if (load < 0.5) return "";
  return fmt::format(
      "warning: the load is {:.2f}; if others go on computing, single-thread figures (this "
      "thread's "
      "own time) hold to about 20 %, figures by the wall clock not at all.",
      load);
}

Bystanders::Bystanders() : begin_(now()) {}

Bystanders::Clocks Bystanders::now() {
  Clocks c;
  c.wall_s = wall_seconds();
  c.own_s = seconds_of(CLOCK_PROCESS_CPUTIME_ID);
  std::ifstream file("/proc/stat");
  std::string name;
  double user = 0, nice = 0, system = 0, idle = 0, wait = 0, irq = 0, soft = 0, stolen = 0;
  if (file >> name >> user >> nice >> system >> idle >> wait >> irq >> soft >> stolen) {
    const double tick = 1.0 / static_cast<double>(sysconf(_SC_CLK_TCK));
    c.busy_s = tick * (user + nice + system + irq + soft);
    c.stolen_s = tick * stolen;
  }
  return c;
}

double Bystanders::others() const {
  const Clocks end = now();
  const double busy = end.busy_s - begin_.busy_s - (end.own_s - begin_.own_s);
  return std::max(0.0, busy / (end.wall_s - begin_.wall_s));
}

double Bystanders::stolen() const {
  const Clocks end = now();
  return (end.stolen_s - begin_.stolen_s) / (end.wall_s - begin_.wall_s);
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
