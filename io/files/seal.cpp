// SPDX-License-Identifier: Apache-2.0
#include "io/files/seal.hpp"

#include "io/files/io_error.hpp"
#include "io/files/sha256.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <fstream>
#include <string_view>
#include <vector>

namespace sturz {
namespace {

constexpr std::string_view seal_begin = "\n#sturz sha256 ";
constexpr std::size_t seal_size = seal_begin.size() + 64 + 1;

std::string seal_line(Sha256& hash) { return std::string(seal_begin) + hash.hex() + "\n"; }

}  // namespace

std::string seal_of(std::span<const std::byte> content) {
  Sha256 hash;
  hash.add(std::span(reinterpret_cast<const char*>(content.data()), content.size()));
  return seal_line(hash);
}

SealState seal_state(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary | std::ios::ate);
  const std::streamoff size = stream ? static_cast<std::streamoff>(stream.tellg()) : -1;
  const auto unreadable = [&] {
    return IoError(
        fmt::format("{}: cannot be read. Check its name and permissions.", file.string()));
  };
  if (size < 0) throw unreadable();
  if (size < static_cast<std::streamoff>(seal_size)) return SealState::missing;
  stream.seekg(0);
  Sha256 hash;
  std::vector<char> block(std::size_t{1} << 18);
  auto left = static_cast<std::size_t>(size) - seal_size;
  while (left > 0) {
    const std::size_t n = std::min(left, block.size());
    if (!stream.read(block.data(), static_cast<std::streamsize>(n))) throw unreadable();
    hash.add(std::span(block.data(), n));
    left -= n;
  }
  std::string found(seal_size, '\0');
  if (!stream.read(found.data(), static_cast<std::streamsize>(seal_size))) throw unreadable();
  if (found == seal_line(hash)) return SealState::good;
  return found.starts_with(seal_begin) ? SealState::broken : SealState::missing;
}

void require_sealed(const std::filesystem::path& file) {
  const SealState state = seal_state(file);
  if (state == SealState::good) return;
  throw IoError(fmt::format(
      "{}: {}. The command that wrote it computes it again.", file.string(),
      state == SealState::broken
          ? "its content does not fit its checksum (it was damaged after it was written)"
          : "does not end with its checksum (it was cut short, damaged, or written by something "
            "else)"));
}

}  // namespace sturz
