// SPDX-License-Identifier: Apache-2.0
#include "tests/physics/results/results_file.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <map>

namespace sturz::test {
namespace {

constexpr const char* head =
    "case,dx_m,particles,dt_s,binding_limit,steps,wall_s,quantity,measured,reference,error,"
    "tolerance,verdict";

/// Holds the file's lock for its lifetime.
class Lock {
 public:
  explicit Lock(const std::string& path) : file_(open(path.c_str(), O_CREAT | O_RDWR, 0644)) {
    if (file_ >= 0) flock(file_, LOCK_EX);
  }
  ~Lock() {
    if (file_ >= 0) close(file_);
  }
  Lock(const Lock&) = delete;
  Lock& operator=(const Lock&) = delete;

 private:
  int file_;
};

std::string key_of(const std::string& line) {
  const auto end = line.find('"', 1);
  return line.empty() || line[0] != '"' || end == std::string::npos ? "" : line.substr(1, end - 1);
}

}  // namespace

void keep_line(const std::string& key, const std::string& line) {
  const std::string folder = STURZ_BINARY_DIR "/tests/physics", path = folder + "/results.csv";
  std::filesystem::create_directories(folder);
  const Lock lock(path + ".lock");
  std::map<std::string, std::string> lines;
  std::ifstream in(path);
  for (std::string old; std::getline(in, old);)
    if (const std::string k = key_of(old); !k.empty()) lines[k] = old;
  in.close();
  lines[key] = line;
  std::ofstream out(path);
  out << head << '\n';
  for (const auto& [k, text] : lines) out << text << '\n';
}

}  // namespace sturz::test
