// SPDX-License-Identifier: Apache-2.0
#include "io/files/checksum.hpp"

#include "engine/core/error.hpp"
#include "io/files/io_error.hpp"

#include <fmt/core.h>
#include <openssl/evp.h>

#include <array>
#include <fstream>
#include <memory>
#include <span>
#include <vector>

namespace sturz {
namespace {

/// libcrypto's digest; it fails only where the library has no SHA-256 or no memory.
class Sha256 {
 public:
  Sha256() : context_(EVP_MD_CTX_new(), &EVP_MD_CTX_free) {
    good_ = context_ && EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr) == 1;
  }
  void add(std::span<const char> bytes) {
    good_ = good_ && EVP_DigestUpdate(context_.get(), bytes.data(), bytes.size()) == 1;
  }
  std::string hex() {
    std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
    unsigned n = 0;
    good_ = good_ && EVP_DigestFinal_ex(context_.get(), digest.data(), &n) == 1;
    expect(good_, "libcrypto computes SHA-256");
    std::string text;
    for (unsigned i = 0; i < n; ++i) text += fmt::format("{:02x}", digest[i]);
    return text;
  }

 private:
  std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context_;
  bool good_ = false;
};

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

std::string checksum_difference(const std::string& before, const std::string& now) {
  if (before == now) return {};
  if (kind_of(before) == kind_of(now)) return "other content than before";
  return fmt::format(
      "its checksum is of another kind ({}, now {}), so a change cannot be detected; "
      "another version of sturz began this folder",
      kind_of(before), kind_of(now));
}

}  // namespace sturz
