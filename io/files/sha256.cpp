// SPDX-License-Identifier: Apache-2.0
#include "io/files/sha256.hpp"

#include "engine/core/error.hpp"

#include <fmt/core.h>
#include <openssl/evp.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace sturz {

/// libcrypto's digest; it fails only where the library has no SHA-256 or no memory.
struct Sha256::State {
  std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context{EVP_MD_CTX_new(),
                                                                  &EVP_MD_CTX_free};
  bool good = context && EVP_DigestInit_ex(context.get(), EVP_sha256(), nullptr) == 1;
};

Sha256::Sha256() : state_(std::make_unique<State>()) {}
Sha256::~Sha256() = default;
Sha256::Sha256(Sha256&&) noexcept = default;
Sha256& Sha256::operator=(Sha256&&) noexcept = default;

void Sha256::add(std::span<const char> bytes) {
  state_->good =
      state_->good && EVP_DigestUpdate(state_->context.get(), bytes.data(), bytes.size()) == 1;
}

void Sha256::add_values(std::span<const double> values) {
  std::array<double, 512> plain{};
  while (!values.empty()) {
    const std::size_t n = std::min(values.size(), plain.size());
    for (std::size_t i = 0; i < n; ++i) {
      const double v = values[i];
      plain[i] = std::isnan(v) ? std::numeric_limits<double>::quiet_NaN() : (v == 0 ? 0.0 : v);
    }
    add(std::span(reinterpret_cast<const char*>(plain.data()), n * sizeof(double)));
    values = values.subspan(n);
  }
}

std::string Sha256::hex() {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned n = 0;
  state_->good = state_->good && EVP_DigestFinal_ex(state_->context.get(), digest.data(), &n) == 1;
  expect(state_->good, "libcrypto computes SHA-256");
  std::string text;
  for (unsigned i = 0; i < n; ++i) text += fmt::format("{:02x}", digest[i]);
  return text;
}

}  // namespace sturz
