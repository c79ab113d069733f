// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/folder/process_identity.hpp"

#include <signal.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace sturz::workflow {
namespace {

std::string first_word(const std::string& file) {
  std::string word;
  std::ifstream(file) >> word;
  return word;
}

struct ProcessState {
  char state = '?';
  std::uint64_t start = 0;
};

/// From /proc/PID/stat; the name in brackets may hold anything, so fields count from the last one.
ProcessState state_of(std::int64_t pid) {
  std::ostringstream text;
  text << std::ifstream("/proc/" + std::to_string(pid) + "/stat").rdbuf();
  const std::string stat = text.str();
  const std::size_t name_end = stat.rfind(')');
  ProcessState found;
  if (name_end == std::string::npos) return found;
  std::istringstream fields(stat.substr(name_end + 1));
  fields >> found.state;
  std::string skipped;
  constexpr int between_state_and_start = 18;
  for (int i = 0; i < between_state_and_start; ++i) fields >> skipped;
  fields >> found.start;
  return found;
}

struct Job {
  std::string name;
  std::int64_t restarts = 0;
};
Job& own_job() {
  static Job job;
  return job;
}

ProcessIdentity identify() {
  ProcessIdentity me;
  me.job = own_job().name;
  me.restarts = own_job().restarts;
  char host[256] = {};
  gethostname(host, sizeof host - 1);
  me.host = host;
  me.machine = first_word("/etc/machine-id");
  me.boot = first_word("/proc/sys/kernel/random/boot_id");
  std::error_code ignored;
  me.pids = std::filesystem::read_symlink("/proc/self/ns/pid", ignored).string();
  me.pid = getpid();
  me.start = state_of(me.pid).start;
  return me;
}

}  // namespace

const ProcessIdentity& this_process() {
  static ProcessIdentity me = identify();
  if (me.pid != getpid()) me = identify();  // a child of fork()
  return me;
}

void this_process_is_of(const std::string& job, std::int64_t restarts) {
  own_job() = {job, restarts};
}

bool replaces(const ProcessIdentity& earlier) {
  const ProcessIdentity& me = this_process();
  return !me.job.empty() && me.job == earlier.job && me.restarts > earlier.restarts;
}

Liveness liveness_of(const ProcessIdentity& other) {
  const ProcessIdentity& me = this_process();
  if (other.host != me.host || other.machine != me.machine) return Liveness::unknown;
  if (other.boot != me.boot) return Liveness::gone;
  if (other.pids != me.pids) return Liveness::unknown;
  if (kill(static_cast<pid_t>(other.pid), 0) != 0 && errno == ESRCH) return Liveness::gone;
  const ProcessState now = state_of(other.pid);
  if (now.state == 'Z' || now.state == 'X') return Liveness::gone;
  if (now.start != 0 && now.start != other.start) return Liveness::gone;
  return Liveness::alive;
}

}  // namespace sturz::workflow
