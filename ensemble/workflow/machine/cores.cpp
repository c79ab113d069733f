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
#include <string_view>
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

/// The smallest value on the way from this process's control group to the root. \param of_folder
/// what a group's folder says, `unlimited` where it says nothing
template <class OfFolder>
double smallest_of_groups(const OfFolder& of_folder) {
  const std::string root = "/sys/fs/cgroup";
  double smallest = of_folder(root);
  std::ifstream groups("/proc/self/cgroup");
  for (std::string line; std::getline(groups, line);) {
    if (!line.starts_with("0::")) continue;
    std::istringstream parts(line.substr(3));
    std::string folder = root;
    for (std::string part; std::getline(parts, part, '/');) {
      if (part.empty()) continue;
      folder += "/" + part;
      smallest = std::min(smallest, of_folder(folder));
    }
  }
  return smallest;
}

double cores_by_quota() {
  return std::min(smallest_of_groups(quota_v2), quota_v1("/sys/fs/cgroup/cpu"));
}

double number_in(const std::string& file) {
  std::ifstream from(file);
  double value = 0;
  return from >> value ? value : unlimited;  // "max" is no number
}

/// Of what a control group holds, what it gives back when memory is wanted: files that were read or
/// written. A container that has read many members mostly holds as much as it may. [bytes]
double reclaimable_in(const std::string& folder, std::string_view prefix) {
  std::ifstream from(folder + "/memory.stat");
  std::string name;
  double value = 0, files = 0;
  while (from >> name >> value)
    if (name.starts_with(prefix) && (name.substr(prefix.size()) == "inactive_file" ||
                                     name.substr(prefix.size()) == "active_file"))
      files += value;
  return files;
}

/// What a control group of either version leaves of its memory [bytes].
double memory_left(double most, double held, double reclaimable) {
  return most < unlimited && held < unlimited
             ? std::max(0.0, most - std::max(0.0, held - reclaimable))
             : unlimited;
}
double memory_left_v2(const std::string& folder) {
  return memory_left(number_in(folder + "/memory.max"), number_in(folder + "/memory.current"),
                     reclaimable_in(folder, ""));
}
double memory_left_v1(const std::string& folder) {
  return memory_left(number_in(folder + "/memory.limit_in_bytes"),
                     number_in(folder + "/memory.usage_in_bytes"),
                     reclaimable_in(folder, "total_"));
}

double free_memory_of_machine() {
  std::ifstream info("/proc/meminfo");
  std::string name, unit;
  double kib = 0;
  while (info >> name >> kib && std::getline(info, unit))
    if (name == "MemAvailable:") return kib * 1024;
  return 0;
}

}  // namespace

int available_cores() {
  const int in_set = std::max(1, cores_in_cpu_set());
  const double quota = cores_by_quota();
  if (quota >= in_set) return in_set;
  return std::max(1, static_cast<int>(std::ceil(quota - 1e-9)));
}

double available_memory_bytes() {
  const double left =
      std::min(smallest_of_groups(memory_left_v2), memory_left_v1("/sys/fs/cgroup/memory"));
  const double free = free_memory_of_machine();
  return free > 0 ? std::min(free, left) : (left < unlimited ? left : 0);
}

std::size_t records_memory_bytes(double max_process_bytes) {
  constexpr double share = 0.125;
  constexpr std::size_t least = std::size_t{128} << 20, most = std::size_t{1} << 30;
  double wanted = share * available_memory_bytes();
  if (max_process_bytes > 0)  // a half: maps take memory as well
    wanted = std::min(wanted, (max_process_bytes - resident_memory_bytes()) / 2);
  return wanted < static_cast<double>(most)
             ? std::max(least, static_cast<std::size_t>(std::max(wanted, 0.0)))
             : most;
}

double resident_memory_bytes() {
  std::ifstream info("/proc/self/statm");
  double pages_in_all = 0, pages_held = 0;
  if (!(info >> pages_in_all >> pages_held)) return 0;
  return pages_held * static_cast<double>(sysconf(_SC_PAGESIZE));
}

}  // namespace sturz::workflow
