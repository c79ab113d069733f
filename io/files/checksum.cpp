// SPDX-License-Identifier: Apache-2.0
#include "io/files/checksum.hpp"

#include "io/files/io_error.hpp"
#include "io/files/sha256.hpp"

#include <fmt/core.h>

#include <fstream>
#include <span>
#include <vector>

namespace sturz {
namespace {

/// "sha256" of "sha256:...".
std::string kind_of(const std::string& checksum) { return checksum.substr(0, checksum.find(':')); }

}  // namespace

std::string file_checksum(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::vector<char> block(1 << 16);
  Sha256 hash;
  while (stream) {
    stream.read(block.data(), static_cast<std::streamsize>(block.size()));
    hash.add(std::span(block.data(), static_cast<std::size_t>(stream.gcount())));
  }
  if (!stream.eof())
    throw IoError(
        fmt::format("cannot read {} for its checksum. Check its permissions.", file.string()));
  return "sha256:" + hash.hex();
}

std::string text_checksum(std::string_view text) {
  Sha256 hash;
  hash.add(std::span(text.data(), text.size()));
  return "sha256:" + hash.hex();
}

std::string checksum_difference(const std::string& before, const std::string& now) {
  if (before == now) return {};
  if (kind_of(before) == kind_of(now)) return "other content than before";
  return fmt::format(
      "its checksum is of another kind ({}, now {}), so a change cannot be detected; "
      "another version of sturz began this folder",
      kind_of(before), kind_of(now));
}

}  // namespace sturz
