// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/batch/guard.hpp"

#include "ensemble/workflow/machine/cores.hpp"

#include <fmt/core.h>

#include <chrono>
#include <ctime>
#include <limits>
#include <utility>

namespace sturz::workflow {
namespace {

constexpr double giga = 1e9;

/// Of the day, by the machine's clock and time zone.
int minute_now() {
  const std::time_t now = std::time(nullptr);
  std::tm local{};
  localtime_r(&now, &local);
  return 60 * local.tm_hour + local.tm_min;
}

}  // namespace

double free_disk_bytes(const std::filesystem::path& wanted) {
  std::error_code failed;
  std::filesystem::path folder = wanted;
  while (!std::filesystem::exists(folder, failed) && folder.has_relative_path())
    folder = folder.parent_path();
  const auto space = std::filesystem::space(folder, failed);
  return failed ? std::numeric_limits<double>::infinity() : static_cast<double>(space.available);
}

Guard::Guard(GuardLimits limits, const std::atomic<bool>& interrupt)
    : limits_(std::move(limits)),
      interrupt_(interrupt),
      watcher_([this](const std::stop_token& over) { watch(over); }) {}

Guard::~Guard() {
  watcher_.request_stop();
  watcher_.join();
}

int Guard::minutes_to_wait() const {
  return limits_.between ? minutes_until_open(*limits_.between, minute_now()) : 0;
}

StopReason Guard::slow_reasons() const {
  std::error_code ignored;
  if (!limits_.stop_file.empty() && std::filesystem::exists(limits_.stop_file, ignored))
    return {StopCause::stop_file,
            fmt::format("the stop file {} is there", limits_.stop_file.string())};
  if (limits_.min_free_disk_bytes > 0) {
    const double free = free_disk_bytes(limits_.disk);
    if (free < limits_.min_free_disk_bytes)
      return {StopCause::disk,
              fmt::format("the disk of {} has {:.3g} GB free, less than min_free_disk_gb = {:g}",
                          limits_.disk.string(), free / giga, limits_.min_free_disk_bytes / giga)};
  }
  if (minutes_to_wait() > 0)
    return {StopCause::window,
            fmt::format("it is not within {}", day_window_text(*limits_.between))};
  const double held = limits_.max_memory_bytes > 0 ? resident_memory_bytes() : 0;
  if (held > limits_.max_memory_bytes)
    return {StopCause::memory, fmt::format("it holds {:.3g} GB, more than max_memory_gb = {:g}",
                                           held / giga, limits_.max_memory_bytes / giga)};
  return {};
}

StopReason Guard::look() {
  const std::lock_guard guard(lock_);
  // A signal counts whatever else there is: who sent it waits for the end.
  if (interrupt_.load()) reason_ = {StopCause::interrupted, "interrupted"};
  if (!reason_) reason_ = slow_reasons();
  if (reason_) flag_ = true;
  return reason_;
}

void Guard::clear() {
  const std::lock_guard guard(lock_);
  reason_ = {};
  flag_ = false;
}

void Guard::watch(const std::stop_token& over) {
  constexpr std::chrono::milliseconds every{50};
  constexpr int slow_every = 20;
  std::mutex mine;
  std::unique_lock hold(mine);
  for (int i = 1; !wake_.wait_for(hold, over, every, [&] { return over.stop_requested(); }); ++i)
    if (interrupt_.load() || i % slow_every == 0) look();
}

}  // namespace sturz::workflow
