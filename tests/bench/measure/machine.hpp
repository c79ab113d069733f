// SPDX-License-Identifier: Apache-2.0
/// Where and when figures were taken, and whether the machine had other work.
#pragma once

#include <nlohmann/json.hpp>

#include <string>

namespace sturz::bench {

/// processor, cores, instruction_set, date (UTC), compiler, build_type, commit.
nlohmann::ordered_json machine_facts();

/// Mean number of runnable tasks over the last minute.
double load_average();
/// A sentence for the reader when the load is high; empty when it is not.
std::string load_warning(double load);

/// What others did on this machine while figures were taken.
class Bystanders {
 public:
  Bystanders();
  /// Processors that others kept busy since, on average.
  double others() const;
  /// Processors that the host of a virtual machine took away since, on average.
  double stolen() const;

 private:
  struct Clocks {
    double wall_s = 0, own_s = 0, busy_s = 0, stolen_s = 0;
  };
  static Clocks now();
  Clocks begin_;
};
/// Processors that this process may use.
int available_cores();
/// Bytes that the allocator has handed out.
std::size_t heap_bytes();

}  // namespace sturz::bench
