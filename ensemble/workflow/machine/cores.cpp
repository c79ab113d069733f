// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/machine/cores.hpp"

#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>
#include <thread>

namespace sturz::workflow {
namespace {

constexpr double unlimited = std::numeric_limits<double>::infinity();

int cores_in_cpu_set() {
  cpu_set_t set;
  CPU_ZERO(&set);
  if (sched_getaffinity(0, sizeof set, &set) == 0) return CPU_COUNT(&set);
  return static_cast<int>(std::thread::hardware_concurrency());
}

/// "max 100000" or "150000 100000" (version 2).
double quota_v2(const std::string& folder) {
  std::ifstream file(folder + "/cpu.max");
  std::string quota;
  double period = 0;
  if (!(file >> quota >> period) || quota == "max" || period <= 0) return unlimited;
  return std::strtod(quota.c_str(), nullptr) / period;
}

double quota_v1(const std::string& folder) {
  std::ifstream quota_file(folder + "/cpu.cfs_quota_us"),
      period_file(folder + "/cpu.cfs_period_us");
  double quota = -1, period = 0;
  if (!(quota_file >> quota) || !(period_file >> period) || quota <= 0 || period <= 0)
    return unlimited;
  return quota / period;
}

/// The smallest quota on the way from this process's control group to the root.
double cores_by_quota() {
  const std::string root = "/sys/fs/cgroup";
  double cores = std::min(quota_v2(root), quota_v1(root + "/cpu"));
  std::ifstream groups("/proc/self/cgroup");
  for (std::string line; std::getline(groups, line);) {
    if (!line.starts_with("0::")) continue;
    std::istringstream parts(line.substr(3));
    std::string folder = root;
    for (std::string part; std::getline(parts, part, '/');) {
      if (part.empty()) continue;
      folder += "/" + part;
      cores = std::min(cores, quota_v2(folder));
    }
  }
  return cores;
}

}  // namespace

int available_cores() {
  const int in_set = std::max(1, cores_in_cpu_set());
  const double quota = cores_by_quota();
  if (quota >= in_set) return in_set;
  return std::max(1, static_cast<int>(std::ceil(quota - 1e-9)));
}

double available_memory_bytes() {
  std::ifstream info("/proc/meminfo");
  std::string name, unit;
  double kib = 0;
  while (info >> name >> kib && std::getline(info, unit))
    if (name == "MemAvailable:") return kib * 1024;
  return 0;
}

double resident_memory_bytes() {
  std::ifstream info("/proc/self/statm");
  double pages_in_all = 0, pages_held = 0;
  if (!(info >> pages_in_all >> pages_held)) return 0;
  return pages_held * static_cast<double>(sysconf(_SC_PAGESIZE));
}

}  // namespace sturz::workflow
