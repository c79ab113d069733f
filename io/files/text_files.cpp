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

namespace sturz {

void write_text_atomic(const std::filesystem::path& target, std::string_view text) {
  write_bytes_atomic(target, std::as_bytes(std::span(text.data(), text.size())));
}

std::string read_text(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  if (stream) text << stream.rdbuf();
  if (!stream || std::filesystem::is_directory(file))
    throw IoError(fmt::format("cannot read {} ({}). Check its name and permissions.", file.string(),
                              std::strerror(errno)));
  return text.str();
}

}  // namespace sturz
