// SPDX-License-Identifier: Apache-2.0
#include "ensemble/app/cluster/run_command.hpp"

#include "engine/core/error.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>

namespace sturz::app {
namespace {

constexpr int not_found = 127;

/// Ends of a pipe that no other child inherits.
std::array<int, 2> new_pipe() {
  std::array<int, 2> ends{};
  require(pipe2(ends.data(), O_CLOEXEC) == 0,
          fmt::format("no pipe to another program ({}). Close some files.", std::strerror(errno)));
  return ends;
}

/// In the child: only calls that are safe between fork and exec.
[[noreturn]] void become(const std::vector<char*>& words, int out, int err) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  signal(SIGXFSZ, SIG_DFL);
  const int nothing = open("/dev/null", O_RDONLY);
  if (nothing >= 0) dup2(nothing, STDIN_FILENO);
  dup2(out, STDOUT_FILENO);
  dup2(err, STDERR_FILENO);
  execvp(words.front(), words.data());
  _exit(errno == ENOENT ? not_found : not_found - 1);
}

/// Reads both until their writers have gone.
void collect(int out, int err, workflow::Ran& ran) {
  std::array<pollfd, 2> streams{{{out, POLLIN, 0}, {err, POLLIN, 0}}};
  std::array<char, 4096> buffer{};
  while (streams[0].fd >= 0 || streams[1].fd >= 0) {
    if (poll(streams.data(), streams.size(), -1) < 0) {
      if (errno == EINTR) continue;
      break;
    }
    for (std::size_t i = 0; i < streams.size(); ++i) {
      if (streams[i].fd < 0 || streams[i].revents == 0) continue;
      const ssize_t n = read(streams[i].fd, buffer.data(), buffer.size());
      if (n > 0)
        (i == 0 ? ran.out : ran.err).append(buffer.data(), static_cast<std::size_t>(n));
      else if (n == 0 || errno != EINTR)
        streams[i].fd = -1;
    }
  }
}

}  // namespace

workflow::Ran run_command(const std::vector<std::string>& words) {
  std::vector<std::string> copies = words;
  std::vector<char*> pointers;
  for (std::string& word : copies) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  const auto out = new_pipe(), err = new_pipe();
  const pid_t child = fork();
  if (child == 0) become(pointers, out[1], err[1]);
  close(out[1]);
  close(err[1]);
  workflow::Ran ran;
  if (child > 0) collect(out[0], err[0], ran);
  close(out[0]);
  close(err[0]);
  require(child > 0,
          fmt::format("{} cannot be started ({}).", words.front(), std::strerror(errno)));
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  ran.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  ran.found = ran.exit_code != not_found;
  return ran;
}

}  // namespace sturz::app
