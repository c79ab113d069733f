// SPDX-License-Identifier: Apache-2.0
/// Runs a program the way a user does: arguments in, exit code and text out, signals in between.
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace sturz::test {

struct Ended {
  int exit_code = -1;  ///< -1 when a signal ended it
  int signal = 0;      ///< the signal that ended it, 0 if none
  std::string out, err;
};

/// A child process whose output goes to two files in `folder`.
class Process {
 public:
  /// \param environment extra "NAME=value" entries
  Process(const std::vector<std::string>& command, const std::string& folder,
          const std::vector<std::string>& environment = {});
  ~Process();
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  void send(int signal);
  bool running();
  /// Waits for the end; kills after `timeout_s` (the exit code is then -1, the signal SIGKILL).
  Ended wait(double timeout_s = 120);

 private:
  pid_t pid_ = -1;
  int status_ = 0;
  bool ended_ = false;
  std::string out_, err_;
};

/// Runs to the end.
Ended run_process(const std::vector<std::string>& command, const std::string& folder,
                  const std::vector<std::string>& environment = {});

}  // namespace sturz::test
