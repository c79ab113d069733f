// SPDX-License-Identifier: Apache-2.0
#include "io/files/checksum.hpp"

#include "io/files/io_error.hpp"

#include <fmt/core.h>

#include <fstream>
#include <vector>

namespace sturz {

std::uint64_t fnv1a64(std::span<const std::byte> bytes, std::uint64_t start) {
  std::uint64_t hash = start;
  for (const std::byte b : bytes) hash = (hash ^ std::to_integer<unsigned>(b)) * 1099511628211ULL;
  return hash;
}

std::string file_checksum(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::vector<char> block(1 << 16);
  std::uint64_t hash = fnv1a64({});
  while (stream) {
    stream.read(block.data(), static_cast<std::streamsize>(block.size()));
    const auto n = static_cast<std::size_t>(stream.gcount());
    hash = fnv1a64(std::as_bytes(std::span(block.data(), n)), hash);
  }
  if (!stream.eof())
    throw IoError(
        fmt::format("cannot read {} for its checksum. Check its permissions.", file.string()));
  return fmt::format("fnv1a64:{:016x}", hash);
}

}  // namespace sturz
