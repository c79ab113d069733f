// SPDX-License-Identifier: Apache-2.0
#include "io/files/sha256.hpp"

#include "engine/core/error.hpp"

#include <fmt/core.h>
#include <openssl/evp.h>

#include <array>

namespace sturz {

struct Sha256::Context {
  std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> digest{EVP_MD_CTX_new(),
                                                                 &EVP_MD_CTX_free};
};

Sha256::Sha256() : context_(std::make_unique<Context>()) {
  EVP_MD_CTX* digest = context_->digest.get();
  good_ = digest && EVP_DigestInit_ex(digest, EVP_sha256(), nullptr) == 1;
}

Sha256::~Sha256() = default;

void Sha256::add(std::span<const char> bytes) {
  good_ = good_ && EVP_DigestUpdate(context_->digest.get(), bytes.data(), bytes.size()) == 1;
}

std::string Sha256::hex() {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned n = 0;
  good_ = good_ && EVP_DigestFinal_ex(context_->digest.get(), digest.data(), &n) == 1;
  expect(good_, "libcrypto computes SHA-256");
  std::string text;
  for (unsigned i = 0; i < n; ++i) text += fmt::format("{:02x}", digest[i]);
  return text;
}

}  // namespace sturz
