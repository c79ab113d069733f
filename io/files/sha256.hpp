// SPDX-License-Identifier: Apache-2.0
/// SHA-256 of bytes that come piece by piece, through libcrypto.
#pragma once

#include <memory>
#include <span>
#include <string>

namespace sturz {

class Sha256 {
 public:
  Sha256();
  ~Sha256();
  Sha256(const Sha256&) = delete;
  Sha256& operator=(const Sha256&) = delete;

  void add(std::span<const char> bytes);
  /// 64 hexadecimal digits of all that was added; once. \throws std::logic_error when libcrypto has
  /// no SHA-256 or no memory
  std::string hex();

 private:
  struct Context;
  std::unique_ptr<Context> context_;
  bool good_ = false;
};

}  // namespace sturz
