// SPDX-License-Identifier: Apache-2.0
#include "io/files/text_files.hpp"

#include "io/files/atomic_file.hpp"
#include "io/files/io_error.hpp"

#include <fmt/core.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <span>
#include <sstream>
#include <system_error>

namespace sturz {

void write_text_atomic(const std::filesystem::path& target, std::string_view text) {
  write_bytes_atomic(target, std::as_bytes(std::span(text.data(), text.size())));
}

std::string read_text(const std::filesystem::path& file) {
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored)) {
    const std::filesystem::path inside = file / "scenario.yaml";
    throw IoError(fmt::format("{} is a folder. {}", file.string(),
                              std::filesystem::exists(inside, ignored)
                                  ? fmt::format("Did you mean {}?", inside.string())
                                  : "Name a file in it."));
  }
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  if (stream) text << stream.rdbuf();
  if (!stream)
    throw IoError(fmt::format("cannot read {} ({}). Check its name and permissions.", file.string(),
                              std::strerror(errno)));
  return text.str();
}

}  // namespace sturz
